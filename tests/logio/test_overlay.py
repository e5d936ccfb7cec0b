"""Is a comparison shown as it was made? Flights and errors in .rrd and .mcap against the Comparison, to the last bit."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_files import messages
from rrd_files import START, channel, log_of, page, panels, rerun_program, rows, told_by_the_verifier
from test_validators import BIN, NODE, ran

from glidercli.channels import CHANNELS
from glidercli.compare import Comparison, compare, overlay
from glidercli.errors import InputError, OutputError
from glidercli.log import Event, Log
from glidercli.logio import read, write
from glidercli.logio.layouts import LAYOUTS, together_in, write_layouts
from glidercli.logio.mcap.topics import field_names

MEASURED = np.arange(0.0, 1000.0, 7.0)
SIMULATED = np.concatenate([np.arange(30.0, 401.0, 10.0), np.arange(440.0, 901.0, 10.0)])
"""With a gap of 40 s, which is none by the rule for logs side by side (a minute), and one for MAX_GAP."""
MAX_GAP = 20.0
LATE = 12.5  # s, of the simulated clock
ORIGIN = {"origin_latitude_deg": "18.0", "origin_longitude_deg": "112.0"}


def flight(times: Any, origin: Any, offset: float, late: float = 0.0, **told: str) -> Log:
    """A descent that waves, a heading that turns past north, in an attitude; places from the log's own origin."""
    t = np.asarray(times, dtype=float)
    values = {
        "depth": 0.1 * t + np.sin(t / 30.0) + offset, "north": 0.3 * t, "east": 0.2 * t + offset, "down": 0.1 * t,
        "roll": 0.1 * np.sin(t / 50.0), "pitch": np.radians(-25.0 + offset * np.cos(t / 70.0)),
        "heading": np.radians((3.6 * t + 20.0 * offset) % 360.0), "temperature": 20.0 - 0.011 * t, "phase": 1.0,
        "mass_position": 0.4 + 0.0 * t, "mass_rotation": 0.3 + 0.0 * t,
    }  # fmt: skip
    channels = [channel(name, t + late, value, origin) for name, value in values.items()]
    return log_of(channels, origin, ORIGIN | told, (Event("apogee", START + 10**9 * int(t[-1]), 100.0),))


def compared(count: int = 2, channels: list[str] | None = None, **told: str) -> Comparison:
    """A measured flight and so many simulated ones, whose clocks are late."""
    others = [flight(SIMULATED, "simulated", 3.0 + n, LATE, **told) for n in range(count)]
    names = ["sea/flight", *(f"models/twin{n}.nc" for n in range(count))]
    measured = flight(MEASURED, "measured", 0.0)
    return compare(measured, others, offset=-LATE, max_gap=MAX_GAP, channels=channels, names=names)


def saved(comparison: Comparison, *paths: Path) -> None:
    shown = overlay(comparison, {"command": ["test"], "origin": comparison.origin})
    write(shown.log, *paths, beside=shown.beside, names=shown.names, errors=shown.errors)


def records(path: Path) -> dict[str, dict[str, str]]:
    with path.open("rb") as stream:
        return {record.name: record.metadata for record in make_reader(stream).iter_metadata()}


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> tuple[Comparison, Path, Path]:
    folder = tmp_path_factory.mktemp("overlay")
    comparison = compared()
    saved(comparison, folder / "a.rrd", folder / "a.mcap")
    return comparison, folder / "a.rrd", folder / "a.mcap"


def expected(errors: Any) -> tuple[Any, Any]:
    """Times and errors of a comparison as they are to be shown: NaN at the measured samples that it left out."""
    shown = dict.fromkeys(errors.skipped_ns.tolist(), np.nan)
    shown |= dict(zip(errors.time_ns.tolist(), errors.error.tolist(), strict=True))
    return zip(*sorted(shown.items()), strict=True)


def test_rerun_has_the_errors_of_the_comparison(both: Any) -> None:
    comparison, rrd, _ = both
    for number, run in enumerate(comparison.runs, 1):
        assert len(run.residuals) == 10
        assert run.residuals["depth"].gap > 0
        for name, errors in run.residuals.items():
            utc, _, values = rows(rrd, f"/difference/{number}/{name}", "Scalars:scalars")
            times, wanted = expected(errors)
            np.testing.assert_array_equal(utc, times)
            np.testing.assert_array_equal(np.ravel(values), wanted, err_msg=name)


def test_titles_have_the_rmse_of_the_comparison(tmp_path: Path) -> None:
    comparison = compared(1, ["depth", "heading"])
    saved(comparison, tmp_path / "a.rrd")
    shown = {name for name in panels(tmp_path / "a.rrd") if "rms" in name}
    rmse = {name: comparison.runs[0].channels[name].rmse for name in ("depth", "heading")}
    assert shown == {
        f"depth, m, orange less blue; deeper positive; rms {rmse['depth']:.3g}",
        f"heading, deg, orange less blue; rms {rmse['heading']:.3g}",
    }


def test_a_measured_flight_on_the_other_side_does_not_turn_the_sign(tmp_path: Path) -> None:
    """Of logs side by side the measured one is taken away; of a comparison its first."""
    model, sea = flight(MEASURED, "simulated", 0.0), flight(SIMULATED, "measured", 3.0)
    comparison = compare(model, sea, max_gap=MAX_GAP)
    saved(comparison, tmp_path / "a.rrd")
    _, _, values = rows(tmp_path / "a.rrd", "/difference/1/depth", "Scalars:scalars")
    np.testing.assert_array_equal(np.ravel(values), list(expected(comparison.runs[0].residuals["depth"]))[1])


def test_mcap_has_the_errors_of_the_comparison_with_their_unit(both: Any) -> None:
    comparison, _, mcap = both
    found = messages(mcap)
    for number, run in enumerate(comparison.runs, 1):
        shown = {topic for topic in found if topic.startswith(f"/difference/{number}/")}
        assert shown == {f"/difference/{number}/{name}" for name in run.residuals}
        for name, errors in run.residuals.items():
            told = found[f"/difference/{number}/{name}"]
            times, wanted = expected(errors)
            assert tuple(at for at, _ in told) == times
            assert {m.DESCRIPTOR.full_name for _, m in told} == {f"difference.{name.capitalize()}"}
            np.testing.assert_array_equal([getattr(m, CHANNELS[name].column) for _, m in told], wanted, err_msg=name)


def test_mcap_tells_what_was_compared(both: Any) -> None:
    comparison, _, mcap = both
    with mcap.open("rb") as stream:
        own = {c.topic: c.metadata for c in make_reader(stream).get_summary().channels.values()}
    errors, found = comparison.runs[1].residuals["heading"], own["/difference/2/heading"]
    assert found["heading_deg"].startswith("twin1.nc SIMULATED less flight MEASURED, deg; ")
    assert found["compared"] == str(len(errors.error))
    assert found["not compared (NaN)"] == f"{errors.outside} outside, {errors.gap} in gaps of the simulated samples"
    assert float(found["root of the mean square"].split()[0]) == comparison.runs[1].channels["heading"].rmse


def test_mcap_is_read_back_as_the_measured_flight_alone(both: Any) -> None:
    comparison, _, mcap = both
    reading = read([mcap])
    measured = comparison.against
    assert reading.log.origin == "measured"
    assert sorted(reading.log.channels) == sorted(measured.channels)
    for name, one in measured.channels.items():
        assert reading.log[name].time_ns.tobytes() == one.time_ns.tobytes()
        assert reading.log[name].values.tobytes() == one.values.tobytes()
        assert reading.log[name].origin == "measured"
    assert reading.log.events == measured.events
    (file,) = reading.files
    told = "flights beside this one are not read: /beside/1 twin0.nc SIMULATED; /beside/2 twin1.nc SIMULATED"
    assert told in file.warnings
    with mcap.open("rb") as stream:  # readers of earlier versions take every message of the package glider
        summary = make_reader(stream).get_summary()
    glider = {c.topic for c in summary.channels.values() if summary.schemas[c.schema_id].name.startswith("glider.")}
    assert glider
    assert all(topic.startswith("/glider/") for topic in glider)


def test_the_others_are_there_whole_on_the_measured_clock(both: Any) -> None:
    comparison, _, mcap = both
    found = messages(mcap)
    for number, run in enumerate(comparison.runs, 1):
        for name, one in run.log.channels.items():
            told = found[f"/beside/{number}/glider/{CHANNELS[name].group}"]
            field = field_names(CHANNELS[name])[0]
            assert [at for at, _ in told] == one.time_ns.tolist()
            assert [getattr(m, field) for _, m in told] == one.values.tolist()
        assert [m.name for _, m in found[f"/beside/{number}/glider/event"]] == ["apogee"]
    assert found["/beside/1/glider/navigation"][0][0] == START + 30 * 10**9  # as if its clock were not late


def test_each_flight_has_frames_and_a_colour_of_its_own(both: Any) -> None:
    _, _, mcap = both
    found = messages(mcap)
    colours, frames = {}, {}
    for number in range(3):
        place, before = (f"/beside/{number}", f"beside_{number}/") if number else ("", "")
        moves = [m for _, m in found[f"{place}/tf"]]
        frames[number] = {(m.parent_frame_id, m.child_frame_id) for m in moves}
        assert frames[number] == {("map_ned", f"{before}base_link_fsd")}
        (entity,) = found[f"{place}/viz/vehicle"][0][1].entities
        assert entity.frame_id == f"{before}base_link_fsd"
        (track,) = found[f"{place}/viz/track"][0][1].entities
        assert track.frame_id == "map_ned"
        shades = {(c.r, c.g, c.b) for c in track.lines[0].colors} | {
            (c.color.r, c.color.g, c.color.b) for c in (*entity.cylinders, *entity.triangles)
        }
        assert len(shades) == 1
        colours[number] = shades.pop()
        assert found[f"{place}/viz/movable_mass"][0][1].entities[0].frame_id == f"{before}base_link_fsd"
    assert len(set(colours.values())) == 3
    assert [f"{e.text}" for e in found["/beside/1/viz/vehicle"][0][1].entities[0].texts] == ["twin0.nc SIMULATED"]
    # the first draws the surroundings, over all flights
    assert not [topic for topic in found if topic.startswith("/beside/") and "surface" in topic]


def test_tracks_stand_about_the_origin_of_the_measured_one(tmp_path: Path) -> None:
    comparison = compared(1, origin_latitude_deg="18.01", origin_longitude_deg="112.02")
    saved(comparison, tmp_path / "a.mcap")
    found = messages(tmp_path / "a.mcap")
    first = found["/beside/1/tf"][0][1].translation
    # WGS-84 at 18 deg N: 110,647 m a degree of latitude, 105,909 m of longitude; own track 9 m north, 9 m east
    np.testing.assert_allclose([first.x, first.y], [1106.5 + 9.0, 2118.1 + 9.0], rtol=1e-3)
    assert found["/beside/1/glider/navigation"][0][1].north_m == 9.0  # samples stay what they are
    surface = found["/viz/surface"][0][1].entities[0].triangles[0].points
    assert max(p.x for p in surface) > 1106.5 + 270.0


def test_tracks_an_ocean_apart_begin_at_one_place_and_say_so(tmp_path: Path) -> None:
    comparison = compared(1, origin_latitude_deg="18.0", origin_longitude_deg="-112.0")
    saved(comparison, tmp_path / "a.mcap")
    found = messages(tmp_path / "a.mcap")
    first = found["/beside/1/tf"][0][1].translation
    np.testing.assert_allclose([first.x, first.y], [9.0, 9.0], rtol=1e-12)
    # cos of the angle: sin2 18 + cos2 18 cos 136 deg; 123.7 deg of a sphere of 6,371 km are 13,757 km
    assert any("13,800 km from MEASURED: drawn FROM ONE START" in m.message for _, m in found["/log"])


def test_what_each_side_is_stands_in_log_and_metadata(tmp_path: Path) -> None:
    comparison = compared(1, reconstruction="fitted to a paper")
    saved(comparison, tmp_path / "a.mcap", tmp_path / "a.rrd")
    lines = [m.message for _, m in messages(tmp_path / "a.mcap")["/log"]]
    assert lines[0] == "flight: MEASURED"
    assert "twin0.nc: SIMULATED FROM A RECONSTRUCTION: fitted to a paper" in lines
    told = records(tmp_path / "a.mcap")
    assert told["origin"]["log"] == "measured"
    assert told["beside 1"]["log"] == "SIMULATED FROM A RECONSTRUCTION"
    assert (told["beside 1"]["topics"], told["beside 1"]["errors"]) == ("/beside/1", "/difference/1")
    assert told["origin of beside 1"]["depth"] == "simulated"
    assert told["run of beside 1"]["reconstruction"] == "fitted to a paper"
    assert told["run of beside 1"]["clock_note"] == "shifted by -12.500 s (align none)"
    assert "not across gaps of more than 20 s" in told["run of beside 1"]["comparison_note"]
    provenance = json.loads(told["run"]["provenance"])
    assert provenance["origin"] == "reconstruction"
    assert [side["origin"] for side in (provenance["origins"]["measured"], *provenance["origins"]["simulated"])] == [
        "measured", "simulated",
    ]  # fmt: skip
    assert "SIMULATED FROM A RECONSTRUCTION. Its clock is shifted by -12.500 s" in page(tmp_path / "a.rrd")


def test_layouts_of_an_overlay_name_what_is_in_the_file(both: Any, tmp_path: Path) -> None:
    _, _, mcap = both
    found = messages(mcap)
    write_layouts(tmp_path, together=together_in(mcap))
    for name in LAYOUTS:
        panels = json.loads((tmp_path / f"glider-{name}.json").read_text())["configById"]
        paths = [path["value"] for panel in panels.values() for path in panel.get("paths", [])]
        drawn = [topic for panel in panels.values() for topic in panel.get("topics", {})]
        more = [path.split(".") for path in paths if path.startswith(("/beside/", "/difference/"))]
        for topic, field in more:
            assert field in found[topic][0][1].DESCRIPTOR.fields_by_name or field not in ("depth_m", "elevation_m")
        assert {topic for topic, _ in more if topic.startswith("/difference/")} == {
            topic for topic in found if topic.startswith("/difference/")
        }
        assert "/beside/2/glider/navigation.elevation_m" in paths
        assert {"/beside/1/viz/vehicle", "/beside/2/viz/track"} <= set(drawn)
        assert {topic for topic in drawn if topic.startswith("/beside/")} <= set(found)
        tabs = [tab["title"] for tab in panels["Tab!plots"]["tabs"]]
        assert "navigation differences" in tabs


def test_a_file_of_one_flight_has_the_usual_layout(tmp_path: Path) -> None:
    write(flight(MEASURED, "measured", 0.0), tmp_path / "a.mcap")
    assert together_in(tmp_path / "a.mcap") is None


def test_validators_find_nothing(both: Any, tmp_path: Path) -> None:
    _, rrd, mcap = both
    assert "without error" in told_by_the_verifier(rrd, tmp_path)
    done = ran(BIN / "pymcap-cli", "doctor", "--strict-message-order", "--format", "jsonl", mcap)
    assert done.returncode == 0, done.stdout + done.stderr
    told = [json.loads(line) for line in done.stdout.splitlines()]
    assert [item for item in told if item.get("severity") in ("warning", "error")] == []
    done = rerun_program(tmp_path, "mcap", "check", mcap)
    assert done.returncode == 0, done.stdout + done.stderr
    lines = [line.split() for line in done.stdout.splitlines() if "/" in line and not line.startswith("/tmp")]
    states = {row[3]: row[0] for row in lines if row[0] in ("ok", "warn", "error")}
    assert states == dict.fromkeys(messages(mcap), "ok")


@pytest.mark.skipif(shutil.which("node") is None, reason="Node.js is not on this machine")
@pytest.mark.skipif(not (NODE / "node_modules").is_dir(), reason="`make test` installs tests/node where npm is")
def test_the_typescript_reader_decodes_every_message(both: Any) -> None:
    _, _, mcap = both
    done = ran("node", NODE / "check.cjs", mcap)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["topics"] == {topic: len(found) for topic, found in messages(mcap).items()}


def test_the_same_comparison_gives_the_same_bytes(both: Any, tmp_path: Path) -> None:
    comparison, rrd, mcap = both
    saved(comparison, tmp_path / "b.rrd", tmp_path / "b.mcap")
    assert (tmp_path / "b.rrd").read_bytes() == rrd.read_bytes()
    assert (tmp_path / "b.mcap").read_bytes() == mcap.read_bytes()


def test_what_cannot_be_shown_is_refused_whole(tmp_path: Path) -> None:
    comparison = compared(1)
    shown = overlay(comparison, {})
    together = {"beside": shown.beside, "names": shown.names}
    with pytest.raises(InputError, match="errors"):
        write(shown.log, tmp_path / "a.rrd", tmp_path / "a.mcap", **together, errors=[*shown.errors, {}])
    early = compare(comparison.against.shifted(-(10**18) * 2), comparison.runs[0].log.shifted(-(10**18) * 2))
    with pytest.raises(OutputError, match="MCAP starts at 1970"):
        saved(early, tmp_path / "a.rrd", tmp_path / "a.mcap")
    assert not list(tmp_path.iterdir())
