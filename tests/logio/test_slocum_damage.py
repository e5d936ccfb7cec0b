"""Damaged Slocum files: cut or overwritten anywhere, it is noticed and said, and no wrong sample gets through."""

from __future__ import annotations

import resource
import shutil
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, Run, one_line_error
from slocum_files import NAVIGATION, SAME, SCIENCE, START, Cycle, cast, dive, made, packed, sensor_lines

from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.logio import read
from glidercli.logio.slocum import is_slocum, read_slocum, sensors

DATA = ROOT / "tests/data/slocum"
WHOLE = made(NAVIGATION, dive())


def inside(part: Log, whole: Log) -> bool:
    """Whether every sample of a log is one of the other's."""
    for name, channel in part.channels.items():
        at = np.searchsorted(whole[name].time_ns, channel.time_ns)
        if not np.array_equal(whole[name].time_ns[at], channel.time_ns):
            return False
        if not np.array_equal(whole[name].values[at], channel.values):
            return False
    return True


def written(path: Path, data: bytes) -> Path:
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("pack", [False, True])
def test_a_file_cut_anywhere_says_so(tmp_path: Path, pack: bool) -> None:
    path = tmp_path / "a.dbd"
    whole = read_slocum(written(path, WHOLE.data)).log
    compressed = packed(WHOLE.data, block=100)
    for size in range(len(compressed) if pack else WHOLE.cycles[0]):
        path.write_bytes(compressed[:size] if pack else WHOLE.data[:size])
        if size > 15:
            assert is_slocum(path)
        try:
            part = read_slocum(path)
        except InputError:
            continue
        report = part.report
        assert report.error is not None or "without the end mark X" in report.warnings[0], size
        assert inside(part.log, whole)
        assert report.records == report.kept + sum(count for _, count in report.dropped)
    for size in range(WHOLE.cycles[0], len(WHOLE.data) if not pack else 0):
        path.write_bytes(WHOLE.data[:size])
        part = read_slocum(path)
        cycles = sum(end <= size for end in WHOLE.cycles[1:])
        if size in WHOLE.cycles:
            assert part.report.error is None
            assert part.report.warnings[0].startswith(f"ends after {cycles} whole cycles without the end mark X")
        else:
            assert part.report.error == (
                f"cut short after {cycles} cycles: the file ends inside the next, at byte {size}"
            )
            assert dict(part.report.dropped)["cycle cut short"] == 1
        assert part.report.records == cycles + (size not in WHOLE.cycles)
        assert part.report.kept == max(cycles - 1, 0)
        assert inside(part.log, whole)


def test_a_tag_or_a_state_overwritten_anywhere_is_told_with_its_place(tmp_path: Path) -> None:
    path = tmp_path / "a.dbd"
    whole = read_slocum(written(path, WHOLE.data)).log
    for number, begin in enumerate(WHOLE.cycles[:-1]):
        for offset in range(3):  # the tag, and two state bytes of six sensors
            data = bytearray(WHOLE.data)
            data[begin + offset] = 0xFF
            report = (part := read_slocum(written(path, bytes(data)))).report
            assert report.error is not None
            assert f"damaged at byte {begin}, after {number} cycles" in report.error
            assert report.records == report.kept + sum(count for _, count in report.dropped)
            assert inside(part.log, whole)
            if number < 7:  # behind it stand five cycles or more, which show where to go on
                assert (
                    f"read again from byte {WHOLE.cycles[number + 2]}, {10 - number} cycles to the end" in report.error
                )
                assert report.records == 12
                assert report.kept == 11 - {0: 1, 1: 2}.get(number, 3)  # itself, the one before and the one behind
                assert "latitude" in part.log or number in (1, 2, 3)
            else:
                assert "nothing more is read" in report.error
                assert (report.records, report.kept) == (number + 1, number - 2)


def test_what_is_unchanged_since_before_a_damage_is_not_known(tmp_path: Path) -> None:
    cycles = [{**cycle, "m_pitch": -0.3 if i == 0 else SAME if i != 8 else -0.5} for i, cycle in enumerate(dive())]
    file = made(NAVIGATION, cycles)
    data = bytearray(file.data)
    data[file.cycles[4]] = 0
    part = read_slocum(written(tmp_path / "a.dbd", bytes(data)))
    pitch = part.log["pitch"]
    # cycles 3, 4 and 5 are lost, 6 and 7 tell of no change, 8 is new; depth is told in all
    assert ((pitch.time_ns * 1e-9 - START) / 4.0).round().tolist() == [1, 2, 8, 9, 10, 11]
    assert pitch.values.round(3).tolist() == [-0.3, -0.3, -0.5, -0.5, -0.5, -0.5]
    assert len(part.log["depth"]) == 8
    assert len(sensors(tmp_path / "a.dbd", ["m_pitch"])["m_pitch"][0]) == 6


def test_behind_two_damages_nothing_shows_where_to_go_on(tmp_path: Path) -> None:
    file = made(NAVIGATION, dive(40))
    data = bytearray(file.data)
    data[file.cycles[5]] = data[file.cycles[38]] = 0
    report = read_slocum(written(tmp_path / "a.dbd", bytes(data))).report
    assert report.error is not None
    assert "damaged at byte" in report.error
    assert "nothing more is read" in report.error
    assert report.kept == 3


def test_a_long_file_of_the_letter_d_makes_no_long_search(tmp_path: Path) -> None:
    began = time.perf_counter()
    report = read_slocum(written(tmp_path / "a.dbd", WHOLE.data[:-1] + b"\x00" + b"d" * 5_000_000)).report
    assert report.error is not None
    assert time.perf_counter() - began < 30.0  # 1 MB is searched, some us each


def test_states_that_stay_possible_move_the_next_cycle_and_take_theirs_with_them(tmp_path: Path) -> None:
    path = tmp_path / "a.dbd"
    whole = read_slocum(written(path, WHOLE.data)).log
    for begin in WHOLE.cycles[2:-2]:
        data = bytearray(WHOLE.data)
        data[begin + 2] |= 0x80  # the position is new, it says: 8 bytes that are not there
        part = read_slocum(written(path, bytes(data)))
        assert part.report.error is not None or data[begin + 2] == WHOLE.data[begin + 2]
        assert inside(part.log, whole)


@pytest.mark.parametrize("name", ["comet-2016-174-05-000.dbd", "comet-2016-174-05-000.ebd"])
def test_a_piece_overwritten_in_a_real_file_is_noticed(tmp_path: Path, name: str) -> None:
    source = (DATA / name).read_bytes()
    for cache in DATA.glob("*.cac"):
        shutil.copy(cache, tmp_path)
    path = tmp_path / name
    part = read_slocum(written(path, source))
    whole, whole_kept = part.log, part.report.kept
    rng = np.random.default_rng(7)
    begin = source.index(b"sa\x124") + 16 + 12000  # after the first cycle, which holds 7 kB of values and no more
    kept = []
    for at in rng.integers(begin, len(source) - 3000, 100):
        data = bytearray(source)
        data[at : at + 3000] = rng.bytes(3000)  # more than a cycle, so that one's tag or states are hit
        part = read_slocum(written(path, bytes(data)))
        assert part.report.error is not None
        assert part.report.error.startswith("damaged at byte ")
        assert inside(part.log, whole)
        kept.append(part.report.kept)
    # 3000 bytes are lost and a cycle on either side, of 800 bytes in the one file, of 60 in the other
    assert np.median(kept) > 0.93 * whole_kept


@pytest.mark.parametrize("rest", [b"d", b"more", b"X" * 40])
def test_bytes_after_the_end_are_damage(tmp_path: Path, rest: bytes) -> None:
    report = read_slocum(written(tmp_path / "a.dbd", WHOLE.data + rest)).report
    assert report.error is not None
    assert "an end mark with" in report.error


def test_padding_after_the_end_is_none(tmp_path: Path) -> None:
    report = read_slocum(written(tmp_path / "a.dbd", WHOLE.data + b"\x1a" * 7)).report
    assert report.error is None
    assert report.warnings[0] == "7 bytes of padding after the end mark X"


def test_a_file_of_no_cycle_but_the_first_is_no_log(tmp_path: Path) -> None:
    for cycles, words in ((dive()[:1], "no usable record: 1 first cycle"), ([], "no usable record")):
        with pytest.raises(InputError, match=words):
            read([written(tmp_path / "a.dbd", made(NAVIGATION, cycles).data)])


@pytest.mark.parametrize(
    ("tags", "words"),
    [
        ({"num_ascii_tags": 13}, "is cut or damaged|missing|known values"),
        ({"num_ascii_tags": 200_000_000}, "num_ascii_tags is 200000000; at most 100 are allowed"),
        ({"num_ascii_tags": -3}, "num_ascii_tags is '-3'; a whole number from 1 to 999999999 is needed"),
        ({"encoding_ver": 6}, "encoding_ver is 6; 2 to 5 can be read"),
        ({"full_filename": None, "num_ascii_tags": 13}, "full_filename missing among its 13 tags"),
        ({"total_num_sensors": 200_000_000}, "6 of 6 sensors are listed as in the cycles; sensors_per_cycle is 7"),
        (
            {"sensors_per_cycle": 200_000_000},
            "state_bytes_per_cycle is 2; 200000000 sensors_per_cycle need 50000000",
        ),
        ({"sensors_per_cycle": 8}, "6 of 6 sensors are listed as in the cycles; sensors_per_cycle is 8"),
        ({"sensors_per_cycle": "six"}, "sensors_per_cycle is 'six'; a whole number from 1 to 999999999 is needed"),
        ({"sensors_per_cycle": 10**12}, "a whole number from 1 to 999999999 is needed"),
        ({"state_bytes_per_cycle": 1}, "state_bytes_per_cycle is 1; 6 sensors_per_cycle need 2, 2 bits each"),
        ({"sensor_list_crc": "deadbeef"}, "sensor_list_crc is deadbeef: the list is cut or damaged"),
        ({"sensor_list_factored": 1, "sensor_list_crc": "../etc/x"}, "8 hexadecimal digits are needed"),
        ({"filename_extension": "xyz"}, "filename_extension is xyz; dbd, mbd, sbd, ebd, nbd, tbd are read"),
    ],
)
def test_faults_of_the_head_are_named(tmp_path: Path, tags: dict[str, object], words: str) -> None:
    if tags.get("total_num_sensors"):
        tags = {**tags, "sensors_per_cycle": 7}
    path = written(tmp_path / "a.dbd", made(NAVIGATION, dive(), **tags).data)  # type: ignore[arg-type]
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(InputError, match=words):
        read_slocum(path)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 50_000  # kB; nothing announced is allocated


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (b" 4 m_depth", b" 3 m_depth", "line 2 is 's: T    1    1 3 m_depth m'"),
        (b"   2 4 m_pitch", b"   1 4 m_pitch", "places of its sensors are not 0, 1, 2 ... in order"),
        (b" m\n", b"\n", "line 2 is 's: T    1    1 4 m_depth'"),
    ],
)
def test_faults_of_the_sensor_list_are_named(tmp_path: Path, old: bytes, new: bytes, words: str) -> None:
    text = sensor_lines(NAVIGATION).replace(old, new)
    data = made(NAVIGATION, dive(), sensor_list_crc="").data.replace(sensor_lines(NAVIGATION), text)
    with pytest.raises(InputError) as caught:
        read_slocum(written(tmp_path / "a.dbd", data))
    assert words in str(caught.value)


def test_a_list_without_checksum_is_checked_line_by_line(tmp_path: Path) -> None:
    """Lines of sensors that are not in the cycles, too."""
    data = made(NAVIGATION, dive(), unused=["m_air_pump"], sensor_list_crc="").data
    assert read_slocum(written(tmp_path / "a.dbd", data)).report.error is None
    data = data.replace(b"4 m_air_pump", b"\x07 m_air_pump")
    with pytest.raises(InputError, match=r"sensor list: line \d+ is 's: F .*m_air_pump nodim'"):
        read_slocum(written(tmp_path / "a.dbd", data))


def test_known_values_show_damage(tmp_path: Path) -> None:
    data = bytearray(WHOLE.data)
    data[WHOLE.cycles[0] - 3] ^= 1
    with pytest.raises(InputError, match="cycle of known values that follows the header is cut or damaged"):
        read_slocum(written(tmp_path / "a.dbd", bytes(data)))


def test_without_a_clock_nothing_is_read(tmp_path: Path) -> None:
    path = written(tmp_path / "a.dbd", made(NAVIGATION[1:], dive()).data)
    with pytest.raises(InputError, match="none of its 5 sensors tells the time; m_present_time or sci_m_present_time"):
        read_slocum(path)


FACTORED = made(NAVIGATION, dive(), factored=True, unused=["m_other", "m_more"])
CAC = f"{FACTORED.crc}.cac"


def test_a_missing_cache_is_named_with_the_three_places(tmp_path: Path, glider: Run) -> None:
    path = written(tmp_path / "a.dbd", FACTORED.data)
    one_line_error(
        glider("replay", path), str(path), f"its cache {CAC} (or {FACTORED.crc}.ccc) is missing", "--cache DIR"
    )
    elsewhere = tmp_path / "elsewhere"
    one_line_error(glider("replay", path, "--cache", elsewhere), "--cache", "is no folder")
    elsewhere.mkdir()
    line = one_line_error(
        glider("replay", path, "--cache", elsewhere), f"{tmp_path}, {tmp_path / 'cache'}, {elsewhere}"
    )
    assert "--cache DIR" not in line
    written(elsewhere / CAC.upper(), FACTORED.cache)
    assert glider("replay", path, "--cache", elsewhere).returncode == 0


@pytest.mark.parametrize("place", [".", "cache"])
@pytest.mark.parametrize("ending", ["cac", "CAC", "ccc", "CCC"])
@pytest.mark.parametrize("lines", [b"\n", b"\r\n"])
def test_caches_are_found_however_they_are_named(tmp_path: Path, place: str, ending: str, lines: bytes) -> None:
    path = written(tmp_path / "a.dbd", FACTORED.data)
    (tmp_path / "cache").mkdir()
    text = FACTORED.cache.replace(b"\n", lines)
    name = f"{FACTORED.crc.upper() if ending.isupper() else FACTORED.crc}.{ending}"
    written(tmp_path / place / name, packed(text) if ending.lower() == "ccc" else text)
    assert read_slocum(path).report.kept == 11


@pytest.mark.parametrize(
    "text", [FACTORED.cache[:-5], FACTORED.cache.replace(b"4 m_depth", b"8 m_depth"), b"", b"s:\xff"]
)
def test_a_wrong_cache_is_not_used(tmp_path: Path, text: bytes) -> None:
    path = written(tmp_path / "a.dbd", FACTORED.data)
    written(tmp_path / CAC, text)
    with pytest.raises(InputError, match=f"its cache .*{CAC} is cut or damaged: the checksum of its text is not"):
        read_slocum(path)
    (tmp_path / "cache").mkdir()
    written(tmp_path / "cache" / CAC, FACTORED.cache)
    assert read_slocum(path).report.kept == 11


def test_a_cache_of_another_number_of_sensors_is_refused(tmp_path: Path) -> None:
    other = made(NAVIGATION, dive(), factored=True, unused=["m_other"], total_num_sensors=9)
    written(tmp_path / f"{other.crc}.cac", other.cache)
    with pytest.raises(
        InputError, match="6 of 7 sensors are listed as in the cycles; sensors_per_cycle is 6, total_num"
    ):
        read_slocum(written(tmp_path / "a.dbd", other.data))


def test_one_file_without_cache_does_not_stop_the_others(tmp_path: Path) -> None:
    written(tmp_path / "a.dbd", FACTORED.data)
    written(tmp_path / "b.ebd", made(SCIENCE, cast(), extension="ebd").data)
    reports = read([tmp_path]).files
    assert [report.kept for report in reports] == [0, 7]
    assert f"its cache {CAC}" in (reports[0].error or "")


def test_a_damaged_block_of_a_compressed_file_is_told(tmp_path: Path) -> None:
    data = made(SCIENCE, cast(3000), extension="ebd").data
    blocks = bytearray(packed(data))
    second = 2 + int.from_bytes(blocks[:2], "big")
    blocks[second + 10 : second + 400] = bytes(390)
    part = read_slocum(written(tmp_path / "a.ecd", bytes(blocks)))
    assert part.report.error is not None
    assert f"compressed data cut short or damaged at byte {second} of the file" in part.report.error
    assert 0 < part.report.kept < 3000


def test_a_sensor_that_is_not_there_is_named(tmp_path: Path) -> None:
    path = written(tmp_path / "a.dbd", WHOLE.data)
    with pytest.raises(InputError, match="has no sensor m_salt; it has 6, such as m_present_time, m_depth, m_pitch"):
        sensors(path, ["m_salt"])


def test_a_value_before_any_is_no_sample(tmp_path: Path) -> None:
    cycles: list[Cycle] = [{k: v for k, v in dive()[0].items() if k != "m_pitch"}, *dive()[1:]]
    cycles[1] = {**cycles[1], "m_pitch": SAME}
    part = read_slocum(written(tmp_path / "a.dbd", made(NAVIGATION, cycles).data))
    assert len(part.log["pitch"]) == 10
    assert "m_pitch: 1 cells left out that are no number" in part.report.warnings
