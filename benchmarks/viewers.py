"""How fast are logs written for viewers, and in how much memory? MCAP and Rerun beside what their libraries offer.

    python benchmarks/viewers.py              speeds side by side, then memory for a day and ten
    python benchmarks/viewers.py --month      thirty days, too (some minutes)

MCAP: the same messages by this writer, which encodes them from the log as well; by mcap.writer.Writer, one
``add_message`` each of bytes that are ready; and by the Rust writer of foxglove-sdk, one ``log`` each of the same bytes
(no dependency: pip install foxglove-sdk). Rerun: the same samples by this writer, track, hull and blueprint included;
one by one with ``log``; and with nothing but ``send_columns``. Medians of interleaved runs on one log of a day at one
second; the libraries' loops get a part of it, as they are slow. Memory is what a process of its own takes at most while
it writes, beyond the log and the loaded libraries (Linux). Other work on the machine moves all alike: read the ratios.
"""

from __future__ import annotations

import importlib.util
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from glidercli.log import Channel, Event, Log

DAY = 86_400
RUNS = 5
LOOPED = 50_000
"""Messages and samples that the libraries' loops get."""
START = 1_600_000_000 * 10**9
WANTED = {"mcap": 130_000, "rrd": 1_000_000}


def flight(seconds: int) -> Log:
    """A yo-yo at one second: 16 channels, as a simulated mission has them."""
    s = np.arange(seconds, dtype=float)
    times = START + np.arange(seconds, dtype=np.int64) * 10**9
    noise = np.random.default_rng(1)
    depth = 100.0 - 100.0 * np.cos(s / 900.0)
    values = {
        "depth": depth, "down": depth, "north": 0.3 * s, "east": 100.0 * np.sin(s / 500.0),
        "roll": 0.1 * np.sin(s / 10.0), "pitch": 0.4 * np.sin(s / 900.0), "heading": s / 500.0 % 6.28,
        "mass_position": 0.4 + 0.01 * np.sin(s / 900.0), "mass_rotation": 0.5 * np.sin(s / 1000.0),
        "ballast_volume": 1e-4 * np.sin(s / 900.0), "temperature": 10.0 + noise.normal(size=seconds),
        "salinity": 35.0 + 0.1 * np.sin(s / 100.0), "conductivity": 4.0 + 0.01 * noise.normal(size=seconds),
        "phase": s // 2827 % 2 + 1.0, "current_east": 0.1 * np.sin(s / 3000.0), "current_north": 0.1 * np.cos(s / 3e3),
    }  # fmt: skip
    channels = {name: Channel(name, times, value, "simulated") for name, value in values.items()}
    return Log(channels, "simulated", {"title": "a yo-yo"}, (Event("apogee", int(times[seconds // 2]), 200.0),))


def ours(log: Log, path: Path) -> None:
    if path.suffix == ".mcap":
        from glidercli.logio.mcap.writer import write_mcap

        write_mcap(log, path)
    else:
        from glidercli.logio.rerun.writer import write_rerun

        write_rerun(log, path)


def messages_of(path: Path) -> tuple[list[tuple[int, int, bytes]], dict[int, tuple[str, str, bytes]]]:
    """Channel, time and bytes of a file's first messages; topic, and name and data of the schema, of each channel."""
    from mcap.reader import make_reader

    kept: list[tuple[int, int, bytes]] = []
    told: dict[int, tuple[str, str, bytes]] = {}
    with path.open("rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            assert schema is not None
            told[channel.id] = (channel.topic, schema.name, schema.data)
            kept.append((channel.id, message.log_time, message.data))
            if len(kept) == LOOPED:
                break
    return kept, told


def mcap_writer(messages: list[Any], told: dict[int, Any], path: Path) -> None:
    from mcap.writer import CompressionType, Writer

    with path.open("wb") as stream:
        writer = Writer(stream, compression=CompressionType.ZSTD)
        writer.start()
        ids = {
            number: writer.register_channel(topic, "protobuf", writer.register_schema(name, "protobuf", data))
            for number, (topic, name, data) in told.items()
        }
        for number, time_ns, data in messages:
            writer.add_message(ids[number], time_ns, data, time_ns)
        writer.finish()


def foxglove_writer(messages: list[Any], told: dict[int, Any], path: Path) -> None:
    import foxglove
    from foxglove import Channel as Topic
    from foxglove import Context, Schema
    from foxglove.mcap import MCAPCompression, MCAPWriteOptions

    context = Context()
    options = MCAPWriteOptions(compression=MCAPCompression.Zstd)
    writer = foxglove.open_mcap(str(path), context=context, writer_options=options)
    topics = {
        number: Topic(
            topic,
            schema=Schema(name=name, encoding="protobuf", data=data),
            message_encoding="protobuf",
            context=context,
        )
        for number, (topic, name, data) in told.items()
    }
    for number, time_ns, data in messages:
        topics[number].log(data, log_time=time_ns)
    writer.close()


def rerun_loop(log: Log, path: Path) -> None:
    import rerun as rr

    recording = rr.RecordingStream("bench")
    recording.save(path)
    rows = LOOPED // len(log.channels)
    for i in range(rows):
        recording.set_time("utc", timestamp=np.datetime64(int(log["depth"].time_ns[i]), "ns"))
        for name, channel in log.channels.items():
            recording.log(name, rr.Scalars(channel.values[i]))
    recording.flush()
    recording.disconnect()


def rerun_columns(log: Log, path: Path) -> None:
    import rerun as rr

    recording = rr.RecordingStream("bench")
    recording.save(path)
    for name, channel in log.channels.items():
        times = rr.TimeColumn("utc", timestamp=channel.time_ns.astype("datetime64[ns]"))
        recording.send_columns(name, [times], rr.Scalars.columns(scalars=channel.values))
    recording.flush()
    recording.disconnect()


def speeds(runs: dict[str, tuple[int, Callable[[Path], None]]], folder: Path, suffix: str) -> dict[str, float]:
    """Items per second of each way of writing, median of interleaved runs after one that is not counted."""
    walls: dict[str, list[float]] = {name: [] for name in runs}
    for run in range(RUNS + 1):
        for name, (_, write) in runs.items():
            path = folder / f"a{suffix}"
            path.unlink(missing_ok=True)
            began = time.perf_counter()
            write(path)
            if run:
                walls[name].append(time.perf_counter() - began)
    return {name: items / statistics.median(walls[name]) for name, (items, _) in runs.items()}


def show(what: str, unit: str, found: dict[str, float], wanted: float) -> None:
    first = next(iter(found.values()))
    for name, speed in found.items():
        ratio = "" if speed == first else f"{first / speed:10.2f}"
        print(f"{what:<7}{name:<34}{speed:14,.0f} {unit}{ratio}")
    print(f"{'':7}{'wanted':<34}{wanted:14,.0f} {unit}: {'met' if first >= wanted else 'MISSED'}")


def peak(seconds: int, target: str) -> tuple[float, float, float]:
    """Memory that writing a log takes beside the log itself, MB, wall s of it, and MB of the file; in a new process."""
    done = subprocess.run([sys.executable, __file__, "--one", str(seconds), target], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stderr)
    memory, wall, size = map(float, done.stdout.split())
    return memory, wall, size


def one(seconds: int, target: Path) -> None:
    ours(flight(600), target)  # the libraries are loaded: they are not what grows with the log
    log = flight(seconds)
    Path("/proc/self/clear_refs").write_text("5")  # the peak so far is forgotten: what made the log does not count
    before = resident("VmRSS")
    began = time.perf_counter()
    ours(log, target)
    wall = time.perf_counter() - began
    print(resident("VmHWM") - before, wall, target.stat().st_size / 1e6)


def resident(key: str) -> float:
    """MB of this process in memory: now (VmRSS) or at most (VmHWM); Linux."""
    lines = dict(line.split(":", 1) for line in Path("/proc/self/status").read_text().splitlines())
    return int(lines[key].split()[0]) / 1e3


def main(month: bool) -> None:
    log = flight(DAY)
    samples = sum(map(len, log.channels.values()))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ours(log, folder / "a.mcap")
        from mcap.reader import make_reader

        with (folder / "a.mcap").open("rb") as stream:
            summary = make_reader(stream).get_summary()
        assert summary is not None
        assert summary.statistics is not None
        messages, told = messages_of(folder / "a.mcap")
        loops: dict[str, tuple[int, Callable[[Path], None]]] = {
            "this, from the log": (summary.statistics.message_count, lambda path: ours(log, path)),
            "mcap.writer.Writer, bytes ready": (len(messages), lambda path: mcap_writer(messages, told, path)),
        }
        if importlib.util.find_spec("foxglove") is None:
            print("foxglove-sdk is not installed: its writer is left out")
        else:
            loops["foxglove-sdk (Rust), bytes ready"] = (
                len(messages), lambda path: foxglove_writer(messages, told, path)
            )  # fmt: skip
        print("the last column: times as fast as that one")
        show("MCAP", "messages/s", speeds(loops, folder, ".mcap"), WANTED["mcap"])
        columns: dict[str, tuple[int, Callable[[Path], None]]] = {
            "this, with scene and blueprint": (samples, lambda path: ours(log, path)),
            "send_columns, samples alone": (samples, lambda path: rerun_columns(log, path)),
            "log() in a loop": (LOOPED // len(log.channels) * len(log.channels), lambda path: rerun_loop(log, path)),
        }
        show("Rerun", "values/s", speeds(columns, folder, ".rrd"), WANTED["rrd"])
        print("\ndays   MB of the log   file    peak MB beyond the log      s   MB of the file")
        for days in (1, 10, 30) if month else (1, 10):
            for suffix in (".mcap", ".rrd"):
                memory, wall, size = peak(days * DAY, str(folder / f"m{suffix}"))
                held = samples * days * 16 / 1e6
                print(f"{days:4d}{held:16.0f}   {suffix:<6}{memory:23.0f}{wall:9.1f}{size:14.0f}")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        one(int(sys.argv[2]), Path(sys.argv[3]))
    else:
        main("--month" in sys.argv)
