"""The room as a whole: one call in, the contract's document out."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from analytic_flights import START_NS, channel, log, vee

import glidercli
from glidercli.compare import compare, matching, overlay, read_facts, write
from glidercli.errors import InputError, OutputError
from glidercli.log import Event, Log

T = np.arange(0.0, 2001.0, 5.0)
KEYS = {"unit", "n", "rmse", "mae", "bias", "std", "max", "correlation", "nrmse"}


def flight(origin="measured", depth: float = 0.0, pitch: float = 0.0, late: float = 0.0, **options) -> Log:
    """300 m down and up; the simulated pitch is off by ``pitch`` deg on the dive and twice that on the climb."""
    diving = T <= 1000.0
    return log(
        T + late, origin, depth=vee(300.0, 1000.0, 1000.0)(T) + depth,
        pitch=np.where(diving, -30.0 + pitch, 30.0 + 2.0 * pitch), heading=(350.0 + 0.1 * T) % 360.0, **options,
    )  # fmt: skip


def test_the_package_function_is_the_room() -> None:
    found = glidercli.compare(flight(), flight("simulated", depth=2.0))
    assert found.document() == compare(flight(), flight("simulated", depth=2.0)).document()
    assert glidercli.compare.compare is compare


def test_the_contract_document() -> None:
    found = compare(flight(), flight("simulated", depth=2.0, pitch=1.5)).document()
    assert {"align", "channels", "phases", "events", "facts"} <= set(found)
    assert "simulations" not in found
    assert found["align"].items() >= {"method": "none", "shift_s": 0.0, "offset_s": 0.0}.items()
    assert set(found["channels"]) == {"depth", "pitch", "heading"}
    assert all(set(one) >= KEYS for one in found["channels"].values())
    # rounding of the unit conversions alone
    assert found["channels"]["depth"]["bias"] == pytest.approx(2.0, abs=1e-9)
    assert found["phases"]["dive"]["pitch"]["bias"] == pytest.approx(1.5, abs=1e-9)
    assert found["phases"]["climb"]["pitch"]["bias"] == pytest.approx(3.0, abs=1e-9)
    assert found["channels"]["pitch"]["unit"] == "deg"
    assert found["facts"] == []
    json.dumps(found, allow_nan=False)


def test_samples_of_the_phases_are_those_of_the_flight() -> None:
    found = compare(flight(), flight("simulated")).document()
    both = found["phases"]["dive"]["depth"]["n"] + found["phases"]["climb"]["depth"]["n"]
    # a sample every 1.5 m: within 1 m of a turning point is that sample alone, so that none is left out or in both
    assert both == found["channels"]["depth"]["n"]


def test_a_descent_alone_has_an_empty_climb() -> None:
    down = log(T, depth=0.2 * T)
    found = compare(down, log(T, "simulated", depth=0.2 * T)).document()
    assert found["phases"]["climb"] == {}
    assert found["phases"]["dive"]["depth"]["n"] > 0


def test_several_simulations() -> None:
    found = compare(flight(), [flight("simulated", depth=d) for d in (1.0, -2.0)], names=["m", "a", "b"]).document()
    assert [one["name"] for one in found["simulations"]] == ["a", "b"]
    assert [one["channels"]["depth"]["bias"] for one in found["simulations"]] == pytest.approx([1.0, -2.0], abs=1e-9)
    assert found["channels"] == found["simulations"][0]["channels"]
    assert [one["name"] for one in found["origins"]["simulated"]] == ["a", "b"]


def test_alignment_and_offset_are_reported() -> None:
    late = flight("simulated", late=1e6)
    with pytest.raises(InputError, match=r"does not overlap in time: .*--align start"):
        compare(flight(), late)
    for method in ("start", "xcorr"):
        found = compare(flight(), late, align=method).document()
        assert found["align"]["shift_s"] == pytest.approx(-1e6, abs=1e-3)  # both curves are the same: rounding alone
        assert found["channels"]["depth"]["rmse"] == pytest.approx(0.0, abs=1e-3)
    found = compare(flight(), late, align="start", offset=10.0).document()
    assert found["align"].items() >= {"method": "start", "shift_s": 10.0 - 1e6, "offset_s": 10.0}.items()
    assert found["phases"]["dive"]["depth"]["bias"] == pytest.approx(-3.0, abs=0.1)  # 10 s late at 0.3 m/s; the turns
    assert found["channels"]["depth"]["skipped"] == {"outside": 2, "gap": 0}


def test_a_shift_of_both_clocks_changes_no_number() -> None:
    here = compare(flight(), flight("simulated", depth=1.0)).document()
    there = compare(flight(late=3600.0), flight("simulated", depth=1.0, late=3600.0)).document()
    for name, one in here["channels"].items():
        other = there["channels"][name]
        assert {k: v for k, v in one.items() if k != "max_time_utc"} == {
            k: v for k, v in other.items() if k != "max_time_utc"
        }


def test_events_are_paired_by_name_and_nearest_time() -> None:
    second = 10**9
    measured = Log(flight().channels, "measured", {}, (Event("surfacing", START_NS + 2000 * second, 0.0),))
    events = (Event("surfacing", START_NS, 0.5), Event("surfacing", START_NS + 1990 * second, 1.0))
    simulated = Log(flight("simulated", depth=4.0).channels, "simulated", {}, events)
    found = compare(measured, simulated).document()["events"]
    pairs = [one for one in found if one["name"] == "surfacing"]
    assert [one["measured"] is None for one in pairs] == [True, False]
    assert (pairs[1]["time_difference_s"], pairs[1]["depth_difference_m"]) == (-10.0, 1.0)
    (deepest,) = (one for one in found if one["name"] == "deepest")
    assert deepest["measured"] == {"time_utc": "2011-07-20T04:44:40.000Z", "depth_m": 300.0}
    assert (deepest["time_difference_s"], deepest["depth_difference_m"]) == (0.0, 4.0)
    assert {"dive begins", "dive ends", "climb begins", "climb ends"} <= {one["name"] for one in found}


def test_channels_by_name_column_and_pattern() -> None:
    assert matching(["pitch_deg", "mass_*", "pitch"]) == ("pitch", "mass_position", "mass_rotation")
    found = compare(flight(), flight("simulated"), channels=["pitch_deg"]).document()
    assert set(found["channels"]) == {"pitch"}
    with pytest.raises(InputError, match="channel depht: unknown; allowed: depth, "):
        compare(flight(), flight("simulated"), channels=["depht"])


def test_nothing_to_compare() -> None:
    with pytest.raises(InputError, match="no channel in common with measured: it has roll; measured has depth, pitch"):
        compare(flight(), log(T, "simulated", roll=0.0 * T))
    with pytest.raises(InputError, match="no channel of roll in common"):
        compare(flight(), flight("simulated"), channels=["roll"])
    sparse = log(np.array([-1.0, 2001.0]), "simulated", depth=np.zeros(2))
    with pytest.raises(InputError, match="gap of more than 60 s; try a longer --max-gap"):
        compare(flight(), sparse)
    with pytest.raises(InputError, match="at least one is needed"):
        compare(flight(), [])
    with pytest.raises(InputError, match="1 for 2 logs"):
        compare(flight(), flight("simulated"), names=["m"])


def test_a_reconstruction_is_named_everywhere(tmp_path: Path) -> None:
    made = flight("reconstruction", metadata={"reconstruction": "from printed figures"})
    follows = flight("simulated", metadata={"reconstruction": "controls from printed figures"})
    found = compare(made, follows, names=["trial.csv", "sim.csv"])
    assert found.origin == "reconstruction"
    assert "trial.csv (reconstruction: from printed figures)" in found.text()
    assert "sim.csv (simulated, made with a reconstruction: controls from printed figures)" in found.text()
    origins = found.document()["origins"]
    assert origins["measured"] == {
        "name": "trial.csv", "origin": "reconstruction", "reconstruction": "from printed figures",
    }  # fmt: skip
    assert found.document()["channels"]["depth"]["origins"] == {"measured": "reconstruction", "simulated": "simulated"}
    for ending in ("csv", "json", "svg"):
        write(found, tmp_path / f"out.{ending}", provenance={})
        assert "controls from printed figures" in (tmp_path / f"out.{ending}").read_text()
    assert "reconstruction" in (tmp_path / "out.csv-metadata.json").read_text()
    assert compare(flight(), flight("simulated")).origin == "simulated"


def test_messages_and_overlays_do_not_call_a_simulated_first_log_measured() -> None:
    first, second = flight("simulated"), flight("simulated", depth=1.0)
    found = compare(first, second)
    assert found.measured.name == "first"
    assert compare(flight(), second).measured.name == "measured"
    (beside,) = overlay(found, {}).beside
    assert beside.metadata["comparison_note"].startswith(
        "errors are simulated less the first log at times of the first"
    )
    (beside,) = overlay(compare(flight(), second), {}).beside
    assert beside.metadata["comparison_note"].startswith("errors are simulated less measured at measured times, not")
    with pytest.raises(InputError, match="the first log has no position"):
        compare(first, second, align="gps")
    apart = log(np.array([-500.0, 5000.0]), "simulated", depth=np.zeros(2))
    with pytest.raises(InputError, match="every sample of the first log lies outside or in a gap of more than 60 s"):
        compare(first, apart)


def test_the_csv(tmp_path: Path) -> None:
    found = compare(flight(), flight("simulated", depth=2.0))
    write(found, tmp_path / "errors.csv", provenance={"program": "x"})
    with (tmp_path / "errors.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    parts = ("flight", "dive", "climb", "0-100 m", "100-200 m", "200-300 m")
    apogee = {("300-400 m", name) for name in ("depth", "pitch", "heading")}
    assert {(row["phase"], row["channel"]) for row in rows} - apogee == {
        (part, name) for part in parts for name in ("depth", "pitch", "heading")
    }
    assert float(rows[0]["bias"]) == found.document()["channels"]["depth"]["bias"]
    assert json.loads((tmp_path / "errors.csv-metadata.json").read_text())["program"] == "x"


def test_the_csv_of_facts(tmp_path: Path) -> None:
    facts = read_facts(Path(__file__).with_name("trial.toml"))
    write(compare(facts, flight("simulated")), tmp_path / "facts.csv", provenance={})
    with (tmp_path / "facts.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["name"] for row in rows] == [fact.name for fact in facts.facts]
    assert rows[0]["verdict"] == "disagrees"  # 300 m against 800 m
    assert rows[3]["simulated"] == ""


def test_outputs_that_cannot_be_written(tmp_path: Path) -> None:
    found = compare(flight(), flight("simulated"))
    with pytest.raises(OutputError, match=r"allowed: \.csv \.json \.png \.svg \.pdf"):
        write(found, tmp_path / "report.docx", provenance={})
    (tmp_path / "errors.csv").write_text("kept")
    with pytest.raises(OutputError, match="exists"):
        write(found, tmp_path / "errors.csv", provenance={})
    assert (tmp_path / "errors.csv").read_text() == "kept"
    assert [path.name for path in tmp_path.iterdir()] == ["errors.csv"]
    write(found, tmp_path / "errors.csv", provenance={}, force=True)
    assert (tmp_path / "errors.csv").read_text() != "kept"


def test_a_channel_without_a_comparable_sample_stays_with_its_counts() -> None:
    simulated = flight("simulated").with_channels(channel("pitch", T + 1e5, 0.0 * T, "simulated"))
    found = compare(flight(), simulated).document()["channels"]["pitch"]
    assert (found["n"], found["rmse"], found["skipped"]) == (0, None, {"outside": len(T), "gap": 0})


def test_channels_counted_from_different_zeros_are_said(tmp_path: Path) -> None:
    measured = flight(metadata={"depth_zero": "the rail"})
    found = compare(measured, flight("simulated"))
    (note,) = found.document()["notes"]
    assert "depth is counted from different zeros (measured: the rail)" in note
    assert note in found.text()
    assert compare(measured, flight("simulated", metadata={"depth_zero": "the rail"})).document()["notes"] == []
    write(found, tmp_path / "errors.csv", provenance={})
    assert json.loads((tmp_path / "errors.csv-metadata.json").read_text())["notes"] == [note]


def test_all_outputs_appear_or_none(tmp_path: Path) -> None:
    (tmp_path / "figure.png").mkdir()
    found = compare(flight(), flight("simulated"))
    with pytest.raises(OutputError, match=r"figure\.png"):
        write(found, tmp_path / "a.csv", tmp_path / "figure.png", provenance={}, force=True)
    assert [path.name for path in tmp_path.iterdir()] == ["figure.png"]
