"""``glider coefficients estimate``: hydrodynamic coefficients of a shape by handbook formulas, without CFD."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from glidercli.cli.options import Debug, Force, Json, Quiet, output_option

if TYPE_CHECKING:
    from glidercli.coefficients.base import Base
    from glidercli.coefficients.estimate import Estimated

_ERROR_BAR = (
    "How far off, against three vehicles (docs/estimates.md): typically a factor of 1.2 in drag, 1.5 in lift and side "
    "force, 1.7 in moments and damping, at worst 1.4, 2.4, 3.2 and 6; roll by 7 or not at all. Fit for straight "
    "glides, not for spirals."
)


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

    from glidercli.cli.printing import json_text, say, warn
    from glidercli.coefficients.base import read_base
    from glidercli.coefficients.estimate import FITTED, estimate
    from glidercli.coefficients.estimate_output import answer, vehicle_text
    from glidercli.coefficients.geometry import load_geometry
    from glidercli.errors import InputError, UsageError
    from glidercli.files import check_not_inputs, check_outputs
    from glidercli.keeping import TABLES, keep, write_csv
    from glidercli.pictures import PICTURES
    from glidercli.provenance import provenance

    outputs = output or []
    files = [path for path in outputs if path != Path("-")]
    if json and Path("-") in outputs:
        raise UsageError("-o - and --json both want stdout; leave one out")
    check_outputs(files, (".toml", *TABLES, *PICTURES), force)
    new = [path for path in files if path.suffix.lower() == ".toml"]
    for option, value, least, most, unit in (
        ("--speed", speed, 1e-3, 20.0, "m/s"), ("--viscosity", viscosity, 1e-4, 0.1, "Pa s"),
        ("--angle", 12.0 if angle is None else angle, 0.1, 30.0, "deg"),
    ):  # fmt: skip
        if not least <= value <= most:
            raise InputError(option, f"{value:g} {unit} is not allowed; {least:g} to {most:g} are")

    shape, shape_file = load_geometry(geometry)
    base = None if vehicle is None else read_base(vehicle)
    inputs = [shape_file] + ([] if base is None else [base.path])
    check_not_inputs(files, inputs)
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
    record = provenance(inputs=inputs, origin="estimated")
    made, lacking = vehicle_text(found, base, new[0].stem) if new else ("", [])
    kept = answer(found, base, made)
    keep(kept, *files, record=record, force=force)
    warn(warnings + found.warnings, quiet)
    for path in files:
        say(f"wrote {path}", quiet)
    if lacking:
        say(f"{new[0]} is no whole vehicle yet; it lacks {', '.join(lacking)}", quiet)
    if json:
        print(json_text(kept.document))
    elif Path("-") in outputs:
        write_csv(kept, sys.stdout)
    else:
        print("\n".join(_text(found, base)))


def _number(value: float) -> str:
    """Four digits, which is more than estimates have."""
    return f"{value + 0.0:.4g}"


def _text(found: Estimated, base: Base | None) -> list[str]:
    """The coefficients for people."""
    import math

    from glidercli.cli.printing import plain, wrapped
    from glidercli.coefficients.estimate_output import of_base

    lines = wrapped(
        f"ESTIMATED from {found.geometry.name} by handbook formulas, no CFD, nothing measured; at {found.speed:g} m/s, "
        f"up to {math.degrees(found.angle):g} deg, in water of {found.geometry.density:g} kg/m3."
    )
    over = f"{plain(base.name)[:9]:>10}  ratio" if base is not None and base.coefficients else ""
    lines += ["", f"{'':8}{'unit':10}{'estimate':>9}  {'interval':>19}{over}"]
    for one in found.coefficients.values():
        total = one.total
        interval = f"{_number(total.lower):>8} ..{_number(total.upper):>8}"
        line = f"{one.row.symbol:8}{one.row.unit:10}{_number(total.value):>9}  {interval}"
        own = None if base is None else of_base(base, one)
        if own is not None:
            ratio = "" if own.ratio is None else f"{own.ratio:.2f}"
            line += f"{_number(own.value):>10}{ratio:>7}  {'inside' if own.inside else 'outside'}"
        lines.append(line.rstrip())
        shares = ", ".join(f"{part} {_number(bounds.value)}" for part, bounds in one.parts.items())
        lines += [f"  {line}" for line in wrapped(plain(shares), 76)] if len(one.parts) > 1 else []
    pitch, yaw = (found.coefficients[symbol].total.value for symbol in ("K_M", "K_MY"))
    lines += ["", *wrapped(
        f"K_M and K_MY come without the Munk moments that the model has from the added mass, "
        f"{_number(found.munk[0])} and {_number(found.munk[1])} kg/rad; whole moments "
        f"{_number(pitch + found.munk[0])} and {_number(yaw + found.munk[1])} kg/rad."
    ), *wrapped(_ERROR_BAR)]  # fmt: skip
    return lines
