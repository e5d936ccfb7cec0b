"""Do logs side by side in Rerun tell which is which, and how far they are apart?"""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rrd_files import START, channel, log_of, page, panels, rows, samples, stored, told_by_the_verifier, written

from glidercli.channels import CHANNELS
from glidercli.errors import InputError
from glidercli.log import Event, Log
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun import titles

MEASURED = np.arange(0.0, 1000.0, 7.0)
SIMULATED = np.concatenate([np.arange(30.0, 401.0, 10.0), np.arange(600.0, 901.0, 10.0)])  # a gap of 200 s
ORIGIN = {"origin_latitude_deg": "18.0", "origin_longitude_deg": "112.0"}


def flight(times: Any, origin: Any, offset: float, turned: float, metadata: dict[str, str] | None = None) -> Log:
    """Depth 0.1 t + offset; heading turns past north once in 100 s, ahead by so many deg; the rest at its simplest."""
    t = np.asarray(times, dtype=float)
    values = {
        "depth": 0.1 * t + offset, "down": 0.1 * t + offset, "north": 0.3 * t, "east": 0.2 * t + offset,
        "roll": 0.0, "pitch": np.radians(-25.0 + offset), "heading": np.radians((3.6 * t + turned) % 360.0),
        "ballast_volume": 1e-4 + 1e-6 * offset, "temperature": 20.0 - 0.01 * t, "phase": 1.0,
    }  # fmt: skip
    channels = [channel(name, t, value, origin) for name, value in values.items()]
    events = (Event("apogee", START + 10**9 * int(t[-1]), 100.0),)
    return log_of(channels, origin, metadata if metadata is not None else ORIGIN, events)


@pytest.fixture
def measured() -> Log:
    return flight(MEASURED, "measured", 0.0, 350.0)


@pytest.fixture
def simulated() -> Log:
    return flight(SIMULATED, "simulated", 3.0, 5.0)


def difference(path: Path, name: str, number: int = 1) -> tuple[Any, Any]:
    utc, _, values = rows(path, f"/difference/{number}/{name}", "Scalars:scalars")
    return (utc - START) / 1e9, np.ravel(values)


@pytest.mark.parametrize("turned", [False, True])
def test_differences_are_simulated_less_measured_at_measured_times(
    measured: Log, simulated: Log, turned: bool, tmp_path: Path
) -> None:
    first, other = (simulated, measured) if turned else (measured, simulated)
    path = written(first, tmp_path, beside=[other])
    assert "without error" in told_by_the_verifier(path, tmp_path)
    known = ((MEASURED >= 30) & (MEASURED <= 400)) | ((MEASURED >= 600) & (MEASURED <= 900))
    wanted = {"depth": 3.0, "pitch": 3.0, "ballast_volume": 3.0, "heading": 15.0, "temperature": 0.0}  # deg, cm3
    for name, value in wanted.items():
        seconds, values = difference(path, name)
        np.testing.assert_allclose(seconds, MEASURED, atol=1e-6)
        np.testing.assert_array_equal(np.isfinite(values), known, err_msg=name)
        np.testing.assert_allclose(values[known], value, atol=1e-9, err_msg=name)  # rounding of turns about 360 deg
    shown = panels(path)
    which = "blue less orange" if turned else "orange less blue"
    assert f"depth, m, {which}; deeper positive; rms 3" in shown
    assert f"heading, deg, {which}; rms 15" in shown
    assert "That of depth is positive where SIMULATED is deeper, though depth is plotted negative down." in page(path)
    labels = ["SIMULATED", "MEASURED"] if turned else ["MEASURED", "SIMULATED"]
    assert f"blue: {labels[0]}, orange: {labels[1]}, grid 20 m" in shown


def test_samples_of_each_log_come_back(measured: Log, simulated: Log, tmp_path: Path) -> None:
    path = written(measured, tmp_path, beside=[simulated])
    for log, place, colour in ((measured, "", look.BLUE), (simulated, "/beside/1", look.ORANGE)):
        for name, sent in log.channels.items():
            if name == "phase":
                continue
            entity = f"{place}/{CHANNELS[name].group}/{name}"
            utc, elapsed, values = samples(path, entity)
            np.testing.assert_array_equal(utc, sent.time_ns)
            np.testing.assert_array_equal(elapsed, sent.time_ns - START)
            factor = -1.0 if name == "depth" else CHANNELS[name].factor
            np.testing.assert_array_equal(values, sent.values * factor)
            kind = "SeriesPoints" if name == "heading" else "SeriesLines"
            assert rows(path, entity, f"{kind}:names")[2] == [[log.kind]]
            packed = look.packed(np.array([colour], np.uint8)).tolist()
            assert rows(path, entity, f"{kind}:colors")[2] == [packed]
        track = np.stack([log[name].values for name in ("north", "east", "down")], axis=-1)
        places = rows(path, f"/world{place}/vehicle", "Transform3D:translation")[2]
        np.testing.assert_allclose(np.squeeze(places), track, atol=3e-5)  # float32 of 300 m


def test_track_is_brought_to_the_origin_of_the_first(measured: Log, simulated: Log, tmp_path: Path) -> None:
    away = simulated.with_metadata(origin_latitude_deg="18.01", origin_longitude_deg="112.02")
    path = written(measured, tmp_path, beside=[away])
    first = np.squeeze(rows(path, "/world/beside/1/vehicle", "Transform3D:translation")[2])[0]
    # WGS-84 at 18 deg N: 110,647 m a degree of latitude, 105,909 m of longitude; own track 9 m north, 9 m east
    np.testing.assert_allclose(first[:2], [1106.5 + 9.0, 2118.1 + 9.0], rtol=1e-3)
    assert not any(entity.startswith("/difference/1/north") for entity, _ in stored(path))


def test_tracks_an_ocean_apart_begin_at_one_place(measured: Log, simulated: Log, tmp_path: Path) -> None:
    """The other begins 9 m north and 9 m east of its origin, which is 136 deg to the east across 180 deg."""
    away = simulated.with_metadata(origin_latitude_deg="18.0", origin_longitude_deg="-112.0")
    path = written(measured, tmp_path, beside=[away])
    places = np.squeeze(rows(path, "/world/beside/1/vehicle", "Transform3D:translation")[2])
    np.testing.assert_allclose(places[0], [0.0, 0.0, 6.0], atol=1e-5)  # float32 of some metres
    np.testing.assert_allclose(places[-1], [0.3 * 870, 0.2 * 870, 93.0], atol=3e-5)  # float32 of 300 m
    strip = rows(path, "/world/beside/1/track", "LineStrips3D:strips")[2][0][0]
    np.testing.assert_allclose(strip[0], [0.0, 0.0, 6.0], atol=1e-5)
    half = np.sin(np.radians(68.0)) * np.cos(np.radians(18.0))  # a great circle between places of one latitude
    km = 2 * 6371.0 * np.arcsin(half)
    (title,) = [name for name in panels(path) if "each from its own start" in name]
    found = float(title.split("start, ")[1].split(" km")[0].replace(",", ""))
    assert found == pytest.approx(km, rel=0.011)  # 0.6 % for the flattened globe, 0.4 % for three digits
    assert f"SIMULATED began {found:,.0f} km from MEASURED" in page(path)
    spots = np.squeeze(rows(path, "/map/beside/1/vehicle", "GeoPoints:positions")[2])
    # within half a turn of the other, so that one map shows both; 9 m are 1e-4 deg
    np.testing.assert_allclose(spots[0], [18.0, 248.0], atol=1e-4)


@pytest.mark.parametrize(("north_km", "far"), [(2.8, False), (3.4, True)])
def test_ten_times_their_size_is_too_far(
    measured: Log, simulated: Log, north_km: float, far: bool, tmp_path: Path
) -> None:
    """The larger track goes 0.3 x 994 m to the north: 2.98 km are ten times that. A degree of latitude is 110.65 km."""
    away = simulated.with_metadata(
        origin_latitude_deg=str(18.0 + north_km / 110.65), origin_longitude_deg="112.0"
    )  # fmt: skip
    path = written(measured, tmp_path, beside=[away])
    assert far == any("from its own start" in name for name in panels(path))
    place = np.squeeze(rows(path, "/world/beside/1/vehicle", "Transform3D:translation")[2])[0]
    assert place[0] == pytest.approx(0.0 if far else 1000.0 * north_km + 9.0, abs=2.0)  # 0.05 % of the degree


def test_titles_have_room(measured: Log, simulated: Log, tmp_path: Path) -> None:
    """Widths in px as seen in the viewer are those that are reckoned with; then long names, and many logs."""
    seen = {
        "speed through water: difference, m/s (rms 0.0163, 0.0": 314,
        "blue: MEASURED, orange: SIMULATED FROM A RECONSTRUC": 367,
    }
    for title, px in seen.items():
        assert px <= titles.width(title) < 1.1 * px
    names = ["a log with a very long name indeed", *("Wörter in another language 海洋" for _ in range(5))]
    for others in (1, 2, 5):
        path = written(measured, tmp_path, f"{others}.rrd", beside=[simulated] * others, names=names[: others + 1])
        rooms = [titles.LEFT, titles.MIDDLE, titles.RIGHT]
        shown = {name for name in panels(path) if name}
        assert all(titles.width(name) <= max(rooms) for name in shown), shown
        short = [name for name in shown if name.split(":")[0] in ("blue", "orange", "green", "violet", "teal", "gold")]
        assert len([name for name in short if titles.width(name) <= titles.hull_room(min(others + 1, 3))]) >= others + 1


def test_logs_of_other_days_start_together(measured: Log, simulated: Log, tmp_path: Path) -> None:
    later = simulated.shifted(86400 * 10**9)
    path = written(measured, tmp_path, beside=[later])
    utc, elapsed, _ = samples(path, "/beside/1/navigation/depth")
    assert (utc[0], elapsed[0]) == (START, 0)
    assert "does not overlap in UTC, so both start at elapsed 0" in page(path)
    assert "shifted by -86430.000 s" in page(path)
    seconds, values = difference(path, "depth")
    shared = np.isfinite(values)
    assert seconds[shared].max() <= 871.0
    np.testing.assert_allclose(values[shared], 3.0 + 3.0, atol=1e-9)  # 30 s at 0.1 m/s
    assert "overlap" not in page(written(measured, tmp_path, "utc.rrd", beside=[simulated]))


def test_page_and_names_tell_which_is_which(measured: Log, simulated: Log, tmp_path: Path) -> None:
    again = dataclasses.replace(simulated, metadata={**ORIGIN, "title": "# again"})
    path = written(measured, tmp_path, beside=[simulated, again], names=["sea", "one", "*two*"])
    text = page(path)
    assert text.startswith("# sea MEASURED beside one SIMULATED beside \\*two\\* SIMULATED\n")
    for line in ("**blue**: sea MEASURED", "**orange**: one SIMULATED", "**green**: \\*two\\* SIMULATED"):
        assert f"- {line}\n" in text
    assert "Recorded by an instrument at sea" in text
    assert "Computed by a model" in text
    assert "# again" not in text.splitlines()
    shown = panels(path)
    assert {"tracks, grid 20 m", "blue", "orange", "green"} <= shown
    assert "depth, m, less blue; deeper positive; rms 3, 3" in shown
    assert rows(path, "/events", "TextLog:text")[2] == [["MEASURED: apogee, depth 100.0 m"]]
    assert rows(path, "/beside/2/events", "TextLog:text")[2] == [["*two* SIMULATED: apogee, depth 100.0 m"]]


def test_other_zeros_are_told(measured: Log, simulated: Log, tmp_path: Path) -> None:
    own = measured.with_metadata(ballast_volume_zero="the vehicle's own")
    path = written(own, tmp_path, beside=[simulated])
    assert "Counted from different zeros, which is in the difference: ballast volume." in page(path)
    assert any(name.startswith("ballast volume, cm3, orange less blue; other zeros") for name in panels(path))


def test_logs_with_nothing_in_common_make_a_recording(measured: Log, tmp_path: Path) -> None:
    other = log_of([channel("conductivity", [0.0, 5.0], [3.0, 3.1])], "simulated", {})
    path = written(measured, tmp_path, beside=[other])
    assert "without error" in told_by_the_verifier(path, tmp_path)
    assert not any(entity.startswith("/difference") for entity, _ in stored(path))
    assert "conductivity, S/m, SIMULATED only" in panels(path)


def test_same_logs_give_the_same_bytes_and_others_do_not(measured: Log, simulated: Log, tmp_path: Path) -> None:
    once = written(measured, tmp_path, "a.rrd", beside=[simulated]).read_bytes()
    assert once == written(measured, tmp_path, "b.rrd", beside=[simulated]).read_bytes()
    deeper = flight(SIMULATED, "simulated", 4.0, 5.0)
    assert once != written(measured, tmp_path, "c.rrd", beside=[deeper]).read_bytes()
    ids = {page(written(measured, tmp_path, f"{name}.rrd", beside=[simulated], names=["x", name])) for name in "de"}
    assert len(ids) == 2


def test_what_cannot_be_shown_is_refused(measured: Log, simulated: Log, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="1 for 2 logs"):
        written(measured, tmp_path, beside=[simulated], names=["one"])
    with pytest.raises(InputError, match="no sample"):
        written(measured, tmp_path, beside=[log_of([channel("depth", [], [])], "measured", {})])
