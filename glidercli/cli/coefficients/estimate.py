"""``glider coefficients estimate``: hydrodynamic coefficients of a shape by handbook formulas, without CFD."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from glidercli.cli.options import Debug, Force, Json, Quiet, output_option


def estimate(
    geometry: Annotated[
        str, typer.Argument(metavar="GEOMETRY", help="Geometry: a TOML file or the name of a shipped one.")
    ],
    vehicle: Annotated[
        str | None,
        typer.Option(
            metavar="NAME|FILE.toml", help="Vehicle to hold them against and to write into; need not be whole."
        ),
    ] = None,
    speed: Annotated[float, typer.Option(help="Speed at which friction and damping are to hold, m/s.")] = 0.257,
    viscosity: Annotated[float, typer.Option(help="Of the water, Pa s.")] = 1.2124e-3,
    angle: Annotated[
        float | None,
        typer.Option(
            help="Largest angle of attack and sideslip, deg [default: the vehicle's, else 12].", show_default=False
        ),
    ] = None,
    output: Annotated[
        list[Path] | None, output_option("a vehicle .toml, estimates .json .csv .parquet, a figure .png .svg .pdf")
    ] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:  # fmt: skip
    """Estimate the coefficients of eq. (20) from a shape by handbook formulas, with intervals, without CFD.

    How far off, against three vehicles: typically a factor of 1.2 in drag, 1.5 in lift and side force, 1.7 in moments
    and damping, at worst 1.4, 2.4, 3.2 and 6; roll by 7 or not at all. Fit for straight glides, not for spirals. The
    tables are in docs/estimates.md.
    """
    import dataclasses
    import math

    from glidercli.cli.answers import give, not_whole, wanted
    from glidercli.coefficients.base import read_base
    from glidercli.coefficients.handbook.estimate import FITTED, estimate
    from glidercli.coefficients.handbook.output import answer, vehicle_text
    from glidercli.coefficients.handbook.text import text
    from glidercli.coefficients.shape.geometry import load_geometry
    from glidercli.errors import InputError
    from glidercli.files import check_not_inputs
    from glidercli.keeping import TABLES
    from glidercli.pictures import PICTURES

    to = wanted(output, json, (".toml", *TABLES, *PICTURES), force)
    if angle is not None and not 0.1 <= angle <= 30.0:
        raise InputError("--angle", f"{angle:g} deg is not allowed; 0.1 to 30 are")
    shape, shape_file = load_geometry(geometry)
    base = None if vehicle is None else read_base(vehicle)
    inputs = [shape_file] + ([] if base is None else [base.path])
    check_not_inputs(to.files, inputs)
    warnings = []
    fitted = FITTED if angle is None else math.radians(angle)
    if base is not None:
        if base.density is not None:
            shape = dataclasses.replace(shape, density=base.density)
        if angle is None and base.fitted_angle is not None:
            fitted = min(base.fitted_angle, math.radians(30.0))
            if fitted < base.fitted_angle:
                warnings.append(
                    f"{base.path}: fitted_angle {math.degrees(base.fitted_angle):g} deg; estimates go up to 30"
                )
        if base.added_mass is None:
            warnings.append(f"{base.path}: no whole added_mass; K_M and K_MY hold with the geometry's own")
    found = estimate(shape, speed, viscosity, fitted, None if base is None else base.added_mass)
    made = ""
    for new in to.vehicles:
        made, lacking = vehicle_text(found, base, new.stem)
        warnings += not_whole(new, lacking)
    give(
        answer(found, base, made), to, text(found, base), inputs=inputs, origin="estimated",
        warnings=[*found.warnings, *warnings], force=force, quiet=quiet,
    )  # fmt: skip
