"""``glider coefficients cases``: the CFD cases of Table 2, as a table for any solver."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from glidercli.cli.options import Debug, Force, Json, Quiet, output_option

if TYPE_CHECKING:
    pass


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
    from glidercli.cli.answers import give, wanted
    from glidercli.coefficients.base import read_base
    from glidercli.coefficients.flows.case_table import RADII
    from glidercli.coefficients.flows.case_table import cases as case_table
    from glidercli.coefficients.flows.text import text
    from glidercli.errors import InputError
    from glidercli.files import check_not_inputs
    from glidercli.keeping import TABLES, Kept, plain

    to = wanted(output, json, TABLES, force)
    water = _water(density, viscosity, temperature, salinity)
    inputs = [Path(vehicle)] if Path(vehicle).suffix else []
    check_not_inputs(to.files, inputs)
    base = read_base(vehicle)
    if base.hull is None:
        raise InputError(base.path, "has no hull; the cases need its length and diameter")
    table = case_table(base.hull, speed=speed, radii=radius or RADII, **water)
    lists = {name: plain(column) for name, column in table.columns.items()}
    rows = [dict(zip(lists, row, strict=True)) for row in zip(*lists.values(), strict=True)]
    found = Kept(lists, {"cases": rows, "counts": table.counts(), "warnings": table.warnings})
    give(
        found, to, text(table, base.name), inputs=inputs, origin="computed", warnings=table.warnings, force=force,
        quiet=quiet,
    )  # fmt: skip


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
    from glidercli.coefficients.flows.reynolds import seawater_viscosity
    from glidercli.ocean import seawater

    practical = 35.0 if salinity is None else salinity
    if not 0.0 <= practical <= 42.0:
        raise InputError("--salinity", f"{practical:g} is not allowed; 0 to 42 is")
    absolute = float(seawater.absolute_salinity(practical, 0.0, None, 0.0))
    viscous = seawater_viscosity(temperature, absolute)
    return {"density": float(seawater.density(absolute, temperature, 0.0)), "viscosity": viscous, **given}
