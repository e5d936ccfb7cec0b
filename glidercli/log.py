"""What is a flight, simulated or real? A Log: named channels, each with its own sample times, events and metadata.

A channel holds finite values only, at strictly increasing times: what is missing is absent, never NaN. A table
(pandas) is one view of a Log: its rows are the union of the sample times and a channel is empty where it has none;
nothing is interpolated.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import CHANNELS, PHASES
from glidercli.errors import InputError

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["Channel", "Event", "Log", "Origin"]

Origin = Literal["measured", "derived", "simulated", "reconstruction"]
"""Where values come from. derived: computed from measured ones, such as a dead-reckoned track."""


@dataclasses.dataclass(frozen=True)
class Channel:
    """Samples of one quantity.

    time_ns : (n,) int64, UTC nanoseconds since 1970, strictly increasing.
    values : (n,) float64, finite, in the SI unit of CHANNELS[name].
    origin : where the values come from.
    """

    name: str
    time_ns: NDArray[np.int64]
    values: NDArray[np.float64]
    origin: Origin = "measured"

    def __post_init__(self) -> None:
        time_ns = np.ascontiguousarray(self.time_ns, dtype=np.int64)
        values = np.ascontiguousarray(self.values, dtype=np.float64)
        if self.name not in CHANNELS:
            raise InputError(self.name, f"is no channel; channels are {', '.join(CHANNELS)}")
        if time_ns.ndim != 1 or time_ns.shape != values.shape:
            raise InputError(self.name, f"has {time_ns.shape} times for {values.shape} values; one each is needed")
        if not np.isfinite(values).all():
            raise InputError(self.name, "holds a value that is not finite; missing samples must be left out")
        if (np.diff(time_ns) <= 0).any():
            raise InputError(self.name, "has times that do not increase")
        object.__setattr__(self, "time_ns", time_ns)
        object.__setattr__(self, "values", values)

    def __len__(self) -> int:
        return len(self.values)

    def sliced(self, start_ns: int | None, end_ns: int | None) -> Channel:
        """The samples with start_ns <= time < end_ns."""
        first = 0 if start_ns is None else int(np.searchsorted(self.time_ns, start_ns))
        last = len(self) if end_ns is None else int(np.searchsorted(self.time_ns, end_ns))
        return dataclasses.replace(self, time_ns=self.time_ns[first:last], values=self.values[first:last])


@dataclasses.dataclass(frozen=True)
class Event:
    """Something that happened at one time: apogee, surfacing, a GPS fix; depth in m, or None where unknown."""

    name: str
    time_ns: int
    depth: float | None = None


@dataclasses.dataclass(frozen=True)
class Log:
    """A flight.

    channels : by name, each with its own times.
    origin : of the log as a whole; "measured" for a recording, some channels of which may be derived.
    metadata : short texts by key; "provenance" is JSON (see provenance.py), others are for people.
    events : in time order.
    """

    channels: Mapping[str, Channel]
    origin: Origin
    metadata: Mapping[str, str] = dataclasses.field(default_factory=dict)
    events: tuple[Event, ...] = ()

    def __getitem__(self, name: str) -> Channel:
        return self.channels[name]

    def __contains__(self, name: object) -> bool:
        return name in self.channels

    @property
    def kind(self) -> str:
        """What the log is, in capitals: MEASURED, DERIVED, SIMULATED, ... FROM A RECONSTRUCTION, RECONSTRUCTION."""
        remade = self.origin != "reconstruction" and "reconstruction" in self.metadata
        return self.origin.upper() + (" FROM A RECONSTRUCTION" if remade else "")

    @property
    def start_ns(self) -> int:
        """Time of the first sample of any channel."""
        return min(int(channel.time_ns[0]) for channel in self.channels.values() if len(channel))

    @property
    def end_ns(self) -> int:
        """Time of the last sample of any channel."""
        return max(int(channel.time_ns[-1]) for channel in self.channels.values() if len(channel))

    def together(self, *names: str) -> tuple[NDArray[np.int64], list[NDArray[np.float64]]]:
        """The times at which all these channels have a sample, and the values there; empty where there is none."""
        if not all(name in self for name in names):
            return np.array([], np.int64), [np.array([]) for _ in names]
        times = self[names[0]].time_ns
        for name in names[1:]:
            if times is not self[name].time_ns and not np.array_equal(times, self[name].time_ns):
                times = np.intersect1d(times, self[name].time_ns, assume_unique=True)
        return times, [
            channel.values if channel.time_ns is times else channel.values[np.searchsorted(channel.time_ns, times)]
            for channel in (self[name] for name in names)
        ]

    def number(self, key: str) -> float | None:
        """A number told by the metadata, or None where it is missing, not finite or no number."""
        try:
            value = float(self.metadata[key])
        except (KeyError, ValueError):
            return None
        return value if math.isfinite(value) else None

    @property
    def place(self) -> tuple[float, float] | None:
        """Latitude and longitude, deg, of what north and east are counted from; None where they are unknown."""
        latitude, longitude = self.number("origin_latitude_deg"), self.number("origin_longitude_deg")
        if latitude is None or longitude is None or not abs(latitude) <= 90.0 or not abs(longitude) <= 360.0:
            return None
        return latitude, longitude

    def with_channels(self, *channels: Channel) -> Log:
        """This log with these channels added or replaced."""
        return dataclasses.replace(self, channels={**self.channels, **{c.name: c for c in channels}})

    def with_metadata(self, **entries: str) -> Log:
        """This log with these metadata added or replaced."""
        return dataclasses.replace(self, metadata={**self.metadata, **entries})

    def sliced(self, start_ns: int | None, end_ns: int | None) -> Log:
        """The part with start_ns <= time < end_ns; channels without a sample there are left out."""
        parts = {name: channel.sliced(start_ns, end_ns) for name, channel in self.channels.items()}
        events = tuple(
            e for e in self.events
            if (start_ns is None or e.time_ns >= start_ns) and (end_ns is None or e.time_ns < end_ns)
        )  # fmt: skip
        return dataclasses.replace(self, channels={n: c for n, c in parts.items() if len(c)}, events=events)

    def shifted(self, by_ns: int) -> Log:
        """This log with by_ns, ns, added to every time."""
        if by_ns == 0:
            return self
        channels = {name: dataclasses.replace(c, time_ns=c.time_ns + by_ns) for name, c in self.channels.items()}
        events = tuple(dataclasses.replace(event, time_ns=event.time_ns + by_ns) for event in self.events)
        return dataclasses.replace(self, channels=channels, events=events)

    def pieces(self, samples: int) -> Iterator[Log]:
        """The log cut in time, each piece with at most so many samples of any channel; all have the same channels."""
        times = [channel.time_ns for channel in self.channels.values()]
        start_ns: int | None = None
        while True:
            ends = [samples + (0 if start_ns is None else int(np.searchsorted(t, start_ns))) for t in times]
            end_ns = min((int(t[end]) for t, end in zip(times, ends, strict=True) if end < len(t)), default=None)
            parts = {name: channel.sliced(start_ns, end_ns) for name, channel in self.channels.items()}
            yield dataclasses.replace(self, channels=parts)
            if end_ns is None:
                return
            start_ns = end_ns

    def table(self, zero_ns: int | None = None) -> pd.DataFrame:
        """All channels as a table in the contract's names and units.

        First column time_utc (datetime64[ns], UTC without zone), second elapsed_s; rows at the union of all sample
        times, NaN (empty in CSV) where a channel has no sample.

        zero_ns : where elapsed_s counts from, of a log that is a piece of another; default: the first row. Channels
        without a sample are left out, unless the log is such a piece.
        """
        import pandas as pd

        kept = [channel for channel in self.channels.values() if len(channel) or zero_ns is not None]
        time_ns = np.unique(np.concatenate([channel.time_ns for channel in kept])) if kept else np.array([], np.int64)
        zero = zero_ns if zero_ns is not None else time_ns[0] if len(time_ns) else 0
        columns: dict[str, object] = {
            "time_utc": time_ns.astype("datetime64[ns]"),
            "elapsed_s": (time_ns - zero) / 1e9,
        }
        for channel in kept:
            spec = CHANNELS[channel.name]
            column = np.full(len(time_ns), np.nan)
            rows = np.searchsorted(time_ns, channel.time_ns)
            column[rows] = channel.values * spec.factor
            if channel.name == "phase":
                words = np.full(len(time_ns), None, dtype=object)
                words[rows] = np.array(PHASES, dtype=object)[channel.values.astype(int)]
                columns[spec.column] = words
            else:
                columns[spec.column] = column
        return pd.DataFrame(columns)
