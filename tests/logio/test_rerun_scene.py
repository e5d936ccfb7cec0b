"""Is the scene of a Rerun recording true to the log: phases, water, map, sea? And does any log make one?"""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rrd_files import START, channel, log_of, page, panels, rows, stored, told_by_the_verifier, written

from glidercli.channels import CHANNELS
from glidercli.log import Event
from glidercli.logio.rerun import colours as look
from glidercli.logio.rerun.sea import Sea, nice
from glidercli.logio.rerun.sections import LIFT


def sinking(times: Any, **more: Any) -> list[Any]:
    """A track to the north-east at 0.1 m/s down, 0.3 and 0.4 m/s over ground."""
    t = np.asarray(times, dtype=float)
    values = {"depth": 0.1 * t, "north": 0.3 * t, "east": 0.4 * t, "down": 0.1 * t, **more}
    return [channel(name, t, value, "measured") for name, value in values.items()]


def test_depth_changes_its_colour_with_the_phase(tmp_path: Path) -> None:
    t = np.arange(0.0, 100.0, 10.0)
    phase = channel("phase", t[1:], [1, 1, 1, 4, 2, 2, 2, 0, 0])
    path = written(log_of([*sinking(t), phase], "measured", {}), tmp_path)
    utc, _, colours = rows(path, "/navigation/depth", "SeriesLines:colors")
    words = ["dive", "inflection", "climb", "surface"]
    wanted = [look.GREY, *(look.PHASE_COLOURS[word] for word in words)]  # grey before the first phase is known
    assert [c[0] for c in colours] == look.packed(np.array(wanted, np.uint8)).tolist()
    np.testing.assert_array_equal((utc - START) / 1e9, [0.0, 10.0, 40.0, 50.0, 80.0])
    assert "depth, m: dive blue, climb orange, surface green" in panels(path)


def test_water_is_drawn_at_the_depth_of_its_time(tmp_path: Path) -> None:
    t = np.concatenate([np.arange(0.0, 300.0, 10.0), np.arange(900.0, 1200.0, 10.0)])  # a gap of 610 s
    ctd = np.arange(-50.0, 1300.0, 7.0)
    water = channel("temperature", ctd, 20.0 - 0.01 * ctd, "measured")
    path = written(log_of([*sinking(t), water], "measured", {}), tmp_path)
    utc, _, depths = rows(path, "/section/temperature", "Scalars:scalars")
    seconds = (utc - START) / 1e9
    inside = ((ctd >= 0) & (ctd <= 290)) | ((ctd >= 900) & (ctd <= 1190))
    np.testing.assert_allclose(seconds, ctd[inside], atol=1e-6)  # a log's elapsed ns are exact in a double
    np.testing.assert_allclose(np.ravel(depths), -0.1 * ctd[inside], atol=1e-9)
    _, _, places = rows(path, "/world/water/temperature", "Points3D:positions")
    wanted = np.outer(ctd[inside], [0.3, 0.4, 0.1])
    np.testing.assert_allclose(places[0], wanted, atol=5e-5)  # float32 of 480 m: 3e-5
    _, _, colours = rows(path, "/section/temperature", "SeriesPoints:colors")
    ends = look.packed(look.scale("plasma", np.array([1.0, 0.0])))  # warmest first
    assert [colours[0][0], colours[-1][0]] == ends.tolist()
    assert "temperature, degC, over depth, m" in panels(path)


def test_colour_bar_tells_values_and_unit(tmp_path: Path) -> None:
    t = np.arange(0.0, 1001.0, 1.0)
    log = log_of([*sinking(t), channel("density", t, 1020.0 + 0.008 * t, "measured")], "measured", {})
    path = written(log, tmp_path)
    labels = rows(path, "/key/density/names", "Points2D:labels")[2][0]
    assert labels == ["1022", "1024", "1026", "kg/m3"]  # of 1020.08 to 1027.92, which hold 98 % of the values
    places = np.array(rows(path, "/key/density/names", "Points2D:positions")[2][0])
    heights = 180.0 * (1.0 - (np.array([1022.0, 1024.0, 1026.0]) - 1020.08) / 7.84)
    marks = np.array(rows(path, "/key/density/ticks", "LineStrips2D:strips")[2][0])
    np.testing.assert_allclose(marks[:, :, 1], np.column_stack([heights, heights]), atol=1e-4)  # float32
    np.testing.assert_allclose(places[:3, 1], heights - LIFT, atol=1e-4)


def test_water_without_depth_stands_in_lines_alone(tmp_path: Path) -> None:
    t = np.arange(0.0, 100.0, 1.0)
    log = log_of([channel("temperature", t, 10.0 + 0.1 * t), channel("salinity", t, 35.0 + 0.01 * t)], "measured", {})
    path = written(log, tmp_path)
    assert panels(path) == {"temperature, degC", "salinity, PSS-78", "about this recording"}
    assert "without error" in told_by_the_verifier(path, tmp_path)


@pytest.mark.parametrize("place", [(0.0, 179.999), (70.0, -179.999)])
def test_track_across_the_date_line_is_one_line(place: tuple[float, float], tmp_path: Path) -> None:
    t = np.arange(0.0, 3000.0, 10.0)
    east = np.sign(place[1]) * 0.4 * t
    told = {"origin_latitude_deg": repr(place[0]), "origin_longitude_deg": repr(place[1])}
    fixes = [channel("latitude", [1.0, 2990.0], place[0], "measured")]
    fixes.append(channel("longitude", [1.0, 2990.0], [place[1], -place[1]], "measured"))
    path = written(log_of([*sinking(t, east=east), *fixes], "measured", told), tmp_path)
    line = np.array(rows(path, "/map/track", "GeoLineStrings:line_strings")[2][0][0])
    assert np.ptp(line[:, 1]) == pytest.approx(
        2990 * 0.4 / (111_320 * np.cos(np.radians(place[0]))), rel=5e-3
    )  # sphere
    points = np.array(rows(path, "/map/fixes", "GeoPoints:positions")[2][0])
    assert np.ptp(points[:, 1]) == pytest.approx(0.002, rel=1e-6)
    _, _, moving = rows(path, "/map/vehicle", "GeoPoints:positions")
    np.testing.assert_allclose(np.squeeze(moving)[:, 1], line[:, 1], atol=1e-9)


@pytest.mark.parametrize(("deep", "times"), [(1000.0, 1.0), (100.0, 2.0), (20.0, 10.0)])
def test_depth_that_is_drawn_too_large_is_said_so(deep: float, times: float, tmp_path: Path) -> None:
    t = np.arange(0.0, 1001.0)
    down = 0.5 * deep * (1.0 - np.cos(t / 50.0))
    log = log_of(sinking(t, depth=down, down=down, north=0.6 * t, east=0.8 * t), "measured", {})
    path = written(log, tmp_path)
    scale = rows(path, "/world", "Transform3D:scale")[2][0][0]
    assert scale == [1.0, 1.0, times]
    assert (f"depth drawn x {times:g}" in " ".join(panels(path))) == (times > 1.0)
    assert (f"Depth is drawn {times:g} times too large" in page(path)) == (times > 1.0)


def test_bottom_is_drawn_only_where_the_log_tells_it(tmp_path: Path) -> None:
    log = log_of(sinking(np.arange(0.0, 1000.0)), "simulated", {})
    assert not any(entity == "/world/bottom" for entity, _ in stored(written(log, tmp_path)))
    path = written(log.with_metadata(bottom_depth_m="250.0"), tmp_path, "bottom.rrd")
    corners = rows(path, "/world/bottom", "Mesh3D:vertex_positions")[2][0]
    assert {corner[2] for corner in corners} == {250.0}
    assert "the bottom that the log tells, 250 m deep" in page(path)


def test_camera_sees_all_that_is_drawn_and_is_not_far_off() -> None:
    rng = np.random.default_rng(1)
    for _ in range(50):
        size = 10.0 ** rng.uniform(0.0, 5.0, 3)
        places = np.cumsum(rng.normal(size=(200, 3)), axis=0) * size / 10.0
        places[:, 2] = np.abs(places[:, 2])
        sea = Sea.about(places, None, np.empty((0, 3)), 1.3)
        eye, target = sea.camera
        forward = (target - eye) / np.linalg.norm(target - eye)
        right = np.cross(forward, [0.0, 0.0, -1.0])
        right /= np.linalg.norm(right)
        seen = places * [1.0, 1.0, sea.exaggeration] - eye
        away = seen @ forward
        assert (away > 0.0).all()
        half = np.tan(np.radians(27.5))  # Rerun's field of view is 55 deg high
        high, wide = (np.abs(seen @ axis) / (half * away) for axis in (np.cross(right, forward), right))
        assert (high <= 1.0).all()
        assert (wide <= 1.3).all()
        # the grid about it reaches an eighth of its width beyond on either side, and the eye is a tenth further away
        assert max(high.max(), wide.max() / 1.3) > 0.5


def test_nice_numbers() -> None:
    assert [nice(value) for value in (1.0, 1.99, 2.0, 4.9, 7.0, 0.011, 999.0)] == [1, 1, 2, 2, 5, 0.01, 500]


HOSTILE = {
    "title": "# not a heading\n- **not bold** <script>alert(1)</script> [x](file:///etc/passwd) `code` | cell",
    "vehicle": "\x00\x1b[31mred\x1b[0m\r\nsecond line " + "long " * 2000,
    "hull_length_m": "1e999", "hull_diameter_m": "-1", "movable_eccentricity_m": "nan", "bottom_depth_m": "-inf",
    "origin_latitude_deg": "91", "origin_longitude_deg": "1e300", "provenance": '{"command": "a\\u0000b", "inputs": [1, {}]}',
    "\ud7ff☃ 𝛼": "\u202e\u2028", "clock_note": "*", "": "",
}  # fmt: skip


@pytest.mark.parametrize("count", [1, 2, 50])
def test_hostile_texts_do_no_harm(count: int, tmp_path: Path) -> None:
    t = np.arange(float(count))
    angles = dict.fromkeys(("roll", "pitch", "heading", "mass_position"), 0.1)
    fixes = {"latitude": 10.0 + 0.0 * t, "longitude": 20.0 + 0.0 * t}
    events = (Event("# x\n<b>\x00", START), Event("", START + 1, -0.0))
    log = log_of(sinking(t, **angles, **fixes), "measured", HOSTILE, events)
    path = written(log, tmp_path)
    assert "without error" in told_by_the_verifier(path, tmp_path)
    lines = page(path).splitlines()
    assert [line for line in lines if line.startswith("#")] == [
        "# MEASURED", "## How it is drawn", "## Metadata", "## Provenance",
    ]  # fmt: skip
    assert "<script" not in page(path).replace("\\<", "")


def test_log_of_one_sample_of_each_channel(tmp_path: Path) -> None:
    one = log_of([channel(name, [3.0], 0.0 if name == "phase" else 0.5) for name in CHANNELS], "simulated", {})
    path = written(one, tmp_path)
    assert "without error" in told_by_the_verifier(path, tmp_path)
    for name, spec in CHANNELS.items():
        if name != "phase":
            utc, elapsed, values = rows(path, f"/{spec.group}/{name}", "Scalars:scalars")
            assert (utc.tolist(), elapsed.tolist()) == ([START + 3 * 10**9], [0])
            assert values == [[(-0.5 if name == "depth" else 0.5 * spec.factor)]]


@pytest.mark.parametrize("name", CHANNELS)
def test_any_single_channel_makes_a_recording(name: str, tmp_path: Path) -> None:
    t = np.arange(0.0, 10.0)
    path = written(log_of([channel(name, t, t % 5)], "measured", {}), tmp_path)
    assert "about this recording" in panels(path)


def test_pieces_draw_what_the_whole_draws(tmp_path: Path) -> None:
    from glidercli.logio.rerun.writer import RerunLog

    t = np.arange(0.0, 2000.0, 10.0)
    more = {
        "temperature": 20.0 - 0.005 * t,
        "current_north": 0.1,
        "current_east": 0.2,
        "phase": np.where(t < 900, 1.0, 2.0),
    }
    log = log_of(sinking(t, **more), "measured", {"origin_latitude_deg": "10", "origin_longitude_deg": "20"})
    whole, parts = written(log, tmp_path), tmp_path / "parts.rrd"
    file = RerunLog(parts)
    pieces = list(log.pieces(37))
    for piece in pieces:
        file.add(piece)
    file.close(dataclasses.replace(pieces[-1], events=log.events))
    assert panels(whole) == panels(parts)

    def still(path: Path) -> dict[Any, Any]:
        found = [(entity, batch) for entity, batch in stored(path) if "utc" not in batch.schema.names]
        return {
            (entity, *batch.schema.names): batch.drop_columns(["rerun.controls.RowId"])
            for entity, batch in found
            if not entity.startswith("/__")
        }

    def times(path: Path, part: str) -> list[Any]:
        batches = [batch for entity, batch in stored(path) if entity == part and "utc" in batch.schema.names]
        return [time for batch in batches for time in batch.column("utc").to_pylist()]

    assert still(parts) == still(whole)
    for part in ("/section/temperature", "/map/vehicle"):
        assert times(parts, part) == times(whole, part)


def test_name_of_the_vehicle_stands_in_its_title_as_far_as_it_can(tmp_path: Path) -> None:
    t = np.arange(0.0, 20.0)
    log = log_of(sinking(t, roll=0.1, pitch=-0.4, heading=3.0), "simulated", {})
    own = {"hull_length_m": "1.5", "hull_diameter_m": "0.2", "vehicle": "my\x00\n\x1bglider" + 1000 * "!"}
    path = written(log.with_metadata(**own), tmp_path)
    assert f"SIMULATED attitude; myglider{32 * '!'} hull" in panels(path)
    assert rows(path, "/world/vehicle/course/body/hull", "Capsules3D:radii")[2][0][0] == pytest.approx(0.1)
    assert "1.5 m x 0.2 m" in page(path)


def drawn(path: Path, entity: str, component: str) -> list[Any]:
    """The values of a component in all chunks of an entity, with their elapsed ns where they have a time."""
    found: list[Any] = []
    for place, batch in stored(path):
        if place == entity and component in batch.schema.names:
            values = batch.column(component).to_pylist()
            if "elapsed" in batch.schema.names:
                times = batch.column("elapsed").to_numpy(zero_copy_only=False).astype(np.int64)
                values = [(int(time), value[0]) for time, value in zip(times, values, strict=True)]
            found += values
    return found


def test_track_is_broken_at_gaps(tmp_path: Path) -> None:
    t = np.concatenate([np.arange(0.0, 300.0, 10.0), [5000.0], np.arange(60_000.0, 60_300.0, 10.0)])
    phase = np.where(t % 300.0 < 150.0, 1.0, 2.0)
    origin = {"origin_latitude_deg": "0", "origin_longitude_deg": "20"}
    path = written(log_of(sinking(t, phase=phase), "measured", origin), tmp_path)
    assert [len(line) for line in rows(path, "/map/track", "GeoLineStrings:line_strings")[2][0]] == [30, 30]
    places = np.outer(t, [0.3, 0.4, 0.1])
    whole = [np.array(line) for line in rows(path, "/world/path", "LineStrips3D:strips")[2][0]]
    wanted = [places[:30], places[31:]]
    for line, points in zip(whole, wanted, strict=True):
        np.testing.assert_allclose(line, points, rtol=1e-6)  # float32
    strips = [np.array(line) for line in rows(path, "/world/track", "LineStrips3D:strips")[2][0]]
    for line, ends in zip(strips, [(0, 15), (15, 29), (31, 46), (46, 60)], strict=True):
        np.testing.assert_allclose(line, places[ends[0] : ends[1] + 1], rtol=1e-6)
    np.testing.assert_allclose(rows(path, "/world/track", "Points3D:positions")[2][0], places[30:31], rtol=1e-6)
    assert "The track is broken at 2 gaps of more than 60 s between its samples." in page(path)


def test_track_without_gaps_is_one_line_and_says_nothing_of_them(tmp_path: Path) -> None:
    path = written(log_of(sinking(np.arange(0.0, 6000.0, 600.0)), "simulated", {}), tmp_path)  # none of them is a gap
    assert len(rows(path, "/world/path", "LineStrips3D:strips")[2][0]) == 1
    assert "broken" not in page(path)


def test_thinning_makes_and_hides_no_gap(tmp_path: Path) -> None:
    """Of 50,000 samples 20,000 are drawn, so that most lie further apart than 60 s; the only gap is one of 61 s."""
    t = np.arange(0.0, 1_500_000.0, 30.0)
    t[31_000:] += 121.0  # 30 s and 121 s are more than five times 30 s
    path = written(log_of(sinking(t, down=0.001 * t, depth=0.001 * t), "simulated", {}), tmp_path)
    lines = [np.array(line) for line in rows(path, "/world/path", "LineStrips3D:strips")[2][0]]
    assert len(lines) == 2
    assert sum(map(len, lines)) == 20_000
    east = 0.4 * t
    # thinned to every third row at most, 36 m: the ends beside the gap are within that of its edges
    assert 0.0 <= east[30_999] - lines[0][-1, 1] <= 36.0
    assert 0.0 <= lines[1][0, 1] - east[31_000] <= 36.0
    assert "broken at 1 gap of more than 150 s" in page(path)


def test_a_sample_alone_is_drawn_as_a_dot_in_plots(tmp_path: Path) -> None:
    from glidercli.logio.rerun.plots import DOT, THIN
    from glidercli.logio.rerun.writer import RerunLog

    t = np.concatenate([np.arange(20.0), [500.0], np.arange(1000.0, 1010.0), [2000.0]])
    log = log_of([channel("temperature", t, 10.0 + t)], "measured", {})
    entity, second = f"/{CHANNELS['temperature'].group}/temperature", 10**9
    wanted = [(0, THIN), (500 * second, DOT), (500 * second + 1, THIN), (2000 * second, DOT)]
    assert drawn(written(log, tmp_path), entity, "SeriesLines:widths") == wanted
    for size in (1, 2, 3, 10):
        path = tmp_path / f"{size}.rrd"
        file = RerunLog(path)
        pieces = list(log.pieces(size))
        for piece in pieces:
            file.add(piece)
        file.close(pieces[-1])
        assert drawn(path, entity, "SeriesLines:widths") == wanted
    alone = written(log.sliced(START, START + 1), tmp_path, "one.rrd")
    assert drawn(alone, entity, "SeriesLines:widths") == [(0, DOT)]


@pytest.mark.parametrize("aspect", [1.3, 16 / 9])
def test_surface_walls_and_bottom_are_all_in_the_picture(aspect: float) -> None:
    rng = np.random.default_rng(2)
    for _ in range(50):
        size = 10.0 ** rng.uniform(0.0, 5.0, 3)
        places = np.cumsum(rng.normal(size=(200, 3)), axis=0) * size / 10.0
        places[:, 2] = np.abs(places[:, 2])
        bottom = float(places[:, 2].max() * rng.uniform(1.0, 3.0))
        sea = Sea.about(places, bottom, np.empty((0, 3)), 1.3)  # the overview's panel; at 16:9 it fills the window
        found = {chunk.entity_path: chunk.to_record_batch() for chunk in sea.chunks}
        parts = [
            found[f"/world/{name}"].column("Mesh3D:vertex_positions").to_pylist()[0] for name in ("surface", "bottom")
        ]
        parts += found["/world/box"].column("LineStrips3D:strips").to_pylist()[0]
        parts.append(found["/world/bottom/name"].column("Points3D:positions").to_pylist()[0])
        eye, target = sea.camera
        forward = (target - eye) / np.linalg.norm(target - eye)
        right = np.cross(forward, [0.0, 0.0, -1.0])
        right /= np.linalg.norm(right)
        seen = np.concatenate(parts) * [1.0, 1.0, sea.exaggeration] - eye
        half = np.tan(np.radians(27.5)) * (seen @ forward)  # Rerun's field of view is 55 deg high
        assert (half > 0.0).all()
        assert (np.abs(seen @ np.cross(right, forward)) <= half).all()
        assert (np.abs(seen @ right) <= aspect * half).all()
        assert found["/world/bottom/name"].column("Points3D:labels").to_pylist()[0] == [f"bottom, {bottom:g} m"]
