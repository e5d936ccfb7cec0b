"""Does a Rerun recording hold just what the Log holds, the same bytes each time, and only panels with data?"""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from rrd_files import START, channel, log_of, page, panels, rows, samples, sights, stored, told_by_the_verifier, written

from glidercli.channels import CHANNELS, PHASES
from glidercli.errors import OutputError
from glidercli.log import Event, Log
from glidercli.logio.rerun.settling import _xxh32
from glidercli.logio.rerun.writer import RerunLog, write_rerun


@pytest.fixture
def spiral() -> Log:
    """A simulated 800 m dive and climb on a spiral, every 10 s."""
    t = np.arange(0.0, 6000.0, 10.0)
    side = np.where(t < 3000.0, 1.0, -1.0)
    depth, heading = np.interp(t, [0.0, 3000.0, 6000.0], [0.0, 800.0, 0.0]), np.radians(0.4 * t) % (2 * np.pi)
    values = {
        "depth": depth, "down": depth, "north": 60.0 * np.sin(heading), "east": -60.0 * np.cos(heading) + 0.02 * t,
        "roll": np.radians(-8.0 * side), "pitch": np.radians(-25.0 * side), "heading": heading,
        "mass_position": 0.4 + 0.03 * side, "mass_rotation": np.radians(45.0 * side), "net_buoyancy": 0.3 * side,
        "temperature": 4.0 + 20.0 * np.exp(-depth / 150.0), "salinity": 34.5 + 0.0 * t, "density": 1022.0 + 0.008 * depth,
        "current_east": 0.06 * np.exp(-depth / 200.0), "current_north": 0.02, "speed_through_water": 0.5,
        "phase": np.where(side > 0, 1.0, 2.0),
    }  # fmt: skip
    metadata = {
        "hull_length_m": "1.99", "hull_diameter_m": "0.22", "movable_nominal_position_m": "0.4",
        "movable_eccentricity_m": "0.014", "provenance": '{"command": ["glider", "simulate"]}',
    }  # fmt: skip
    events = (Event("apogee", START + 3000 * 10**9, 800.0), Event("surfacing", START + 5990 * 10**9))
    return log_of([channel(name, t, value) for name, value in values.items()], "simulated", metadata, events)


@pytest.fixture
def field() -> Log:
    """A measured dive without a track: attitude every 20 s, CTD every 30 s on its own clock, three GPS fixes."""
    t, ctd, gps = np.arange(0.0, 3600.0, 20.0), np.arange(7.5, 3600.0, 30.0), [1.0, 2.0, 3590.0]
    channels = [
        channel("depth", t, 300.0 * np.sin(np.pi * t / 3600.0), "measured"),
        channel("pitch", t[:-3], -0.4, "measured"), channel("roll", t, 0.02, "measured"),
        channel("heading", t, 6.2, "measured"),
        channel("temperature", ctd, 8.0, "measured"), channel("conductivity", ctd, 3.3, "measured"),
        channel("latitude", gps, [18.0, 18.001, 18.01], "measured"),
        channel("longitude", gps, [112.0, 112.001, 112.01], "measured"),
    ]  # fmt: skip
    return log_of(channels, "measured", {"platform": "test | glider"})


@pytest.fixture
def depth_only() -> Log:
    return log_of([channel("depth", [0.0, 10.0, 20.0], [0.0, 5.0, 9.0])], "reconstruction", {})


@pytest.mark.parametrize("name", ["spiral", "field", "depth_only"])
def test_verifier_of_the_viewer_accepts_the_file(name: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    path = written(request.getfixturevalue(name), tmp_path)
    assert "without error" in told_by_the_verifier(path, tmp_path)


@pytest.mark.parametrize("name", ["spiral", "field", "depth_only"])
def test_every_sample_comes_back(name: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    log = request.getfixturevalue(name)
    path = written(log, tmp_path)
    for name, sent in log.channels.items():
        if name == "phase":
            continue
        spec = CHANNELS[name]
        utc, elapsed, values = samples(path, f"/{spec.group}/{name}")
        np.testing.assert_array_equal(utc, sent.time_ns)
        np.testing.assert_array_equal(elapsed, sent.time_ns - log.start_ns)
        factor = -1.0 if name == "depth" else spec.factor
        np.testing.assert_array_equal(values, sent.values * factor)


def test_phases_stand_where_they_change(spiral: Log, tmp_path: Path) -> None:
    utc, _, states = rows(written(spiral, tmp_path), "/navigation/phase", "StateChange:state")
    assert [state[0] for state in states] == ["dive", "climb"]
    np.testing.assert_array_equal(utc, [START, START + 3000 * 10**9])
    assert set(PHASES) >= {state[0] for state in states}


def test_vehicle_moves_along_the_track_nose_down_in_a_dive(spiral: Log, tmp_path: Path) -> None:
    path = written(spiral, tmp_path)
    _, _, places = rows(path, "/world/vehicle", "Transform3D:translation")
    track = np.stack([spiral[name].values for name in ("north", "east", "down")], axis=-1)
    np.testing.assert_allclose(np.squeeze(places), track, atol=1e-4)  # float32 of 800 m: 6e-5
    _, _, turns = rows(path, "/world/vehicle/course/body", "Transform3D:quaternion")
    x, y, z, w = turns[0][0]
    nose_down = 2.0 * (x * z - w * y)  # third row, first column of R_ned_body = -sin(pitch)
    assert nose_down == pytest.approx(np.sin(np.radians(25.0)), abs=1e-6)  # float32


def test_mass_turns_to_port_for_positive_rotation(spiral: Log, tmp_path: Path) -> None:
    path = written(spiral, tmp_path)
    _, _, slides = rows(path, "/world/vehicle/course/body/slide", "Transform3D:translation")
    np.testing.assert_allclose(np.squeeze(slides)[:, 0], spiral["mass_position"].values, atol=1e-6)  # float32
    _, _, turns = rows(path, "/world/vehicle/course/body/slide/turn", "Transform3D:quaternion")
    x, y, z, w = turns[0][0]
    # R (0, 0, Rr) = (0, -Rr sin gamma, Rr cos gamma) for gamma = 45 deg; float32
    assert (2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)) == pytest.approx((-(0.5**0.5), 0.5**0.5), abs=1e-6)


def test_attitude_stands_only_where_all_three_angles_do(field: Log, tmp_path: Path) -> None:
    utc, _, _ = rows(written(field, tmp_path), "/world/vehicle/course/body", "Transform3D:quaternion")
    np.testing.assert_array_equal(utc, field["pitch"].time_ns)


@pytest.mark.parametrize("told", [{"mass_position_zero": "LinPos"}, {"movable_nominal_position_m": "unknown"}])
def test_mass_with_an_unknown_zero_is_drawn_about_its_middle(spiral: Log, told: dict[str, str], tmp_path: Path) -> None:
    path = written(spiral.with_metadata(**told), tmp_path)
    _, _, slides = rows(path, "/world/vehicle/course/body/slide", "Transform3D:translation")
    forward = np.squeeze(slides)[:, 0]
    assert (forward.min(), forward.max()) == pytest.approx((-0.03, 0.03), abs=1e-6)  # float32
    assert "about the middle of its range" in page(path)


def test_mass_is_said_to_be_exaggerated_only_by_what_the_log_tells(spiral: Log, tmp_path: Path) -> None:
    assert "0.055 m for a true 0.014 m" in page(written(spiral, tmp_path))
    other = dataclasses.replace(spiral, metadata={})
    assert "drawn not to scale: it is unknown" in page(written(other, tmp_path))


def test_camera_sees_a_long_track_from_its_side(spiral: Log, tmp_path: Path) -> None:
    along = np.linspace(0.0, 3000.0, len(spiral["north"]))
    north, east = (dataclasses.replace(spiral[name], values=along) for name in ("north", "east"))
    path = written(spiral.with_channels(north, east), tmp_path)
    sight = max(sights(path), key=np.linalg.norm)  # the other one is that on the hull
    level = sight[:2] / np.linalg.norm(sight[:2])
    assert abs(level @ [0.5**0.5, 0.5**0.5]) < 0.5  # at least 60 deg off the track
    assert level[0] > 0.0  # from the south
    assert sight[2] > 0.0  # from above


@pytest.mark.parametrize("name", ["spiral", "field", "depth_only"])
def test_same_log_gives_the_same_bytes(name: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    log = request.getfixturevalue(name)
    log = log.with_channels(*(channel(kind, [0.0, 5.0], 1.0, "derived") for kind in ("density", "salinity")))
    backwards = Log(dict(reversed(log.channels.items())), log.origin, log.metadata, log.events)
    once = written(log, tmp_path, "a.rrd").read_bytes()
    assert once == written(log, tmp_path, "b.rrd").read_bytes()
    assert once == written(backwards, tmp_path, "c.rrd").read_bytes()


def test_another_log_is_another_recording(depth_only: Log, tmp_path: Path) -> None:
    from rerun.chunk import RrdReader

    other = depth_only.with_metadata(title="another")
    ids = {RrdReader(written(log, tmp_path)).recordings()[0].recording_id for log in (depth_only, other)}
    assert len(ids) == 2


def test_panels_without_data_are_left_out(spiral: Log, field: Log, depth_only: Log, tmp_path: Path) -> None:
    assert panels(written(depth_only, tmp_path)) == {"depth, m (negative down)", "about this recording"}
    assert panels(written(field, tmp_path)) == {
        "MEASURED attitude; generic hull, not to scale", "depth, m (negative down)", "pitch (blue), roll (orange), deg",
        "heading, deg clockwise from true north", "temperature, degC", "conductivity, S/m",  # constant: no section
        "latitude, deg", "longitude, deg",
        "track and fixes; map from the network", "about this recording",
    }  # fmt: skip
    shown = panels(written(spiral, tmp_path))
    assert {
        "SIMULATED track, grid 50 m, arrows: current",
        "SIMULATED attitude; red: mass; its own hull",
        "events",
    } <= shown
    assert "depth, m: dive blue, climb orange" in shown
    assert "speed in water, m/s" in shown  # alone in its panel
    assert not any("network" in name for name in shown)  # nobody knows where on the globe it was


def test_derived_track_is_not_shown_as_measured(spiral: Log, tmp_path: Path) -> None:
    track = [dataclasses.replace(spiral[name], origin="derived") for name in ("north", "east", "down")]
    log = dataclasses.replace(spiral.with_channels(*track), origin="measured")
    shown = panels(written(log, tmp_path))
    assert {"DERIVED track, grid 50 m, arrows: current", "MEASURED attitude; red: mass; its own hull"} <= shown
    assert "north (blue), east (orange), down (green), m from the origin, derived" in shown


@pytest.mark.parametrize("name", ["spiral", "field", "depth_only"])
def test_origin_stands_at_the_top_of_the_page(name: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    log = request.getfixturevalue(name)
    assert page(written(log, tmp_path)).startswith(f"# {log.origin.upper()}\n")


def test_page_tells_provenance_metadata_and_derived_channels(field: Log, spiral: Log, tmp_path: Path) -> None:
    text = page(written(spiral, tmp_path))
    assert "- **command**: glider simulate\n" in text
    path = written(field.with_channels(channel("density", [0.0, 1.0], 1025.0, "derived")), tmp_path)
    text = page(path)
    assert "- **derived**: density\n" in text
    assert "- **platform**: test \\| glider\n" in text
    assert "NOT TO SCALE" in text


def test_reconstruction_is_told_before_anything_else(spiral: Log, tmp_path: Path) -> None:
    text = page(written(spiral.with_metadata(reconstruction="water as in fig. 11"), tmp_path))
    assert text.startswith("# SIMULATED FROM A RECONSTRUCTION\n")
    assert text.index("**Reconstruction**: water as in fig. 11") < text.index("## ")


def test_metadata_that_cannot_be_understood_are_shown_as_they_stand(field: Log, tmp_path: Path) -> None:
    told = {"provenance": "by hand", "origin_latitude_deg": "?", "hull_length_m": "long", "hull_diameter_m": "nan"}
    text = page(written(field.with_metadata(**told), tmp_path))
    assert "- **record**: by hand\n" in text
    assert "NOT TO SCALE" in text


def test_events_carry_their_times(spiral: Log, tmp_path: Path) -> None:
    utc, _, texts = rows(written(spiral, tmp_path), "/events", "TextLog:text")
    assert texts == [["apogee, depth 800.0 m"], ["surfacing"]]
    np.testing.assert_array_equal(utc, [event.time_ns for event in spiral.events])


def test_fixes_are_placed_about_the_origin(field: Log, spiral: Log, tmp_path: Path) -> None:
    path = written(field, tmp_path)
    north, east, down = np.array(rows(path, "/world/fixes", "Points3D:positions")[2][0]).T
    # A degree of latitude is 110 647 m at 18 deg N (WGS 84), of longitude 105 909 m: to 0.1 % over 1 km.
    np.testing.assert_allclose(north, [0.0, 110.65, 1106.5], rtol=1e-3)
    np.testing.assert_allclose(east, [0.0, 105.91, 1059.1], rtol=1e-3)
    assert (down == 0.0).all()
    lost = spiral.with_channels(field["latitude"], field["longitude"])  # a track whose origin nobody knows
    with pytest.raises(KeyError):
        rows(written(lost, tmp_path), "/world/fixes", "Points3D:positions")


def test_log_without_a_sample_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="no sample"):
        write_rerun(log_of([channel("depth", [], [])], "measured", {}), tmp_path / "empty.rrd")


@pytest.mark.parametrize(("data", "seed", "value"), [(b"", 0, 0x02CC5D05), (b"abc", 0, 0x32D153FF)])
def test_checksum_has_its_published_values(data: bytes, seed: int, value: int) -> None:
    assert _xxh32(data, seed) == value


def test_a_line_breaks_at_a_gap(tmp_path: Path) -> None:
    """A nanosecond after the last sample before it, with NaN, which is drawn as nothing."""
    seconds = [0.0, 10.0, 20.0, 2000.0, 2010.0]
    path = written(log_of([channel("pitch", seconds, np.arange(5) * 0.1)], "measured", {}), tmp_path)
    _, elapsed, values = rows(path, "/attitude/pitch", "Scalars:scalars")
    assert elapsed.tolist() == [0, 10**10, 2 * 10**10, 2 * 10**10 + 1, 2000 * 10**9, 2010 * 10**9]
    assert np.isnan(np.ravel(values)).tolist() == [False] * 3 + [True] + [False] * 2


def test_a_line_breaks_at_a_gap_between_two_pieces(tmp_path: Path) -> None:
    """As a recording in pieces makes them: what is usual is told by the first."""
    file = RerunLog(tmp_path / "a.rrd")
    for seconds in ([0.0, 10.0, 20.0], [30.0], [2000.0], [2010.0]):
        log = log_of([channel("pitch", seconds, 0.1)], "measured", {})
        file.add(log)
    file.close(log)
    broken = []
    for entity, batch in stored(tmp_path / "a.rrd"):
        if entity == "/attitude/pitch" and "Scalars:scalars" in batch.schema.names:
            elapsed = batch.column("elapsed").to_numpy(zero_copy_only=False).astype(np.int64)
            broken += elapsed[np.isnan(batch.column("Scalars:scalars").flatten().to_numpy())].tolist()
    assert broken == [30 * 10**9 + 1]
