"""What follows from recorded channels alone? Each is marked as derived, and a note of the log says how."""

from __future__ import annotations

from glidercli.log import Log
from glidercli.logio.derived.motion import with_motion
from glidercli.logio.derived.seawater import with_seawater
from glidercli.logio.derived.track import with_track
from glidercli.logio.whereabouts import Whereabouts

__all__ = ["with_derived"]


def with_derived(log: Log, near: Whereabouts | None = None) -> Log:
    """The log with what can be had and is not there: depth, vertical speed, phase, salinity, density, track.

    near : positions that need be no fixes, for density and depth of a log without fixes, and for the track of one
    without pitch or heading.
    """
    return with_track(with_seawater(with_motion(log, near), near), near)
