"""The page in headless Chromium: silent, alone, drawn in both themes, on a phone and on paper, and used by keyboard."""

from __future__ import annotations

import io
import re
import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from chromium import CHROMIUM, Tab, browser
from matplotlib.image import imread

from glidercli.compare import compare, read_facts
from glidercli.compare.page.whole import page
from glidercli.log import Event, Log
from glidercli.logio import read
from glidercli.simulation import simulate
from tests.logio.viewer_logs import HOSTILE, ROOT, full, hostile

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium (Debian: chromium)")

RECORD = {"program": "glidercli", "command": ["glider", "compare"], "inputs": [], "seed": None, "origin": "simulated"}
MIDDLE = "(b => [b.left + b.width / 2, b.top + b.height / 2])(document.getElementById('{}').getBoundingClientRect())"
MARKUP = "<script>alert(1)</script><b>bold</b><a href='http://127.0.0.1/'>link</a>"
"""What Plotly reads as markup in its labels, beside what a browser does."""
SHOWN = ("depth", "pitch", "heading", "density")
PAGES = ("glider", "facts", "hostile")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One page of a real glider and two logs beside it, one of published values, one of hostile logs."""
    folder = tmp_path_factory.mktemp("pages")
    measured = read([ROOT / "logs" / "seaglider-sg561"]).log
    other = measured.shifted(60 * 10**9)
    facts = read_facts(ROOT / "logs" / "south-china-sea-2011" / "facts.toml")
    known = Event(MARKUP, full(50).start_ns + 10**9, 12.0)
    evil = Log(hostile().channels, "measured", hostile().metadata, (known, *hostile().events))
    found = {
        "glider": compare(measured, [other, measured.shifted(-(10**9) * 200)], names=["a", "b", "c"], channels=SHOWN),
        "facts": compare(facts, simulate("south-china-sea-2011", every=20.0).log),
        "hostile": compare(evil, evil, names=[f"m{HOSTILE[3]}{HOSTILE[2]}", f'"><img src=x onerror=alert(1)>{HOSTILE[1]}']),
    }  # fmt: skip
    for name, one in found.items():
        (folder / f"{name}.html").write_text(page(one, RECORD), encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def tab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tab]:
    with browser(tmp_path_factory.mktemp("profile")) as found:
        yield found


def pixels(picture: bytes) -> np.ndarray:
    return (imread(io.BytesIO(picture))[..., :3] * 255).astype(int)


@pytest.mark.parametrize("name", PAGES)
def test_it_complains_of_nothing_and_asks_for_nothing(tab: Tab, folder: Path, name: str) -> None:
    tab.requests.clear()
    tab.faults.clear()
    tab.open(folder / f"{name}.html")
    assert tab.faults == []
    assert tab.requests == [(folder / f"{name}.html").as_uri()]
    drawn = tab.run(
        "[...document.querySelectorAll('.plot')].map(p => p.querySelectorAll('.scatterlayer path, canvas').length)"
    )
    assert len(drawn) > 2
    assert all(count > 0 for count in drawn)


def test_a_request_would_be_seen_and_is_refused(tab: Tab, folder: Path) -> None:
    """The two lists that the test above finds empty do fill; and the policy stops what a script might try."""
    tab.open(folder / "glider.html")
    tab.faults.clear()
    answer = tab.run("fetch('http://127.0.0.1:9/').then(() => 'came', () => 'refused')")
    assert answer == "refused"
    tab.run("console.error('seen')")
    assert any("Content Security Policy" in fault for fault in tab.faults), tab.faults
    assert any("seen" in fault for fault in tab.faults)
    tab.run("document.body.append(Object.assign(document.createElement('script'), {textContent: 'window.ran = 1'}))")
    assert tab.run("window.ran") is None


def test_hostile_texts_are_seen_as_text(tab: Tab, folder: Path) -> None:
    tab.faults.clear()
    tab.open(folder / "hostile.html")
    tab.run("window.alert = () => { window.alerted = true; }")
    tab.run("document.querySelectorAll('details').forEach(one => { one.open = true; })")
    assert tab.run("document.scripts.length") == 3
    assert tab.run("document.querySelectorAll('img, iframe, [onerror], [onload]').length") == 0
    seen = tab.run("document.body.innerText")
    for text in (
        "<script>alert(1)</script>",
        "<img src=x onerror=alert(1)>",
        "%s%n{}$(id)",
        "\\x00\\x01\\x1b[31mred",
        "\\u202eabc",
    ):
        assert text in seen, text
    # over the event's mark: Plotly's own labels, that understand some markup
    tab.run(
        "Plotly.Fx.hover(document.getElementById('plot-0'), [{curveNumber: document.getElementById('plot-0').data"
        ".findIndex(trace => trace.text), pointNumber: 0}])"
    )
    tab.wait("document.querySelector('#plot-0 .hovertext') !== null")
    assert MARKUP in tab.run("document.querySelector('#plot-0 .hoverlayer').textContent")
    assert tab.run("document.querySelectorAll('#plot-0 a').length") == 0
    assert tab.run("window.alerted") is None
    assert tab.faults == []


def test_dark_and_light_follow_the_system_and_the_button(tab: Tab, folder: Path) -> None:
    def brightness() -> float:
        return float(pixels(tab.picture()).mean())

    def ink() -> str:
        return str(tab.run("document.getElementById('plot-0').data.at(0).line.color"))

    tab.open(folder / "glider.html", scheme="light")
    light, black = brightness(), ink()
    tab.scheme("dark")
    tab.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert brightness() < 80.0 < 200.0 < light  # of 255
    assert ink() != black
    tab.open(folder / "glider.html", scheme="dark")
    assert brightness() < 80.0
    assert tab.run("document.getElementById('theme').textContent") == "Light colours"
    tab.run("document.getElementById('theme').click()")
    assert brightness() > 200.0
    assert ink() == black
    assert tab.run("document.getElementById('theme').textContent") == "Dark colours"


@pytest.mark.parametrize("name", PAGES)
@pytest.mark.parametrize("width", [320, 390])
def test_a_phone_scrolls_down_alone(tab: Tab, folder: Path, name: str, width: int) -> None:
    tab.open(folder / f"{name}.html", width=width, height=844, touch=True)
    tab.run("document.querySelectorAll('details').forEach(one => { one.open = true; })")
    assert tab.run("document.documentElement.scrollWidth") <= width
    assert (
        tab.run("Math.max(...[...document.querySelectorAll('.plot svg')].map(s => s.getBoundingClientRect().right))")
        <= width
    )
    assert tab.run("[...document.querySelectorAll('.wide')].some(one => one.scrollWidth > one.clientWidth)")
    # nothing of a plot lies over the words beneath it, and a finger on a plot scrolls the page
    assert tab.run(
        "[...document.querySelectorAll('figure')].every(f => !f.querySelector('figcaption') || f.querySelector('figcaption')"
        ".getBoundingClientRect().top >= f.querySelector('.main-svg').getBoundingClientRect().bottom - 1)"
    )
    assert tab.run("document.getElementById('plot-0')._fullLayout.dragmode") is False


def test_it_prints_light_without_buttons_and_as_before_afterwards(tab: Tab, folder: Path) -> None:
    tab.open(folder / "glider.html", scheme="dark")
    before = tab.run(
        "[innerWidth, document.getElementById('plot-0').clientWidth, document.querySelectorAll('details[open]').length]"
    )
    pdf = tab.printed()
    assert pdf.startswith(b"%PDF")
    sheets = len(re.findall(rb"/Type\s*/Page\b", pdf))
    assert 4 <= sheets <= 40
    streams = [_inflated(part) for part in re.findall(rb"stream\r?\n(.*?)endstream", pdf, re.DOTALL)]
    assert sum(len(stream) for stream in streams) > 100_000  # curves are there as lines, not as a blank
    assert any(b"/Subtype /Image" in part or b"/Subtype/Image" in part for part in [pdf, *streams])  # the 3-D track
    tab.call("Emulation.setEmulatedMedia", media="print", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    tab.run("dispatchEvent(new Event('beforeprint'))")
    assert tab.run("getComputedStyle(document.getElementById('theme')).display") == "none"
    assert tab.run("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert tab.run("document.querySelectorAll('details:not([open])').length") == 0
    assert tab.run("document.querySelector('#plot-track > img').src.length") > 5000
    tab.run("dispatchEvent(new Event('afterprint'))")
    tab.call("Emulation.setEmulatedMedia", media="", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    assert tab.run("getComputedStyle(document.body).backgroundColor") != "rgb(255, 255, 255)"
    after = tab.run(
        "[innerWidth, document.getElementById('plot-0').clientWidth, document.querySelectorAll('details[open]').length]"
    )
    assert after == before
    tab.wait(f"document.getElementById('plot-0')._fullLayout.width === {before[1]}")


def _inflated(data: bytes) -> bytes:
    try:
        return zlib.decompress(data)
    except zlib.error:
        return data


def test_the_keyboard_reaches_every_control_and_leaves(tab: Tab, folder: Path) -> None:
    tab.open(folder / "glider.html")
    describe = (
        "(e => e.id || e.dataset.time || e.dataset.turn || (e.dataset.log !== undefined && 'log ' + e.dataset.log) || "
        "e.getAttribute('href') || e.className || e.tagName)(document.activeElement)"
    )
    reached = []
    for _ in range(200):
        tab.key("Tab")
        reached.append(tab.run(describe))
        if reached[-1] == "BODY" or reached.count("theme") > 1:
            break
        outline = tab.run("getComputedStyle(document.activeElement).outlineStyle")
        assert outline != "none", reached[-1]
    assert reached[:2] == ["#content", "theme"]
    wanted = ["log 0", "log 1", "log 2", "in", "out", "back", "on", "all", "left", "right", "up", "down", "reset"]
    assert [stop for stop in reached if stop in wanted][: len(wanted) + 2] == [
        *wanted[:8], "left", "right", "up", "down", "in", "out", "reset",
    ]  # fmt: skip
    assert "wide" in reached  # tables that scroll take the keyboard too
    assert reached[-1] in ("BODY", "theme")  # past the last one, out of the page
    tab.key("Tab", shift=True)
    assert tab.run(describe) not in ("BODY", "theme", "#content")


def test_keys_work_the_controls(tab: Tab, folder: Path) -> None:
    tab.open(folder / "glider.html")
    ends = "document.getElementById('plot-1')._fullLayout.xaxis.range.map(Number)"
    first, last = tab.run(ends)
    tab.run("document.querySelector('[data-time=in]').focus()")
    tab.key("Enter", text="\r")
    near = tab.run(ends)
    assert near == pytest.approx([first + (last - first) / 4, last - (last - first) / 4])
    assert tab.run(ends.replace("plot-1", "plot-3")) == near  # all plots share their time axis
    tab.run("document.querySelector('[data-time=on]').focus()")
    tab.key("Enter", text="\r")
    assert tab.run(ends)[0] == pytest.approx(near[0] + (near[1] - near[0]) / 4)
    tab.run("document.querySelector('[data-time=all]').focus()")
    tab.key("Enter", text="\r")
    assert tab.run(ends) == pytest.approx([first, last])
    tab.run("document.querySelector('[data-log=\"1\"]').focus()")
    tab.key(" ", text=" ")
    shown = "document.getElementById('plot-0').data.filter(t => t.visible === true).length"
    assert tab.run(shown) < tab.run("document.getElementById('plot-0').data.length")
    eye = "document.getElementById('plot-track')._fullLayout.scene.camera.eye"
    was = tab.run(eye)
    tab.run("document.querySelector('[data-turn=left]').focus()")
    tab.key("Enter", text="\r")
    now = tab.run(eye)
    assert now["z"] == pytest.approx(was["z"])
    assert np.arctan2(was["y"], was["x"]) - np.arctan2(now["y"], now["x"]) == pytest.approx(np.pi / 12)
    tab.run("document.querySelector('[data-turn=reset]').focus()")
    tab.key("Enter", text="\r")
    assert tab.run(eye) == pytest.approx(was)


def test_dragging_over_one_plot_zooms_all(tab: Tab, folder: Path) -> None:
    tab.open(folder / "glider.html", height=1600)
    box = tab.run(
        "(b => [b.left, b.top, b.width, b.height])(document.querySelector('#plot-0 .nsewdrag').getBoundingClientRect())"
    )
    at = [box[0] + 0.25 * box[2], box[0] + 0.75 * box[2]]
    y = box[1] + 0.5 * box[3]
    for kind, x in (
        ("mouseMoved", at[0]),
        ("mousePressed", at[0]),
        ("mouseMoved", sum(at) / 2),
        ("mouseMoved", at[1]),
        ("mouseReleased", at[1]),
    ):
        tab.call(
            "Input.dispatchMouseEvent",
            type=kind,
            x=x,
            y=y,
            button="none" if kind == "mouseMoved" and x == at[0] else "left",
            buttons=1,
            clickCount=1,
        )
    ends = "document.getElementById('{}')._fullLayout.xaxis.range.map(Number)"
    tab.wait(f"Math.abs({ends.format('plot-0')}[0] - {ends.format('plot-2')}[0]) < 1e-6")
    whole = tab.run("JSON.parse(document.getElementById('data').textContent).range")
    span = whole[1] - whole[0]
    tab.wait(f"{ends.format('plot-2')}[0] > {whole[0] + 0.2 * span}")
    assert tab.run(ends.format("plot-2")) == pytest.approx(
        [whole[0] + 0.25 * span, whole[0] + 0.75 * span], abs=0.02 * span
    )  # 2 %: some pixels


def test_a_finger_on_a_plot_scrolls_the_page(tab: Tab, folder: Path) -> None:
    tab.open(folder / "glider.html", width=390, height=844, touch=True)
    for plot in ("plot-1", "plot-track"):
        tab.run(f"document.getElementById('{plot}').scrollIntoView({{block: 'center'}})")
        before = tab.run("scrollY")
        x, y = tab.run(MIDDLE.format(plot))
        tab.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        for step in range(1, 11):
            tab.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=[{"x": x, "y": y - 15 * step}])
        tab.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        tab.wait(f"scrollY > {before} + 50")


def test_the_wheel_scrolls_the_page_over_the_tracks(tab: Tab, folder: Path) -> None:
    tab.open(folder / "glider.html")
    tab.run("document.getElementById('plot-track').scrollIntoView({block: 'center'})")
    before = tab.run("scrollY")
    x, y = tab.run(MIDDLE.format("plot-track"))
    tab.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=200)
    tab.wait(f"scrollY > {before} + 50")


def test_names_and_roles_as_a_screen_reader_meets_them(tab: Tab, folder: Path) -> None:
    tab.open(folder / "glider.html")
    tab.call("Accessibility.enable")
    nodes = tab.call("Accessibility.getFullAXTree")["nodes"]
    met = [(n["role"]["value"], n.get("name", {}).get("value", "")) for n in nodes if not n.get("ignored")]
    roles = {role for role, _ in met}
    assert {"banner", "navigation", "main", "table", "columnheader", "rowheader", "checkbox", "button"} <= roles
    named = ("button", "checkbox", "link", "image", "table", "group", "navigation")
    nameless = [role for role, name in met if role in named and not name]
    assert nameless == ["group"] * 3  # the folded parts, each with a heading line of its own
    pictures = [name for role, name in met if role == "image"]
    plotted = tab.run("document.querySelectorAll('.plot').length")
    assert len(pictures) == plotted
    assert any(
        re.match(r"Plot of depth, m, against time: measured [\d.]+ to [\d.]+; compared 1 ", name) for name in pictures
    )
    assert ("StaticText", "time, s") not in met  # no loose words of axes
