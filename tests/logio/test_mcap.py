"""Does a Log survive the MCAP file to the last bit, and are unusable files refused in one line?"""

from __future__ import annotations

import dataclasses
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader
from random_logs import AFTER_1970, possible

from glidercli.channels import CHANNELS, PHASES
from glidercli.errors import InputError, OutputError
from glidercli.log import Channel, Event, Log
from glidercli.logio.mcap import contents as mcap_contents
from glidercli.logio.mcap import writer as mcap_writer
from glidercli.logio.mcap.reader import is_mcap, read_mcap_log
from glidercli.logio.mcap.writer import write_mcap
from glidercli.logio.plausible import quantity_of

START = 1_313_000_000_123_456_789
DATA = Path(__file__).parents[1] / "data" / "mcap"
PYMCAP = Path(sys.executable).with_name("pymcap-cli")


def full_log(n: int = 2000, origin: str = "simulated") -> Log:
    """Every channel at n times, by turns 1 s and 1 s + 1 ns apart; with events."""
    times = START + np.cumsum(1_000_000_000 + np.arange(n) % 2)
    random = np.random.default_rng(7)
    bounds = {name: quantity_of(name) for name in CHANNELS}
    values = {name: random.uniform(bound.low, bound.high, n) for name, bound in bounds.items()}
    values["phase"] = random.integers(0, len(PHASES), n).astype(float)
    values["latitude"], values["longitude"] = 20.0 + 1e-5 * np.arange(n), 115.0 + 1e-5 * np.arange(n)
    channels = {name: Channel(name, times, values[name], origin) for name in CHANNELS}
    metadata = {"provenance": '{"program": "glidercli"}', "hull_length_m": "1.5", "hull_diameter_m": "0.2", "empty": ""}
    events = (Event("apogee", int(times[n // 2]), 200.25), Event("surfaced", int(times[-1])))
    return Log(channels, origin, metadata, events)


def assert_same(back: Log, log: Log) -> None:
    assert list(back.channels) == list(log.channels)
    for name, channel in log.channels.items():
        assert back[name].time_ns.tobytes() == channel.time_ns.tobytes(), name
        assert back[name].values.tobytes() == channel.values.tobytes(), name  # bytes: -0.0 is not 0.0
        assert back[name].origin == channel.origin
    assert (back.origin, back.metadata, back.events) == (log.origin, dict(log.metadata), log.events)


TIMES = AFTER_1970
FINITE = st.floats(allow_nan=False, allow_infinity=False)
ORIGINS = st.sampled_from(["measured", "derived", "simulated", "reconstruction"])
EVENTS = st.lists(st.builds(Event, st.text(max_size=8), TIMES, st.none() | FINITE), max_size=4)
POOLS = st.lists(TIMES, min_size=1, max_size=8, unique=True)


@st.composite
def logs(draw: st.DrawFn) -> Log:
    """Channels with times of their own out of a few, so that some are shared and some are not."""
    pool = draw(POOLS)
    channels = {}
    for name in draw(st.lists(st.sampled_from(list(CHANNELS)), unique=True)):
        samples = draw(st.dictionaries(st.sampled_from(pool), possible(name), max_size=8))
        times = np.array(sorted(samples), np.int64)
        channels[name] = Channel(name, times, np.array([samples[t] for t in times.tolist()]), draw(ORIGINS))
    events = tuple(sorted(draw(EVENTS), key=lambda event: event.time_ns))
    metadata = draw(st.dictionaries(st.text(max_size=5), st.text(max_size=9), max_size=4))
    return Log(channels, draw(ORIGINS), metadata, events)


@settings(deadline=None, max_examples=150)  # no deadline: the first example imports protobuf
@given(log=logs())
def test_a_log_comes_back_to_the_last_bit(log: Log, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("mcap") / "a.mcap"
    write_mcap(log, path)
    assert_same(read_mcap_log(path), log)


def test_many_chunks_come_back(tmp_path: Path) -> None:
    log = full_log(20_000)
    sparse = Channel("pitch", log["pitch"].time_ns[::7] + 3, -0.0 * np.ones(len(log["pitch"].time_ns[::7])), "derived")
    log = log.with_channels(sparse)
    write_mcap(log, tmp_path / "a.mcap")
    assert_same(read_mcap_log(tmp_path / "a.mcap"), log)


def test_the_bytes_depend_on_the_log_alone(tmp_path: Path) -> None:
    for name in ("a.mcap", "b.mcap"):
        write_mcap(full_log(), tmp_path / name)
    assert (tmp_path / "a.mcap").read_bytes() == (tmp_path / "b.mcap").read_bytes()


def test_times_before_1970_are_refused(tmp_path: Path) -> None:
    log = Log({"depth": Channel("depth", np.array([-1]), np.array([1.0]))}, "measured")
    with pytest.raises(OutputError, match=r"a\.mcap: .*1970"):
        write_mcap(log, tmp_path / "a.mcap")


def test_events_out_of_order_come_back_in_order(tmp_path: Path) -> None:
    first, second = Event("a", 5), Event("b", 9)
    write_mcap(Log({}, "measured", {}, (second, first)), tmp_path / "a.mcap")
    assert read_mcap_log(tmp_path / "a.mcap").events == (first, second)


def test_is_mcap_goes_by_content(tmp_path: Path) -> None:
    write_mcap(full_log(5), tmp_path / "a.txt")
    (tmp_path / "b.mcap").write_text("time_utc,depth_m\n")
    assert is_mcap(tmp_path / "a.txt")
    assert not is_mcap(tmp_path / "b.mcap")
    assert not is_mcap(tmp_path / "missing")
    assert not is_mcap(tmp_path)


def test_what_is_no_mcap_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    path.write_text("time_utc,depth_m\n")
    with pytest.raises(InputError, match=r"a\.mcap: is no MCAP file"):
        read_mcap_log(path)


def test_an_mcap_of_another_program_is_refused(tmp_path: Path) -> None:
    from mcap.writer import Writer

    path = tmp_path / "a.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        schema = writer.register_schema("x", "jsonschema", b"{}")
        channel = writer.register_channel("/x", "json", schema)
        writer.add_message(channel, 1, b"{}", 1)
        writer.finish()
    with pytest.raises(InputError, match=r"a\.mcap: is an MCAP file that glider did not write"):
        read_mcap_log(path)


@settings(deadline=None, max_examples=60)
@given(part=st.floats(0.0, 1.0, exclude_max=True))
def test_a_truncated_file_is_refused(part: float, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("mcap") / "a.mcap"
    write_mcap(full_log(50), path)
    whole = path.read_bytes()
    path.write_bytes(whole[: max(8, math.floor(part * len(whole)))])  # the magic bytes are left: it is an MCAP
    with pytest.raises(InputError, match=r"a\.mcap: is truncated .*pymcap-cli recover") as caught:
        read_mcap_log(path)
    assert "\n" not in str(caught.value)


@settings(deadline=None, max_examples=100)
@given(part=st.floats(0.0, 1.0, exclude_max=True), flip=st.integers(1, 255))
def test_a_changed_byte_never_changes_a_value(part: float, flip: int, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("mcap") / "a.mcap"
    log = full_log(50)
    write_mcap(log, path)
    data = bytearray(path.read_bytes())
    data[math.floor(part * len(data))] ^= flip
    path.write_bytes(data)
    try:
        back = read_mcap_log(path)
    except InputError:
        return
    assert_same(back, log)  # bytes that nothing depends on


@pytest.mark.parametrize("summary", [1, 2**56, 2**64 - 1])
def test_a_footer_that_points_out_of_the_file_is_damage(tmp_path: Path, summary: int) -> None:
    """One changed byte of the footer can name a place that no file has: opcode, length 20, summary_start, ..."""
    path = tmp_path / "a.mcap"
    write_mcap(full_log(50), path)
    data = bytearray(path.read_bytes())
    at = len(data) - 8 - 29 + 9  # magic; footer of 1 + 8 + 20 bytes; the number stands behind opcode and length
    data[at : at + 8] = summary.to_bytes(8, "little")
    path.write_bytes(data)
    with pytest.raises(InputError, match="is truncated or damaged"):
        read_mcap_log(path)


def test_most_of_a_cut_file_is_recovered(tmp_path: Path) -> None:
    """What the error message advises: the first chunks come back exactly."""
    log = full_log(5000)
    write_mcap(log, tmp_path / "a.mcap")
    whole = (tmp_path / "a.mcap").read_bytes()
    (tmp_path / "cut.mcap").write_bytes(whole[: len(whole) * 3 // 4])
    command = [PYMCAP, "recover", tmp_path / "cut.mcap", "-o", tmp_path / "saved.mcap"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 3, done.stdout + done.stderr  # its code for "saved, with loss"
    back = read_mcap_log(tmp_path / "saved.mcap")
    n = len(back["depth"])
    assert n > 2500  # of 5000: three quarters less the chunk that was cut and the bulky first one
    assert back["depth"].values.tobytes() == log["depth"].values[:n].tobytes()
    assert back.metadata == log.metadata


@settings(deadline=None, max_examples=60)
@given(log=logs(), samples=st.integers(1, 3))
def test_a_log_in_pieces_comes_back_to_the_last_bit(
    log: Log, samples: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("mcap") / "a.mcap"
    with pytest.MonkeyPatch.context() as patch, path.open("wb") as stream:
        patch.setattr(mcap_contents, "PIECE", samples)
        file = mcap_writer.McapLog(stream)
        file.add(log)
        file.close(log)
    assert_same(read_mcap_log(path), log)


def test_pieces_show_what_the_whole_shows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The viewers' topics hold the same messages, however the log is cut."""
    from mcap.reader import make_reader

    log = full_log(3000)
    odd = Channel("pitch", log["pitch"].time_ns[5::7] + 3, 0.1 * np.ones(len(log["pitch"].time_ns[5::7])), "derived")
    found = []
    for piece in (100_000, 211):
        monkeypatch.setattr(mcap_contents, "PIECE", piece)
        write_mcap(log.with_channels(odd), tmp_path / "a.mcap")
        with (tmp_path / "a.mcap").open("rb") as stream:
            topics: dict[str, list[tuple[int, bytes]]] = {}
            for _, channel, message in make_reader(stream).iter_messages():
                topics.setdefault(channel.topic, []).append((message.log_time, message.data))
        found.append(topics)
    assert found[0] == found[1]


def test_attachments_are_the_files(tmp_path: Path) -> None:
    from mcap.reader import make_reader

    raw = tmp_path / "raw.gli"
    raw.write_bytes(np.random.default_rng(1).bytes(3_000_000))
    write_mcap(full_log(20), tmp_path / "a.mcap", [raw])
    with (tmp_path / "a.mcap").open("rb") as stream:
        found = {item.name: item.data for item in make_reader(stream, validate_crcs=True).iter_attachments()}
    assert found["raw.gli"] == raw.read_bytes()
    assert found["provenance.json"] == b'{"program": "glidercli"}'
    doctor = subprocess.run([PYMCAP, "doctor", tmp_path / "a.mcap"], capture_output=True, text=True, check=False)
    assert doctor.returncode == 0, doctor.stdout


def test_a_file_of_the_earlier_layout_is_read() -> None:
    """It was written by the commit before the layout changed; what it holds was worked out by hand."""
    log = read_mcap_log(DATA / "layout-1.mcap")
    start, n = 1_313_000_000_123_456_789, np.arange(30)
    times = start + n * 1_000_000_001
    assert list(log.channels) == ["depth", "pressure", "pitch", "latitude", "phase", "ballast_volume"]
    assert log["depth"].values.tolist() == (n / 3).tolist()
    assert log["depth"].time_ns.tolist() == times.tolist()
    assert log["pitch"].values.tolist() == (-0.4 - n / 1e3)[::3].tolist()
    assert log["latitude"].origin == "measured"
    assert log["ballast_volume"].values.tolist() == (1e-4 * n).tolist()
    assert log.metadata == {"title": "layout 1", "provenance": "{}"}  # the second came at the end
    assert log.events == (Event("apogee", int(times[15]), 5.0),)


def test_what_is_known_late_is_told_beside_what_was_told_first(tmp_path: Path) -> None:
    log = full_log(20)
    first = dataclasses.replace(log, metadata={"title": "a", "kept": "b"}, events=())
    with (tmp_path / "a.mcap").open("wb") as stream:
        file = mcap_writer.McapLog(stream)
        file.add(first)
        file.close(dataclasses.replace(log, metadata={"title": "c", "kept": "b", "more": ""}))
    assert read_mcap_log(tmp_path / "a.mcap").metadata == {"title": "c", "kept": "b", "more": ""}
    with (tmp_path / "a.mcap").open("rb") as stream:
        told = [(item.name, item.metadata) for item in make_reader(stream).iter_metadata()]
    assert [name for name, _ in told] == ["run", "origin", "version", "run, told at the end"]
    assert told[-1][1] == {"title": "c", "more": ""}
