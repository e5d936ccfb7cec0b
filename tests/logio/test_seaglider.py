"""Seaglider files: every record kept or named; .eng, .log and .nc of a dive agree; traps and damaged files."""

from __future__ import annotations

import contextlib
import gzip
import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from conftest import ROOT

from glidercli.channels import PHASES
from glidercli.dives import phases
from glidercli.errors import InputError
from glidercli.logio import read
from glidercli.logio.reader import Part
from glidercli.logio.seaglider import is_seaglider, read_seaglider

SG561 = ROOT / "logs/seaglider-sg561"
OTHERS = ROOT / "tests/data/seaglider"
NC, ENG, LOG = (SG561 / f"p5610003.{ending}" for ending in ("nc", "eng", "log"))
REAL = sorted([p for folder in (SG561, OTHERS) for p in folder.iterdir() if p.suffix in (".nc", ".eng", ".log")])
SERIES = {  # dimensions that channels are taken from
    "p5610003.nc": ("sg_data_point", "gc_event", "gc_state", "gps_info"),
    "p2490010.nc": ("sg_data_point", "ctd_data_point", "gc_event", "gc_state", "gps_info"),
    "p1710100.nc": (
        "sg_data_point", "ctd_data_point", "gc_event", "gc_state", "gps_info", "ad2cp_inv_glider_point",
    ),
}  # fmt: skip


def read_one(path: Path) -> Part:
    part = read_seaglider(path)
    report = part.report
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    assert len(part.record_ns) == report.kept
    assert (np.diff(part.record_ns) >= 0).all()
    return part


def lines_after(path: Path, mark: str) -> list[str]:
    lines = path.read_text().splitlines()
    return [line for line in lines[lines.index(mark) + 1 :] if line.strip()]


def test_real_files_are_there() -> None:
    assert len(REAL) == 11


@pytest.mark.parametrize("path", REAL, ids=lambda path: path.name)
def test_records_are_those_that_others_count(path: Path) -> None:
    assert is_seaglider(path)
    part = read_one(path)
    report = part.report
    assert report.error is None
    if path.suffix == ".eng":
        assert report.records == report.kept == len(lines_after(path, "%data:"))
    elif path.suffix == ".log":
        lines = [line.split(",")[0] for line in lines_after(path, "data:")]
        assert report.records == len(lines)
        ends = sum(",end " in line for line in lines_after(path, "data:") if line.startswith("$STATE"))
        kept = sum(key in ("$GC", "$STATE", "$GPS", "$GPS1", "$GPS2") for key in lines) - ends
        assert report.kept == kept
    else:
        with netCDF4.Dataset(path) as file:
            assert report.records == sum(len(file.dimensions[name]) for name in SERIES[path.name])
            for channel, name in (("pitch", "eng_pitchAng"), ("depth", "depth"), ("pressure", "pressure")):
                assert len(part.log[channel]) == np.isfinite(file[name][:].filled(np.nan)).sum()
            raw, flags = file["temperature_raw"][:].filled(np.nan), file["temperature_raw_qc"][:].astype(str)
            assert len(part.log["temperature"]) == (np.isfinite(raw) & np.isin(flags, ["0", "1", "2", "5"])).sum()


def test_a_folder_reads_the_nc_alone() -> None:
    reading = read([SG561])
    reports = {report.path.suffix: report for report in reading.files}
    assert set(reports) == {".nc", ".eng", ".log"}  # sg_calib_constants.m goes with them
    assert reports[".nc"].kept == 84
    assert reports[".eng"].dropped == (("its recording is in p5610003.nc", 54),)
    assert reports[".log"].kept == 0


def test_eng_and_log_together_tell_what_the_nc_tells() -> None:
    texts, nc = read([ENG, LOG]).log, read([NC]).log
    channels = ("pitch", "roll", "heading", "mass_position", "mass_rotation", "ballast_volume", "latitude", "longitude")
    for name in channels:
        np.testing.assert_array_equal(texts[name].time_ns, nc[name].time_ns)
        # the same printed digits through other arithmetic
        np.testing.assert_allclose(texts[name].values, nc[name].values, rtol=1e-12, atol=1e-12)
    np.testing.assert_array_equal(texts["depth"].time_ns, nc["depth"].time_ns)
    with netCDF4.Dataset(NC) as file:
        np.testing.assert_allclose(texts["depth"].values, file["eng_depth"][:] / 100.0, rtol=1e-12)
    # the vehicle reckons depth without its latitude: gravity differs by 0.5 % at most between equator and pole
    np.testing.assert_allclose(texts["depth"].values, nc["depth"].values, rtol=5e-3)
    begun = {"dive", "inflection", "climb", "surface"}
    assert {PHASES[int(value)] for value in texts["phase"].values} == begun
    np.testing.assert_array_equal(texts["phase"].time_ns, nc["phase"].time_ns)
    np.testing.assert_array_equal(texts["phase"].values, nc["phase"].values)
    assert texts.events == nc.events


@pytest.mark.parametrize("paths", [[ENG, LOG], [ENG], [LOG], [NC]], ids=["eng-log", "eng", "log", "nc"])
def test_every_depth_has_the_phase_that_the_states_tell(paths: list[Path]) -> None:
    # $STATE lines of the .log, s since the start: the dive begins at 13, apogee 706, climb 793, surface coast 1607
    log = read(paths).log
    assert set(log["depth"].time_ns) <= set(log["phase"].time_ns)
    since = (log["phase"].time_ns - np.datetime64("2016-05-04T18:14:19", "ns").astype(np.int64)) * 1e-9
    state = np.searchsorted([13.0, 706.0, 793.0, 1607.0], since, side="right")
    told = [PHASES[int(value)] for value in log["phase"].values]
    assert told == [("", "dive", "inflection", "climb", "surface")[number] for number in state]


def texts_of(tmp_path: Path, eng: str, log: str, source: Path = LOG, pack: bool = False) -> Path:
    """A folder with a .eng and a .log under other names."""
    for name, file in ((eng, ENG), (log, source)):
        data = file.read_bytes()
        (tmp_path / name).write_bytes(gzip.compress(data) if pack else data)
    return tmp_path


@pytest.mark.parametrize(
    ("eng", "log"), [("p5610003.ENG", "p5610003.LOG"), ("p5610003.eng.gz", "p5610003.log.gz"), ("dive 3.eng", "dive 3.log")]
)  # fmt: skip
def test_the_log_beside_is_found_in_capitals_and_packed(tmp_path: Path, eng: str, log: str) -> None:
    found = read([texts_of(tmp_path, eng, log, pack=eng.endswith("gz"))]).log
    expected = read([ENG, LOG]).log
    for name in ("heading", "mass_position", "phase"):
        np.testing.assert_array_equal(found[name].values, expected[name].values)


def test_a_log_of_another_dive_or_name_is_told_and_not_used(tmp_path: Path) -> None:
    other = read_one(texts_of(tmp_path, ENG.name, LOG.name, OTHERS / "p5610004.log") / ENG.name)
    assert "p5610003.log beside it is not used: it is of sg561.6.4, this is sg561.6.3" in other.report.warnings
    (tmp_path / LOG.name).rename(tmp_path / "other.log")
    none = read_one(tmp_path / ENG.name)
    assert any(warning.startswith("no p5610003.log beside it") for warning in none.report.warnings)
    for part in (other, none):
        assert "heading" not in part.log
        assert "phase" not in part.log


def test_a_dive_without_its_log_still_dives_beside_one_that_has_it(tmp_path: Path) -> None:
    for name in ("p5610004.eng", "p5610004.log", "p5610005.eng"):
        shutil.copy(OTHERS / name, tmp_path)
    shutil.copy(ENG, tmp_path)
    log = read([tmp_path]).log
    assert [interval.name for interval in phases(log)] == ["dive", "climb"] * 3


def test_a_log_that_was_cut_tells_no_phase_after_its_end(tmp_path: Path) -> None:
    shutil.copy(ENG, tmp_path)
    text = LOG.read_text()
    (tmp_path / LOG.name).write_text(text[: text.index("$GC,1068")])  # the last event that is left is at 978 s
    part = read_one(tmp_path / ENG.name)
    rows = part.log["depth"].time_ns
    end = np.datetime64("2016-05-04T18:14:19", "ns").astype(np.int64) + 983 * 10**9  # 2 s of roll within the event
    np.testing.assert_array_equal(part.log["phase"].time_ns, rows[rows < end])


def test_lines_may_end_in_any_way(tmp_path: Path) -> None:
    for ends in (b"\r\n", b"\r"):
        for file in (ENG, LOG):
            (tmp_path / file.name).write_bytes(file.read_bytes().replace(b"\n", ends))
        found, expected = read([tmp_path]), read([ENG, LOG])
        assert [r.kept for r in found.files] == [r.kept for r in expected.files]
        np.testing.assert_array_equal(found.log["heading"].values, expected.log["heading"].values)


def test_times_are_those_of_the_printed_start() -> None:
    first = read_one(ENG).log["pitch"].time_ns[0].astype("datetime64[ns]")
    assert first == np.datetime64("2016-05-04T18:14:19") + np.timedelta64(41733, "ms")  # year 116, elaps_t 41.733


def classic(tmp_path: Path, left_out: Callable[[str], bool] = lambda name: False) -> Path:
    """The .nc as basestation 2 writes it: NetCDF-3, without states and TEOS-10 quantities."""
    path = tmp_path / "p5610003.nc"
    with netCDF4.Dataset(NC) as old, netCDF4.Dataset(path, "w", format="NETCDF3_CLASSIC") as new:
        old.set_auto_mask(False)
        for name, dimension in old.dimensions.items():
            new.createDimension(name, len(dimension))
        new.setncatts({name: old.getncattr(name) for name in old.ncattrs()})
        for name, variable in old.variables.items():
            later = name.startswith(("gc_state", "gsw_", "absolute_", "conservative_"))
            if later or left_out(name):
                continue
            copy = new.createVariable(name, variable.dtype, variable.dimensions)
            copy.setncatts({n: variable.getncattr(n) for n in variable.ncattrs() if n != "_FillValue"})
            copy[...] = variable[...]
    return path


def test_netcdf_3_of_basestation_2_is_the_same(tmp_path: Path) -> None:
    old, new = read_one(classic(tmp_path)), read_one(NC)
    assert old.report.records == new.report.records - 10  # no gc_state
    assert (old.dive, old.holds) == (new.dive, new.holds) == ("sg561.6.3", ("sg561.6.3.eng", "sg561.6.3.log"))
    assert set(new.log.channels) - set(old.log.channels) == {"absolute_salinity", "conservative_temperature", "phase"}
    for name, channel in old.log.channels.items():
        np.testing.assert_array_equal(channel.time_ns, new.log[name].time_ns)
        np.testing.assert_array_equal(channel.values, new.log[name].values)


def test_a_packed_nc_is_the_same(tmp_path: Path) -> None:
    path = tmp_path / "p5610003.nc.gz"
    path.write_bytes(gzip.compress(NC.read_bytes()))
    assert is_seaglider(path)
    assert read_one(path).report.kept == 84


def test_quality_flags_are_counted() -> None:
    part = read_one(OTHERS / "p1710100.nc")
    assert "temperature_raw: 23 values of quality 3 (probably bad) left out" in part.report.warnings
    assert "salinity: 22 values of quality 8 (interpolated) left out" in part.report.warnings
    assert "eng_vbdCC: 721 values left out: the basestation's own interpolation of the motor events" in (
        part.report.warnings
    )
    assert {name for name, c in part.log.channels.items() if c.origin == "derived"} == {
        "salinity", "absolute_salinity", "conservative_temperature", "density", "speed_through_water", "phase",
        "current_east", "current_north", "current_up",
    }  # fmt: skip


def test_current_is_that_at_the_glider() -> None:
    log = read_one(OTHERS / "p1710100.nc").log
    with netCDF4.Dataset(OTHERS / "p1710100.nc") as file:
        below = file["ad2cp_inv_glider_depth"][:] > 0.0
        np.testing.assert_allclose(log["current_east"].values, file["ad2cp_inv_glider_uocn"][:][below])
        up = -np.interp(log["speed_through_water"].time_ns, log["depth"].time_ns[1:], np.diff(log["depth"].values))
        assert np.corrcoef(up, file["ad2cp_inv_glider_wttw"][:][below])[0, 1] > 0.9  # up is positive
    assert log["current_east"].time_ns[0] > log["latitude"].time_ns[1]  # after the last fix before the dive


def eng_file(tmp_path: Path, *rows: str) -> Path:
    lines = ENG.read_text().splitlines()
    path = tmp_path / "p5610003.eng"
    path.write_text("\n".join([*lines[: lines.index("%data:") + 1], *lines[-6:], *rows]) + "\n")
    return path


ROW = "67322.474 1663.474 700.000 262.900 23.400 -16.700 0.619 -29.910 147.668 51.000 4.000 6362.7 3428.5 1 2 3 4 5"


@pytest.mark.parametrize(
    ("row", "reason"),
    [
        ("67322.474 1663.474 700.000", "wrong number of fields"),
        (ROW.replace("1663.474", "soon"), "time cannot be read"),
        (ROW.replace("1663.474", "1e300"), "time cannot be read"),
        (ROW.replace("1663.474", "1633.473"), "time repeats"),
        (ROW.replace("1663.474", "1500"), "time goes back"),
        (ROW.replace("1663.474", "-46e6"), "clock not set: more than 30 days from the dive"),
        ("67322.474 1663.474 " + "0 " * 16, "all values zero"),
        ("67322.474 1663.474 " + "NaN " * 16, "no value"),
    ],
)
def test_each_trap_of_an_eng_is_dropped_by_name(tmp_path: Path, row: str, reason: str) -> None:
    report = read_one(eng_file(tmp_path, row)).report
    assert (report.records, report.kept, report.dropped) == (7, 6, ((reason, 1),))


def test_impossible_cells_are_left_out_and_counted(tmp_path: Path) -> None:
    part = read_one(eng_file(tmp_path, ROW.replace("23.400", "-95.0").replace("-16.700", "much")))
    assert part.report.kept == 7
    assert len(part.log["pitch"]) == len(part.log["roll"]) == 6
    assert "pitchAng: 1 values outside -90..90 deg left out" in part.report.warnings
    assert "rollAng: 1 cells left out that are no number" in part.report.warnings


def test_heading_without_magnetic_variation_is_left_out(tmp_path: Path) -> None:
    part = read_one(eng_file(tmp_path))
    assert "heading" not in part.log
    assert "head: 6 values left out: magnetic, and nothing tells the magnetic variation" in part.report.warnings
    shutil.copy(LOG, tmp_path)
    assert len(read_one(eng_file(tmp_path)).log["heading"]) == 6


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("$D_TGT,90", "a setting, no sample"),
        ("garbage", "no line of the form $KEY,value"),
        ("$GC,14,-0.58", "$GC: wrong number of fields"),
        ("$GPS,,,0.000,0.000,901,99.0,901,0.0", "$GPS: time cannot be read"),
        ("$GPS,311320,184309,7018.048,835.862,16,1.5,16,1.1", "$GPS: time cannot be read"),
        ("$GPS,060180,184309,7018.048,835.862,16,1.5,16,1.1", "$GPS: clock not set: more than 30 days from the dive"),
        ("$GPS,040516,190000,7018.048,835.862,16,99.0,99,1.1", "$GPS: no usable value"),
        ("$GPS,040516,190000,0.0,0.0,16,1.0,99,1.1", "$GPS: no usable value"),
        ("$GPS,040516,190000,7061.048,835.862,16,1.0,99,1.1", "$GPS: no usable value"),
        ("$GPS,040516,190000", "$GPS: no value"),
        ("$STATE,1700,begin dreaming", "$STATE: unknown state"),
        ("$STATE,soon,begin surface", "$STATE: time cannot be read"),
        ("$SM_CCo,soon,1,2", "$SM_CCo: the pump's run at the surface, events and no sample"),
    ],
)
def test_each_trap_of_a_log_is_dropped_by_name(tmp_path: Path, line: str, reason: str) -> None:
    path = tmp_path / LOG.name
    path.write_text(LOG.read_text() + line + "\n")
    before, after = read_one(LOG).report, read_one(path).report
    assert (after.records, after.kept) == (before.records + 1, before.kept)
    assert dict(after.dropped)[reason] == dict(before.dropped).get(reason, 0) + 1


OLD_GC = ["14,-0.58,-145.9,0.0,0,88,0.00,0.00,-71.45,0.0,0,0,0,269,2059,3244", "167,-1,-1,0,0,168,0,0,0,0,0,0,0,1,1,1"]


def test_a_log_before_version_65_has_events_without_head_and_positions_before(tmp_path: Path) -> None:
    lines = [line for line in LOG.read_text().splitlines() if not line.startswith(("$GC,", "$GCHEAD"))]
    path = tmp_path / LOG.name
    path.write_text("\n".join([*lines, *(f"$GC,{row}" for row in OLD_GC)]) + "\n")
    part = read_one(path)
    assert dict(part.report.dropped)["$GC: no depth or position, and no motor ran"] == 1
    assert part.log["ballast_volume"].values.tolist() == [pytest.approx((3244 - 2650) * -0.245296e-6)]
    stop = np.datetime64("2016-05-04T18:14:19") + np.timedelta64(85450, "ms")  # 14 s and 71.45 s
    assert part.log["ballast_volume"].time_ns[0].astype("datetime64[ns]") == stop


def change(tmp_path: Path, **values: Callable[[Any], Any]) -> Path:
    path = tmp_path / NC.name
    shutil.copy(NC, path)
    path.chmod(0o644)
    with netCDF4.Dataset(path, "a") as file:
        file.set_auto_mask(False)
        for name, make in values.items():
            file[name][:] = make(file[name][:])
    return path


def first_of(value: float) -> Callable[[Any], Any]:
    return lambda values: np.concatenate([[value], values[1:]])


@pytest.mark.parametrize(
    ("variable", "value", "reason"),
    [
        ("gc_st_secs", np.nan, "gc_event: time cannot be read"),
        ("gc_st_secs", 1e300, "gc_event: time cannot be read"),
        ("gc_st_secs", 0.0, "gc_event: clock not set: more than 30 days from the dive"),
        ("log_gps_time", 1e5, "gps_info: clock not set: more than 30 days from the dive"),
        ("log_gps_lat", 95.0, "gps_info: no usable value"),
        ("gc_state_state", 77, "gc_state: unknown state"),
    ],
)
def test_each_trap_of_a_nc_is_dropped_by_name(tmp_path: Path, variable: str, value: float, reason: str) -> None:
    report = read_one(change(tmp_path, **{variable: first_of(value)})).report
    assert dict(report.dropped)[reason] == 1


def test_impossible_counts_and_runs_leave_no_sample(tmp_path: Path) -> None:
    lines = [line for line in LOG.read_text().splitlines() if not line.startswith("$GC,")]
    head = "$GC,14,-0.58,-145.9,{pitch},2060,1296,1208,7777,0.0,0,88,0.00,0.00,{vbd},"
    rest = "0.000,16390,0.000,0.000,269,2059,3244,3240,3249,0,0,0,0,0,0,28.83,28.83,14.92"
    path = tmp_path / LOG.name
    path.write_text("\n".join([*lines, head.format(pitch=99999, vbd=1e300) + rest]) + "\n")
    part = read_one(path)
    assert "mass_position" not in part.log
    assert len(part.log["ballast_volume"]) == len(part.log["mass_rotation"]) == 1  # at the event's start
    assert "vbd_secs: 1 runs left out that outlast their event" in part.report.warnings
    assert "GC pitchCtl: 1 values outside -20..20 cm left out" in part.report.warnings


def test_a_clock_that_was_not_set_takes_its_rows_only(tmp_path: Path) -> None:
    unset = lambda seconds: np.concatenate([seconds[:5] - 4e8, seconds[5:]])  # noqa: E731
    report = read_one(change(tmp_path, time=unset, ctd_time=unset)).report
    assert dict(report.dropped)["sg_data_point: clock not set: more than 30 days from the dive"] == 5


def test_ctd_keeps_its_own_times(tmp_path: Path) -> None:
    part = read_one(change(tmp_path, ctd_time=lambda seconds: seconds + 0.5))
    shift = part.log["temperature"].time_ns - part.log["depth"].time_ns
    assert (shift == 500_000_000).all()
    assert part.report.records == 89 + 54  # the CTD is a series of its own then


@pytest.mark.parametrize("share", [0.001, 0.1, 0.5, 0.9, 0.999])
@pytest.mark.parametrize("kind", ["hdf5", "classic"])
def test_a_cut_nc_is_named_as_damaged(tmp_path: Path, kind: str, share: float) -> None:
    whole = (NC if kind == "hdf5" else classic(tmp_path)).read_bytes()
    path = tmp_path / "cut.nc"
    path.write_bytes(whole[: int(len(whole) * share)])
    with pytest.raises(InputError, match="is damaged") as caught:
        read_seaglider(path)
    assert "\n" not in str(caught.value)


def test_a_header_that_promises_too_much_allocates_nothing(tmp_path: Path) -> None:
    data = bytearray(classic(tmp_path).read_bytes())
    at = data.index(b"sg_data_point") + 16  # the name is padded to four bytes; its length follows
    for length in (b"\x7f\xff\xff\xff", b"\xff\xff\xff\xff"):
        data[at : at + 4] = length
        (tmp_path / "large.nc").write_bytes(data)
        with pytest.raises(InputError, match=r"is damaged: variable .* should reach beyond the end of the file"):
            read_seaglider(tmp_path / "large.nc")


def test_a_heap_of_zeros_does_not_hang(tmp_path: Path) -> None:
    data = bytearray(NC.read_bytes())
    at = data.index(b"GCOL\x01")
    data[at + 16 : at + 528] = bytes(512)  # the HDF5 library would go round for ever
    path = tmp_path / NC.name
    path.write_bytes(data)
    assert is_seaglider(path)
    with pytest.raises(InputError, match="is damaged: a global heap holds an object that does not fit in it"):
        read_seaglider(path)


@pytest.mark.parametrize("kind", ["hdf5", "classic", "eng", "log"])
def test_garbled_bytes_are_an_error_or_an_account(tmp_path: Path, kind: str) -> None:
    source = {"hdf5": NC, "eng": ENG, "log": LOG}.get(kind) or classic(tmp_path)
    whole = np.frombuffer(source.read_bytes(), np.uint8)
    random = np.random.default_rng(7)
    for _ in range(15):
        data = whole.copy()
        data[random.integers(0, len(data), 3)] ^= np.uint8(1 << random.integers(0, 8))
        path = tmp_path / f"garbled{source.suffix}"
        path.write_bytes(data.tobytes())
        with contextlib.suppress(InputError):
            read_one(path)


def test_what_is_no_dive_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "other.nc"
    with netCDF4.Dataset(path, "w") as file:
        file.createDimension("sg_data_point", 3)
        file.createVariable("salt", "f8", ("sg_data_point",))
    with pytest.raises(InputError, match="has none of the times of a dive"):
        read_seaglider(path)
    text = tmp_path / "p5610003.log"
    text.write_text(LOG.read_text().replace("start: 5 4 116 18 14 19", "start: 15 4 116 18 14 19"))
    with pytest.raises(InputError, match="is no time; allowed: month day years-since-1900"):
        read_seaglider(text)


def test_an_enormous_setting_is_no_number(tmp_path: Path) -> None:
    """A warning of numpy, an error here, told of the overflow of its product with a count."""
    path = tmp_path / "a.log"
    text = LOG.read_text("latin-1")
    assert "\n$ROLL_CNV," in text
    path.write_text(re.sub(r"\n\$(ROLL|PITCH|VBD)_CNV,[^\n]*", r"\n$\1_CNV,-1e308", text), "latin-1")
    log = read([path]).log
    assert not {"mass_position", "mass_rotation", "ballast_volume"} & log.channels.keys()
    assert len(log["latitude"]) == len(read([LOG]).log["latitude"])
