"""Factors: shares by hand, numbers of an analytic flight, and variants that change what they say and nothing else."""

from __future__ import annotations

import csv
import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest
from analytic_flights import log, vee

from glidercli.compare import read_facts
from glidercli.compare.factors import Factors, Flown, Variant, explained, factors, measured, worse
from glidercli.compare.facts import Fact, Facts
from glidercli.errors import InputError, OutputError
from glidercli.simulation import simulate
from glidercli.simulation.mission_file import load_mission
from glidercli.vehicle import load_vehicle

TRIAL = "south-china-sea-2011"
T = np.arange(0.0, 6001.0, 5.0)


@pytest.mark.parametrize(
    ("base", "variant", "published", "share", "further"),
    [
        (-30.0, -35.0, -40.0, 50.0, False),  # half of 10 deg
        (-30.0, -40.0, -40.0, 100.0, False),
        (-30.0, -45.0, -40.0, 150.0, False),  # past it by 5, the base was 10 off
        (-30.0, -51.0, -40.0, 210.0, True),  # past it by 11
        (-30.0, -29.0, -40.0, -10.0, True),
        (-1400.0, -750.0, -100.0, 50.0, False),
        (20.0, 18.0, 28.0, -25.0, True),
        (20.0, 20.0, 28.0, 0.0, False),
        (-40.0, -41.0, -40.0, None, True),  # nothing to explain
        (None, -41.0, -40.0, None, False),
        (-30.0, None, -40.0, None, False),
        (-30.0, -41.0, None, None, False),
    ],
)
def test_shares_by_hand(base, variant, published, share, further) -> None:
    assert explained(base, variant, published) == share
    assert worse(base, variant, published) is further


def flown(factor: str, name: str, pitch: float, turn: float, time: float | None = 3000.0) -> Flown:
    numbers = {
        "time_to_depth": time, "pitch": pitch, "pitch_mean": pitch, "roll": 20.0, "turn": turn, "turn_rate": -0.1,
        "window": 5000.0,
    }  # fmt: skip
    beyond = {"roll": 12.4, "angle of attack": 0.0, "sideslip": 0.0}
    return Flown(Variant(factor, name, "a guess"), numbers, beyond, ("a warning", "another"))


STUB = Factors(
    flown("base", "as it stands", -30.0, -1400.0),
    (flown("hull", "soft", -32.5, -750.0, None), flown("sign", "other", -29.0, -1530.0, 2300.0)),
    {"pitch": -40.0, "turn": -100.0, "roll": 28.0, "time_to_depth": 2300.0},
    800.0,
)


def test_the_text_of_stub_numbers() -> None:
    lines = STUB.text().splitlines()
    head = [cell.strip() for cell in lines[0].split("  ") if cell.strip()]
    assert head == [
        "factor", "variant", "to 800 m, s", "pitch", "mean", "roll", "turn", "deg/s", "window, s", "pitch %", "turn %",
        "roll %", "time %", "roll, s", "attack, s", "sideslip, s",
    ]  # fmt: skip
    assert lines[1].split() == ["published", "2300", "-40.00", "-", "28.0", "-100", "-", "-"]
    base = "base as it stands 3000 -30.00 -30.00 20.0 -1400 -0.100 5000 12 0 0"
    assert lines[2].split() == base.split()
    # never at 800 m: no time and no share of it; pitch 2.5 of 10 deg, turn 650 of 1300 deg, roll unchanged
    assert lines[3].split() == [
        "hull",
        "soft",
        "-",
        "-32.50",
        "-32.50",
        "20.0",
        "-750",
        "-0.100",
        "5000",
        "25.0",
        "50.0",
        "0.0",
        "-",
        "12",
        "0",
        "0",
    ]
    # 1 of 10 deg and 130 of 1300 deg the wrong way, the time met
    other = "sign other 2300 -29.00 -29.00 20.0 -1530 -0.100 5000 -10.0 * -10.0 * 0.0 100.0 12 0 0"
    assert lines[4].split() == other.split()
    assert "* further from it than the base" in STUB.text()


def test_the_table_as_csv(tmp_path: Path) -> None:
    path = tmp_path / "factors.csv"
    STUB.write(path, {"command": ["x"]})
    assert json.loads((tmp_path / "factors.csv-metadata.json").read_text()) == {"command": ["x"]}
    base, soft, other = csv.DictReader(path.read_text().splitlines())
    assert base["factor"] == "base"
    assert (soft["basis"], soft["time_to_depth_s"], soft["time_to_depth_explained_percent"]) == ("a guess", "", "")
    assert (float(soft["turn_explained_percent"]), soft["turn_worse"]) == (50.0, "False")
    assert (float(other["pitch_explained_percent"]), other["pitch_worse"]) == (-10.0, "True")
    assert float(other["roll_beyond_s"]) == 12.4
    assert other["warnings"] == "a warning; another"
    assert "pitch_mean_explained_percent" not in base  # nothing published is a mean
    with pytest.raises(OutputError, match="exists"):
        STUB.write(path, {})


def test_numbers_of_an_analytic_flight() -> None:
    """800 m down in 3000 s and up again, turning evenly on the way down."""
    diving = T <= 3000.0
    flight = log(
        T, "simulated", depth=vee(800.0, 3000.0, 3000.0)(T), pitch=np.where(diving, -40.0, 40.0),
        heading=(50.0 - 100.0 * np.minimum(T, 3000.0) / 3000.0) % 360.0,
    )  # fmt: skip
    numbers = measured(flight, 401.0)
    assert numbers["time_to_depth"] == pytest.approx(401.0 / 800.0 * 3000.0, abs=1e-6)  # between two samples
    assert numbers["pitch"] == numbers["pitch_mean"] == pytest.approx(-40.0, abs=1e-9)
    assert numbers["roll"] is None  # the log has none
    assert numbers["turn"] == pytest.approx(
        -100.0, abs=4 * 5.0 * 100.0 / 3000.0
    )  # two samples of each end are the turn
    assert numbers["turn_rate"] == pytest.approx(-100.0 / 3000.0, abs=1e-9)
    assert numbers["window"] == pytest.approx(6000.0, abs=1e-6)
    assert measured(flight, 801.0)["time_to_depth"] is None
    assert measured(flight, 0.0)["time_to_depth"] == 0.0


def test_published_values_are_those_of_the_same_quantity_channel_and_phase() -> None:
    def fact(name: str, quantity: str, value: float, **more: str) -> Fact:
        return Fact(name, quantity, value, "", 1.0, "p", **more)

    facts = Facts("s", "", (
        fact("a", "median", -41.0, channel="pitch", phase="dive"), fact("b", "median", 41.0, channel="pitch", phase="climb"),
        fact("c", "maximum", 9.0, channel="roll", phase="dive"), fact("d", "time_to_max_depth", 2000.0),
        fact("e", "duration", 6000.0), fact("f", "duration", 5000.0),
    ))  # fmt: skip
    found = factors(TRIAL, [], facts, 800.0)
    assert found.published == {"pitch": -41.0, "time_to_depth": 2000.0, "window": 6000.0}  # the first of two


def test_the_base_is_the_mission_as_it_stands() -> None:
    found = factors(TRIAL, [], Facts("s", "", ()), 800.0)
    run = simulate(TRIAL)
    assert found.base.numbers == measured(run.log, 800.0)
    assert found.base.warnings == run.warnings
    end = next(event for event in run.log.events if event.name == "end of dive")
    exact = (end.time_ns - run.log.start_ns) * 1e-9  # found by the integrator itself
    # samples of 1 s; between two the depth bends by 0.5 * 0.005 m/s2 * (0.5 s)^2 at 0.1 m/s
    assert found.base.numbers["time_to_depth"] == pytest.approx(exact, abs=0.01)


def one(variant: Variant) -> Flown:
    (found,) = factors(TRIAL, [variant], Facts("s", "", ()), 800.0).variants
    return found


def test_a_parameter_is_the_vehicles() -> None:
    craft = load_vehicle("seawing")
    other = dataclasses.replace(craft, hydrodynamics=dataclasses.replace(craft.hydrodynamics, roll_sideslip=-20.0))
    assert one(Variant("", "", parameters={"KMR": -20.0})).numbers == measured(
        simulate(TRIAL, vehicle=other).log, 800.0
    )


def test_fields_of_the_mission() -> None:
    uniform = one(Variant("", "", mission={"ctd": None, "adcp": None}))
    assert not any("csv" in warning for warning in uniform.warnings)  # neither cast nor current is read
    plan, path = load_mission(TRIAL)
    still = simulate((dataclasses.replace(plan, ctd=None, adcp=None), path))
    assert uniform.numbers == measured(still.log, 800.0)
    assert "current_east" not in still.log


def test_columns_of_control_tables(monkeypatch: pytest.MonkeyPatch) -> None:
    logs = []

    def kept(*arguments, **options):
        run = simulate(*arguments, **options)
        logs.append(run.log)
        return run

    monkeypatch.setattr("glidercli.simulation.simulate", kept)
    one(Variant("", "", controls={"dive.mass_position_m": 0.423}))
    base, moved = logs
    for log_, position in ((base, 0.4216), (moved, 0.423)):
        channel = log_["mass_position"]
        dive = channel.time_ns < log_.start_ns + 3000 * 10**9
        assert channel.values[dive] == pytest.approx(position, abs=1e-12)
        assert channel.values[-1] == pytest.approx(0.3816, abs=1e-12)  # the climb's own
    assert moved["mass_rotation"].values.min() == base["mass_rotation"].values.min()  # the other columns stay


def test_equations() -> None:
    assert one(Variant("", "", equations="paper")).numbers == measured(simulate(TRIAL, equations="paper").log, 800.0)


def test_changes_together() -> None:
    a = Variant("a", "one", "guess", {"KMR": 0.0, "Nv": 1.0}, {"ctd": None}, {"dive.mass_position_m": 0.42})
    b = Variant("b", "two", "guess", {"Nv": 2.0}, {"adcp": None}, equations="paper")
    both = a.and_(b)
    assert (both.factor, both.name) == ("together", "one, two")
    assert both.basis == "guess"
    assert both.parameters == {"KMR": 0.0, "Nv": 2.0}
    assert both.mission == {"ctd": None, "adcp": None}
    assert both.controls == {"dive.mass_position_m": 0.42}
    assert both.equations == "paper"
    assert b.and_(a).equations == "paper"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"parameters": {"K_MR": 0.0}}, "K_MR is no parameter; allowed: ms, rs"),
        ({"parameters": {"KMR": (0.0, 0.0, 0.0)}}, "KMR = .*; allowed: a number"),
        ({"parameters": {"rs": 0.0}}, "rs = 0.0; allowed: three numbers"),
        ({"mission": {"ctdd": None}}, "mission.ctdd: unknown; allowed: actuators"),
        ({"controls": {"ascent.mass_position_m": 0.0}}, "has no leg ascent with a table"),
        ({"controls": {"dive.mass_m": 0.0}}, "dive.csv has no column mass_m"),
    ],
)
def test_changes_of_what_is_not_there(change, message) -> None:
    with pytest.raises(InputError, match=message):
        one(Variant("", "strange", **change))


def test_a_changed_flight_says_so() -> None:
    run = simulate(TRIAL, changes={"KMR": 0.0, "rs": [-0.08, 0.0, 0.003]}, every=60.0)
    assert run.log.metadata["parameters_changed"] == "KMR = 0.0, rs = [-0.08, 0.0, 0.003]"
    assert "parameters_changed" not in simulate(TRIAL, every=60.0).log.metadata


def test_excursions_are_those_of_the_warnings() -> None:
    run = simulate(TRIAL, every=60.0)
    spent = {item.name: item.duration for item in run.excursions}
    assert set(spent) == {"roll", "angle of attack"}
    assert any(f"roll was beyond 90 deg for {spent['roll']:.1f} s" in line for line in run.warnings)


def test_facts_of_the_shipped_trial_are_met_by_measures() -> None:
    from glidercli import shipped

    folder = shipped.find(TRIAL)
    assert folder is not None
    found = factors(TRIAL, [], read_facts(folder / "facts.toml"), 800.0)
    assert found.published == {
        "time_to_depth": 2300.0, "pitch": -40.0, "roll": 28.0, "turn": -100.0, "window": 6120.0,
    }  # fmt: skip
