"""``glider trim``: the steady flight of three controls, or the controls of a steady flight."""

from __future__ import annotations

import math
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from glidercli.cli.options import Debug, Equations, Force, Json, Quiet, Vehicle, output_option

if TYPE_CHECKING:
    from glidercli.trim.recursion import Recursion

_PINS = "Pins: three that determine a trim"


class Method(StrEnum):
    """How a trim is solved."""

    ROOT = "root"
    RECURSION = "recursion"
    RECURSION_PRINTED = "recursion-printed"


def trim(
    speed: Annotated[float | None, typer.Option(help="Speed through water, m/s.", rich_help_panel=_PINS)] = None,
    angle_of_attack: Annotated[float | None, typer.Option(help="Angle of attack, deg.", rich_help_panel=_PINS)] = None,
    sideslip: Annotated[float | None, typer.Option(help="Sideslip, deg.", rich_help_panel=_PINS)] = None,
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
    equations: Annotated[
        Equations | None,
        typer.Option(
            help="full: the whole model; paper: as printed, CA left out [default: full; paper with recursion].",
            show_default=False,
        ),
    ] = None,
    method: Annotated[
        Method,
        typer.Option(
            help="root: from the controls; recursion: from speed and flow angles; recursion-printed: for the record."
        ),
    ] = Method.ROOT,
    trace: Annotated[bool, typer.Option("--trace", help="Print every iterate of the recursion, eq. (44).")] = False,
    output: Annotated[list[Path] | None, output_option(".json .csv")] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Steady flight: a straight glide or a spiral, from its controls, or its controls from the flight."""
    from glidercli.cli.printing import json_text, warn
    from glidercli.errors import UsageError
    from glidercli.files import check_outputs

    flow = {"speed": speed, "angle-of-attack": angle_of_attack, "sideslip": sideslip}
    controls = {"net-buoyancy": net_buoyancy, "mass-position": mass_position, "mass-rotation": mass_rotation}
    by_recursion = method is not Method.ROOT
    taken = _pins(method, *((flow, controls) if by_recursion else (controls, flow)))
    if by_recursion and equations is Equations.FULL:
        raise UsageError(f"--method {method.value} solves the paper's equilibrium; --equations full contradicts it")
    if trace and not by_recursion:
        raise UsageError("--trace prints the iterates of --method recursion; it needs that method")
    outputs = output or []
    if json and Path("-") in outputs:
        raise UsageError("-o - and --json both want stdout; leave one out")
    check_outputs(outputs, (".json", ".csv"), force)
    traced: list[dict[str, Any]] = []

    def look(sequences: list[Recursion]) -> None:
        traced.extend(map(_sequence, sequences))
        if trace and not json and Path("-") not in outputs:
            print("\n\n".join(map(_trace, traced)), end="\n\n", flush=True)

    if by_recursion:
        from glidercli.trim import trims_by_recursion

        found = trims_by_recursion(
            vehicle,
            speed=taken[0],
            angle_of_attack=math.radians(taken[1]),
            sideslip=math.radians(taken[2]),
            printed=method is Method.RECURSION_PRINTED,
            look=look,
        )
    else:
        from glidercli.trim import trim as solve

        one = solve(
            vehicle,
            net_buoyancy=taken[0],
            mass_position=taken[1],
            mass_rotation=math.radians(taken[2]),
            equations=(equations or Equations.FULL).value,
        )
        found = [one]
    warn(found[0].warnings, quiet)
    document: dict[str, Any] = {"trims": [one.document() for one in found]}
    if trace:
        document["trace"] = traced
    for path in outputs:
        _write(document, path, vehicle, force)
    if json:
        print(json_text(document))
    elif Path("-") not in outputs:
        titles = [f"solution {i} of {len(found)}\n" if len(found) > 1 else "" for i in range(1, len(found) + 1)]
        print("\n\n".join(title + _table(one) for title, one in zip(titles, document["trims"], strict=True)))


def _pins(method: Method, wanted: dict[str, float | None], others: dict[str, float | None]) -> list[float]:
    """The values of the three pins that a method takes; UsageError where one is missing or another is given."""
    from glidercli.errors import UsageError

    extra = [f"--{name}" for name, value in others.items() if value is not None]
    if extra:
        takes = ", ".join(f"--{name}" for name in wanted)
        raise UsageError(f"--method {method.value} takes {takes}; it cannot take {', '.join(extra)}")
    missing = [f"--{name}" for name, value in wanted.items() if value is None]
    if missing:
        raise UsageError(f"too few pins: {' and '.join(missing)} would complete the trim")
    return [value for value in wanted.values() if value is not None]


def _sequence(one: Recursion) -> dict[str, Any]:
    """One sequence of the recursion as plain values: the vector D of eq. (44), pass by pass."""
    rows = [
        {
            "pitch_deg": math.degrees(D.pitch),
            "roll_deg": math.degrees(D.roll),
            "net_buoyancy_kg": D.mb,
            "mass_rotation_deg": math.degrees(D.gamma),
            "yaw_rate_rad_s": D.omega3,
            "mass_position_m": D.rrx,
        }
        for D in one.iterates
    ]
    return {"start": one.start, "converged": one.converged, "residual": one.residual, "iterates": rows}


def _trace(sequence: dict[str, Any]) -> str:
    """A sequence for people, a line each pass."""
    rows = sequence["iterates"]
    end = "a trim" if sequence["converged"] else "no trim"
    lines = [f"{sequence['start']}: {end}, residual {sequence['residual']:.1e} N or N m"]
    lines.append("pass  " + "  ".join(f"{name:>18}" for name in rows[0]))
    lines += [f"{i:>4}  " + "  ".join(f"{v:>18.12f}" for v in row.values()) for i, row in enumerate(rows, start=1)]
    return "\n".join(lines)


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
