"""Can a dive have started when its .log says? All its states and motor runs count from there, the fixes do not.

$GPS2 is the fix before a dive, $GPS the one after it. In the nine dives at hand (sg171, sg249, sg561) the dive starts
21 to 25 s after $GPS2, and $GPS comes 157 to 511 s after the last start of a motor run (92 s after the last state of
dive 3 of sg561). So a start before $GPS2, or a motor run or a state after $GPS, is wrong; or the fix is. What is wrong
by less than these spans cannot be noticed.
"""

from __future__ import annotations

from glidercli.logio.records import NO_TIME
from glidercli.utc import to_second

__all__ = ["doubts_about_start", "other_start"]

CLOCK = 10
"""s; the vehicle's clock is set by its fixes, and an ordinary quartz (20 parts in a million) strays so in 6 days."""
SECOND = 10**9


def doubts_about_start(start_ns: int, before_ns: int, after_ns: int, last_ns: int) -> list[str]:
    """A line for each fix that contradicts the start of the dive.

    before_ns, after_ns : $GPS2 and $GPS. last_ns : the last state or start of a motor run. All UTC ns, NO_TIME where it
    is not told. A fix after the dive that is no later than the one before it is an old one, and tells nothing.
    """
    doubts = []
    if before_ns != NO_TIME and start_ns < before_ns - CLOCK * SECOND:
        doubts.append(
            f"start: {to_second(start_ns)} is {(before_ns - start_ns) / SECOND:.0f} s before $GPS2, the fix before the "
            "dive; it or the fix is wrong, and with it the times of all states and motor runs"
        )
    if NO_TIME not in (after_ns, last_ns) and after_ns > before_ns and last_ns > after_ns + CLOCK * SECOND:
        doubts.append(
            f"start: {to_second(start_ns)} brings the last state or motor run {(last_ns - after_ns) / SECOND:.0f} s "
            "after $GPS, the fix after the dive; it or the fix is wrong, and with it the times of all of them"
        )
    return doubts


def other_start(start_ns: int, log_ns: int, log: str) -> list[str]:
    """A line where a .eng and the .log of its dive do not start together. log : the latter's name."""
    if start_ns == log_ns:
        return []
    return [
        f"start: {to_second(start_ns)}, in {log} {to_second(log_ns)}, {abs(log_ns - start_ns) / SECOND:.0f} s apart: "
        "one of the two is wrong, and the times of all that counts from it"
    ]
