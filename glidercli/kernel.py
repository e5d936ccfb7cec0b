"""One source for the physics: functions marked here run as plain Python or, for long runs, compiled by numba.

A function marked ``@kernel`` stays a plain Python function and works on floats, tuples and named tuples. ``compiled``
hands an entry point to numba, which sees every marked function that it calls. Nothing imports numba before that, so
that a single trim starts at once.

Compiled code is kept under the user's cache folder, in a directory named by a hash of every source file of the
package: an edit anywhere gives a new directory, so that no stale answer can come back (numba's own check looks at the
entry point's file alone). Where that folder cannot be written the cache is off and each process compiles anew.
"""

from __future__ import annotations

import functools
import gc
import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])

_OPTIONS = {"error_model": "numpy", "no_cfunc_wrapper": True}
"""No check for division by zero: what divides sees to it, and plain code, which does check, runs the same source. No
wrapper for callers in C, of which there are none: it takes a twelfth of the time to compile."""

_told_of_compiling: list[Callable[[str], None]] = []
_marked: list[Callable[..., Any]] = []
_replaced: list[tuple[Callable[..., Any], Callable[..., Any]]] = []


def kernel(function: Function) -> Function:
    """Mark a function as part of the compilable physics; it is returned unchanged."""
    _marked.append(function)
    return function


def compiled_as(other: Callable[..., Any]) -> Callable[[Function], Function]:
    """Mark a function that is itself in plain code, and ``other``, a kernel of the same meaning, in compiled code.

    For library functions that are quick to call and slow to compile.
    """

    def mark(function: Function) -> Function:
        _replaced.append((function, other))
        return function

    return mark


def sources_hash(package: Path | None = None) -> str:
    """Hash of all Python sources below a folder (default: this package), as 16 hexadecimal digits."""
    package = package or Path(__file__).parent
    digest = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        digest.update(str(path.relative_to(package)).encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@functools.cache
def cache_folder() -> Path | None:
    """Where this version of the sources keeps what it worked out once, or None where that cannot be written."""
    base = os.environ.get("GLIDER_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    folder = Path(base) / "glidercli" / f"numba-{sources_hash()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / f".probe-{os.getpid()}"
        probe.touch()
        probe.unlink()
    except OSError:
        return None
    return folder


def _standing_for(other: Callable[..., Any]) -> Callable[..., Any]:
    """What numba asks for which source stands for a function, given the types of its arguments: always ``other``."""

    def source(*types: Any) -> Callable[..., Any]:
        return other

    return source


@functools.cache
def _numba() -> tuple[Any, bool]:
    """numba, with every marked function made known to it, and whether its cache may be used."""
    folder = cache_folder()
    if folder is not None:
        os.environ["NUMBA_CACHE_DIR"] = str(folder)
    os.environ.setdefault("NUMBA_OPT", "1")  # level 3 compiles 15 % longer and runs no faster here
    import numba
    from numba.core import event
    from numba.extending import overload, register_jitable

    if folder is not None:
        setattr(numba.config, "CACHE_DIR", str(folder))  # numba may have been imported before, by others  # noqa: B010
    for function in _marked:
        register_jitable(forceinline=True, **_OPTIONS)(function)  # calls on tuples cost more than what they do
    for function, other in _replaced:
        overload(function, strict=False)(_standing_for(other))

    class Compiling(event.Listener):
        """Keeps Python from looking for garbage while numba compiles, where there is little: a tenth of its time."""

        depth, looked = 0, False

        def on_start(self, event: Any) -> None:
            if self.depth == 0:
                self.looked = gc.isenabled()
            self.depth += 1
            gc.disable()

        def on_end(self, event: Any) -> None:
            self.depth -= 1
            if self.depth == 0 and self.looked:
                gc.enable()

    event.register("numba:compile", Compiling())  # type: ignore[no-untyped-call]
    return numba, folder is not None


@functools.cache
def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """The entry point compiled by numba; every ``@kernel`` function that it calls is compiled with it.

    All modules with kernels that the entry point reaches must have been imported, which its own imports see to.
    """
    numba, cached = _numba()
    if not ready(function):
        for tell in _told_of_compiling:
            tell(function.__name__)
    return numba.njit(cache=cached, nogil=True, **_OPTIONS)(function)  # type: ignore[no-any-return]


def tell_of_compiling(tell: Callable[[str], None]) -> None:
    """Have a function called with the name of every entry point that is about to be compiled, which takes seconds."""
    _told_of_compiling.append(tell)


def ready(function: Callable[..., Any]) -> bool:
    """Whether an earlier process has compiled the entry point, so that ``compiled`` costs a second and not ten."""
    folder = cache_folder()
    return folder is not None and any(folder.rglob(f"*.{function.__name__}-*.nbi"))


_WORTH = 400
"""Points from which compiling pays: it costs seconds once; a trim takes 5 to 100 ms plain, 0.1 ms compiled."""


def runner(points: int) -> Callable[..., Any]:
    """What calls a kernel, run(function, *arguments), for so many points: compiled where there is enough to do, or
    where an earlier process has compiled it; plain otherwise. The answers are the same."""

    def run(function: Callable[..., Any], *arguments: Any) -> Any:
        return (compiled(function) if points >= _WORTH or ready(function) else function)(*arguments)

    return run


_WARM = 100
"""Calls of a function in one process after which compiling it pays: it costs seconds once, and saves milliseconds."""


@functools.cache
def warmed(function: Function) -> Function:
    """The function, plain for its first calls in a process and compiled from then on; its answers are the same."""
    calls = 0

    @functools.wraps(function)
    def either(*args: Any) -> Any:
        nonlocal calls
        calls += 1
        return function(*args) if calls <= _WARM else compiled(function)(*args)

    return either  # type: ignore[return-value]
