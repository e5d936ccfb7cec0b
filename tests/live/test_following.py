"""Does following a growing file show what reading it at the end gives, and never a half record?"""

from __future__ import annotations

import os
import shutil
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, Run, one_line_error
from grown_files import appended, growing
from live_clients import Watcher, running, wait_for

from glidercli.errors import InputError
from glidercli.live.following import Follower, following
from glidercli.log import Channel, Log
from glidercli.logio import read, write

LOGS = ROOT / "logs"
DERIVED_LATE = {"phase", "north", "east"}
"""Derived channels whose earlier samples may change as more is known."""


def same(a: Channel, b: Channel) -> bool:
    return np.array_equal(a.time_ns, b.time_ns) and np.array_equal(a.values, b.values)


def check_grown(folder: Path, source: Path, seed: int, pieces: int = 30) -> list[Log]:
    """Follow a folder while a file grows in it; each channel must be that of the file when it is whole."""
    said: list[str] = []
    shown: list[Log] = []
    whole = read([source], columns=folder / "columns.toml" if (folder / "columns.toml").exists() else None).log
    with following([folder], None, None, None, said.append) as follower:
        for _ in growing(source, folder / source.name, pieces, seed):
            if (step := follower.look()) is not None:
                shown.append(step.piece)
                last = step.log
                for name, channel in step.log.channels.items():
                    if channel.origin == "measured":  # no half record: each sample is one of the whole file
                        at = np.searchsorted(whole[name].time_ns, channel.time_ns)
                        assert np.array_equal(whole[name].time_ns[at], channel.time_ns), name
                        assert np.array_equal(whole[name].values[at], channel.values), name
        assert follower.look() is None
    plain = read([folder]).log
    assert last.channels.keys() == plain.channels.keys()
    assert all(same(last[name], channel) for name, channel in plain.channels.items())
    got = appended(shown)
    assert got.keys() == plain.channels.keys()
    changed = {
        name.replace(" ", "_") for line in said if "told otherwise" in line for name in line.split(":")[0].split(", ")
    }
    assert changed <= {*DERIVED_LATE, "vertical_speed"}
    for name, channel in plain.channels.items():
        assert same(got[name], channel) or name in changed, name
    return shown


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_seaexplorer_lines(seed: int, tmp_path: Path) -> None:
    assert len(check_grown(tmp_path, LOGS / "seaexplorer-sea035" / "sea035.12.gli.sub.37", seed)) > 10


def test_seaglider_lines(tmp_path: Path) -> None:
    source = tmp_path / "source"
    source.mkdir()
    shutil.copy(LOGS / "seaglider-sg561" / "p5610003.eng", source)
    (tmp_path / "grows").mkdir()
    assert len(check_grown(tmp_path / "grows", source / "p5610003.eng", 1)) > 10


def test_slocum_cycles(tmp_path: Path) -> None:
    source = LOGS / "slocum-comet-2019"
    for cache in source.glob("*.cac"):
        shutil.copy(cache, tmp_path)
    assert len(check_grown(tmp_path, source / "comet-2019-218-00-034.dbd", 1)) > 10


def test_slocum_never_shows_half_a_cycle(tmp_path: Path) -> None:
    """Cut at each of 120 places about the start of a cycle, the tag d, a file gives only cycles that are whole."""
    source = LOGS / "slocum-comet-2019"
    for cache in source.glob("*.cac"):
        shutil.copy(cache, tmp_path)
    data = (source / "comet-2019-218-00-034.dbd").read_bytes()
    whole = read([source / "comet-2019-218-00-034.dbd"]).log
    counts = []
    for size in range(60_370, 60_490):
        (tmp_path / "a.dbd").write_bytes(data[:size])
        log = read([tmp_path / "a.dbd"]).log
        measured = {name: channel for name, channel in log.channels.items() if channel.origin == "measured"}
        for name, channel in measured.items():
            at = np.searchsorted(whole[name].time_ns, channel.time_ns)
            assert np.array_equal(whole[name].time_ns[at], channel.time_ns), (size, name)
            assert np.array_equal(whole[name].values[at], channel.values), (size, name)
        counts.append({name: len(channel) for name, channel in measured.items()})
    start = data.index(b"d", 60_420)
    assert all(count == counts[0] for count in counts[: start - 60_370])
    assert all(count == counts[-1] for count in counts[start - 60_370 :])
    assert counts[-1]["depth"] == counts[0]["depth"] + 1


def test_own_csv(tmp_path: Path) -> None:
    (tmp_path / "made").mkdir()
    (tmp_path / "grows").mkdir()
    write(read([LOGS / "seaexplorer-sea035" / "sea035.12.gli.sub.37"]).log, tmp_path / "made" / "a.csv")
    (tmp_path / "made" / "a.csv-metadata.json").unlink()
    assert len(check_grown(tmp_path / "grows", tmp_path / "made" / "a.csv", 1)) > 10


def test_a_plain_table_by_its_mapping(tmp_path: Path) -> None:
    (tmp_path / "grows").mkdir()
    rows = "".join(f"{1_600_000_000 + 10 * i},{i % 60}.{i}\n" for i in range(200))
    (tmp_path / "dives.csv").write_text("t,z\n" + rows)
    mapping = '[time]\ncolumn = "t"\nformat = "unix"\n\n[columns]\ndepth = { column = "z", unit = "m" }\n'
    for place in (tmp_path, tmp_path / "grows"):
        (place / "dives.toml").write_text(mapping)
    assert len(check_grown(tmp_path / "grows", tmp_path / "dives.csv", 1)) > 10


@pytest.fixture
def follower(tmp_path: Path) -> Iterator[tuple[Follower, Path, list[str]]]:
    said: list[str] = []
    with following([tmp_path], None, None, None, said.append) as found:
        yield found, tmp_path, said


LINES = (LOGS / "seaexplorer-sea035" / "sea035.12.gli.sub.37").read_bytes().splitlines(keepends=True)


def test_new_files_of_a_folder_join(follower: tuple[Follower, Path, list[str]]) -> None:
    look, folder, _ = follower
    for name in ("sea035.12.gli.sub.36", "sea035.12.gli.sub.37", "sea035.12.pld1.sub.37"):
        shutil.copy(LOGS / "seaexplorer-sea035" / name, folder)
        step = look.look()
        assert step is not None
        assert step.fresh or name == "sea035.12.gli.sub.37"
    assert "temperature" in step.log


def test_a_half_line_is_not_shown_until_it_has_its_end(follower: tuple[Follower, Path, list[str]]) -> None:
    look, folder, _ = follower
    path = folder / "sea035.12.gli.sub.37"
    path.write_bytes(b"".join(LINES[:20]) + LINES[20][:-5])
    first = look.look()
    assert first is not None
    count = len(first.log["heading"])
    with path.open("ab") as stream:
        stream.write(LINES[20][-5:-1])
    assert look.look() is None
    with path.open("ab") as stream:
        stream.write(LINES[20][-1:])
    second = look.look()
    assert second is not None
    assert len(second.log["heading"]) == count + 1
    assert len(second.piece["heading"]) == 1


def test_a_file_that_shrinks_and_one_that_is_replaced_are_told(follower: tuple[Follower, Path, list[str]]) -> None:
    look, folder, said = follower
    path = folder / "sea035.12.gli.sub.37"
    path.write_bytes(b"".join(LINES[:40]))
    assert look.look() is not None
    path.write_bytes(b"".join(LINES[:30]))
    shrunk = look.look()
    assert shrunk is not None
    assert shrunk.moved
    assert not any(map(len, shrunk.piece.channels.values()))
    assert any("shrank from" in line for line in said)
    other = folder.parent / "other"
    other.write_bytes(b"".join(LINES[:50]))
    os.replace(other, path)
    step = look.look()
    assert any("was replaced" in line for line in said)
    assert step is not None
    assert int(step.piece["heading"].time_ns[0]) > int(step.log["heading"].time_ns[38])
    path.unlink()
    assert look.look() is None
    assert any("is gone" in line for line in said)


TABLE = "time_utc,depth_m,pitch_deg\n" + "".join(f"2020-01-01T00:00:{s:02d}Z,{s},2\n" for s in range(0, 50, 10))
GOOD = "2020-01-01T00:{:02d}:00Z,7,2\n"


def test_what_is_left_out_of_a_table_is_told_when_it_happens(follower: tuple[Follower, Path, list[str]]) -> None:
    """By reason and number, once each; and again with the account of the file when its lines are taken away."""
    look, folder, said = follower
    path = folder / "a.csv"
    path.write_text(TABLE)
    assert look.look() is not None
    assert said == []
    path.write_text(TABLE + "garbage &&& line\n" + GOOD.format(1))
    assert look.look() is not None
    assert said == [f"{path}: new records left out: 1 wrong number of fields"]
    path.write_text(path.read_text() + "one\ntwo\n2019-01-01T00:00:00Z,7,2\n" + GOOD.format(2))
    assert look.look() is not None
    assert said[1:] == [f"{path}: new records left out: 1 time goes back, 2 wrong number of fields"]
    path.write_text(path.read_text() + GOOD.format(3) + "2020-01-01T00:04:00Z,abc,2\n")
    assert look.look() is not None
    (line,) = said[2:]
    assert line.startswith(f"{path}: depth_m: 1 cells left out that are no number")
    path.write_text(path.read_text() + GOOD.format(5))
    assert look.look() is not None
    assert len(said) == 3
    path.write_text(TABLE)
    assert look.look() is not None
    (line,) = [line for line in said if "shrank" in line]
    # 5 rows, a word and a row, two words and an old row and a row, a row and one with half its cells, a row
    assert (
        "of its 14 records 10 had been kept: 1 time goes back, 3 wrong number of fields, depth_m: 1 cells left out"
        in line
    )
    assert look.reading is not None
    assert [(report.records, report.kept) for report in look.reading.files] == [(5, 5)]


def test_outputs_of_a_file_that_was_rewritten_shorter_hold_what_is_on_disk(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(TABLE)
    with running("replay", path, "--follow", "--wait", "0.1", "-o", "out.csv", cwd=tmp_path) as run:
        run.wait_for_line("it goes on without")
        path.write_text("".join(TABLE.splitlines(keepends=True)[:4]))
        run.wait_for_line("shrank from")
        assert run.end(signal.SIGINT) == 0, run.said
    depths = [line.split(",")[2] for line in (tmp_path / "out.csv").read_text().splitlines()[1:]]
    assert depths == ["0", "10", "20"]


def test_what_is_not_whole_yet_waits(follower: tuple[Follower, Path, list[str]]) -> None:
    """A compressed file in a folder counts once it can be unpacked to its end."""
    look, folder, said = follower
    source = ROOT / "tests" / "data" / "seaexplorer" / "sea063.22.gli.sub.120.gz"
    data = source.read_bytes()
    (folder / source.name).write_bytes(data[: len(data) // 2])
    assert look.look() is None
    assert any("not whole yet" in line for line in said)
    (folder / source.name).write_bytes(data)
    step = look.look()
    assert step is not None
    assert same(step.piece["heading"], read([source]).log["heading"])


def test_a_look_at_what_has_not_changed_reads_nothing(
    follower: tuple[Follower, Path, list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    from glidercli.live import growing as module

    look, folder, _ = follower
    for number in (36, 37):
        shutil.copy(LOGS / "seaexplorer-sea035" / f"sea035.12.gli.sub.{number}", folder)
    assert look.look() is not None
    calls = []
    real = module.read_one
    monkeypatch.setattr(module, "read_one", lambda *a: (calls.append(a[0].name), real(*a))[1])
    assert look.look() is None
    assert calls == []
    shutil.copy(LOGS / "seaexplorer-sea035" / "sea035.12.gli.sub.38", folder)
    assert look.look() is not None
    assert calls == ["sea035.12.gli.sub.38"]


@pytest.mark.parametrize("suffix", [".mcap", ".nc", ".parquet"])
def test_kinds_that_appear_whole_cannot_be_followed(suffix: str, tmp_path: Path, glider: Run) -> None:
    path = tmp_path / f"a{suffix}"
    write(read([LOGS / "seaexplorer-sea035" / "sea035.12.gli.sub.36"]).log, path)
    one_line_error(glider("replay", path, "--follow"), str(path), "cannot be followed", "appears whole")


def test_what_can_be_no_log_is_refused_at_once(tmp_path: Path) -> None:
    """A beginning may become a log; so much text without one will not."""
    path = tmp_path / "a.txt"
    path.write_text("hello\nworld\n")
    said: list[str] = []
    with following([path], None, None, None, said.append) as look:
        assert look.look() is None
        assert len(said) == 1
        assert "not a log that can be read" in said[0]
    path.write_text("hello\n" * 20_000)
    with following([path], None, None, None, print) as look, pytest.raises(InputError, match="not a log"):
        look.look()


def test_an_empty_folder_waits(follower: tuple[Follower, Path, list[str]]) -> None:
    look, folder, said = follower
    assert look.look() is None
    shutil.copy(LOGS / "seaexplorer-sea035" / "sea035.12.gli.sub.36", folder)
    assert look.look() is not None
    assert len(said) == 1


def test_a_file_that_is_not_there_is_refused(glider: Run) -> None:
    one_line_error(glider("replay", "none.dbd", "--follow"), "none.dbd", "no such file")


def test_a_growing_file_reaches_a_viewer_and_the_outputs(tmp_path: Path) -> None:
    """The command as it runs: lines in bursts and halves; at Ctrl-C the output is that of all whole records."""
    folder = tmp_path / "grows"
    folder.mkdir()
    source = LOGS / "seaexplorer-sea035" / "sea035.12.gli.sub.37"
    target = folder / source.name
    target.write_bytes(b"".join(LINES[:30]))
    with running("replay", folder, "--follow", "-o", "a.mcap", "--json", cwd=tmp_path) as run:
        watcher = Watcher(run.url())
        wait_for(lambda: bool(watcher.messages.get("/glider/attitude")), "the first samples")

        def grow() -> None:
            with target.open("ab") as stream:
                rest = b"".join(LINES[30:]) + LINES[-1][:20]
                for part in np.array_split(np.frombuffer(rest, np.uint8), 5):
                    stream.write(part.tobytes())
                    stream.flush()
                    time.sleep(0.4)

        thread = threading.Thread(target=grow)
        thread.start()
        thread.join()
        whole = read([source]).log
        wait_for(lambda: len(watcher.messages["/glider/attitude"]) >= len(whole["heading"]), "the last samples")
        late = Watcher(run.url())
        wait_for(lambda: bool(late.messages.get("/map/track")), "the track for one who comes late")
        assert run.end(signal.SIGINT) == 0, run.said
        watcher.until_closed()
        late.until_closed()
    times = [at for at, _ in watcher.messages["/glider/attitude"]]
    assert times == whole["heading"].time_ns.tolist()
    assert watcher.clocks[-1] == whole.end_ns
    back = read([tmp_path / "a.mcap"]).log
    for name, channel in whole.channels.items():
        assert same(back[name], channel), name
    assert len(watcher.messages["/map/track"]) > 1
    assert late.messages["/map/track"] == watcher.messages["/map/track"][-1:]  # the last one counts


def test_channels_that_come_later_reach_a_viewer_whole(tmp_path: Path) -> None:
    """A file with other channels changes kinds of messages: the viewer is told, and gets every new sample."""
    folder = tmp_path / "grows"
    folder.mkdir()
    source = LOGS / "seaexplorer-sea035"
    shutil.copy(source / "sea035.12.gli.sub.36", folder)
    with running("replay", folder, "--follow", "--json", cwd=tmp_path) as run:
        watcher = Watcher(run.url())
        wait_for(lambda: bool(watcher.messages.get("/glider/attitude")), "the first samples")
        shutil.copy(source / "sea035.12.pld1.sub.36", tmp_path / "part")
        os.replace(tmp_path / "part", folder / "sea035.12.pld1.sub.36")
        whole = read([folder]).log
        water = len(np.union1d(whole["temperature"].time_ns, whole["pressure"].time_ns))
        wait_for(lambda: len(watcher.messages.get("/glider/water", [])) >= water, "the water")
        assert run.end(signal.SIGTERM) == 0, run.said
        watcher.until_closed()
    assert [at for at, _ in watcher.messages["/glider/attitude"]] == whole["heading"].time_ns.tolist()
    assert len(watcher.messages["/glider/water"]) == water
