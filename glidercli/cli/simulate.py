"""``glider simulate``: fly a mission or three held controls."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any

import typer

from glidercli.cli.options import (
    CacheOption,
    ColumnsOption,
    Debug,
    Equations,
    EquationsOption,
    Force,
    Json,
    Quiet,
    output_option,
)

_MOST_EVENTS = 40  # lines of the summary


def simulate(
    mission: Annotated[
        str | None, typer.Argument(help="Mission: a TOML file or the name of a shipped one.", show_default=False)
    ] = None,
    ctd: Annotated[
        list[Path] | None,
        typer.Option(metavar="FILE|LOG", help="Water: .cnv, CSV, NetCDF or a log; several are casts in time."),
    ] = None,
    adcp: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="FILE|LOG", help="Current: CSV, NetCDF, RDI PD0, .ad2cp or a log; several are profiles in time."
        ),
    ] = None,
    controls: Annotated[
        str | None, typer.Option(metavar="LOG", help="Fly the actuators that a log recorded.", show_default=False)
    ] = None,
    initial: Annotated[
        str | None, typer.Option(metavar="LOG", help="Begin as a log shows at its first depth.", show_default=False)
    ] = None,
    trim: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE|-",
            help="Begin in a trim, what glider trim --json printed; without a mission hold its controls.",
        ),
    ] = None,
    net_buoyancy: Annotated[float | None, typer.Option(help="Held net buoyancy, kg, sinking positive.")] = None,
    mass_position: Annotated[float | None, typer.Option(help="Held position of the movable mass, m.")] = None,
    mass_rotation: Annotated[float | None, typer.Option(help="Held rotation of the movable mass, deg.")] = None,
    duration: Annotated[float | None, typer.Option(help="Length of the flight, s [default: 3600].")] = None,
    start_depth: Annotated[float | None, typer.Option(help="Depth of the start, m [default: 0].")] = None,
    latitude: Annotated[float | None, typer.Option(help="Latitude, deg: gravity, and pressure of a cast.")] = None,
    every: Annotated[float, typer.Option(help="Time between samples, s.")] = 1.0,
    rtol: Annotated[float, typer.Option(help="Relative tolerance of the integrator.")] = 1e-7,
    instruments: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE|none",
            help="Log what the sensors of a TOML file would read [default: the mission's]; none: the flight as it is.",
            show_default=False,
        ),
    ] = None,
    seed: Annotated[
        int | None, typer.Option(help="Of the instruments' noise [default: the mission's, else 0].", show_default=False)
    ] = None,
    vehicle: Annotated[
        str | None,
        typer.Option(
            metavar="NAME|FILE.toml", help="Vehicle [default: the mission's, else seawing].", show_default=False
        ),
    ] = None,
    equations: EquationsOption = Equations.FULL,
    cache: CacheOption = None,
    columns: ColumnsOption = None,
    output: Annotated[list[Path] | None, output_option(".mcap .rrd .nc .parquet .csv .png .svg .pdf")] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Full dynamics through measured water and current: a mission, held controls, or recorded ones."""
    from glidercli.cli.logs_in import LogSource, read_logs
    from glidercli.cli.outputs import check_log_outputs, log_sink
    from glidercli.cli.printing import json_text, warn
    from glidercli.cli.progress import progress
    from glidercli.cli.water_in import read_water
    from glidercli.kernel import tell_of_compiling
    from glidercli.provenance import provenance_json
    from glidercli.simulation import simulate as fly
    from glidercli.simulation.start import read_trim

    outputs = output or []
    check_log_outputs(outputs, force, json, quiet, pictures=True)
    source = LogSource(cache, columns)
    water, flow = read_water(ctd, source), read_water(adcp, source)
    logs = read_logs({"controls": controls, "initial": initial}, source)
    first = None if trim is None else read_trim(trim)
    files = [*logs.files, *([trim] if trim and str(trim) != "-" else []), *water.files, *flow.files]
    tell_of_compiling(lambda name: _say_compiling(name, quiet))
    with progress("the flight", "s", quiet) as bar, log_sink(outputs, force) as sink:
        flown = fly(
            mission,
            vehicle=vehicle,
            net_buoyancy=net_buoyancy,
            mass_position=mass_position,
            mass_rotation=None if mass_rotation is None else math.radians(mass_rotation),
            trim=first,
            controls=logs.read.get("controls"),
            initial=logs.read.get("initial"),
            ctd=water.sources or None,
            adcp=flow.sources or None,
            duration=duration,
            start_depth=start_depth,
            latitude=latitude,
            every=every,
            rtol=rtol,
            equations=equations.value,
            instruments=instruments,
            seed=seed,
            outputs=outputs,
            inputs=files,
            piece=sink.piece,
            progress=bar.tell,
        )
        origin = "simulated, from a reconstruction" if "reconstruction" in flown.log.metadata else "simulated"
        log = flown.log.with_metadata(provenance=provenance_json(inputs=flown.inputs, seed=flown.seed, origin=origin))
        bar.stage("writing")
        sink.finish(log)
    warn(list(dict.fromkeys([*logs.warnings, *water.warnings, *flow.warnings, *flown.warnings])), quiet)
    sink.say(quiet)
    if json:
        print(json_text(flown.document()))
    elif Path("-") not in outputs:
        print(_summary(flown.document()))


def _say_compiling(name: str, quiet: bool) -> None:
    """Say that the integrator is compiled; what else is takes a second."""
    from glidercli.cli.printing import say

    if name == "fly_stretch":
        say("compiling the flight model, once on this machine: some 10 s", quiet)


def _span(seconds: float) -> str:
    """A duration in s, and in hours or days where that says more."""
    if seconds < 7200.0:
        return f"{seconds:.1f} s"
    return f"{seconds:.1f} s, " + (f"{seconds / 3600.0:.1f} h" if seconds < 172800.0 else f"{seconds / 86400.0:.1f} d")


def _summary(d: dict[str, Any]) -> str:
    """The flight for people, a line each."""
    rate = d["simulated_seconds_per_second"]
    seen = ", AS ITS INSTRUMENTS WOULD RECORD IT" if d["instruments"] else ""
    remade = f" FROM A RECONSTRUCTION{seen}: {d['reconstruction']}" if d["reconstruction"] else seen
    lines = [f"SIMULATED{remade}"]
    if d["instruments"]:
        told = [f"{kind} {aboard['settings']['model'] or ''}".rstrip() for kind, aboard in d["instruments"].items()]
        lines.append(f"{'instruments':<17}{', '.join(told)}; seed {d['seed']}; below is the flight as it was")
    energy = d["energy"]
    kj = {name: energy[f"{name}_j"] / 1e3 for name in ("total", "pump", "slide", "rotation", "hotel", "per_dive")}
    lines += [
        f"{'duration':<17}{_span(d['duration_s'])}",
        f"{'maximum depth':<17}{d['max_depth_m']:.2f} m",
        f"{'distance':<17}{d['distance_m']:.1f} m over ground",
        f"{'energy':<17}{kj['total']:.2f} kJ: pump {kj['pump']:.2f}, slide {kj['slide']:.2f}, "
        f"rotation {kj['rotation']:.2f}, hotel {kj['hotel']:.2f}",
    ]
    if energy["dives"]:
        lines.append(f"{'per dive':<17}{kj['per_dive']:.2f} kJ, {energy['dives']} dives")
    lines += [
        f"{'on one battery':<17}{energy['endurance_s'] / 86400.0:.1f} days, {energy['range_m'] / 1e3:.0f} km over "
        f"ground, of {energy['battery_j'] / 1e6:g} MJ",
        f"{'lost to water':<17}{energy['lost_to_water_j']:.1f} J",
        f"{'net buoyancy':<17}{d['final']['net_buoyancy_kg']:z.3f} kg pumped, {d['net_buoyancy_in_water_kg']:z.3f} kg "
        "in the water at the end",
    ]
    events = d["events"]
    width = max(17, *(len(e["name"]) + 2 for e in events))
    told = [f"{e['name']:<{width}}{e['time_s']:.1f} s, {e['depth_m']:z.2f} m" for e in events]
    half = _MOST_EVENTS // 2
    if len(told) > _MOST_EVENTS:
        told[half:-half] = [f"... {len(told) - 2 * half} more events (--json has them all)"]
    lines += told
    final = d["final"]
    lines += [
        f"{'at the end':<17}pitch {final['pitch_deg']:z.2f} deg, roll {final['roll_deg']:z.2f} deg, heading "
        f"{final['heading_deg']:z.1f} deg, {final['speed_through_water_m_s']:.3f} m/s through water",
        f"{'integrated in':<17}{d['wall_s']:.3f} s" + (f", {rate:,.0f} simulated s/s" if rate else ""),
    ]
    return "\n".join(lines)
