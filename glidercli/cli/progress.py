"""How far is it? A bar on stderr for what takes longer than two seconds; a word of it when it is interrupted."""

from __future__ import annotations

import contextlib
import math
import sys
import threading
from collections.abc import Iterator
from typing import Any

from glidercli.errors import Interrupted

__all__ = ["Bar", "progress"]

_AFTER = 2.0  # s


class Bar:
    """What is being done, how much of it is done, and the bar that shows it; silent where stderr is no terminal."""

    def __init__(self, what: str, unit: str, quiet: bool) -> None:
        self._what, self._unit = what, unit
        self._done, self._whole = 0.0, math.inf
        self._shown: Any = None
        self._task: Any = None
        self._lock, self._stopped = threading.Lock(), False
        self._timer = threading.Timer(_AFTER, self._show)
        self._timer.daemon = True
        if not quiet and sys.stderr.isatty():
            self._timer.start()

    def tell(self, done: float, whole: float) -> None:
        """So much is done of the whole (infinite: not known)."""
        self._done, self._whole = done, whole
        self._update()

    def stage(self, what: str) -> None:
        """Something else is done now, of unknown length."""
        self._what, self._unit, self._done, self._whole = what, "", 0.0, math.inf
        self._update()

    def stop(self) -> None:
        """Take the bar away."""
        self._timer.cancel()
        with self._lock:
            self._stopped = True
            if self._shown is not None:
                self._shown.stop()

    def interrupted(self) -> Interrupted:
        """The error that says how far it came."""
        of = f" of {self._whole:,.0f}" if math.isfinite(self._whole) else ""
        far = f" after {self._done:,.0f}{of} {self._unit}" if self._unit else ""
        return Interrupted(f"{self._what} was interrupted{far}; nothing was written")

    def _show(self) -> None:
        from rich.console import Console
        from rich.progress import Progress

        with self._lock:
            if self._stopped:  # while the lines above took their time
                return
            self._shown = Progress(console=Console(stderr=True), transient=True)
            self._task = self._shown.add_task(self._what)
            self._shown.start()
        self._update()

    def _update(self) -> None:
        if self._task is not None:
            whole = self._whole if math.isfinite(self._whole) else None
            self._shown.update(self._task, description=self._what, completed=self._done, total=whole)


@contextlib.contextmanager
def progress(what: str, unit: str, quiet: bool) -> Iterator[Bar]:
    """A bar for what is done in the block; ``what`` is counted in a unit, as "points".

    An interruption from the keyboard becomes an error that says how far it came.
    """
    bar = Bar(what, unit, quiet)
    try:
        yield bar
    except KeyboardInterrupt:
        raise bar.interrupted() from None
    finally:
        bar.stop()
