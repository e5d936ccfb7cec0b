"""``glider compare``: a simulation held against a measured log or published values."""

from __future__ import annotations

import sys
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from glidercli.cli.logs_in import LogSource
from glidercli.cli.options import CacheOption, ColumnsOption, Debug, Force, Json, Quiet, output_option

if TYPE_CHECKING:
    from glidercli.compare import Facts
    from glidercli.log import Log


class Align(StrEnum):
    """How a simulated clock is laid on the measured one."""

    NONE = "none"
    START = "start"
    GPS = "gps"
    DIVE = "dive"
    XCORR = "xcorr"


def compare(
    measured: Annotated[
        str, typer.Argument(help="Measured log, a TOML file of published values, or the name of a shipped trial.")
    ],
    simulated: Annotated[list[str], typer.Argument(help="Simulated logs, one or more.")],
    align: Annotated[
        Align,
        typer.Option(
            help="Clocks: none as they are; at the first depth sample (start), position (gps) or dive; "
            "xcorr where the depths lie closest."
        ),
    ] = Align.NONE,
    offset: Annotated[float, typer.Option(metavar="S", help="Seconds added to the simulated times after that.")] = 0.0,
    max_gap: Annotated[
        float, typer.Option(metavar="S", help="Simulated samples further apart are not interpolated between, s.")
    ] = 60.0,
    channels: Annotated[
        list[str] | None, typer.Option(metavar="NAME", help="Channel or quoted pattern (mass_*); may repeat.")
    ] = None,
    depth_band: Annotated[
        float | None, typer.Option(metavar="M", help="Width of the bands of depth that errors are told by, m.")
    ] = None,
    cache: CacheOption = None,
    columns: ColumnsOption = None,
    output: Annotated[
        list[Path] | None, output_option(".csv .json .png .svg .pdf .html, flights and errors to .rrd .mcap")
    ] = None,
    force: Force = False,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """Errors of a simulation by channel and phase, or its verdicts on published values."""
    from glidercli.cli.printing import json_text, plain, say, shown, warn
    from glidercli.cli.progress import progress
    from glidercli.compare import SUFFIXES, matching, overlay, write
    from glidercli.compare import compare as compared
    from glidercli.compare.align import MOST_OFFSET
    from glidercli.errors import InputError, OutputError, UsageError
    from glidercli.files import check_not_inputs, check_outputs
    from glidercli.logio import VIEWERS, saving
    from glidercli.provenance import provenance

    if not max_gap > 0.0:
        raise InputError("--max-gap", f"{max_gap} s is not allowed; a positive time is needed")
    if not abs(offset) <= MOST_OFFSET:
        raise InputError("--offset", f"{offset:g} s is not allowed; {-MOST_OFFSET:g} to {MOST_OFFSET:g} are")
    if depth_band is not None and not depth_band >= 0.1:
        raise InputError("--depth-band", f"{depth_band:g} m is not allowed; 0.1 m or more is needed")
    try:
        matching(channels or [])
    except InputError as error:
        raise UsageError(f"--channels: {error}") from error
    files = [path for path in output or [] if path != Path("-")]
    check_outputs(files, (*SUFFIXES, *VIEWERS), force)
    recordings = [path for path in files if path.suffix.lower() in VIEWERS]
    tables = [path for path in files if path not in recordings]

    source = LogSource(cache, columns)
    with progress("reading", "", quiet) as bar:
        facts = _facts_file(measured)
        inputs: list[Path] = []
        against: Log | Facts
        if facts is not None:
            from glidercli.compare import read_facts

            if recordings:
                told = f"not written: {facts} holds published values, which are no recording to overlay"
                raise OutputError(recordings[0], f"{told}; a measured LOG is needed, or one of {' '.join(SUFFIXES)}")
            against = read_facts(facts)
            inputs.append(facts)
            if align != Align.NONE or offset or depth_band is not None:
                warn(["--align, --offset and --depth-band have no effect on a comparison with published values"], quiet)
        else:
            against = _log(measured, source, inputs, quiet)
        logs = [_log(name, source, inputs, quiet) for name in simulated]
        bar.stage("comparing")
        check_not_inputs(files, [*inputs, *source.files])
        comparison = compared(
            against,
            logs,
            align=align.value,
            offset=offset,
            max_gap=max_gap,
            channels=channels,
            depth_band=depth_band,
            names=_called([measured, *simulated]),
        )
        recorded = [run.side for run in comparison.runs if run.side.origin in ("measured", "derived")]
        warn([f"{side.name} is {side.origin}, and stands here as a simulation" for side in recorded], quiet)
        record = provenance(inputs=dict.fromkeys(inputs), origin=comparison.origin)
        if recordings:
            bar.stage("writing")
            log, beside, names, errors = overlay(comparison, record)
            with saving(recordings, force, (), beside, names, errors) as shown_together:
                shown_together.add(log)
                shown_together.close(log)
                write(comparison, *tables, provenance=record, force=force)
        else:
            write(comparison, *tables, provenance=record, force=force)
    for path in files:
        say(f"wrote {path}", quiet)
    if json or Path("-") in (output or []):
        print(json_text(comparison.document()))
    else:
        for line in comparison.text().split("\n"):
            prose = line.endswith((".", ":"))  # rows of tables stay whole
            print(shown(line, sys.stdout) if prose else plain(line))


def _called(arguments: list[str]) -> list[str]:
    """What each log is called in every output: as given, controls written out, numbered where given more than once."""
    from glidercli.cli.printing import plain

    names = [plain(text) for text in arguments]
    return [f"{name} ({names[: i + 1].count(name)})" if names.count(name) > 1 else name for i, name in enumerate(names)]


def _facts_file(text: str) -> Path | None:
    """The facts TOML that an argument stands for: itself, in a folder or in a shipped trial; None for a log."""
    from glidercli import shipped
    from glidercli.files import readable_file

    path = Path(text)
    if path.suffix.lower() == ".toml":
        return readable_file(path)
    if (path / "facts.toml").is_file():
        return path / "facts.toml"
    folder = None if path.exists() else shipped.find(text)
    return None if folder is None else readable_file(folder / "facts.toml")


def _log(text: str, source: LogSource, inputs: list[Path], quiet: bool) -> Log:
    """Read one log; its files join the inputs."""
    from glidercli.cli.printing import warn

    reading = source.reading(text)
    inputs += reading.inputs
    for file in reading.files:
        lost = ", ".join(f"{count} {reason}" for reason, count in file.dropped)
        counted = [f"{file.records - file.kept} of {file.records} records dropped: {lost}"] if lost else []
        broken = [file.error] if file.error else []
        warn([f"{file.path}: {message}" for message in (*broken, *counted, *file.warnings)], quiet)
    return reading.log
