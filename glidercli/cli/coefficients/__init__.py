"""``glider coefficients``: from shape and forces to the numbers of a vehicle file."""

from __future__ import annotations

import typer

from glidercli.cli import lists
from glidercli.cli.coefficients import added_mass, cases, estimate, fit

app = typer.Typer(
    help="Where a vehicle's numbers come from: added mass, the CFD cases, the fit, estimates.",
    rich_markup_mode=None,
    no_args_is_help=True,
)
app.command("added-mass", no_args_is_help=True, short_help="The added mass of a shape.")(added_mass.added_mass)
app.command("cases", short_help="The CFD cases of Table 2, for any program.")(cases.cases)
app.command("fit", no_args_is_help=True, short_help="The coefficients from a table of forces.")(fit.fit)
app.command("estimate", no_args_is_help=True, short_help="The coefficients of a shape, without CFD.")(estimate.estimate)
app.command("geometries")(lists.geometries)
