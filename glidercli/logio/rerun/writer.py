"""Writes a Log as one Rerun recording (.rrd): the flight in three dimensions, every channel as a plot, its origin."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from glidercli.channels import CHANNELS, PHASES
from glidercli.errors import OutputError
from glidercli.log import Log
from glidercli.logio.rerun import blueprint as look
from glidercli.logio.rerun.scene import Scene, columns

if TYPE_CHECKING:
    from rerun.chunk import Chunk

__all__ = ["write_rerun"]

ORIGINS = {
    "simulated": "Computed by a model. Nothing here was measured.",
    "measured": "Recorded by an instrument at sea. Channels that were computed from it are named below.",
    "reconstruction": "Rebuilt from published values. It is not a recording.",
    "derived": "Computed from measured channels.",
}


def write_rerun(log: Log, path: Path) -> None:
    """Write the log to `path` as a Rerun recording with its blueprint; the same log gives the same bytes.

    Timelines are utc and elapsed (from the log's first sample). Each channel keeps its own times and stands under
    /GROUP/NAME in table units (degrees, dbar, cm3), depth negative down; the scene stands under /world in NED, m.
    Raises OutputError for a log without a single sample.
    """
    import rerun as rr

    log = log.sliced(None, None)  # without channels that are empty
    if not log.channels:
        raise OutputError(path, "not written: the log holds no sample")
    rr.set_strict_mode(True)
    digest, scene = _digest(log), Scene(log)
    page = rr.TextDocument(_about(log, scene.draw()), media_type=rr.MediaType.MARKDOWN)
    chunks = [*_header(log), *_plots(log), *scene.chunks, look.row("/about", page)]
    blueprint: Any = look.Settled(log, scene.camera, scene.has_hull, scene.has_plan, digest)
    recording = rr.RecordingStream("glider", recording_id=digest[:32], send_properties=False)
    recording.set_log_time_enabled(False)
    recording.save(path, default_blueprint=blueprint)
    rr.send_chunks(look.identified(chunks, digest), recording=recording)
    recording.flush()
    recording.disconnect()
    look.settle(path, digest)


def _digest(log: Log) -> str:
    """SHA-256 of all that a log holds, hexadecimal; the order of channels does not count."""
    told = [log.origin, [*log.metadata.items()], [(e.name, e.time_ns, e.depth) for e in log.events]]
    whole = hashlib.sha256(json.dumps(told).encode())
    for name, channel in sorted(log.channels.items()):
        whole.update(f"{name} {channel.origin} {len(channel)} ".encode())
        whole.update(channel.time_ns.tobytes() + channel.values.tobytes())
    return whole.hexdigest()


def _header(log: Log) -> Iterator[Chunk]:
    """Name and start of the recording, and its events."""
    import rerun as rr

    name = f"{log.kind} {np.datetime64(log.start_ns // 10**9, 's')} UTC"
    yield look.row("/__properties", rr.archetypes.RecordingInfo(start_time=log.start_ns, name=name))
    if log.events:
        texts = [e.name if e.depth is None else f"{e.name}, depth {e.depth:.1f} m" for e in log.events]
        times = np.array([e.time_ns for e in log.events], dtype=np.int64)
        yield columns("/events", log.start_ns, times, rr.TextLog.columns(text=texts, level=["INFO"] * len(texts)))


def _plots(log: Log) -> Iterator[Chunk]:
    """Each channel as a line in table units; heading as points, which do not join 359 to 0; phases as states."""
    import rerun as rr

    for name in (name for name in CHANNELS if name in log):
        spec, channel, entity = CHANNELS[name], log[name], f"/{CHANNELS[name].group}/{name}"
        if name == "phase":
            yield look.row(entity, rr.StateConfiguration(values=PHASES, colors=[*look.PHASE_COLOURS.values()]))
            changed = np.flatnonzero(np.diff(channel.values, prepend=-1.0))
            states = rr.StateChange.columns(state=[PHASES[int(value)] for value in channel.values[changed]])
            yield columns(entity, log.start_ns, channel.time_ns[changed], states)
            continue
        style: dict[str, Any] = {"names": look.series_name(name), "colors": look.COLOURS.get(name, look.GREY)}
        dots = name == "heading"
        yield look.row(
            entity, rr.SeriesPoints(marker_sizes=1.5, **style) if dots else rr.SeriesLines(widths=1.5, **style)
        )
        values = channel.values * (-1.0 if name == "depth" else spec.factor)
        yield columns(entity, log.start_ns, channel.time_ns, rr.Scalars.columns(scalars=values))


def _about(log: Log, notes: list[str]) -> str:
    """The about page, Markdown: where the values come from, how they are drawn, metadata, provenance."""
    lines = [f"# {log.kind}", "", ORIGINS[log.origin], ""]
    told = {key: value for key, value in log.metadata.items() if key != "provenance"}
    if remade := told.pop("reconstruction", ""):
        lines += [f"**Reconstruction**: {_plain(remade)}", ""]
    others: dict[str, list[str]] = {}
    for name in (name for name in CHANNELS if name in log):
        if log[name].origin != log.origin:
            others.setdefault(log[name].origin, []).append(name.replace("_", " "))
    lines += [f"- **{origin}**: {', '.join(names)}" for origin, names in others.items()]
    lines += ["", "## How it is drawn", "", *(f"- {note}" for note in notes)]
    for title, entries in (("Metadata", told), ("Provenance", _record(log))):
        lines += ["", f"## {title}", "", *_entries(entries)] if entries else []
    return "\n".join(lines) + "\n"


def _record(log: Log) -> dict[str, Any]:
    """The provenance as a dictionary; a record that is no JSON object stands as it is, under "record"."""
    text = log.metadata.get("provenance", "{}")
    try:
        record = json.loads(text)
    except ValueError:
        record = text
    return record if isinstance(record, dict) else {"record": text}


def _entries(entries: dict[str, Any]) -> Iterator[str]:
    """A Markdown list of keys and values, which wraps where a table would be cut off; an item each of many inputs."""
    for key, value in entries.items():
        for one in value if isinstance(value, list) and key != "command" else [value]:
            words = [f"{k} {v}" for k, v in one.items()] if isinstance(one, dict) else one
            yield f"- **{_plain(key)}**: {_plain(' '.join(map(str, words)) if isinstance(words, list) else str(words))}"


def _plain(text: str) -> str:
    """Text as it stands, on one line, whatever Markdown would make of its signs."""
    return re.sub(r"([\\`*_<>|\[\]#~])", r"\\\1", " ".join(text.split()))
