"""What is each of several Logs called where they are shown together?"""

from __future__ import annotations

from collections.abc import Sequence

from glidercli.log import Log

__all__ = ["labels"]


def labels(number: int, logs: Sequence[Log], names: Sequence[str]) -> tuple[str, str]:
    """What a log is called: its name and kind, and what of that is enough to tell it from the others."""
    kinds = [log.kind for log in logs]
    kind, alone = kinds[number], kinds.count(kinds[number]) == 1
    if not names:
        label = kind if alone else f"{kind} {kinds[: number + 1].count(kind)}"
        return label, label
    name = " ".join(names[number].split())
    return f"{name} {kind}", kind if alone else f"{name} {logs[number].origin.upper()}"
