"""What Logs may there be? Random ones for round trips, absurd ones, and what it means that one came back."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from glidercli.channels import CHANNELS, PHASES
from glidercli.log import Channel, Event, Log
from glidercli.logio.plausible import quantity_of

SPECIAL = [0.0, -0.0, 5e-324, -2.2e-310, 1e300, -1e300, 9.969209968386869e36, -9999.0, 1.0 / 3.0]
FINITE = st.sampled_from(SPECIAL) | st.floats(allow_nan=False, allow_infinity=False, max_value=1e300, min_value=-1e300)
TIMES = st.integers(-(2**62), 2**62)
"""1823 to 2116, before 1970 too."""
AFTER_1970 = st.integers(0, int(np.datetime64("2200-01-01", "ns").astype(np.int64)) - 1)
ORIGINS = st.sampled_from(["measured", "derived", "simulated", "reconstruction"])
KEYS = st.sampled_from(["title", "provenance", "platform", "vehicle_reference"]) | st.text(max_size=5)
TEXTS = st.sampled_from(
    ["\x00", "a\nb\r\x1b[0m", "{}", '{"b": 1, "a": [2.50]}', '"text"', "null", "𝛼 ☃\u2028"]
) | st.text(max_size=9)


def possible(name: str) -> st.SearchStrategy[float]:
    """Values of a channel that a reader takes, the ends of its range among them."""
    if name == "phase":
        return st.integers(0, len(PHASES) - 1).map(float)
    low, high = quantity_of(name).low, quantity_of(name).high
    special = [value for value in SPECIAL if low <= value <= high]
    return st.sampled_from([low, high, *special]) | st.floats(low, high, allow_nan=False)


@st.composite
def logs(draw: st.DrawFn, times: st.SearchStrategy[int] = TIMES, sampled: bool = False, absurd: bool = False) -> Log:
    """Channels with times of their own out of a few, some shared. sampled : every channel has a sample.

    absurd : values may be any finite number, not those alone that a channel can have.
    """
    pool = draw(st.lists(times, min_size=1, max_size=8, unique=True))
    channels = {}
    for name in draw(st.lists(st.sampled_from(list(CHANNELS)), unique=True, max_size=8)):
        values = FINITE if absurd and name != "phase" else possible(name)
        samples = draw(st.dictionaries(st.sampled_from(pool), values, min_size=int(sampled), max_size=8))
        at = np.array(sorted(samples), np.int64)
        channels[name] = Channel(name, at, np.array([samples[t] for t in at.tolist()]), draw(ORIGINS))
    events = draw(st.lists(st.builds(Event, st.text(max_size=8), times, st.none() | FINITE), max_size=4))
    metadata = draw(st.dictionaries(KEYS, TEXTS, max_size=4))
    return Log(channels, draw(ORIGINS), metadata, tuple(sorted(events, key=lambda event: event.time_ns)))


def assert_same(back: Log, log: Log) -> None:
    """Equal to the last bit."""
    assert list(back.channels) == list(log.channels)
    for name, channel in log.channels.items():
        assert back[name].time_ns.tobytes() == channel.time_ns.tobytes(), name
        assert back[name].values.tobytes() == channel.values.tobytes(), name  # bytes: -0.0 is not 0.0
        assert back[name].origin == channel.origin, name
    assert (back.origin, back.metadata, back.events) == (log.origin, dict(log.metadata), log.events)


def assert_near(back: Log, log: Log) -> None:
    """Equal but for what a table in degrees, cm3 and dbar rounds away."""
    assert list(back.channels) == list(log.channels)
    for name, channel in log.channels.items():
        assert back[name].time_ns.tobytes() == channel.time_ns.tobytes(), name
        factor = CHANNELS[name].factor
        # a product and a quotient round by half a last place each; of numbers below the least normal one (5e-324 apart)
        # as many bits are lost as the factor shifts out
        near = {"rtol": 0.0, "atol": 0.0} if factor == 1.0 else {"rtol": 4.5e-16, "atol": 5e-324 * (2.0 + 1.0 / factor)}
        np.testing.assert_allclose(back[name].values, channel.values, **near)
        assert back[name].origin == channel.origin, name
    assert (back.origin, back.metadata, back.events) == (log.origin, dict(log.metadata), log.events)
