"""What a glider measured becomes casts and current profiles; held against analytic water, gsw and plain numpy."""

from __future__ import annotations

import gsw
import numpy as np
import pytest

from glidercli.errors import InputError
from glidercli.log import Channel, Log
from glidercli.logio import read
from glidercli.ocean.bins import by_bins, depth_at, turns
from glidercli.ocean.from_log import casts_of_log, currents_of_log
from glidercli.ocean.gathering import gathered_casts

START = 1_600_000_000_000_000_000
SECOND = 1_000_000_000


def temperature(z):
    return 4.0 + 16.0 * np.exp(-np.asarray(z) / 60.0)


def salinity(z):
    return 35.0 + 0.5 * np.tanh((np.asarray(z) - 50.0) / 40.0)


def sawtooth(t, period=2000.0, deepest=100.0):
    """Depth, m, of a glider that goes down and up again in a period, s."""
    phase = (t / period) % 1.0
    return deepest * (1.0 - np.abs(2.0 * phase - 1.0))


def log_of(times, origin="measured", metadata=None, **values):
    """A log of channels that share their times, s; a pair (times, values) has its own."""
    channels = {}
    for name, given in values.items():
        own, column = given if isinstance(given, tuple) else (times, given)
        ns = START + (np.asarray(own) * SECOND).astype(np.int64)
        channels[name] = Channel(name, ns, np.asarray(column, dtype=float))
    return Log(channels, origin, {"source": "dive.log", **(metadata or {})})


@pytest.fixture
def dives():
    """Two dives to 100 m in water that is known, a sample in 4 s: 0.4 m."""
    t = np.arange(0.0, 4000.0, 4.0)
    z = sawtooth(t)
    return log_of(
        t, depth=z, temperature=temperature(z), salinity=salinity(z), latitude=20.0 + 0 * t, longitude=-30.0 + 0 * t
    )


def test_every_descent_and_ascent_is_a_cast_at_its_mid_time(dives):
    casts = casts_of_log(dives)
    assert len(casts) == 4
    # 2 or 3 samples share a bin, so that the mean of bins is not that of times to the second
    assert [cast.moment.seconds - START / 1e9 for cast in casts] == pytest.approx(
        [500.0, 1500.0, 2500.0, 3500.0], abs=5.0
    )
    assert all(cast.moment.is_utc for cast in casts)
    assert sum(cast.records for cast in casts) == 1000
    assert "4 descents and ascents by depth: 1000 samples in" in " ".join(casts[0].warnings)


def test_the_water_is_that_which_was_flown_through(dives):
    for cast in casts_of_log(dives):
        assert (np.diff(cast.depth) > 0.0).all()
        # medians of 2 or 3 samples 0.4 m apart: half a step times the gradient, 0.27 degC/m, times the curvature's share
        assert cast.temperature == pytest.approx(temperature(cast.depth), abs=1e-3)
        p = gsw.p_from_z(-cast.depth, 20.0)
        SA = gsw.SA_from_SP(salinity(cast.depth), p, -30.0, 20.0)
        expected = gsw.rho_t_exact(SA, temperature(cast.depth), p)
        assert cast.density == pytest.approx(expected, abs=3e-3)  # 75 terms or exact, and the medians


def test_bins_of_one_sample_are_that_sample():
    depth, columns = by_bins(np.array([7.5, 1.25, 3.0]), np.array([[70.0, 10.0, 30.0]]))
    assert depth.tolist() == [1.25, 3.0, 7.5]
    assert columns.tolist() == [[10.0, 30.0, 70.0]]


def test_medians_are_numpys():
    rng = np.random.default_rng(1)
    z, values = rng.uniform(0.0, 30.0, 400), rng.normal(size=(2, 400))
    depth, columns = by_bins(z, values)
    for i, b in enumerate(np.unique(np.floor(z))):
        inside = np.floor(z) == b
        assert depth[i] == np.median(z[inside])
        assert columns[:, i].tolist() == np.median(values[:, inside], axis=1).tolist()


def test_turns_are_found_through_noise_and_not_in_it():
    t = np.arange(0.0, 8000.0, 1.0)
    noisy = sawtooth(t) + np.random.default_rng(2).normal(0.0, 0.5, len(t))
    found = turns(noisy)
    assert len(found) == 9
    assert found[1:-1] == pytest.approx(np.arange(1000, 8000, 1000), abs=60)  # 3 sigma of noise are 15 s of the slope
    assert turns(np.random.default_rng(3).normal(2.0, 0.6, 1000)).tolist() == [0, 1000]  # drifting at the surface
    assert turns([3.0]).tolist() == [0, 1]
    assert turns([5.0, 5.0, 5.0]).tolist() == [0, 3]
    assert turns([0, 10, 20, 20, 3, 2, 9, 9, 1]).tolist() == [0, 2, 5, 6, 9]


def test_depth_is_not_made_up_across_gaps_and_ends():
    known = START + np.array([0, 60, 300]) * SECOND
    asked = START + np.array([-1, 0, 30, 60, 61, 299, 300, 301]) * SECOND
    found = depth_at(asked, known, np.array([0.0, 6.0, 30.0]))
    assert found.tolist()[1:4] == [0.0, 3.0, 6.0]
    assert np.isnan(found[[0, 4, 5, 7]]).all()
    assert found[6] == 30.0


def test_what_cannot_be_used_is_left_out_and_counted(dives):
    t = np.arange(0.0, 4000.0, 4.0)
    s = salinity(sawtooth(t))
    s[10:13] = 60.0
    temp = np.delete(temperature(sawtooth(t)), np.arange(100, 105))
    log = log_of(t, depth=sawtooth(t), temperature=(np.delete(t, np.arange(100, 105)), temp), salinity=s)
    casts = casts_of_log(log, 20.0, -30.0)
    assert dict(casts[0].dropped)["salinity outside 0..45"] == 3
    assert dict(casts[0].dropped)["without temperature"] == 5
    assert sum(cast.records for cast in casts) == 1000
    assert "8 of 1000 samples left out: 5 without temperature, 3 salinity outside 0..45" in casts[0].warnings


def test_conductivity_serves_for_salinity_and_pressure_for_depth():
    t = np.arange(0.0, 1000.0, 4.0)
    z = sawtooth(t)
    p = gsw.p_from_z(-z, 20.0)
    C = gsw.C_from_SP(salinity(z), temperature(z), p) / 10.0
    C[0] = 3e-4  # in air
    (cast,) = casts_of_log(log_of(t, pressure=p * 1e4, temperature=temperature(z), conductivity=C), 20.0, -30.0)
    assert dict(cast.dropped)["in air"] == 1
    assert cast.depth[-1] == pytest.approx(z.max(), abs=0.5)  # the last bin is half a metre wide
    assert cast.salinity == pytest.approx(salinity(cast.depth), abs=2e-3)  # medians of T and C apart
    assert any("pressure" in line for line in cast.warnings)


def test_a_simulated_flight_gives_its_density():
    t = np.arange(0.0, 1000.0, 4.0)
    z = sawtooth(t)
    (cast,) = casts_of_log(log_of(t, depth=z, density=1025.0 + 0.01 * z, origin="simulated"))
    assert cast.density == pytest.approx(1025.0 + 0.01 * cast.depth, abs=1e-9)
    assert cast.temperature is None
    assert not cast.reconstructed
    (remade,) = casts_of_log(log_of(t, depth=z, density=1025.0 + 0.01 * z, metadata={"reconstruction": "why"}))
    assert remade.reconstructed


def test_overturning_water_is_doubted_once(dives):
    t = np.arange(0.0, 4000.0, 4.0)
    casts = casts_of_log(log_of(t, depth=sawtooth(t), density=1026.0 - 0.01 * sawtooth(t)))
    assert sum("overturn" in line for cast in casts for line in cast.warnings) == 1
    assert "in 4 of 4 profiles" in " ".join(casts[0].warnings)


def test_climbs_alone_are_profiles_too():
    t = np.arange(0.0, 4000.0, 4.0)
    z = sawtooth(t)
    up = (t % 2000.0) > 1000.0
    log = log_of(t, depth=z, temperature=(t[up], temperature(z[up])), salinity=(t[up], salinity(z[up])))
    casts = casts_of_log(log, 20.0, -30.0)
    assert len(casts) == 2
    assert [cast.moment.seconds - START / 1e9 for cast in casts] == pytest.approx([1500.0, 3500.0], abs=5.0)


def test_a_log_without_dates_counts_from_its_first_depth():
    t = np.arange(0.0, 4000.0, 4.0)
    z = sawtooth(t)
    log = log_of(t + 1000.0, depth=z, density=1025.0 + 0.01 * z, metadata={"time_note": "elapsed only"})
    assert [cast.moment.seconds for cast in casts_of_log(log)] == pytest.approx(
        [500.0, 1500.0, 2500.0, 3500.0], abs=5.0
    )
    assert len(gathered_casts([log], start_ns=None)) == 4


def test_in_a_flight_without_a_start_the_first_deep_profile_holds():
    t = np.arange(0.0, 3000.0, 4.0)
    z = np.where(t < 1000.0, sawtooth(t, 1000.0, 20.0), sawtooth(t - 1000.0))
    (cast,) = gathered_casts([log_of(t, depth=z, density=1025.0 + 0.01 * z)])
    assert cast.moment is None
    assert cast.depth[-1] > 99.0
    assert "no start time" in cast.warnings[0]
    assert len(gathered_casts([log_of(t, depth=z, density=1025.0 + 0.01 * z)], start_ns=START)) == 4


@pytest.mark.parametrize(
    ("channels", "message"),
    [
        ({"depth": 5.0, "temperature": 5.0}, "needed are temperature with salinity"),
        ({"density": 1025.0}, "neither depth nor pressure"),
        ({"pitch": 0.0}, "neither depth nor pressure"),
        ({"depth": 5.0, "density": 1025.0}, "no descent or ascent of two bins among 10 samples"),
        ({"depth": 5.0, "density": 0.0}, "10 density outside 990..1100 kg/m3"),
    ],
)
def test_logs_that_have_no_water(channels, message):
    t = np.arange(10.0)
    with pytest.raises(InputError, match=message) as caught:
        casts_of_log(log_of(t, **{name: np.full(10, value) for name, value in channels.items()}))
    assert str(caught.value).startswith("dive.log: ")


# Currents ------------------------------------------------------------------------------------------------------------


def test_current_by_depth_is_recovered():
    t = np.arange(0.0, 4000.0, 40.0)  # a solution each 4 m, as an inversion gives
    dense = np.arange(0.0, 4000.0, 5.0)
    east, north = 0.3 * np.exp(-sawtooth(t) / 50.0), 0.002 * sawtooth(t)
    east[7] = 9.0
    log = log_of(t, depth=(dense, sawtooth(dense)), current_east=east, current_north=north)
    profiles = currents_of_log(log)
    assert len(profiles) == 4
    for profile in profiles:
        assert profile.east == pytest.approx(0.3 * np.exp(-profile.depth / 50.0), abs=1e-9)  # a bin holds one sample
        assert profile.north == pytest.approx(0.002 * profile.depth, abs=1e-9)
        assert not profile.up.any()
    assert sum(profile.records for profile in profiles) == 100
    assert dict(profiles[0].dropped) == {"faster than 5 m/s": 1}


def test_a_mean_current_of_a_dive_is_no_profile():
    t = np.arange(0.0, 2000.0, 4.0)
    log = log_of(t, depth=sawtooth(t), current_east=([1000.0], [0.1]), current_north=([1000.0], [0.1]))
    with pytest.raises(InputError, match="no descent or ascent of two bins among 1 samples: 1 in a descent"):
        currents_of_log(log)
    with pytest.raises(InputError, match="has no current_north; needed are both"):
        currents_of_log(log_of(t, depth=sawtooth(t), current_east=0 * t))


# A real log ----------------------------------------------------------------------------------------------------------


def test_the_dives_of_a_seaexplorer(pytestconfig):
    log = read([pytestconfig.rootpath / "logs/seaexplorer-sea035"]).log
    casts = casts_of_log(log)
    assert sum(cast.records for cast in casts) == 719  # samples of temperature
    deep = [cast for cast in casts if cast.depth[-1] > 600.0]
    assert len(deep) == 4
    # its own samples, by time alone: a dive of 700 m lasts more than an hour, and the water of the same place at the
    # same depth differs by less than 0.5 degC below the thermocline
    t, p = log["temperature"], log["pressure"]
    assert np.array_equal(t.time_ns, p.time_ns)
    z = -gsw.z_from_p(p.values / 1e4, 48.9)
    below = z > 300.0
    for cast in deep:
        apart = np.interp(z[below], cast.depth, cast.temperature) - t.values[below]
        assert np.abs(apart).max() < 0.5


def test_casts_of_a_log_that_crosses_180_degrees_are_there() -> None:
    n = 400
    times = np.arange(n) * 10 * 10**9
    depth = 100.0 * (1.0 - np.abs(np.linspace(-1.0, 1.0, n)))
    columns = {"depth": depth, "temperature": np.full(n, 10.0), "salinity": np.full(n, 35.0)}
    channels = {name: Channel(name, times, values) for name, values in columns.items()}
    fixed = times[[0, 100, 300, 399]]
    channels["latitude"] = Channel("latitude", fixed, np.full(4, -20.0))
    channels["longitude"] = Channel("longitude", fixed, np.array([179.9, -179.9, 179.9, -179.9]))
    for cast in casts_of_log(Log(channels, "measured")):
        assert abs(cast.longitude) == pytest.approx(180.0, abs=0.11)
