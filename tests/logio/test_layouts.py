"""Do the shipped layouts fit the files? Every topic and message path that they name is in an MCAP of ours."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Run, one_line_error
from google.protobuf.descriptor_pb2 import FileDescriptorSet
from google.protobuf.descriptor_pool import DescriptorPool
from mcap.reader import make_reader
from viewer_logs import LOGS

from glidercli.channels import CHANNELS
from glidercli.logio.layouts import LAYOUTS, write_layouts
from glidercli.logio.mcap.layouts import Sight, sight_of
from glidercli.logio.mcap.layouts import layout as layout_of
from glidercli.logio.mcap.reader import read_mcap_log
from glidercli.logio.mcap.topics import field_names
from glidercli.logio.mcap.writer import write_mcap

BUILTIN = {"3D", "map", "Plot", "StateTransitions", "RosOut", "RawMessages", "SourceInfo", "Tab"}
"""Panel types of both viewers that the layouts may use (Lichtblick: suite-base/src/panels/index.ts)."""
LAYOUT = layout_of("foxglove")
SCHEMAS = {
    "map": {"foxglove.GeoJSON", "foxglove.LocationFix"},
    "RosOut": {"foxglove.Log"},
    "3D": {"foxglove.SceneUpdate"},
}


def kinds_in(path: Path) -> dict[str, Any]:
    """The message descriptor of each topic of an MCAP with a message, by the mcap library and the file's own schemas."""
    with path.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    assert summary.statistics is not None
    kinds = {}
    for channel in summary.channels.values():
        assert summary.statistics.channel_message_counts[channel.id] > 0
        schema, pool = summary.schemas[channel.schema_id], DescriptorPool()
        for file in FileDescriptorSet.FromString(schema.data).file:
            pool.Add(file)
        kinds[channel.topic] = pool.FindMessageTypeByName(schema.name)
    return kinds


@pytest.fixture(scope="module")
def described(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """The message descriptor of each topic, from a file with every channel, from an event to fixes at the surface."""
    path = tmp_path_factory.mktemp("layouts") / "a.mcap"
    log = LOGS["full"]()
    fixed = {name: log[name].__class__(name, log[name].time_ns, log[name].values) for name in ("latitude", "longitude")}
    log = log.with_channels(*fixed.values()).with_metadata(origin_latitude_deg="20", origin_longitude_deg="115")
    log = log.with_metadata(
        depth_averaged_current_north_m_s="0.1", depth_averaged_current_east_m_s="0.2", bottom_depth_m="90"
    )
    write_mcap(log, path)
    return kinds_in(path)


def leaves(tree: Any) -> Iterator[str]:
    """Names of the panels in a tree of rows and columns."""
    if isinstance(tree, str):
        yield tree
        return
    assert tree["direction"] in ("row", "column")
    assert 0.0 < tree["splitPercentage"] < 100.0
    yield from leaves(tree["first"])
    yield from leaves(tree["second"])


@pytest.fixture(params=LAYOUTS)
def layout(request: pytest.FixtureRequest, tmp_path: Path) -> Any:
    write_layouts(tmp_path)
    return json.loads((tmp_path / f"glider-{request.param}.json").read_text())


def test_every_panel_is_shown_once_and_known(layout: Any) -> None:
    panels = layout["configById"]
    trees = [layout["layout"], *(tab["layout"] for item in panels.values() for tab in item.get("tabs", []))]
    shown = [name for tree in trees for name in leaves(tree)]
    assert sorted(shown) == sorted(panels)
    assert {name.split("!")[0] for name in shown} == BUILTIN
    assert layout.keys() == {"configById", "globalVariables", "userNodes", "playbackConfig", "layout"}


def test_every_message_path_resolves(layout: Any, described: dict[str, Any]) -> None:
    paths = [
        (name, path["value"]) for name, panel in layout["configById"].items() for path in panel.get("paths", [])
    ]  # fmt: skip
    assert len(paths) > 20
    for name, path in paths:
        topic, *fields = path.split(".")
        assert re.fullmatch(r"(/\w+)+", topic), path
        kind = described[topic]
        for field in fields[:-1]:
            kind = kind.fields_by_name[field].message_type
        last = kind.fields_by_name[fields[-1]]
        assert last.type == last.TYPE_STRING if name.startswith("StateTransitions") else last.type == last.TYPE_DOUBLE


def test_every_topic_is_there_and_of_the_kind_that_the_panel_draws(layout: Any, described: dict[str, Any]) -> None:
    drawn = set()
    for name, panel in layout["configById"].items():
        kind = name.split("!")[0]
        for topic in panel.get("topics", {}):
            assert described[topic].full_name in SCHEMAS[kind]
            drawn.add(topic)
        for key in ("topicToRender", "topicPath"):
            if key in panel:
                assert panel[key] in described
                assert kind not in SCHEMAS or described[panel[key]].full_name in SCHEMAS[kind]
        assert panel.get("followTf", "map") in ("map", "base_enu")
    scenes = {topic for topic, kind in described.items() if kind.full_name in SCHEMAS["3D"]}
    assert drawn == scenes  # nothing that is in the file stays unseen


def test_every_channel_but_places_is_plotted(layout: Any) -> None:
    paths = {path["value"] for panel in layout["configById"].values() for path in panel.get("paths", [])}
    own = {name: {f"/glider/{spec.group}.{field}" for field in field_names(spec)} for name, spec in CHANNELS.items()}
    absent = {name for name, fields in own.items() if not fields & paths}
    # places and phase have panels of their own; body velocities repeat speed and angles, pressure depth
    assert absent == {"latitude", "longitude", "north", "east", "down", "phase", "u", "v", "w", "pressure"}


def test_the_two_differ_in_titles_alone(tmp_path: Path) -> None:
    write_layouts(tmp_path)
    one, other = ((tmp_path / f"glider-{name}.json").read_text() for name in ("foxglove", "lichtblick"))
    assert one != other
    assert one.replace("foxglovePanelTitle", "lichtblickPanelTitle") == other


def test_the_command_lists_and_writes_them(glider: Run, tmp_path: Path) -> None:
    assert {line.split("  ")[0] for line in glider("layouts").stdout.splitlines()} == set(LAYOUTS)
    assert not list(tmp_path.iterdir())
    done = glider("layouts", "-o", "new/folder")
    assert done.returncode == 0, done.stderr
    names = {f"glider-{name}.json" for name in LAYOUTS}
    assert {path.name for path in (tmp_path / "new" / "folder").iterdir()} == names
    assert set(json.loads(glider("layouts", "--json").stdout)["layouts"][0]) == {"name", "description"}


def test_layouts_that_are_there_are_kept(glider: Run, tmp_path: Path) -> None:
    (tmp_path / "glider-lichtblick.json").write_text("mine")
    assert "exists; --force" in one_line_error(glider("layouts", "-o", "."))
    assert [path.name for path in tmp_path.iterdir()] == ["glider-lichtblick.json"]
    assert glider("layouts", "-o", ".", "--force").returncode == 0
    assert json.loads((tmp_path / "glider-lichtblick.json").read_text())["configById"]
    assert "is a file; a folder is needed" in one_line_error(glider("layouts", "-o", "glider-lichtblick.json"))


def test_the_view_of_the_whole_fits_a_log(glider: Run, tmp_path: Path) -> None:
    """The trial's track lies within the cone that a camera of 45 deg sees."""
    assert glider("simulate", "south-china-sea-2011", "-o", "a.mcap").returncode == 0
    assert glider("layouts", "-o", ".", "--for", "a.mcap").returncode == 0
    panel = json.loads((tmp_path / "glider-foxglove.json").read_text())["configById"]["3D!track"]
    log = read_mcap_log(tmp_path / "a.mcap")
    east, north, up = log["east"].values, log["north"].values, -log["down"].values
    centre = np.array(panel["cameraState"]["targetOffset"])
    reach = np.linalg.norm(np.stack([east, north, up], axis=-1) - centre, axis=-1).max()
    distance = panel["cameraState"]["distance"]
    assert math.degrees(math.asin(reach / distance)) < 45.0 / 2 + 3.0  # the ball about it; corners may touch the edge
    assert reach > 0.25 * distance  # and it is not lost in the middle


@pytest.mark.parametrize("name", LOGS)
def test_panels_of_which_a_log_has_nothing_are_left_out(name: str, tmp_path: Path) -> None:
    """What is left is a whole layout, each panel of which shows something that is in the log's own file."""
    log = LOGS[name]()
    write_layouts(tmp_path, log=log)
    write_mcap(log, tmp_path / "a.mcap")
    there = kinds_in(tmp_path / "a.mcap")
    for found in sorted(tmp_path.glob("glider-*.json")):
        whole = json.loads(found.read_text())
        panels = whole["configById"]
        tabs = [tab for panel in panels.values() for tab in panel.get("tabs", [])]
        shown = [panel for tree in (whole["layout"], *(tab["layout"] for tab in tabs)) for panel in leaves(tree)]
        assert sorted(shown) == sorted(panels)  # no id that hangs loose, none twice, none unseen
        for panel, settings in panels.items():
            assert settings.get("tabs") != [], panel
            assert settings.get("paths") != [], panel
            assert settings.get("topics") != {} or not panel.startswith("3D"), panel
            for topic in (*settings.get("topics", {}), settings.get("topicPath"), settings.get("topicToRender")):
                assert topic is None or topic in there, panel
            for path in settings.get("paths", []):
                topic, field = path["value"].split(".")
                assert field in there[topic].fields_by_name, path
        drawn = {topic for topic, kind in there.items() if kind.full_name in SCHEMAS["3D"]}
        assert {topic for settings in panels.values() for topic in settings.get("topics", {})} == drawn
        assert ("map!track" in panels) == any(kind.full_name in SCHEMAS["map"] for kind in there.values())
        assert ("RawMessages!event" in panels) == ("/glider/event" in there)
        for spec in CHANNELS.values():  # and whatever can be plotted is
            plotted = f"/glider/{spec.group}.{field_names(spec)[-1]}"
            in_all = any(plotted == p["value"] for s in LAYOUT["configById"].values() for p in s.get("paths", []))
            in_this = any(plotted == p["value"] for s in panels.values() for p in s.get("paths", []))
            assert in_this == (in_all and spec.name in log and len(log[spec.name]) > 0), plotted


@pytest.mark.parametrize("name", ["one_sample", "events_alone"])
def test_a_log_with_nothing_to_fit_gets_the_usual_view(name: str) -> None:
    assert sight_of(LOGS[name]()) == Sight()


def test_a_fit_without_a_folder_is_wrong_usage(glider: Run) -> None:
    assert "-o FOLDER is needed" in one_line_error(glider("layouts", "--for", "a.mcap"), code=2)
    assert "no such file" in one_line_error(glider("layouts", "--for", "a.mcap", "-o", "."))
