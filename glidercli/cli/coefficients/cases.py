"""``glider coefficients cases``: the CFD cases of Table 2, as a table for any solver."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from glidercli.cli.options import Debug, Force, Json, Quiet, output_option

if TYPE_CHECKING:
    from glidercli.coefficients.case_table import CaseTable


def cases(
    vehicle: Annotated[
        str, typer.Option("--vehicle", metavar="NAME|FILE.toml", help="Vehicle whose hull is meant.")
    ] = "seawing",
    speed: Annotated[float, typer.Option(metavar="M/S", help="Speed of every case, m/s.")] = 0.257,
    radius: Annotated[
        list[float] | None,
        typer.Option(
            metavar="M", help="Radius of turn, m; may repeat. Default: 5, 10, 20, 30, 40.", show_default=False
        ),
    ] = None,
    density: Annotated[
        float | None, typer.Option(metavar="KG/M3", help="Of the water, kg/m3. Default: 1025, the paper's.")
    ] = None,
    viscosity: Annotated[
        float | None,
        typer.Option(
            metavar="PA_S", help="Dynamic, Pa s. Default: 1.2124e-3, which gives the paper's Reynolds numbers."
        ),
    ] = None,
    temperature: Annotated[
        float | None, typer.Option(metavar="DEGC", help="Density and viscosity of seawater at the surface, degC.")
    ] = None,
    salinity: Annotated[
        float | None, typer.Option(metavar="PSU", help="Practical salinity, with --temperature. Default: 35.")
    ] = None,
    output: Annotated[list[Path] | None, output_option(".csv .json .parquet")] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """The CFD cases that the fit needs: Table 2 of the paper, with velocities, rates and the flow domain."""
    from glidercli.cli.printing import json_text, say, warn
    from glidercli.coefficients.case_table import RADII
    from glidercli.coefficients.case_table import cases as case_table
    from glidercli.errors import UsageError
    from glidercli.files import check_not_inputs, check_outputs
    from glidercli.keeping import TABLES, Kept, keep, plain, write_csv
    from glidercli.provenance import provenance
    from glidercli.vehicle import load_vehicle

    outputs = output or []
    stdout = Path("-") in outputs
    if json and stdout:
        raise UsageError("-o - and --json both want stdout; leave one out")
    water = _water(density, viscosity, temperature, salinity)
    files = [path for path in outputs if path != Path("-")]
    inputs = [Path(vehicle)] if Path(vehicle).suffix else []
    check_outputs(outputs, TABLES, force)
    check_not_inputs(files, inputs)
    hull = load_vehicle(vehicle).hull
    table = case_table(hull, speed=speed, radii=radius or RADII, **water)
    lists = {name: plain(column) for name, column in table.columns.items()}
    rows = [dict(zip(lists, row, strict=True)) for row in zip(*lists.values(), strict=True)]
    document = {"cases": rows, "counts": table.counts(), "warnings": table.warnings}
    found = Kept(lists, document)
    keep(found, *files, record=provenance(inputs=inputs, origin="computed"), force=force)
    warn(table.warnings, quiet)
    for path in files:
        say(f"wrote {path}", quiet)
    if stdout:
        write_csv(found, sys.stdout)
    else:
        print(json_text(document) if json else _text(table, vehicle))


def _water(
    density: float | None, viscosity: float | None, temperature: float | None, salinity: float | None
) -> dict[str, Any]:
    """Density and viscosity: as given, else of seawater at a temperature, else the paper's."""
    from glidercli.errors import InputError, UsageError

    given = {name: value for name, value in (("density", density), ("viscosity", viscosity)) if value is not None}
    if temperature is None:
        if salinity is not None:
            raise UsageError("--salinity is part of --temperature; it needs that option")
        return given
    if len(given) == 2:
        raise UsageError("--temperature gives density and viscosity; leave it out, or one of --density, --viscosity")
    from glidercli.coefficients.reynolds import seawater_viscosity
    from glidercli.ocean import seawater

    practical = 35.0 if salinity is None else salinity
    if not 0.0 <= practical <= 42.0:
        raise InputError("--salinity", f"{practical:g} is not allowed; 0 to 42 is")
    absolute = float(seawater.absolute_salinity(practical, 0.0, None, 0.0))
    viscous = seawater_viscosity(temperature, absolute)
    return {"density": float(seawater.density(absolute, temperature, 0.0)), "viscosity": viscous, **given}


def _text(table: CaseTable, vehicle: str) -> str:
    """The table for people: how many of what, the water, the domain, a line a radius."""
    column = table.columns
    counts = table.counts()
    first = {name: values[0] for name, values in column.items()}
    lines = [
        f"{len(column['case'])} cases for {vehicle}",
        f"straight         {counts['straight']}, k-epsilon: angle of attack or sideslip -12 to 12 deg by 1",
        f"turning          {counts['about-p3']} about p3, {counts['about-p2']} about p2, k-omega, at each radius:",
        "                 sideslip -3 0 3 6 9 12 deg, angle of attack -3 3 6 9 deg",
        f"speed            {first['speed_m_s']:g} m/s, Reynolds number {first['reynolds_number']:.3g}",
        f"water            {first['density_kg_m3']:.6g} kg/m3, {first['viscosity_Pa_s']:.5g} Pa s",
        f"domain           {first['domain_length_m']:.4g} m long, {first['domain_width_m']:.4g} m wide and high,",
        f"                 inlet {first['inlet_distance_m']:.4g} m ahead of the centre of buoyancy",
        "",
        "radius m   rate rad/s   inlet m/s: inner edge   centre   outer edge",
    ]
    turning = column["set"] == "about-p3"
    names = ("turning_radius_m", "angular_speed_rad_s", "inlet_speed_inner_m_s", "inlet_speed_centre_m_s",
             "inlet_speed_outer_m_s")  # fmt: skip
    shown = dict.fromkeys(zip(*(column[name][turning].tolist() for name in names), strict=True))
    lines += [f"{r:>8g}   {w:>10.5f}   {a:>21.4f}   {b:>6.4f}   {c:>10.4f}" for r, w, a, b, c in shown]
    return "\n".join(lines)
