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
    assert "depth: SIMULATED less MEASURED (deeper +), m (rms 3)" in shown
    assert "heading: difference, deg (rms 15)" in shown
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
    away = simulated.with_metadata(origin_latitude_deg="18.0", origin_longitude_deg="-112.0")
    path = written(measured, tmp_path, beside=[away])
    first = np.squeeze(rows(path, "/world/beside/1/vehicle", "Transform3D:translation")[2])[0]
    np.testing.assert_allclose(first, [9.0, 9.0, 6.0], atol=1e-5)  # its own places; float32
    # WGS-84 at 18 deg N: 105,905 m a degree of longitude, 136 deg apart across 180 deg
    assert "began 14,403 km from MEASURED, which one scene cannot hold" in page(path)
    assert any("FROM ONE START" in name for name in panels(path))
    spot = np.squeeze(rows(path, "/map/beside/1/vehicle", "GeoPoints:positions")[2])[0]
    np.testing.assert_allclose(spot, [18.0, -112.0], atol=1e-3)  # 9 m from it
    near = simulated.with_metadata(origin_latitude_deg="18.01", origin_longitude_deg="112.02")
    assert not any("FROM ONE START" in name for name in panels(written(measured, tmp_path, "near.rrd", beside=[near])))


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
    assert {"tracks, grid 20 m", "blue: MEASURED, attitude", "green: *two* SIMULATED, attitude"} <= shown
    assert "depth: difference (deeper +), m (rms 3, 3)" in shown
    assert rows(path, "/events", "TextLog:text")[2] == [["MEASURED: apogee, depth 100.0 m"]]
    assert rows(path, "/beside/2/events", "TextLog:text")[2] == [["*two* SIMULATED: apogee, depth 100.0 m"]]


def test_other_zeros_are_told(measured: Log, simulated: Log, tmp_path: Path) -> None:
    own = measured.with_metadata(ballast_volume_zero="the vehicle's own")
    path = written(own, tmp_path, beside=[simulated])
    assert "Counted from different zeros, which is in the difference: ballast volume." in page(path)
    assert any(name.endswith("cm3 (rms 3), other zeros") for name in panels(path))


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
