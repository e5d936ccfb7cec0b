"""``glider coefficients fit``: the coefficients of eq. (20) from a table of cases and forces."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from glidercli.cli.options import Debug, Force, Json, Quiet, output_option


def fit(
    forces: Annotated[
        Path,
        typer.Argument(
            metavar="FORCES.csv",
            help="Cases with forces: the table of `cases` with drag_N side_force_N lift_N roll_moment_N_m "
            "pitch_moment_N_m yaw_moment_N_m (flow frame), or body_x_force_N ... body_z_moment_N_m.",
        ),
    ],
    vehicle: Annotated[
        str | None,
        typer.Option(
            "--vehicle", metavar="NAME|FILE.toml", help="Shown beside the fit; supplies what a new vehicle file keeps."
        ),
    ] = None,
    density: Annotated[
        float | None,
        typer.Option(metavar="KG/M3", help="Of the water in the table, if it has no column density_kg_m3."),
    ] = None,
    partial: Annotated[
        bool, typer.Option("--partial", help="Fit what the table tells; the rest stays the vehicle's.")
    ] = False,
    hold: Annotated[
        list[str] | None, typer.Option(metavar="NAME", help="Coefficient that stays the vehicle's, as Kp; may repeat.")
    ] = None,
    subtract_munk: Annotated[
        bool,
        typer.Option(
            "--subtract-munk",
            help="The forces hold those of added mass, as CFD and tow tanks measure them; the model adds them itself, "
            "so take off what the vehicle's added mass gives.",
        ),
    ] = False,
    output: Annotated[
        list[Path] | None, output_option(".csv .json .parquet, a vehicle to .toml, residuals to .png .svg .pdf")
    ] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Coefficients of eq. (20) from forces, by least squares in the order of section 3.3, with standard errors."""
    from glidercli.cli.answers import give, not_whole, wanted
    from glidercli.cli.printing import finite
    from glidercli.coefficients.forces.figure import figure
    from glidercli.coefficients.forces.new_vehicle import new_vehicle
    from glidercli.coefficients.forces.result import fit as fitted
    from glidercli.coefficients.forces.telling import columns, document, text
    from glidercli.errors import UsageError
    from glidercli.files import check_not_inputs, readable_file
    from glidercli.keeping import TABLES, Kept
    from glidercli.pictures import PICTURES

    to = wanted(output, json, (*TABLES, ".toml", *PICTURES), force)
    if to.vehicles and vehicle is None:
        raise UsageError(f"-o {to.vehicles[0]}: a vehicle file needs --vehicle for what forces do not tell")
    inputs = [readable_file(forces), *([Path(vehicle)] if vehicle and Path(vehicle).suffix else [])]
    check_not_inputs(to.files, inputs)

    result = fitted(
        forces, vehicle=vehicle, density=density, subtract_munk=subtract_munk, partial=partial, hold=hold or []
    )
    warnings = list(result.warnings)
    made = ""
    for new in to.vehicles:
        assert result.base is not None
        made, lacking = new_vehicle(result, result.base, new.stem)
        warnings += not_whole(new, lacking)
    told = finite({**document(result), "warnings": warnings})
    found = Kept(columns(result), told, lambda: figure(result), made)
    give(found, to, text(result), inputs=inputs, origin="computed", warnings=warnings, force=force, quiet=quiet)
