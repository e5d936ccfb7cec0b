"""The figure: the expected panels, legible labels, origins in the legend, the same bytes each time."""

from pathlib import Path

import numpy as np
import pytest
from analytic_flights import log, vee

from glidercli.compare import compare, read_facts, write
from glidercli.compare.figure import figure
from glidercli.errors import InputError
from glidercli.log import Log

T = np.arange(0.0, 2001.0, 5.0)


def flight(origin="measured", off: float = 0.0, **more) -> Log:
    return log(
        T, origin, depth=vee(300.0, 1000.0, 1000.0)(T) + off, pitch=np.where(T < 1000.0, -30.0, 30.0) + off,
        heading=(350.0 + 0.1 * T + off) % 360.0, **more,
    )  # fmt: skip


def titles(drawing) -> list[str]:
    return [axes.get_title(loc="left") for axes in drawing.axes if axes.get_title(loc="left")]


def legend(drawing) -> list[str]:
    return [entry.get_text() for entry in drawing.legends[0].get_texts()]


def test_panels_with_errors_beneath() -> None:
    drawing = figure(compare(flight(), flight("simulated", 2.0, mass_position=0.4 + 0.0 * T)))
    assert titles(drawing) == ["depth", "pitch", "heading", "mass position"]
    labels = [axes.get_ylabel() for axes in drawing.axes]
    assert labels == ["m", "error, m", "deg", "error, deg", "deg", "error, deg", "m"]  # no error without a measured one
    assert legend(drawing) == ["measured: measured", "simulated: simulated"]
    assert drawing.axes[0].yaxis_inverted()  # depth grows downward
    assert any("time, s" in axes.get_xlabel() for axes in drawing.axes)


def test_the_error_drawn_is_simulated_less_measured() -> None:
    drawing = figure(compare(flight(), flight("simulated", 2.0)))
    curve = drawing.axes[1].get_lines()[-1]
    assert curve.get_ydata() == pytest.approx(np.full(len(T), 2.0), abs=1e-9)  # rounding alone


def test_a_heading_is_drawn_from_0_to_360_and_broken_at_north() -> None:
    drawing = figure(compare(flight(), flight("simulated", 15.0)))
    for line, start in zip(drawing.axes[4].get_lines(), (350.0, 5.0), strict=True):
        heading = line.get_ydata()
        assert np.nanmin(heading) >= 0.0
        assert np.nanmax(heading) < 360.0
        assert heading[0] == pytest.approx(start, abs=1e-9)
        steps = np.abs(np.diff(heading))
        assert np.nanmax(steps) == pytest.approx(0.5, abs=1e-9)  # 0.1 deg/s every 5 s
        assert np.isnan(heading).sum() == (start > 180.0)  # one passage of north, at the first flight's 100 s
    assert drawing.axes[5].get_lines()[-1].get_ydata() == pytest.approx(np.full(len(T), 15.0), abs=1e-9)


def test_turns_are_added_up_beside_published_ones() -> None:
    facts = read_facts(Path(__file__).with_name("trial.toml"))
    panel = figure(compare(facts, flight("simulated", 5.0))).axes[2]
    heading = panel.get_lines()[0].get_ydata()
    assert heading[-1] - heading[0] == pytest.approx(200.0, abs=1e-9)
    assert "turns added up" in panel.get_ylabel()


def test_the_time_axis_is_that_of_the_part_compared() -> None:
    short = flight("simulated").sliced(None, flight().start_ns + 500 * 10**9)
    for axes in figure(compare(flight(), short)).axes:
        assert axes.get_xlim() == pytest.approx((-0.02 * 495.0, 1.02 * 495.0), abs=1e-6)  # its last sample; 2 % margin


def test_lines_are_broken_at_gaps() -> None:
    measured = flight()
    kept = Log({n: type(c)(n, *(np.delete(x, np.s_[100:200]) for x in (c.time_ns, c.values)))
                for n, c in measured.channels.items()}, "measured")  # fmt: skip
    line = figure(compare(kept, flight("simulated"))).axes[0].get_lines()[0]
    assert np.isnan(line.get_ydata()).sum() == 1


def test_asked_channels_and_the_rest_when_none_of_the_usual_are_there() -> None:
    pair = flight(temperature=20.0 - 0.01 * T), flight("simulated", temperature=20.0 - 0.01 * T)
    assert titles(figure(compare(*pair, channels=["temperature", "pitch"]))) == ["temperature", "pitch"]
    water = log(T, temperature=T), log(T, "simulated", temperature=T)
    assert titles(figure(compare(*water))) == ["temperature"]


def test_published_values_as_bands() -> None:
    facts = read_facts(Path(__file__).with_name("trial.toml"))
    drawing = figure(compare(facts, flight("simulated")))
    assert titles(drawing) == ["depth", "pitch", "heading"]
    assert legend(drawing) == ["published, with tolerance: A paper (2013), a journal 60, 1-13", "simulated: simulated"]
    (band,) = drawing.axes[0].collections
    heights = band.get_paths()[0].vertices[:, 1]
    assert (heights.min(), heights.max()) == (760.0, 840.0)
    assert "Published, not drawn: density." in [text.get_text() for text in drawing.texts]


def test_a_log_without_any_channel_to_show() -> None:
    facts = read_facts(Path(__file__).with_name("trial.toml"))
    with pytest.raises(InputError, match="none of the channels"):
        figure(compare(facts, log(T, "simulated", temperature=T)))


def test_a_reconstruction_is_named_in_the_legend() -> None:
    made = flight("reconstruction", metadata={"reconstruction": "from printed figures"})
    drawing = figure(compare(made, flight("simulated"), names=["a.csv", "b.csv"]))
    assert legend(drawing) == ["reconstruction: a.csv", "simulated: b.csv"]
    assert "Reconstruction: from printed figures" in [text.get_text() for text in drawing.texts]


@pytest.mark.parametrize(("ending", "magic"), [("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")])
def test_files_are_whole_and_the_same_each_time(tmp_path: Path, ending: str, magic: bytes) -> None:
    found = compare(flight(), [flight("simulated", 2.0), flight("simulated", -1.0)])
    for name in ("one", "two"):
        write(found, tmp_path / f"{name}.{ending}", provenance={"program": "glidercli"})
    one, two = ((tmp_path / f"{name}.{ending}").read_bytes() for name in ("one", "two"))
    assert one.startswith(magic)
    assert one == two
    assert b"CreationDate" not in one
    assert b"dc:date" not in one
