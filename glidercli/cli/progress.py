"""How far is it? A bar on stderr for what takes longer than two seconds; a word of it when it is interrupted."""

from __future__ import annotations

import contextlib
import math
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

from glidercli.errors import Interrupted

__all__ = ["progress"]

_AFTER = 2.0  # s


class _Bar:
    """What was done so far, and the bar that shows it; silent where stderr is no terminal."""

    def __init__(self, what: str, quiet: bool) -> None:
        self._what, self._silent = what, quiet or not sys.stderr.isatty()
        self._began = time.monotonic()
        self._bar: Any = None
        self._task: Any = None
        self.done, self.whole = 0.0, math.inf

    def tell(self, done: float, whole: float) -> None:
        """So much is done of the whole (infinite: not known)."""
        self.done, self.whole = done, whole
        if self._silent or time.monotonic() - self._began < _AFTER:
            return
        if self._bar is None:
            from rich.console import Console
            from rich.progress import Progress

            self._bar = Progress(console=Console(stderr=True), transient=True)
            self._bar.start()
            self._task = self._bar.add_task(self._what, total=whole if math.isfinite(whole) else None)
        self._bar.update(self._task, completed=done)

    def stop(self) -> None:
        """Take the bar away."""
        if self._bar is not None:
            self._bar.stop()


@contextlib.contextmanager
def progress(what: str, unit: str, quiet: bool) -> Iterator[Callable[[float, float], None]]:
    """A function that is told how much is done and how much there is to do (infinite: not known), in a unit.

    An interruption from the keyboard becomes an error that says how far it came.
    """
    bar = _Bar(what, quiet)
    try:
        yield bar.tell
    except KeyboardInterrupt:
        of = f" of {bar.whole:,.0f}" if math.isfinite(bar.whole) else ""
        raise Interrupted(f"{what} was interrupted after {bar.done:,.0f}{of} {unit}; nothing was written") from None
    finally:
        bar.stop()
