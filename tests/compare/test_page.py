"""The page: complete in itself, its words and tables from the document, texts of logs shown as text, size bounded."""

import base64
import hashlib
import html.parser
import itertools
import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from analytic_flights import START_NS, log, vee
from conftest import ROOT, Run, one_line_error

from glidercli.compare import compare, read_facts, write
from glidercli.compare.page import whole as page_module
from glidercli.compare.page.html import MOST_ROWS, embedded, escaped, number, table
from glidercli.compare.page.plots import ALL_POINTS, MOST_POINTS, plots, thinned
from glidercli.compare.page.track import track
from glidercli.compare.page.whole import page
from glidercli.log import Event, Log
from tests.logio.viewer_logs import HOSTILE, full, hostile

T = np.arange(0.0, 2001.0, 5.0)
RECORD = {
    "program": "glidercli 9.9", "python": "3.x", "numpy": "2.x", "seed": 7, "origin": "simulated",
    "command": ["glider", "compare", "a file"], "inputs": [{"path": "a", "sha256": "ab12"}],
}  # fmt: skip
FACTS = Path(__file__).with_name("trial.toml")


def flight(origin="measured", off: float = 0.0, **more) -> Log:
    return log(
        T, origin, depth=vee(300.0, 1000.0, 1000.0)(T) + off, pitch=np.where(T < 1000.0, -30.0, 30.0) + off,
        north=T + off, east=0.5 * T, **more,
    )  # fmt: skip


class Read(html.parser.HTMLParser):
    """Elements of a page with their attributes, its text, and whether every element ends where it should."""

    VOID = ("meta", "input", "br", "img", "link")

    def __init__(self, source: str) -> None:
        super().__init__(convert_charrefs=True)
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self._open: list[str] = []
        self.scripts: list[str] = []
        self.feed(source)
        self.close()
        assert self._open == []

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag not in self.VOID:
            self._open.append(tag)
        if tag == "script":
            self.scripts.append("")

    def handle_endtag(self, tag):
        assert self._open.pop() == tag
        if tag not in ("b", "span"):
            self.text += " "

    def handle_data(self, data):
        if self._open and self._open[-1] == "script":
            self.scripts[-1] += data
        elif not self._open or self._open[-1] != "style":
            self.text += data


def one_page(*, provenance=RECORD, measured=None, simulated=None, **options) -> tuple[Read, str]:
    source = page(compare(measured or flight(), simulated or flight("simulated", 2.0), **options), provenance)
    return Read(source), source


def words(read: Read) -> str:
    return " ".join(read.text.split())


def test_it_says_what_was_compared_and_how() -> None:
    told = words(one_page(names=["dive.nc", "model.nc"], align="start", offset=1.0)[0])
    assert "Measured dive.nc" in told
    assert "Simulated model.nc" in told
    assert "both logs' first depth samples fall together: 1 s, 1 s of it asked for as offset" in told
    assert (
        "2011-07-20T04:28:05Z and 2011-07-20T05:01:20Z, 33.3 min" in told
    )  # from the second sample on: shifted by 1 s


def test_words_and_tables_hold_the_numbers_of_the_document() -> None:
    found = compare(flight(), flight("simulated", 2.0))
    told = words(Read(page(found, RECORD)))
    assert found.runs[0].channels["depth"].bias == pytest.approx(2.0)
    assert "the simulation is 2 m deeper on average, 2 m off at most" in told
    assert "depth m 401 2 2 2 0 2 1 0.006667 0 measured simulated" in told  # 2 m of 300 m: 0.00667
    assert "on dives of the measured log" in told
    assert "on climbs of the measured log" in told


@pytest.mark.parametrize(("origin", "called"), [("simulated", "Simulated"), ("reconstruction", "A reconstruction")])
def test_a_first_log_that_is_no_recording_is_not_called_measured(origin: str, called: str) -> None:
    """Neither in text nor in what is read out, with every kind of table: tracks, gaps, constants, other zeros."""
    sparse = log(T[:300:100], origin, depth=vee(300.0, 1000.0, 1000.0)(T[:300:100])).channels.values()
    first = flight(origin, roll=0.0 * T, metadata={"depth_zero": "the rail"}).with_channels(*sparse)
    runs = [flight("simulated", off, roll=1.0 + 0.0 * T) for off in (2.0, 3.0)]
    for later in (runs[:1], runs):
        found = compare(first, later, names=["a.nc", *"bc"[: len(later)]])
        read = Read(page(found, RECORD))
        told = words(read)
        labels = [attributes["aria-label"] for _, attributes in read.elements if attributes.get("aria-label")]
        for text in (told, " ".join(map(str, labels)), found.text()):
            assert "measured" not in text.lower()
        for said in (
            f"{called} a.nc", "Errors are simulated less the first log", "on dives of the first log", "b: first and simulated",
            "first: time, UTC", "from the first one", "Constant in the first log", "less first", "samples of the first log of the track",
            "first is simulated is", "without a depth of the first log", "(first: the rail)", "against it, not against a recording",
        ):  # fmt: skip
            assert said in told
        assert "rmse by depth of the first log, m:" in found.text()


def test_a_derived_first_log_is_called_measured_as_a_recording_is() -> None:
    pages = [
        words(Read(page(compare(flight(origin), flight("simulated", 2.0)), RECORD)))
        for origin in ("measured", "derived")
    ]
    for said in ("less measured", "measured samples", "on dives of the measured log", "from the measured one"):
        assert pages[0].count(said) == pages[1].count(said) > 0


def test_published_values_with_verdicts_and_places() -> None:
    told = words(Read(page(compare(read_facts(FACTS), flight("simulated", density=1025.0 + 0.0 * T)), RECORD)))
    assert "Published values" in told
    for fact in read_facts(FACTS).facts:
        assert fact.name in told
        assert fact.place in told
    assert re.search(r"Of \d published values \d agree within their tolerance", told)


def test_several_simulations_stand_side_by_side() -> None:
    told = words(one_page(simulated=[flight("simulated", 2.0), flight("simulated", -1.0)], names=["m", "a", "b"])[0])
    assert "RMSE of every simulation side by side" in told
    assert "depth m 2 1 2" in told  # channel, unit, 1: a, 2: b, closest


def test_a_reconstruction_is_said_before_anything_else() -> None:
    made = flight("simulated", metadata={"reconstruction": "from printed figures"})
    told = words(one_page(simulated=made)[0])
    assert "Made with a reconstruction: from printed figures" in told
    assert told.index("from printed figures") < told.index("Summary")


def test_provenance_is_there_and_each_logs_own() -> None:
    own = json.dumps({"command": ["glider", "simulate"], "seed": 3, "inputs": [{"path": "w.csv", "sha256": "cd34"}]})
    told = words(one_page(simulated=flight("simulated", metadata={"provenance": own, "vehicle": "seawing"}))[0])
    for text in ("glidercli 9.9", "glider compare 'a file'", "ab12", "glider simulate", "w.csv", "cd34", "seawing"):
        assert text in told
    assert "seed 7" in told


@pytest.mark.parametrize(
    "own", ["no JSON", "[" * 100_000, "[]", "{}", '{"command": 1, "inputs": [1], "seed": NaN}', '{"inputs": [{}]}']
)
def test_any_provenance_of_a_log_is_shown_or_told(own: str) -> None:
    found = compare(flight(), flight("simulated", metadata={"provenance": own}), names=["\udcffm", "s"])
    source = page(found, RECORD)
    Read(source)
    assert "\\udcffm" in source
    source.encode()


def test_what_a_document_gains_is_shown(monkeypatch) -> None:
    """Keys of the document that are not always there: another of them shows without a change of the page."""
    errors = {"rmse": 12.5, "mean": 3.5, "max": 99.5, "max_time_utc": "2016-05-04T18:15:00.000Z", "unit": "m"}
    plain = page_module.document

    def more(comparison):
        told = plain(comparison)
        told["align"] |= {"certainty_s": 1.5, "note": "certain to 1.5 s"}
        told["bands"] = [{"from_m": 0, "to_m": 50, "channels": told["channels"]}]
        told["outcomes"] = [{"name": "turns", "measured": 7, "simulated": 8, "difference": 1, "relative": 0.14}]
        told["ranking"] = [{"rank": 1, "name": "first one", "score": 0.5}, {"rank": 2, "name": "other", "score": 0.7}]
        told["track"] = {
            "absolute": errors, "aligned": {**errors, "rotation_deg": 11.5}, "closure": {"distance_m": 401.5},
            "relative": [{"over_s": 300.0, "rmse": 4.5, "n": 20}], "n": 5, "origin": "derived",
        }  # fmt: skip
        return told

    monkeypatch.setattr(page_module, "document", more)
    told = words(one_page(align="xcorr")[0])
    for text in (
        "certain to 1.5 s", "from 0 to 50 m of depth", "turns 7 8 1 0.14", "first one 0.5", "rotation, deg", "11.5",
        "distance, m", "401.5", "12.5 m (RMSE) from the measured one, 99.5 m at most", "300 4.5 20",
    ):  # fmt: skip
        assert text in told, text


def test_nothing_comes_from_elsewhere_and_scripts_are_named_by_hash() -> None:
    read, _ = one_page()
    for tag, attributes in read.elements:
        assert tag not in ("link", "img", "iframe", "object", "embed", "base", "form"), tag
        assert "src" not in attributes
        assert not any(name.startswith("on") for name in attributes)
        assert attributes.get("href", "#").startswith("#")
    (policy,) = (a["content"] for t, a in read.elements if a.get("http-equiv") == "Content-Security-Policy")
    assert policy is not None
    assert policy.startswith("default-src 'none';")
    data, *scripts = read.scripts
    json.loads(data)
    assert len(scripts) == 2
    for script in scripts:
        digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
        assert f"'sha256-{digest}'" in policy
    assert "unsafe-inline" not in policy.split("style-src")[0]


def test_structure_for_screen_readers() -> None:
    read, _ = one_page(simulated=flight("simulated", 1.0, metadata={"provenance": "{}", "a": "b"}))
    levels = [int(tag[1]) for tag, _ in read.elements if re.fullmatch("h[1-6]", tag)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in itertools.pairwise(levels))
    tags = [tag for tag, _ in read.elements]
    assert dict(read.elements)["html"]["lang"] == "en"
    assert {"header", "nav", "main"} <= set(tags)
    assert tags.count("table") == tags.count("caption")
    assert all("scope" in attributes for tag, attributes in read.elements if tag == "th")
    plotted = [a for _, a in read.elements if (a.get("class") or "").startswith("plot ") or a.get("class") == "plot"]
    assert len(plotted) == 6  # four channels, the track twice
    assert all(a["role"] == "img" and a["aria-label"] for a in plotted)
    ids = [a["id"] for _, a in read.elements if "id" in a]
    assert len(ids) == len(set(ids))
    targets = {a["href"] for t, a in read.elements if t == "a"}
    assert all(target is not None and target[1:] in ids for target in targets)


def test_the_text_of_a_plot_tells_all_samples_before_thinning() -> None:
    long = np.arange(0.0, 50_000.0)
    density = 1025.0 + np.sin(long)
    density[31_234] = 1777.0
    pair = log(long, density=density), log(long, "simulated", density=density + 1.0)
    told = plots(compare(*pair), ["measured", "simulated"]).told["density"]
    assert "measured 1024 to 1777; simulated 1025 to 1778; simulated less measured 1 to 1." in told


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_texts_are_text(text: str) -> None:
    shown = Read(f"<p>{escaped(text)}</p>")
    assert [tag for tag, _ in shown.elements] == ["p"]
    assert shown.text.replace("\n", "").isprintable()
    assert json.loads(embedded(text)) == text
    assert re.fullmatch(r"[ -~]*", embedded(text))
    assert not re.search("[<>&]", embedded(text))
    Read(table(text, [{"a": text}]))


def test_a_hostile_log_makes_a_page_like_another() -> None:
    def tags(read: Read) -> set[str]:
        return {tag for tag, _ in read.elements}

    names = [f"m{HOSTILE[3]}", f's" onload="x{HOSTILE[1]}']
    read, source = one_page(measured=hostile(), simulated=hostile(), names=names)
    assert tags(read) <= tags(one_page(measured=full(50), simulated=full(50))[0]) | {"p"}
    assert len(read.scripts) == 3
    assert not any(name.startswith("on") for _, attributes in read.elements for name in attributes)
    assert "<script>alert(1)</script>" in read.text
    assert "\x00" not in source
    assert "\u202e" not in source


def test_the_same_page_each_time_and_written_whole(tmp_path: Path) -> None:
    found = compare(flight(), flight("simulated", 2.0))
    for name in ("one.html", "two.html"):
        write(found, tmp_path / name, provenance=RECORD)
    one, two = ((tmp_path / name).read_bytes() for name in ("one.html", "two.html"))
    assert one == two
    assert one.rstrip().endswith(b"</html>")
    assert b"\r" not in one


def test_the_command_writes_it_and_keeps_an_old_one(glider: Run, tmp_path: Path) -> None:
    for name, off in (("m", 0.0), ("s", 2.0)):
        flight(off=off).table().to_csv(tmp_path / f"{name}.csv", index=False)
    assert glider("compare", "m.csv", "s.csv", "-o", "r.html").returncode == 0
    source = (tmp_path / "r.html").read_text()
    assert hashlib.sha256((tmp_path / "m.csv").read_bytes()).hexdigest() in source
    one_line_error(glider("compare", "m.csv", "s.csv", "-o", "r.html"), "r.html", "exists", "--force")
    assert (tmp_path / "r.html").read_text() == source


def test_thinning_keeps_ends_and_extremes_and_every_sample_of_a_short_line() -> None:
    random = np.random.default_rng(1)
    x = np.cumsum(random.uniform(0.1, 3.0, 100_000))
    y = np.cumsum(random.normal(size=len(x)))
    kept = thinned(x, y, 1000)
    assert len(kept) <= 1000
    assert (np.diff(kept) > 0).all()
    assert {0, len(x) - 1, int(np.argmin(y)), int(np.argmax(y))} <= set(kept.tolist())
    for begin, end in itertools.pairwise(np.linspace(x[0], x[-1], 500)):  # the 499 equal parts
        part = y[(x >= begin) & (x < end)]
        inside = y[kept][(x[kept] >= begin) & (x[kept] < end)]
        assert (inside.max(), inside.min()) == (part.max(), part.min())
    assert thinned(x[:1000], y[:1000], 1000).tolist() == list(range(1000))


def test_gaps_stay_gaps_when_thinned() -> None:
    seconds = np.concatenate([np.arange(0.0, 20_000.0), np.arange(90_000.0, 110_000.0)])
    both = log(seconds, depth=50.0 + np.sin(seconds / 500.0)), log(seconds, "simulated", depth=0.0 * seconds + 50.0)
    (line, _) = plots(compare(*both), ["measured", "simulated"]).data["panels"][0]["lines"]
    assert line["y"].count(None) == 1
    at = line["y"].index(None)
    assert line["x"][at - 1] == pytest.approx(19_999.0 / 3600.0, abs=1e-4)  # hours; rounded to 1e-5 h
    assert line["x"][at + 1] == pytest.approx(90_000.0 / 3600.0, abs=1e-4)


def test_the_size_is_bounded() -> None:
    """The plots' library takes 1.8 MB; 200,000 points of 12 bytes or so, with the tables, less than as much again."""
    n = 40_000
    seconds = np.arange(n) * 2.0
    random = np.random.default_rng(2)
    columns = {"depth": 400.0 - 400.0 * np.cos(seconds / 2000.0)} | {
        name: random.normal(size=n) * 10.0 + 50.0
        for name in ("pitch", "roll", "heading", "temperature", "salinity", "north", "east", "u", "v", "w", "p", "q", "r")
    }  # fmt: skip
    events = tuple(Event(f"event {i}", START_NS + i * 10**9, 5.0) for i in range(600))
    logs = [log(seconds, origin, **columns) for origin in ("measured", *("simulated",) * 5)]
    logs = [Log(one.channels, one.origin, {}, events) for one in logs]
    found = compare(logs[0], logs[1:])
    source = page(found, RECORD)
    assert len(source.encode()) < 4_500_000
    data = json.loads(Read(source).scripts[0])
    points = sum(len(line["x"]) for panel in data["panels"] for line in panel["lines"] + panel["errors"])
    assert points <= 2 * ALL_POINTS  # a line that jumps all the time is broken between any two points
    assert f"The first {MOST_ROWS} of" in source
    assert "Of 6 logs with more than 200 events" in source
    assert "long lines are thinned" in source


def test_a_single_line_has_the_most_points() -> None:
    long = np.arange(0.0, 50_000.0)
    pair = log(long, pitch=np.sin(long)), log(long, "simulated", pitch=np.cos(long))
    found = plots(compare(*pair), ["a", "b"])
    assert found.points == MOST_POINTS
    assert found.thinned == 3
    assert all(len(line["x"]) <= MOST_POINTS for line in found.data["panels"][0]["lines"])


def test_tracks_share_a_frame() -> None:
    def at(latitude: float, longitude: float, origin="measured") -> Log:
        named = {"origin_latitude_deg": str(latitude), "origin_longitude_deg": str(longitude)}
        return flight(origin, metadata=named)

    found = track([at(20.0, 115.0), at(20.001, 115.0, "simulated"), flight("simulated")], 1000)
    assert found is not None
    first, second, third = found["lines"]
    assert second["north"][0] - first["north"][0] == pytest.approx(
        110.7, abs=0.1
    )  # a degree of latitude at 20 deg: 110.70 km
    assert second["east"][0] == pytest.approx(first["east"][0], abs=0.01)  # written to 0.01 m
    assert third["north"][0] == 0.0
    assert found["apart"] == [2]
    assert found["exaggeration"] == 5.0  # 300 m deep, 2111 m to the north: a third of it is 704 m
    assert found["interpolated"] == []


def test_depth_of_a_track_between_samples_is_named() -> None:
    whole = flight()
    depth = whole["depth"]
    odd = type(depth)("depth", depth.time_ns + 1_000_000_000, depth.values)
    found = track([whole.with_channels(odd)], 1000)
    assert found is not None
    assert found["interpolated"] == [0]
    assert len(found["lines"][0]["depth"]) == len(T) - 1  # the first is before the first depth sample


def test_logs_without_a_track_or_a_drawn_channel_make_a_page() -> None:
    source = page(compare(read_facts(FACTS), log(T, "simulated", temperature=T)), RECORD)
    assert 'id="plots"' not in source
    assert 'id="track"' not in source
    Read(source)


@pytest.mark.parametrize(
    ("value", "text"),
    [(29.0243, "29.02"), (-0.5, "−0.5"), (0.00005, "0.00005"), (12345.6, "12,346"), (float("nan"), "–"), (0.0, "0"), (-1e-12, "−1e−12")],
)  # fmt: skip
def test_numbers_for_people(value: float, text: str) -> None:
    assert number(value) == text


def test_importing_compare_reads_no_page_and_no_library() -> None:
    code = "import sys, glidercli.compare; print([m for m in sys.modules if 'page' in m and 'glidercli' in m])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.strip() == "[]"


def test_the_library_is_the_published_one() -> None:
    library = (ROOT / "glidercli" / "compare" / "page" / "files" / "plotly-gl3d.min.js").read_bytes()
    assert hashlib.sha256(library).hexdigest() in (ROOT / "docs" / "dependencies.md").read_text()
