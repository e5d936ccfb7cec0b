import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from glidercli.ocean.downcast import Samples, downcast


def recorded(pressure, **changed):
    """Samples of plain sea water at these pressures, with some arrays changed."""
    p = np.asarray(pressure, dtype=float)
    arrays = {
        "pressure_dbar": p,
        "temperature": np.full(len(p), 10.0),
        "salinity": np.full(len(p), 35.0),
        "flagged": np.zeros(len(p), dtype=bool),
        "conductivity": None,
        "second_temperature": None,
        "second_salinity": None,
    }
    return Samples(**{**arrays, **{name: np.asarray(values) for name, values in changed.items()}})


def kept(pressure, **changed):
    index, dropped, _ = downcast(recorded(pressure, **changed))
    return np.asarray(pressure)[index].tolist(), dict(dropped)


def test_the_last_descent_is_taken_and_the_rest_counted():
    # soak to 10 dbar, back to the surface, down with one heave, up
    pressure = [1, 5, 10, 6, 2, 4, 6, 8, 7, 8, 9, 12, 15, 12, 8, 3]
    profile, dropped = kept(pressure)
    assert profile == [1, 2, 4, 6, 7, 8, 9, 12, 15]
    assert dropped == {"upcast": 3, "pressure reversal": 4}


def test_equal_pressures_leave_one():
    profile, dropped = kept([1, 2, 2, 2, 3])
    assert profile == [1, 2, 3]
    assert dropped == {"duplicate pressure": 2}


@pytest.mark.parametrize("place", [0, 1, 37, 98, 99])
def test_a_pressure_spike_is_dropped_wherever_it_stands(place):
    pressure = np.arange(1.0, 101.0)
    pressure[place] = 7590.0
    profile, dropped = kept(pressure)
    assert dropped == {"pressure spike": 1}
    assert profile == [p for i, p in enumerate(np.arange(1.0, 101.0)) if i != place]


def test_a_gap_or_a_coarse_turn_is_no_spike():
    assert kept([1, 2, 3, 4, 5, 6, 60, 61, 62, 63, 64, 65, 66])[1] == {}
    assert kept([0, 100, 200, 300, 400, 300, 200, 100])[1] == {"upcast": 3}


def test_impossible_values_are_dropped_by_reason():
    temperature, salinity = np.full(8, 10.0), np.full(8, 35.0)
    temperature[1], temperature[2], salinity[3], salinity[4] = 98.4, np.nan, 102.5, -0.1
    flagged = np.arange(8) == 5
    profile, dropped = kept([1, 2, 3, 4, 5, 6, -0.3, 8], temperature=temperature, salinity=salinity, flagged=flagged)
    assert profile == [1, 8]
    assert dropped == {
        "bad flag": 1,
        "missing value": 1,
        "pressure outside 0..12000 dbar": 1,
        "temperature outside -3..45 degC": 1,
        "salinity outside 0..45": 2,
    }


def test_air_and_the_filling_cell_are_dropped():
    conductivity = [0.0003, 0.0003, 0.4, 1.4, 3.15, 3.17, 3.2]  # S/m, as press-pass-prDE.cnv enters the water
    profile, dropped = kept([0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6], conductivity=conductivity)
    assert profile == [0.4, 0.5, 0.6]
    assert dropped == {"in air, or the cell filling": 4}


def test_sensors_that_contradict_each_other():
    second = np.array([10.0, 10.0, 10.0, 11.0, 10.0])
    profile, dropped = kept([1, 2, 3, 4, 5], second_temperature=second)
    assert profile == [1, 2, 3, 5]
    assert sum(dropped.values()) == 1
    index, _, warnings = downcast(recorded([1, 2, 3, 4, 5], second_salinity=np.zeros(5)))
    assert len(index) == 5  # most of the cast: no telling which pair is wrong
    assert "in 5 of 5 samples; the first pair is used" in warnings[0]


@given(st.lists(st.floats(-5.0, 13000.0) | st.just(np.nan), min_size=1, max_size=60))
def test_every_sample_is_kept_or_counted_and_pressure_increases(pressure):
    index, dropped, _ = downcast(recorded(pressure))
    assert len(index) + sum(count for _, count in dropped) == len(pressure)
    assert (np.diff(np.asarray(pressure)[index]) > 0.0).all()
