"""How far is it? A bar on stderr for what takes longer than two seconds; nothing where stderr is no terminal."""

from __future__ import annotations

import contextlib
import math
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

__all__ = ["progress"]

_AFTER = 2.0  # s


@contextlib.contextmanager
def progress(what: str, quiet: bool) -> Iterator[Callable[[float, float], None] | None]:
    """A function that is told how much is done and how much there is to do (infinite: not known), in any one unit."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    began = time.monotonic()
    bar: Any = None
    task: Any = None

    def tell(done: float, whole: float) -> None:
        nonlocal bar, task
        if bar is None and time.monotonic() - began > _AFTER:
            from rich.console import Console
            from rich.progress import Progress

            bar = Progress(console=Console(stderr=True), transient=True)
            bar.start()
            task = bar.add_task(what, total=whole if math.isfinite(whole) else None)
        if bar is not None:
            bar.update(task, completed=done, description=f"{what} {done / 86400:.2f} d")

    try:
        yield tell
    finally:
        if bar is not None:
            bar.stop()
