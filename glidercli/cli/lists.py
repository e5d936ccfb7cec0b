"""``glider vehicles``, ``missions``, ``layouts``, ``coefficients geometries``: what is shipped, a plain line each."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from glidercli.cli.options import Debug, Force, Json, Quiet


def vehicles(json: Json = False, quiet: Quiet = False, debug: Debug = False) -> None:
    """List the shipped vehicles: name, two spaces, description."""
    from glidercli.vehicle import load_vehicle, shipped_vehicles

    _show({name: load_vehicle(name).description for name in shipped_vehicles()}, "vehicles", json)


def missions(json: Json = False, quiet: Quiet = False, debug: Debug = False) -> None:
    """List the shipped missions: name, two spaces, description."""
    from glidercli import shipped
    from glidercli.simulation.mission_file import load_mission

    _show({name: load_mission(name)[0].description for name in shipped.missions()}, "missions", json)


def geometries(json: Json = False, quiet: Quiet = False, debug: Debug = False) -> None:
    """List the shipped geometries: name, two spaces, description."""
    from glidercli.coefficients.shape.geometry import load_geometry, shipped_geometries

    _show({name: load_geometry(name)[0].description for name in shipped_geometries()}, "geometries", json)


def layouts(
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FOLDER", help="Write each to FOLDER/glider-NAME.json.")
    ] = None,
    fit: Annotated[
        str | None,
        typer.Option(
            "--for",
            metavar="LOG",
            help="Flight that the view of the whole fits; of a comparison's .mcap, plots of all.",
        ),
    ] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """List the shipped viewer layouts: name, two spaces, description; with -o, write them to import there."""
    from glidercli.cli.logs_in import LogSource
    from glidercli.errors import UsageError
    from glidercli.logio.layouts import LAYOUTS, together_in, write_layouts

    if fit is not None and output is None:
        raise UsageError("--for fits the files that -o FOLDER writes; -o FOLDER is needed")
    if output is not None:
        log = None if fit is None else LogSource().reading(fit).log
        write_layouts(output, force, log, None if fit is None else together_in(Path(fit)))
    _show(dict(LAYOUTS), "layouts", json)


def _show(found: dict[str, str], what: str, json: bool) -> None:
    from glidercli.cli.printing import json_text

    if json:
        print(json_text({what: [{"name": name, "description": text} for name, text in found.items()]}))
    else:
        for name, text in found.items():
            print(f"{name}  {text}")
