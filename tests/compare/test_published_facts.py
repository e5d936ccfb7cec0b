"""Published values: the file's faults are all reported, and each verdict follows from an analytic flight."""

from pathlib import Path

import numpy as np
import pytest
from analytic_flights import channel, log, vee

import glidercli
from glidercli.compare import read_facts
from glidercli.compare.facts import Fact, Facts
from glidercli.errors import InputError

TRIAL = Path(__file__).with_name("trial.toml")
T = np.arange(0.0, 6001.0, 5.0)
SAMPLE = 5.0 * 800.0 / 3000.0  # depth, m, within one sample interval


def flight(turn: float = -100.0, **more):
    """800 m down in 3000 s and up again, turning by ``turn`` deg on the way down."""
    diving = T <= 3000.0
    return log(
        T, "simulated", depth=vee(800.0, 3000.0, 3000.0)(T), pitch=np.where(diving, -40.0, 40.0),
        heading=(50.0 + turn * np.minimum(T, 3000.0) / 3000.0) % 360.0, **more,
    )  # fmt: skip


def verdict(log_, **fact):
    entry = Fact("x", value=fact.pop("value", 0.0), unit="", tolerance=fact.pop("tolerance", 1.0), place="p", **fact)
    (one,) = glidercli.compare(Facts("source", "", (entry,)), log_).runs[0].facts
    return one


def test_the_trial_file() -> None:
    facts = read_facts(TRIAL)
    assert [fact.name for fact in facts.facts] == ["maximum depth", "pitch on the dive", "turn on the dive", "density"]
    assert facts.facts[0].value == 800.0
    found = glidercli.compare(facts, flight(turn=-730.0)).document()
    assert [(one["name"], one["verdict"]) for one in found["facts"]] == [
        ("maximum depth", "agrees"),
        ("pitch on the dive", "agrees"),
        ("turn on the dive", "disagrees"),
        ("density", "not simulated"),
    ]
    turn = found["facts"][2]
    # the phase leaves out at most two sample intervals at each end: 4 x 5 s at 730 deg in 3000 s
    assert turn["simulated"] == pytest.approx(-730.0, abs=4 * 5.0 * 730.0 / 3000.0)
    assert turn["difference"] == turn["simulated"] - turn["published"]
    assert (turn["published"], turn["tolerance"], turn["place"]) == (-100.0, 10.0, "Fig. 12(c)")
    assert found["facts"][1]["note"] == "also a control input: not an independent check"
    assert found["facts"][3]["reason"] == "the log has no density"
    assert found["origins"]["measured"]["origin"] == "published"
    assert (found["align"], found["channels"], found["events"]) == (None, {}, [])


@pytest.mark.parametrize(
    ("fact", "expected", "within"),
    [
        ({"quantity": "max_depth"}, 800.0, 1e-9),  # a sample stands at the apogee: rounding alone
        ({"quantity": "duration"}, 6000.0, 1e-6),
        ({"quantity": "duration", "phase": "dive"}, 3000.0, 4 * 5.0),  # two sample intervals at each end
        ({"quantity": "time_to_max_depth"}, 3000.0, 1e-6),
        ({"quantity": "heading_change"}, -100.0, 1e-9),
        ({"quantity": "turn_rate", "phase": "dive"}, -100.0 / 3000.0, 1e-9),  # constant: the ends do not matter
        ({"quantity": "mean", "channel": "pitch", "phase": "climb"}, 40.0, 1e-9),
        ({"quantity": "median", "channel": "pitch", "phase": "dive"}, -40.0, 1e-9),
        ({"quantity": "minimum", "channel": "pitch"}, -40.0, 1e-9),
        ({"quantity": "maximum", "channel": "pitch"}, 40.0, 1e-9),
        ({"quantity": "range", "channel": "pitch"}, 80.0, 1e-9),
        ({"quantity": "first", "channel": "depth"}, 0.0, 1e-9),
        ({"quantity": "last", "channel": "pitch", "phase": "dive"}, -40.0, 1e-9),
        ({"quantity": "mean", "channel": "depth"}, 400.0, 1e-9),  # trapezoids are exact on straight lines
        ({"quantity": "density_change"}, 0.7, 1e-9),
    ],
)
def test_quantities(fact: dict, expected: float, within: float) -> None:
    simulated = flight(density=1020.0 * (1.0 + 0.007 * vee(1.0, 3000.0, 3000.0)(T)))
    assert verdict(simulated, **fact).simulated == pytest.approx(expected, abs=within)


def test_the_mean_is_by_time() -> None:
    uneven = np.concatenate([np.arange(0.0, 10.0), [110.0]])
    found = verdict(log(uneven, "simulated", depth=uneven), quantity="mean", channel="depth")
    assert found.simulated == pytest.approx(55.0, abs=1e-9)  # mean of a line over 0..110


def test_angles_on_the_circle_are_compared_the_short_way() -> None:
    north = log(T, "simulated", heading=np.full(len(T), 359.0))
    found = verdict(north, quantity="mean", channel="heading", value=1.0, tolerance=2.5)
    assert found.difference == pytest.approx(-2.0, abs=1e-9)
    assert found.simulated == pytest.approx(-1.0, abs=1e-9)
    assert found.verdict == "agrees"


@pytest.mark.parametrize(("value", "expected"), [(840.0, "agrees"), (760.0, "agrees"), (840.5, "disagrees")])
def test_the_tolerance_belongs_to_agreement(value: float, expected: str) -> None:
    assert verdict(flight(), quantity="max_depth", value=value, tolerance=40.0).verdict == expected


def test_what_a_log_does_not_hold_is_not_simulated() -> None:
    descending = log(T, "simulated", depth=0.2 * T)
    cases = {
        "the log has no climb": {"quantity": "duration", "phase": "climb"},
        "the log has no roll": {"quantity": "mean", "channel": "roll"},
        "the log has no heading": {"quantity": "turn_rate"},
        "one sample lasts no time": {"quantity": "duration"},
    }
    for reason, fact in cases.items():
        held = descending if "one" not in reason else log(T[:1], "simulated", depth=T[:1])
        found = verdict(held, **fact)
        assert (found.verdict, found.simulated, found.reason) == ("not simulated", None, reason)


def test_a_phase_without_samples_of_the_channel() -> None:
    late = flight().with_channels(channel("roll", T[-10:], np.zeros(10), "simulated"))
    assert verdict(late, quantity="mean", channel="roll", phase="dive").reason == "the log has no roll on the dive"


def test_every_fault_is_reported_together(tmp_path: Path) -> None:
    path = tmp_path / "facts.toml"
    path.write_text(
        """
        other = 1
        [facts]
        titel = "A trial"
        [[fact]]
        name = "depth"
        quantity = "max_depth"
        value = "800"
        unit = "km"
        place = "p. 1"
        [[fact]]
        name = "depth"
        quantity = "mean"
        value = 1
        unit = "deg"
        tolerance = -1
        phase = "ascent"
        [[fact]]
        name = "a"
        quantity = "average"
        channel = "pitch"
        value = nan
        unit = "deg"
        tolerance = true
        place = "p. 2"
        [[fact]]
        name = "b"
        quantity = "median"
        channel = "phase"
        value = 1.0
        unit = "deg"
        tolerance = 1
        place = "p. 2"
        [[fact]]
        name = "c"
        quantity = "duration"
        channel = "depth"
        value = 1.0
        unit = "s"
        tolerance = 1
        place = ""
        [[fact]]
        name = "d"
        quantity = "other"
        channel = "depth"
        phase = "dive"
        value = 6.0
        unit = "s"
        tolerance = 1
        place = "p. 3"
        """,
        encoding="utf-8",
    )
    with pytest.raises(InputError) as caught:
        read_facts(path)
    text = str(caught.value)
    assert text.startswith(f"{path}: ")
    for fault in (
        "other: unknown",
        "facts.titel: unknown; allowed: source, title",
        "facts.source: missing",
        "fact 1 (depth).value = '800'; allowed: a finite number",
        "fact 1 (depth).unit = 'km'; allowed for this quantity: m",
        "fact 1 (depth).tolerance: missing",
        "fact 2 (depth).name: used twice",
        "fact 2 (depth).place: missing",
        "fact 2 (depth).channel: missing",
        "fact 2 (depth).tolerance = -1; allowed: 0 or more",
        "fact 2 (depth).phase = 'ascent'; allowed: flight, dive, climb",
        "fact 3 (a).quantity = 'average'; allowed: max_depth",
        "fact 3 (a).value = nan; allowed: a finite number",
        "fact 3 (a).tolerance = True; allowed: a finite number",
        "fact 4 (b).channel = 'phase'; allowed: depth",
        "fact 5 (c).channel: duration takes none",
        "fact 5 (c).place = ''; allowed: a text",
        "fact 6 (d).channel: other takes none",
        "fact 6 (d).phase: other takes none",
        "fact 6 (d).note: missing; it says why no log holds the value",
    ):
        assert fault in text


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (b"[facts", "is not valid TOML"),
        (b"\xff\xfe", "is not a text file"),
        (b"", "is empty"),
        (b"# nothing\n", r"\[facts\]: missing"),
        (b"fact = 3\n[facts]\nsource = 's'", r"\[\[fact\]\]: missing"),
    ],
)
def test_files_that_are_no_facts(tmp_path: Path, content: bytes, fault: str) -> None:
    path = tmp_path / "facts.toml"
    path.write_bytes(content)
    with pytest.raises(InputError, match=fault):
        read_facts(path)


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_facts(tmp_path / "facts.toml")


def test_what_no_log_can_hold_is_not_simulated_and_says_why(tmp_path: Path) -> None:
    path = tmp_path / "facts.toml"
    path.write_text(
        """
        [facts]
        source = "s"
        [[fact]]
        name = "sampling"
        quantity = "other"
        value = 6.0
        unit = "of any kind"
        tolerance = 0.5
        place = "p. 1"
        note = "a simulation has no instruments"
        """,
        encoding="utf-8",
    )
    found = glidercli.compare(read_facts(path), flight())
    (one,) = found.runs[0].facts
    assert (one.verdict, one.simulated, one.difference) == ("not simulated", None, None)
    assert "sampling: no log holds it; a simulation has no instruments." in found.text()


def test_facts_given_to_the_simulation_are_counted_apart() -> None:
    entries = tuple(Fact(str(i), "max_depth", 800.0, "m", 1.0, "p", given=i < 2) for i in range(3))
    found = glidercli.compare(Facts("source", "", entries), flight())
    assert "Of 3 facts: 3 agree (2 of them given to the simulation), 0 disagree" in found.text()
    assert [one["given"] for one in found.document()["facts"]] == [True, True, False]
