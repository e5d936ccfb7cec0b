"""What can go wrong, as one tree; a command turns each into one line and an exit code.

    GliderError                 exit 1
    ├── InputError              a file or a number that cannot be used: file, what, where, what is allowed
    ├── OutputError             an output that cannot be written
    ├── NoSolutionError         a question that has no answer: the nearest point and what fails there
    ├── UsageError              exit 2: options that do not make a question: missing, contradictory, an unknown choice
    └── Interrupted             exit 130: somebody pressed Ctrl-C; how far it came

Solvers report their outcome as data; exceptions are for input that cannot be used and questions without an answer.
"""

from __future__ import annotations

__all__ = ["GliderError", "InputError", "Interrupted", "NoSolutionError", "OutputError", "UsageError"]


class GliderError(Exception):
    """Any expected failure of the program; its text is one line fit for a user."""

    exit_code = 1


class InputError(GliderError):
    """Input that cannot be used.

    where : the file, option or quantity at fault, named first in the message.
    what : what is wrong, where in it, and what is allowed.
    """

    def __init__(self, where: object, what: str) -> None:
        super().__init__(f"{where}: {what}")

    @classmethod
    def of_all(cls, where: object, faults: list[str]) -> InputError:
        """One error for every fault of a file, counted if there are several."""
        return cls(where, (f"{len(faults)} faults: " if len(faults) > 1 else "") + "; ".join(faults))


class OutputError(GliderError):
    """An output that cannot be written: it exists, its folder is missing or closed, or its kind is unknown."""

    def __init__(self, path: object, what: str) -> None:
        super().__init__(f"{path}: {what}")
        self.path, self.what = path, what


class NoSolutionError(GliderError):
    """A well-posed question that the model answers with "there is none"."""


class UsageError(GliderError):
    """Options that do not make a question; the message says what would."""

    exit_code = 2


class Interrupted(GliderError):
    """Interrupted from the keyboard; the message says how far it came and what became of the outputs."""

    exit_code = 130
