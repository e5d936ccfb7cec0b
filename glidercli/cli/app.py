"""The application: its commands and the options that stand before a command."""

from __future__ import annotations

from typing import Annotated

import typer

from glidercli.cli import coefficients, compare, info, lists, replay, simulate, trim

app = typer.Typer(
    name="glider",
    help="Mission analysis and log replay for underwater gliders.",
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    no_args_is_help=True,
    add_completion=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _show_version(value: bool) -> None:
    if value:
        from glidercli.provenance import version

        print(f"glider {version()}")
        raise typer.Exit


@app.callback()
def _before(
    version: Annotated[
        bool, typer.Option("--version", help="Show the version and exit.", callback=_show_version, is_eager=True)
    ] = False,
) -> None:
    pass


app.command("trim", no_args_is_help=True)(trim.trim)
app.command("simulate", no_args_is_help=True)(simulate.simulate)
app.command("replay", no_args_is_help=True)(replay.replay)
app.command("info", no_args_is_help=True)(info.info)
app.command("compare", no_args_is_help=True)(compare.compare)
app.add_typer(coefficients.app, name="coefficients")
app.command("vehicles")(lists.vehicles)
app.command("missions")(lists.missions)
app.command("layouts")(lists.layouts)
