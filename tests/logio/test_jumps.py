"""Fixes that jump and depths that spike: real recordings, made ones, and the rule against brute force."""

from __future__ import annotations

import dataclasses
from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from glidercli.log import Channel, Log
from glidercli.logio import read
from glidercli.logio.consistent import with_agreeing_fixes, without_spikes
from glidercli.logio.derived.motion import with_motion
from glidercli.logio.derived.track import with_track
from glidercli.logio.formats import read_file
from glidercli.logio.joining import joined
from glidercli.logio.jumps import CIRCLE, DRIFT, agreeing, spikes
from glidercli.logio.reader import Aids, Part
from glidercli.logio.report import FileReport

SECOND = 10**9
METRE = 1.0 / 111_195.0
"""deg of latitude, on the mean sphere."""


def placed(seconds: list[float], metres: list[float]) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Times, and latitudes of places north of the equator."""
    return np.array([round(s * SECOND) for s in seconds], np.int64), np.array(metres) * METRE


def kept(seconds: list[float], metres: list[float]) -> list[int]:
    time_ns, latitude = placed(seconds, metres)
    return np.flatnonzero(agreeing(time_ns, latitude, np.zeros(len(latitude)))).tolist()


def test_a_single_outlier_is_left_out() -> None:
    assert kept([0, 20, 40, 60, 80], [0, 5, 400, 15, 20]) == [0, 1, 3, 4]
    assert kept([0, 20, 40, 60], [500, 5, 10, 15]) == [1, 2, 3]
    assert kept([0, 20, 40, 60], [0, 5, 10, 500]) == [0, 1, 2]


def test_the_longer_of_two_clusters_stays() -> None:
    assert kept([0, 5, 10, 15, 20, 25, 30], [9000, 9001, 9002, 0, 1, 2, 3]) == [3, 4, 5, 6]
    assert kept([0, 5, 10, 15, 20, 25, 30], [0, 1, 2, 3, 9000, 9001, 9002]) == [0, 1, 2, 3]
    assert kept([0, 5, 10, 15, 20, 25, 30], [0, 1, 9000, 9001, 9002, 2, 3]) == [0, 1, 5, 6]


def test_what_a_current_or_the_error_of_fixes_can_do_stays() -> None:
    assert kept([0, 20, 40], [0, 109, 50]) == [0, 1, 2]  # 3 m/s for 20 s and the circle of error
    assert kept([0, 3600, 3620], [0, 10_000, 10_005]) == [0, 1, 2]  # hours apart, 2.8 m/s
    time_ns, _ = placed([0, 5, 10], [0, 0, 0])
    assert agreeing(time_ns, np.zeros(3), np.array([179.9999, -179.9999, 179.9998])).all()


@given(st.lists(st.tuples(st.integers(1, 60), st.integers(0, 12)), min_size=1, max_size=9))
def test_as_many_as_can_be_agree(steps: list[tuple[int, int]]) -> None:
    seconds = np.cumsum([step for step, _ in steps]).tolist()
    metres = [50.0 * place for _, place in steps]

    def can(chosen: tuple[int, ...]) -> bool:
        return all(abs(metres[b] - metres[a]) <= CIRCLE + DRIFT * (seconds[b] - seconds[a]) + 1e-6
                   for a, b in pairwise(chosen))  # fmt: skip

    # just at the limit the rounding of degrees decides: such places are not asked for
    bounds = [CIRCLE + DRIFT * abs(seconds[b] - seconds[a]) - abs(metres[b] - metres[a])
              for a, b in combinations(range(len(seconds)), 2)]  # fmt: skip
    if any(abs(bound) < 1.0 for bound in bounds):
        return
    found = tuple(kept(seconds, metres))
    assert can(found)
    count = len(seconds)
    assert len(found) == max(n for n in range(1, count + 1) if any(can(c) for c in combinations(range(count), n)))


def test_the_first_fix_of_a_surfacing_of_sea035_is_126_m_off() -> None:
    """14:15:41 to 14:16:01 it would have gone 128 m in 20 s, 6 m/s; the drift after it is 0.3 m/s."""
    path = ROOT / "tests/data/seaexplorer-sea035/sea035.12.gli.sub.42"
    before = read_file(path, None, Aids()).log["latitude"]
    reading = read([path])
    log, report = reading.log, reading.files[0]
    (note,) = [warning for warning in report.warnings if warning.startswith("GPS")]
    assert note.endswith("too far from the others (3 m/s and 50 m are allowed): 2019-07-22T14:15:41Z")
    assert "1 fixes left out" in note
    assert log["latitude"].time_ns.tolist() == before.time_ns[1:].tolist()
    assert len(log["longitude"]) == len(log["latitude"])
    assert report.records == report.kept + sum(count for _, count in report.dropped)


def test_a_stale_position_of_a_slocum_in_og1_is_left_out() -> None:
    """12:07:23 has the place of 11:38:55, and 88 s later it is 976 m further on."""
    reading = read([ROOT / "tests/data/netcdf/dfo-rosie713-20190615-og10.nc"])
    (note,) = [warning for warning in reading.files[0].warnings if warning.startswith("GPS")]
    assert note.endswith("too far from the others (3 m/s and 50 m are allowed): 2019-06-20T12:07:23Z")
    assert len(reading.log["latitude"]) == 19


@pytest.mark.parametrize("folder", ["seaglider-sg561", "slocum-comet-2019"])
def test_good_fixes_stay(folder: str) -> None:
    reading = read([ROOT / "logs" / folder])
    assert not [w for report in reading.files for w in report.warnings if w.startswith("GPS")]


def part_of(channels: list[Channel]) -> Part:
    times = np.unique(np.concatenate([channel.time_ns for channel in channels]))
    log = Log({channel.name: channel for channel in channels}, "measured")
    return Part(log, FileReport(Path("a"), "slocum", len(times), len(times)), times)


def fixes_of(seconds: list[float], metres: list[float]) -> list[Channel]:
    time_ns, latitude = placed(seconds, metres)
    return [Channel("latitude", time_ns, latitude), Channel("longitude", time_ns, np.zeros(len(time_ns)))]


def test_a_record_of_a_left_out_fix_alone_is_dropped_by_name() -> None:
    fixes = fixes_of([0, 20, 40, 60, 80], [0, 900, 10, 15, 900])
    depth = Channel("depth", fixes[0].time_ns[3:], np.zeros(2))
    (part,) = with_agreeing_fixes([part_of([*fixes, depth])])
    assert part.report.dropped == (("fix too far from the others for its time", 1),)  # the other one told its depth
    assert (part.report.kept, len(part.record_ns)) == (4, 4)
    assert len(part.log["latitude"]) == 3


@pytest.mark.parametrize("metres", [[0.0, 900.0], [9000.0 * i for i in range(8)]])
def test_where_most_disagree_all_stay_and_it_is_said(metres: list[float]) -> None:
    (part,) = with_agreeing_fixes([part_of(fixes_of([20.0 * i for i in range(len(metres))], metres))])
    assert len(part.log["latitude"]) == len(metres)
    assert "all are kept" in part.report.warnings[0]


def file_of(name: str, seconds: list[float], metres: list[float]) -> Part:
    part = part_of(fixes_of(seconds, metres))
    return dataclasses.replace(part, report=dataclasses.replace(part.report, path=Path(name)), dive=name)


def accounted(reports: list[FileReport]) -> bool:
    return all(r.records == r.kept + sum(count for _, count in r.dropped) for r in reports)


def test_a_boat_that_carries_it_over_two_files_is_judged_as_one_way() -> None:
    """17 m/s from within the first file on: file by file the first would lose 24 fixes, and the second keep all."""
    drift, boat = [0.3 * 10 * i for i in range(40)], [117.0 + 170.0 * i for i in range(1, 101)]
    seconds = [10.0 * i for i in range(140)]
    first = file_of("a", seconds[:64], [*drift, *boat[:24]])
    second = file_of("b", seconds[64:], boat[24:])
    assert [len(part.log["latitude"]) for one in (first, second) for part in with_agreeing_fixes([one])] == [40, 76]
    log, reports = joined([first, second])
    assert len(log["latitude"]) == 140
    assert accounted(reports)
    assert [report.kept for report in reports] == [64, 76]
    (note,) = [warning for report in reports for warning in report.warnings]
    assert note.startswith("GPS: 140 fixes of 2 files, half or more too far from one another")


def test_a_file_of_two_fixes_is_judged_by_the_files_beside_it() -> None:
    """Alone nothing tells which of the two is wrong."""
    first = file_of("a", [0, 20], [0, 900])
    second = file_of("b", [60, 80, 100], [18, 24, 30])
    (alone,) = with_agreeing_fixes([first])
    assert len(alone.log["latitude"]) == 2
    log, reports = joined([first, second])
    assert (log["latitude"].time_ns // SECOND).tolist() == [0, 60, 80, 100]
    assert accounted(reports)
    assert reports[0].dropped == (("fix too far from the others for its time", 1),)
    assert [report.kept for report in reports] == [1, 3]


def test_two_files_may_tell_the_same_fix() -> None:
    first, second = file_of("a", [0, 20, 40], [0, 6, 12]), file_of("b", [0, 20, 40], [0, 900, 12])
    left = with_agreeing_fixes([first, second])
    assert [len(part.log["latitude"]) for part in left] == [3, 3]
    assert [part.report.warnings for part in left] == [(), ()]


def test_fixes_of_files_of_this_program_stay() -> None:
    log, reports = joined([file_of("a", [0, 20, 40, 60], [0, 900, 12, 18])], own=True)
    assert len(log["latitude"]) == 4
    assert reports[0].warnings == ()


def test_what_was_simulated_stays() -> None:
    part = part_of(fixes_of([0, 20, 40, 60], [0, 900, 10, 15]))
    part = dataclasses.replace(part, log=dataclasses.replace(part.log, origin="simulated"))
    assert with_agreeing_fixes([part]) == [part]
    assert without_spikes(part) is part


def test_many_fixes_take_no_time() -> None:
    rng = np.random.default_rng(1)
    time_ns = np.arange(100_000, dtype=np.int64) * 5 * SECOND
    latitude = np.cumsum(rng.normal(0.0, 2.0, 100_000)) * METRE
    wrong = rng.choice(100_000, 200, replace=False)
    latitude[wrong] += 0.1
    assert set(np.flatnonzero(~agreeing(time_ns, latitude, np.zeros(100_000)))) == set(wrong)


def dive() -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    time_ns = np.arange(200, dtype=np.int64) * 5 * SECOND
    return time_ns, 0.5 * np.arange(200)


@pytest.mark.parametrize(
    "rows",
    [
        [50],
        [50, 51, 52],
        [50, 51, 52, 53, 54],
        [20, 120],
        [0],
        [0, 1],
        [199],
        [198, 199],
        list(range(0, 200, 9)),
        list(range(3, 200, 7)),
    ],
)
@pytest.mark.parametrize("by", [150.0, -40.0])
def test_spikes_of_depth_and_pressure_are_left_out_and_no_speed_comes_of_them(rows: list[int], by: float) -> None:
    time_ns, depth = dive()
    clean = with_motion(Log({"depth": Channel("depth", time_ns, depth)}, "measured"))
    depth = depth + 60.0
    depth[rows] += by
    for name, metre in (("depth", 1.0), ("pressure", 1e4)):
        part = without_spikes(part_of([Channel(name, time_ns, depth * metre)]))
        assert len(part.log[name]) == 200 - len(rows)
        assert part.report.dropped == (("spike", len(rows)),)
        assert (
            f"{name}: {len(rows)} values left out that leave the others by more than 3 m/s" in part.report.warnings[0]
        )
        if name == "depth":
            speed = with_motion(part.log)["vertical_speed"].values
            np.testing.assert_allclose(speed, clean["vertical_speed"].values[0], rtol=1e-12)  # rounding


def test_a_step_that_does_not_come_back_stays_without_a_speed_or_a_way() -> None:
    time_ns, depth = dive()
    depth[100:] += 80.0
    assert not spikes(time_ns, depth).any()
    channels = {"depth": depth, "pitch": np.full(200, -0.4), "heading": np.zeros(200)}
    log = Log({name: Channel(name, time_ns, values) for name, values in channels.items()}, "measured")
    moved = with_track(with_motion(log))
    assert moved["vertical_speed"].values.max() < 0.2
    assert "nor at 2 samples beside a step of depth" in moved.metadata["vertical_speed_note"]
    assert moved["north"].values[-1] < 200 * 0.5 / np.tan(0.4)  # 100 m of depth, not 180


def test_six_samples_that_come_back_are_no_spike() -> None:
    time_ns, depth = dive()
    depth[50:56] += 150.0
    assert not spikes(time_ns, depth).any()


def test_spikes_beside_one_another_on_either_side_are_left_out() -> None:
    time_ns, depth = dive()
    depth[50], depth[51], depth[120], depth[121] = -8.0, 1000.0, 900.0, 0.0
    assert np.flatnonzero(spikes(time_ns, depth)).tolist() == [50, 51, 120, 121]


def test_two_sensors_that_take_turns_both_stay_and_it_is_said() -> None:
    time_ns, depth = dive()
    depth[::2] += 100.0
    part = without_spikes(part_of([Channel("depth", time_ns, depth)]))
    assert len(part.log["depth"]) == 200
    assert "all are kept" in part.report.warnings[0]


@pytest.mark.parametrize("folder", ["logs/seaglider-sg561", "logs/slocum-comet-2019", "logs/seaexplorer-sea035"])
def test_no_real_depth_is_taken_for_a_spike(folder: str) -> None:
    reading = read([ROOT / folder])
    assert not [w for report in reading.files for w in report.warnings if "come back" in w]
    assert "beside a step" not in reading.log.metadata["vertical_speed_note"]
