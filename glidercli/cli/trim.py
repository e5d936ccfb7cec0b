"""``glider trim``: the steady flight of three controls."""

from __future__ import annotations

import math
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer

from glidercli.cli.options import Debug, Equations, EquationsOption, Force, Json, Quiet, Vehicle, output_option

_PINS = "Pins: three that determine a trim"


class Method(StrEnum):
    """How a trim is solved."""

    ROOT = "root"


def trim(
    net_buoyancy: Annotated[
        float | None, typer.Option(help="Net buoyancy, kg, sinking positive.", rich_help_panel=_PINS)
    ] = None,
    mass_position: Annotated[
        float | None, typer.Option(help="Position of the movable mass, m, forward.", rich_help_panel=_PINS)
    ] = None,
    mass_rotation: Annotated[
        float | None, typer.Option(help="Rotation of the movable mass, deg.", rich_help_panel=_PINS)
    ] = None,
    vehicle: Vehicle = "seawing",
    equations: EquationsOption = Equations.FULL,
    method: Annotated[Method, typer.Option(help="How the trim is solved.")] = Method.ROOT,
    output: Annotated[list[Path] | None, output_option(".json .csv")] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Steady flight: a straight glide or a spiral, from net buoyancy, mass position and mass rotation."""
    from glidercli.cli.printing import json_text, warn
    from glidercli.errors import UsageError
    from glidercli.files import check_outputs
    from glidercli.trim import trim as solve

    pins = {"net-buoyancy": net_buoyancy, "mass-position": mass_position, "mass-rotation": mass_rotation}
    missing = [f"--{name}" for name, value in pins.items() if value is None]
    if net_buoyancy is None or mass_position is None or mass_rotation is None:
        raise UsageError(f"too few pins: {' and '.join(missing)} would complete the trim")
    outputs = output or []
    if json and Path("-") in outputs:
        raise UsageError("-o - and --json both want stdout; leave one out")
    check_outputs(outputs, (".json", ".csv"), force)
    found = solve(
        vehicle,
        net_buoyancy=net_buoyancy,
        mass_position=mass_position,
        mass_rotation=math.radians(mass_rotation),
        equations=equations.value,
    )
    warn(found.warnings, quiet)
    document = {"trims": [found.document()]}
    for path in outputs:
        _write(document, path, vehicle, force)
    if json:
        print(json_text(document))
    elif Path("-") not in outputs:
        print(_table(found.document()))


def _write(document: dict[str, Any], path: Path, vehicle: str, force: bool) -> None:
    """One output: JSON with its provenance inside, or a CSV with it beside."""
    from glidercli.cli.printing import finite, json_text
    from glidercli.files import atomic
    from glidercli.provenance import provenance

    inputs = [Path(vehicle)] if Path(vehicle).suffix else []
    record = provenance(inputs=inputs, origin="computed")
    if str(path) == "-":
        print(json_text(document))
    elif path.suffix.lower() == ".json":
        with atomic(path, force) as part:
            part.write_text(json_text({**document, "provenance": record}) + "\n", encoding="utf-8")
    else:
        rows = [finite(row) for row in document["trims"]]
        lines = [",".join(rows[0])] + [",".join("" if v is None else str(v) for v in row.values()) for row in rows]
        beside = path.with_name(path.name + "-metadata.json")
        with atomic(path, force) as part, atomic(beside, force) as metadata:
            part.write_text("\n".join(lines) + "\n", encoding="utf-8")
            metadata.write_text(json_text(record) + "\n", encoding="utf-8")


def _table(t: dict[str, Any]) -> str:
    """The trim for people: the ten parameters, then what follows from them."""
    radius = f"{t['turning_radius_m']:.2f} m" if math.isfinite(t["turning_radius_m"]) else "straight"
    vertical = t["vertical_speed_m_s"]
    rows = [
        ("speed", f"{t['speed_m_s']:.4f} m/s"),
        ("angle of attack", f"{t['angle_of_attack_deg']:.4f} deg"),
        ("sideslip", f"{t['sideslip_deg']:.4f} deg"),
        ("yaw rate", f"{t['yaw_rate_rad_s']:.6f} rad/s ({t['yaw_rate_deg_s']:.4f} deg/s)"),
        ("roll", f"{t['roll_deg']:.4f} deg"),
        ("pitch", f"{t['pitch_deg']:.4f} deg"),
        ("mass position", f"{t['mass_position_m']:.4f} m"),
        ("mass rotation", f"{t['mass_rotation_deg']:.2f} deg"),
        ("net buoyancy", f"{t['net_buoyancy_kg']:.4f} kg"),
        ("turning radius", radius),
        ("vertical speed", f"{abs(vertical):.4f} m/s {'down' if vertical >= 0.0 else 'up'}"),
        ("horizontal speed", f"{t['horizontal_speed_m_s']:.4f} m/s"),
        ("glide angle", f"{t['glide_angle_deg']:.2f} deg"),
        ("lift to drag", f"{t['lift_to_drag']:.3f}"),
        ("residual", f"{t['residual']:.1e} N or N m, {t['iterations']} iterations, {t['equations']} equations"),
        ("stable", "yes" if t["stable"] else "no"),
        ("within limits", "yes" if t["within_limits"] else "no"),
    ]
    return "\n".join(f"{name:<17}{value}" for name, value in rows)
