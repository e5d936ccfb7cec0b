"""``glider coefficients added-mass``: the water that a shape drags along, by strip theory."""

from __future__ import annotations

import sys
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
    from glidercli.cli.printing import json_text, say, shown, warn
    from glidercli.coefficients.added_mass import added_mass as estimated
    from glidercli.coefficients.added_mass import answer, terms_of
    from glidercli.coefficients.added_mass_text import text
    from glidercli.coefficients.base import read_base
    from glidercli.coefficients.geometry import load_geometry
    from glidercli.coefficients.rest import rest
    from glidercli.errors import UsageError
    from glidercli.files import check_not_inputs, check_outputs
    from glidercli.keeping import TABLES, keep, write_csv
    from glidercli.pictures import PICTURES
    from glidercli.provenance import provenance
    from glidercli.vehicle.writing import revised

    outputs = output or []
    stdout = Path("-") in outputs
    if json and stdout:
        raise UsageError("-o - and --json both want stdout; leave one out")
    files = [path for path in outputs if path != Path("-")]
    check_outputs(files, (".toml", *TABLES, *PICTURES), force)
    shape, path = load_geometry(geometry)
    base = None if vehicle is None else read_base(vehicle)
    inputs = [path] if base is None else [path, base.path]
    check_not_inputs(files, inputs)

    found = estimated(shape)
    beside = None if base is None else terms_of(base)
    hull = found.strips["hull"] if plain_strips else found.corrected["hull"]
    left = None
    if beside is not None:
        left = rest(beside[1], hull, shape, found.origin)
    record = provenance(inputs=inputs, origin="estimated")
    made, lacking = "", list[str]()
    if toml := [item for item in files if item.suffix.lower() == ".toml"]:
        tables = found.numbers(not plain_strips, f"{shape.name} ({path.name})")
        changed = f"hull and added mass of {shape.name}"
        made, lacking = revised(base.path if base else None, tables, name=toml[0].stem, changed=changed)
    kept = answer(found, beside, left, made)
    keep(kept, *files, record=record, force=force)
    warn(found.notes(), quiet)
    for item in files:
        say(f"wrote {item}", quiet)
    if lacking:
        say(f"{toml[0]} is no whole vehicle yet; it lacks {', '.join(lacking)}", quiet)
    if json:
        print(json_text(kept.document))
    elif stdout:
        write_csv(kept, sys.stdout)
    else:
        for line in text(found, beside, left).split("\n"):
            print(shown(line, sys.stdout))
