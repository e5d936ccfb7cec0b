"""The command line: one thin file per command; options in, one library call, result out."""

from __future__ import annotations

import signal
import sys
from typing import NoReturn

__all__ = ["main"]


def main() -> None:
    """Run ``glider`` and exit: 0 success, 1 a failure named in one line, 2 wrong usage."""
    from glidercli.cli.app import app
    from glidercli.errors import GliderError

    for name in ("SIGTERM", "SIGHUP"):
        request = getattr(signal, name, None)  # not every system has terminals that hang up
        if request is not None and signal.getsignal(request) is not signal.SIG_IGN:  # nohup has it ignored
            signal.signal(request, _terminated)
    try:
        app(prog_name="glider")
    except GliderError as error:
        if "--debug" in sys.argv:
            raise
        _fail(str(error), error.exit_code)
    except BrokenPipeError:
        sys.stderr.close()
        sys.exit(1)
    except OSError as error:
        if "--debug" in sys.argv:
            raise
        _fail(f"{error.filename or 'standard output'}: {error.strerror or error}", 1)
    except Exception as error:
        if "--debug" in sys.argv:
            raise
        _fail(f"internal error, {type(error).__name__}: {error} (--debug shows where)", 1)


def _terminated(number: int, frame: object) -> NoReturn:
    """A request to end is an interruption like that from the keyboard: outputs appear whole or not at all."""
    raise KeyboardInterrupt


def _fail(message: str, exit_code: int) -> None:
    from glidercli.cli.printing import plain

    print(plain("glider: error: " + " ".join(message.split())), file=sys.stderr)
    sys.exit(exit_code)
