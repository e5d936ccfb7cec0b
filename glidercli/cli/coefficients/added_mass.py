"""``glider coefficients added-mass``: the water that a shape drags along, by strip theory."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from glidercli.cli.options import Debug, Force, Json, Quiet, output_option


def added_mass(
    geometry: Annotated[
        str, typer.Argument(metavar="GEOMETRY", help="Geometry: a TOML file or the name of a shipped one.")
    ],
    vehicle: Annotated[
        str | None,
        typer.Option(
            metavar="NAME|FILE.toml", help="Vehicle to set beside it, and to begin a .toml from.", show_default=False
        ),
    ] = None,
    plain_strips: Annotated[
        bool, typer.Option("--plain-strips", help="To the vehicle file: strips alone, as the paper has them.")
    ] = False,
    output: Annotated[
        list[Path] | None,
        output_option("a vehicle .toml, terms .json .csv .parquet, a drawing .png .svg .pdf"),
    ] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Added mass and inertia of hull, wings and fins about the centre of buoyancy, as section 2.5 of the paper."""
    from glidercli.cli.answers import give, not_whole, wanted
    from glidercli.coefficients.added.added_mass import added_mass as estimated
    from glidercli.coefficients.added.added_mass import answer, terms_of
    from glidercli.coefficients.added.rest import rest
    from glidercli.coefficients.added.text import text
    from glidercli.coefficients.base import read_base
    from glidercli.coefficients.shape.geometry import load_geometry
    from glidercli.files import check_not_inputs
    from glidercli.keeping import TABLES
    from glidercli.pictures import PICTURES
    from glidercli.vehicle.writing import revised

    to = wanted(output, json, (".toml", *TABLES, *PICTURES), force)
    shape, path = load_geometry(geometry)
    base = None if vehicle is None else read_base(vehicle)
    inputs = [path] if base is None else [path, base.path]
    check_not_inputs(to.files, inputs)

    found = estimated(shape)
    warnings = found.notes()
    beside = None if base is None else terms_of(base)
    hull = found.strips["hull"] if plain_strips else found.corrected["hull"]
    left = None if beside is None else rest(beside[1], hull, shape, found.origin)
    made = ""
    for new in to.vehicles:
        tables = found.numbers(not plain_strips, f"{shape.name} ({path.name})")
        changed = f"hull and added mass of {shape.name}"
        made, lacking = revised(base.path if base else None, tables, name=new.stem, changed=changed)
        warnings += not_whole(new, lacking)
        if base is not None and "KM" in base.coefficients:
            warnings.append(
                f"K_M and K_MY stay those of {base.name}; estimates, and fits with --subtract-munk, hold with the "
                "added mass that they were made with, and are to be made anew"
            )
    give(
        answer(found, beside, left, made), to, text(found, beside, left), inputs=inputs, origin="estimated",
        warnings=warnings, force=force, quiet=quiet,
    )  # fmt: skip
