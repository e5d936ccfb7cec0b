"""Which Logs must viewers take? Simulated, one of each family of vehicles, one with hostile texts, and hardly any."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from glidercli.channels import CHANNELS, PHASES
from glidercli.log import Channel, Event, Log
from glidercli.logio import read
from glidercli.logio.plausible import quantity_of
from glidercli.simulation import simulate

ROOT = Path(__file__).parents[2]
START = 1_313_000_000_123_456_789
HOSTILE = [
    "", "\x00\x01\x1b[31mred\x1b[0m", "a\nb\r\nc\u2028d", "<script>alert(1)</script>", "../../etc/passwd", "%s%n{}$(id)",
    '"; DROP TABLE events; --', "\u202eabc\u202c", "𝛼 ☃ \U0010ffff", "x" * 70_000,
]  # fmt: skip
"""Texts that break what pastes them: control codes, markup, paths, right-to-left, the last code point, a long one."""


def mission() -> Log:
    return simulate("sawtooth-transect", every=20.0).log


def seaexplorer() -> Log:
    return read([ROOT / "logs" / "seaexplorer-sea035"]).log


def slocum() -> Log:
    return read([ROOT / "logs" / "slocum-comet-2019"]).log


def seaglider() -> Log:
    return read([ROOT / "logs" / "seaglider-sg561"]).log


def full(n: int = 400) -> Log:
    """Every channel, at times that are a second and some nanoseconds apart."""
    times = START + np.cumsum(1_000_000_000 + np.arange(n) % 3)
    random = np.random.default_rng(5)
    values = {}
    for name in CHANNELS:
        low, high = (
            max(quantity_of(name).low, -1000.0),
            min(quantity_of(name).high, 1000.0 if name != "density" else 1200.0),
        )
        values[name] = random.uniform(low, high, size=n)
    values |= {"depth": 100.0 - 100.0 * np.cos(np.arange(n) / 40.0), "phase": (np.arange(n) // 99 % len(PHASES)) * 1.0}
    values |= {"latitude": 20.0 + 1e-5 * np.arange(n), "longitude": 115.0 - 1e-5 * np.arange(n)}
    values |= {"down": values["depth"] - 1.0}
    channels = {name: Channel(name, times, values[name], "simulated") for name in CHANNELS}
    events = (Event("apogee", int(times[n // 2]), 200.0), Event("surfaced", int(times[-1])))
    return Log(channels, "simulated", {"title": "every channel"}, events)


def hostile() -> Log:
    log = full(50)
    times = log["depth"].time_ns
    events = tuple(Event(text, int(times[i]), None) for i, text in enumerate(HOSTILE))
    metadata = {text[:300]: text for text in HOSTILE} | {"reconstruction": HOSTILE[1], "track_note": HOSTILE[3]}
    metadata |= {"hull_length_m": "nan", "hull_diameter_m": HOSTILE[5], "origin_latitude_deg": "1e400"}
    return Log(log.channels, "measured", metadata, events)


def events_alone() -> Log:
    return Log(
        {}, "measured", {"title": "nothing but events"}, (Event("fix", START, None), Event("dive", START + 1, 0.0))
    )


def one_sample() -> Log:
    return Log({"depth": Channel("depth", np.array([START]), np.array([12.5]), "measured")}, "measured")


LOGS: dict[str, Callable[[], Log]] = {
    log.__name__: log for log in (mission, seaexplorer, slocum, seaglider, full, hostile, events_alone, one_sample)
}
