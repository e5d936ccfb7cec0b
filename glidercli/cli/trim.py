"""``glider trim``: steady flights from any three of their ten quantities, sweeps of them, and the polar."""

from __future__ import annotations

import math
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from glidercli.cli.options import Debug, Equations, Force, Json, Quiet, Vehicle, output_option

if TYPE_CHECKING:
    from glidercli.cli.progress import Bar
    from glidercli.trim import Trim
    from glidercli.trim.output import Answer
    from glidercli.trim.recursion import Recursion

    _Told = tuple[Answer, list[str], str]  # what is kept, what is warned of, what a terminal shows

_PINS = "Pins: three that determine a trim"
_SHOWN = 200  # rows of a sweep that a terminal is asked to show; a file takes all


class Method(StrEnum):
    """How a trim is solved."""

    ROOT = "root"
    RECURSION = "recursion"
    RECURSION_PRINTED = "recursion-printed"


def _pin(text: str) -> Any:
    """The option of a pin."""
    return typer.Option(help=text, rich_help_panel=_PINS, show_default=False)


def trim(
    speed: Annotated[float | None, _pin("Speed through water, m/s.")] = None,
    angle_of_attack: Annotated[float | None, _pin("Angle of attack, deg.")] = None,
    sideslip: Annotated[float | None, _pin("Sideslip, deg.")] = None,
    yaw_rate: Annotated[
        float | None, _pin("Turning rate about the vertical, deg/s, to starboard; 0 asks for a straight glide.")
    ] = None,
    roll: Annotated[float | None, _pin("Roll, deg, starboard down.")] = None,
    pitch: Annotated[float | None, _pin("Pitch, deg, nose up.")] = None,
    mass_position: Annotated[float | None, _pin("Position of the movable mass, m, forward.")] = None,
    mass_rotation: Annotated[float | None, _pin("Rotation of the movable mass, deg.")] = None,
    net_buoyancy: Annotated[float | None, _pin("Net buoyancy, kg, sinking positive.")] = None,
    turning_radius: Annotated[float | None, _pin("Turning radius, m, to starboard; inf is straight.")] = None,
    sweep: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=START:STOP:STEP",
            help="Sweep a pin in the unit of its option; may repeat. One makes curves, two a map.",
            show_default=False,
        ),
    ] = None,
    polar: Annotated[
        bool, typer.Option("--polar", help="Every straight glide, the best, fastest and cheapest of them.")
    ] = False,
    current: Annotated[
        float | None, typer.Option(help="For --polar: a current against the vehicle, m/s.", show_default=False)
    ] = None,
    hotel_power: Annotated[
        float | None, typer.Option(help="For --polar: power besides the pump's, W.", show_default=False)
    ] = None,
    pump_efficiency: Annotated[
        float | None, typer.Option(help="For --polar: of the pump, 0 to 1.", show_default=False)
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
            help="root: any three pins; recursion: from speed and flow angles; recursion-printed: for the record."
        ),
    ] = Method.ROOT,
    linearize: Annotated[
        bool, typer.Option("--linearize", help="The modes of small deviations: eigenvalues, damping, time to half.")
    ] = False,
    trace: Annotated[bool, typer.Option("--trace", help="Print every iterate of the recursion, eq. (44).")] = False,
    output: Annotated[list[Path] | None, output_option(".json .csv .parquet .png .svg .pdf")] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Steady flight: a straight glide or a spiral, from any three of the ten quantities that describe it."""
    from glidercli.cli.answers import wanted
    from glidercli.cli.printing import json_text, say, warn
    from glidercli.cli.progress import progress
    from glidercli.errors import UsageError
    from glidercli.files import check_not_inputs
    from glidercli.keeping import TABLES
    from glidercli.pictures import PICTURES
    from glidercli.provenance import provenance
    from glidercli.trim.output import SUFFIXES, write
    from glidercli.trim.pins import QUANTITIES

    pins: dict[str, float] = {
        name: value * QUANTITIES[name].factor
        for name, value in {
            "speed": speed, "angle_of_attack": angle_of_attack, "sideslip": sideslip, "yaw_rate": yaw_rate,
            "roll": roll, "pitch": pitch, "mass_position": mass_position, "mass_rotation": mass_rotation,
            "net_buoyancy": net_buoyancy, "turning_radius": turning_radius,
        }.items()
        if value is not None
    }  # fmt: skip
    journey = {"current": current, "hotel_power": hotel_power, "pump_efficiency": pump_efficiency}
    by_recursion = method is not Method.ROOT
    form = equations or (Equations.PAPER if by_recursion else Equations.FULL)
    if by_recursion and form is Equations.FULL:
        raise UsageError(f"--method {method.value} solves the paper's equilibrium; --equations full contradicts it")
    if trace and not by_recursion:
        raise UsageError("--trace prints the iterates of --method recursion; it needs that method")
    if sum((by_recursion, bool(sweep), polar)) > 1:
        raise UsageError("--method recursion, --sweep and --polar are three questions; ask one at a time")
    alone = [f"--{name.replace('_', '-')}" for name, value in journey.items() if value is not None]
    if alone and not polar:
        raise UsageError(f"{alone[0]} is part of --polar; it needs that option")
    if polar and linearize:
        raise UsageError("--linearize is for trims and sweeps; it cannot take --polar")
    to = wanted(output, json, SUFFIXES, force)
    inputs = [Path(vehicle)] if Path(vehicle).suffix else []
    check_not_inputs(to.files, inputs)
    pictures = [path for path in to.files if path.suffix.lower() in PICTURES]
    if pictures and not polar and not 1 <= len(sweep or []) <= 2:
        raise UsageError(f"-o {pictures[0]}: a picture shows one --sweep, two, or --polar; else {' '.join(TABLES)}")

    with progress("the search", "points" if sweep else "", quiet) as bar:
        if polar:
            answer, warnings, text = _polar(vehicle, pins, journey, form)
        elif sweep:
            answer, warnings, text = _sweep(vehicle, pins, sweep, form, linearize, bar)
        elif by_recursion:
            answer, warnings, text = _recursion(vehicle, pins, method, linearize, trace)
        else:
            answer, warnings, text = _root(vehicle, pins, form, linearize)
        bar.stage("writing")
        write(answer, *to.files, record=provenance(inputs=inputs, origin="computed"), force=force)
    warn(warnings, quiet)
    for path in to.files:
        say(f"wrote {path}", quiet)
    print(json_text(answer.document()) if to.json or to.stdout else text)


def _root(vehicle: str, pins: dict[str, float], form: Equations, linearize: bool) -> _Told:
    """One question, every solution."""
    from glidercli.trim import trims

    return _answered(trims(vehicle, equations=form.value, **pins), linearize)


def _recursion(vehicle: str, pins: dict[str, float], method: Method, linearize: bool, trace: bool) -> _Told:
    """The same by the paper's recursion, with its iterates where they are wanted; they are shown even if it fails."""
    from glidercli.cli.trim_text import passes
    from glidercli.errors import NoSolutionError, UsageError
    from glidercli.trim import trims_by_recursion
    from glidercli.trim.pins import spelled

    taken = ("speed", "angle_of_attack", "sideslip")
    for named, what in (([n for n in pins if n not in taken], "it cannot take"), (
        [n for n in taken if n not in pins], "missing:")):  # fmt: skip
        if named:
            takes, told = ", ".join(map(spelled, taken)), ", ".join(map(spelled, named))
            raise UsageError(f"--method {method.value} takes {takes}; {what} {told}")
    sequences: list[Recursion] = []
    try:
        found = trims_by_recursion(
            vehicle, **pins, printed=method is Method.RECURSION_PRINTED, look=lambda ran: sequences.extend(ran)
        )
    except NoSolutionError:
        if trace:
            print("\n\n".join(passes(_sequence(one, [])) for one in sequences), flush=True)
        raise
    answer, warnings, text = _answered(found, linearize)
    if not trace:
        return answer, warnings, text
    traced = [_sequence(one, found) for one in sequences]
    answer = answer._replace(beside={"trace": traced})
    return answer, warnings, "\n\n".join([*map(passes, traced), text])


def _answered(found: list[Trim], linearize: bool) -> _Told:
    """Trims of one question, as they are kept, warned of and shown."""
    from glidercli.cli.printing import finite
    from glidercli.cli.trim_text import several_trims
    from glidercli.trim.output import Answer, columns_of

    rows = [one.document() for one in found]
    columns = columns_of(rows)
    if linearize:
        rows = [{**row, "modes": [m.document() for m in one.modes()]} for row, one in zip(rows, found, strict=True)]
    which = f"solution 1 of {len(found)}: " if len(found) > 1 else ""
    warnings = [which + line for line in found[0].warnings]
    return Answer(columns, [finite(row) for row in rows], {}, None), warnings, several_trims(rows)


def _sweep(vehicle: str, pins: dict[str, float], texts: list[str], form: Equations, linearize: bool, bar: Bar) -> _Told:
    """A sweep of one pin or more: every point's trims, and the points that have none."""
    from glidercli.cli.trim_text import rows_text
    from glidercli.trim import sweep
    from glidercli.trim.figure import figure
    from glidercli.trim.output import Answer, rows_of
    from glidercli.trim.pins import QUANTITIES
    from glidercli.trim.stability import modes
    from glidercli.trim.sweeping import axis

    axes = tuple(axis(text) for text in texts)
    found = sweep(vehicle, axes, equations=form.value, linearize=linearize, progress=bar.tell, **pins)
    missing = [{**found.at(number), "reason": reason} for number, reason in sorted(found.missing.items())]
    columns = {**found.table, "solution": found.solution}
    rows = None
    if found.linear is not None:
        rows = [
            {**row, "modes": [mode.document() for mode in modes(A)]}
            for row, A in zip(rows_of(columns), found.linear, strict=True)
        ]
    fixed = ", ".join(
        f"{name.replace('_', ' ')} {value / QUANTITIES[name].factor:g} {QUANTITIES[name].unit}"
        for name, value in pins.items()
    )
    title = f"{vehicle}, {form.value} equations" + (f": {fixed}" if fixed else "")
    answer = Answer(columns, rows, {"points": found.points, "missing": missing}, lambda: figure(found, title))
    shown = {name: column[: _SHOWN + 1] for name, column in columns.items()}
    return answer, found.warnings, rows_text(rows_of(shown), _SHOWN, len(found.point))


def _polar(vehicle: str, pins: dict[str, float], journey: dict[str, float | None], form: Equations) -> _Told:
    """The polar of a vehicle and the best points on it."""
    from glidercli.cli.trim_text import best_text
    from glidercli.errors import UsageError
    from glidercli.trim import polar
    from glidercli.trim.output import Answer, rows_of
    from glidercli.trim.pins import spelled
    from glidercli.trim.polar_figure import figure
    from glidercli.trim.polars import BEST, Journey

    others = [spelled(name) for name in pins if name != "net_buoyancy"]
    if others:
        raise UsageError(f"--polar takes --net-buoyancy at most; it cannot take {', '.join(others)}")
    way = Journey(**{name: value for name, value in journey.items() if value is not None})
    found = polar(vehicle, net_buoyancy=pins.get("net_buoyancy"), journey=way, equations=form.value)
    on_curves = found.curve != BEST
    columns = {name: column[on_curves] for name, column in found.table.items()}
    document = found.document()
    answer = Answer(columns, rows_of(columns), {"polar": document}, lambda: figure(found, way, vehicle))
    return answer, found.warnings, best_text(document, way.current)


def _sequence(one: Recursion, found: list[Trim]) -> dict[str, Any]:
    """One sequence of the recursion as plain values: the vector D of eq. (44), pass by pass, and what came of it."""
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
    outcome = "no trim"
    for number, trim in enumerate(found, start=1):
        off = (one.last.mb - trim.net_buoyancy, one.last.rrx - trim.mass_position, one.last.gamma - trim.mass_rotation)
        if one.converged and max(map(abs, off)) < 1e-9:
            outcome = f"solution {number}"
    return {
        "start": one.start, "converged": one.converged, "outcome": outcome, "residual": one.residual, "iterates": rows,
    }  # fmt: skip
