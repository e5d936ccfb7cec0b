"""``glider replay``: recorded logs, every record accounted for, into MCAP, Rerun and CSV."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from glidercli.cli.options import CacheOption, ColumnsOption, Debug, Force, FormatOption, Json, Quiet, output_option

if TYPE_CHECKING:
    from glidercli.live import Choices
    from glidercli.logio import Reading


def replay(
    log: Annotated[
        list[str], typer.Argument(metavar="LOG...", help="Files, folders or quoted globs.", show_default=False)
    ],
    format: FormatOption = None,
    cache: CacheOption = None,
    columns: ColumnsOption = None,
    start: Annotated[
        str | None,
        typer.Option(metavar="T", help="From: ISO 8601 UTC, or s since the start; records are counted of whole files."),
    ] = None,
    end: Annotated[str | None, typer.Option(metavar="T", help="To, not included: ISO 8601 UTC, or s.")] = None,
    strict: Annotated[bool, typer.Option("--strict", help="A file that cannot be read is a failure.")] = False,
    attach: Annotated[bool, typer.Option("--attach", help="Put the files that were read into the .mcap.")] = False,
    beside: Annotated[
        list[str] | None,
        typer.Option("--with", metavar="LOG", help="Show it beside, in the .rrd, with differences; may repeat."),
    ] = None,
    spawn: Annotated[bool, typer.Option("--spawn", help="Open the Rerun viewer.")] = False,
    serve: Annotated[
        bool, typer.Option("--serve", help="Serve the Rerun web viewer on 127.0.0.1 until Ctrl-C.")
    ] = False,
    foxglove: Annotated[bool, typer.Option("--foxglove", help="Play to a Foxglove WebSocket on 127.0.0.1.")] = False,
    rate: Annotated[
        float | None,
        typer.Option(metavar="X", help="Play at X times real time: to --spawn, --serve, --foxglove (default)."),
    ] = None,
    follow: Annotated[
        bool, typer.Option("--follow", help="Show files as they grow, to the same viewers; Ctrl-C ends it.")
    ] = False,
    port: Annotated[
        int | None,
        typer.Option(metavar="N", help="Of --serve (9090), else of the WebSocket (8765).", show_default=False),
    ] = None,
    wait: Annotated[float, typer.Option(metavar="S", help="How long a play waits for a WebSocket viewer.")] = 60.0,
    output: Annotated[list[Path] | None, output_option(".mcap .rrd .nc .parquet .csv")] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Recorded field logs: what they hold, into MCAP, Rerun and CSV, and live in viewers."""
    from glidercli.cli.logs_in import cores
    from glidercli.cli.outputs import check_log_outputs, write_log
    from glidercli.cli.printing import json_text, say, shown, warn
    from glidercli.cli.progress import progress
    from glidercli.errors import InputError, UsageError
    from glidercli.live.choices import Choices, check_choices
    from glidercli.logio import replay as play
    from glidercli.logio.replaying import check_beside

    outputs = output or []
    choices = Choices(spawn=spawn, serve=serve, foxglove=foxglove, rate=rate, follow=follow, port=port, wait=wait)
    check_choices(choices)
    if follow and (start is not None or end is not None):
        raise UsageError("--follow shows all that comes; leave out --start and --end")
    check_beside(beside or (), outputs)  # a play or files that grow may take long before
    check_log_outputs(outputs, force, json, quiet)
    files = [path for path in outputs if path != Path("-")]
    reading = None
    if follow:
        reading = _followed(log, format, cache, columns, choices, quiet)
        if reading is None:
            raise InputError(" ".join(log), "held no whole record while it was followed; nothing was written")
    with progress("reading", "files", quiet) as bar:
        played = play(
            log, files, format=format, start=start, end=end, strict=strict, force=force, attach=attach,
            beside=beside or (), cache=cache, columns=columns, workers=cores(), progress=bar.tell, stage=bar.stage,
            reading=reading,
        )  # fmt: skip
    warn((f"{report.path}: {report.error}" for report in played.broken), quiet)
    for path in files:
        say(f"wrote {path}", quiet)
    if stdout := Path("-") in outputs:
        write_log(played.log, [Path("-")], force, quiet)
    if json:
        print(json_text(played.document()))
    elif not stdout:
        for line in _summary(played.document(), played.log.kind, played.log.metadata):
            print(shown(line, sys.stdout))
    if choices.live and not follow:
        from glidercli.live import show

        sys.stdout.flush()
        show(played.log, choices, lambda line: say(line, quiet))


def _followed(
    log: list[str], format: str | None, cache: Path | None, columns: Path | None, choices: Choices, quiet: bool
) -> Reading | None:
    """Show files as they grow; what they held at the end, by whole records."""
    from glidercli.cli.printing import say
    from glidercli.live import follow, following

    def tell(line: str) -> None:
        say(line, quiet)

    with following(log, format, cache, columns, tell) as follower:
        follow(follower, choices, tell)
        return follower.reading


def _summary(d: dict[str, Any], kind_of_log: str, metadata: Mapping[str, str]) -> list[str]:
    """Files, channels and what to know of them, for people, a line each."""
    lines = [kind_of_log, f"{'file':<34} {'format':<12} {'records':>8} {'kept':>8}  dropped"]
    for f in d["files"]:
        gone = ", ".join(f"{item['count']} {item['reason']}" for item in f["dropped"]) or "none"
        gone = "; ".join([f["error"], gone] if f["dropped"] else [f["error"]]) if "error" in f else gone
        name, kind = Path(f["path"]).name, f["format"] or "-"
        lines.append(f"{name:<34} {kind:<12} {f['records']:>8} {f['kept']:>8}  {gone}")
        lines += [f"    {warning}" for warning in f["warnings"] if warning != f.get("error")]
    lines += [f"not looked at: {line}" for line in d["passed_over"]]
    if d["part"] is not None:
        first, last = d["part"]["start"] or "the start", d["part"]["end"] or "the end"
        lines.append(f"records above are of whole files; samples below from {first} to {last}, not included")
    lines.append(f"{'channel':<30} {'samples':>8} {'minimum':>12} {'maximum':>12}  origin")
    for c in d["channels"]:
        low, high = ("-" if v is None else f"{v:z.6g}" for v in (c["minimum"], c["maximum"]))
        lines.append(f"{c['name']:<30} {c['samples']:>8} {low:>12} {high:>12}  {c['origin']}")
    notes = {key: text for key, text in metadata.items() if key.endswith(("_note", "_zero"))}
    return lines + [f"{key.replace('_', ' ')}: {text}" for key, text in notes.items()]
