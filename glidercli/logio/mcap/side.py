"""Which of the flights in a file is it? Its topics, frames, messages and colour; a flight alone needs none of that."""

from __future__ import annotations

import dataclasses

from glidercli.log import Channel, Log
from glidercli.logio.mcap.primitives import Colour
from glidercli.places import geodetic_of_track, track_of_geodetic

__all__ = ["ALONE", "Side"]

_WAYS = ("north", "east")


@dataclasses.dataclass(frozen=True)
class Side:
    """One of the flights in a file.

    place : what stands before the names of its topics, such as /beside/1; "" of the flight that the file is read back
    as. name : what to call it, in words. colour : of its hull and track; None where it is alone. about : latitude and
    longitude, deg, that it is drawn about; None: the origin of its own.
    """

    place: str = ""
    name: str = ""
    colour: Colour | None = None
    about: tuple[float, float] | None = None

    @property
    def package(self) -> str:
        """Of glider's own messages. One that is not "glider" keeps them out of what is read back, in any version."""
        return self.place.strip("/").replace("/", "_") or "glider"

    def frame(self, name: str) -> str:
        """Its own frame of that kind."""
        return f"{self.package}/{name}" if self.place else name

    def drawn(self, log: Log) -> Log:
        """The log, or a piece of it, with north and east as they are drawn; as it is where an origin is unknown."""
        own = log.place
        if own is None or self.about is None or own == self.about:
            return log
        latitude, longitude = map(repr, self.about)
        told = log.with_metadata(origin_latitude_deg=latitude, origin_longitude_deg=longitude)
        times, (north, east) = log.together(*_WAYS)
        if not len(times):
            return told
        ways = track_of_geodetic(*geodetic_of_track(north, east, *own), *self.about)
        moved = {name: Channel(name, times, way, log[name].origin) for name, way in zip(_WAYS, ways, strict=True)}
        return dataclasses.replace(told, channels={**log.channels, **moved})


ALONE = Side()
