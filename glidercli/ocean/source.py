"""What text does a file hold? Plain or gzipped, UTF-8 with or without a byte-order mark, else Latin-1."""

from __future__ import annotations

from pathlib import Path

from glidercli.errors import InputError
from glidercli.files import is_utf16, readable_file
from glidercli.gzipped import unpacked

__all__ = ["left_out", "listed", "read_text"]

_TEXT_CONTROLS = b"\t\n\v\f\r\x1a"  # \x1a ends text files written by DOS programs
_NOT_TEXT = bytes(code for code in range(32) if code not in _TEXT_CONTROLS)


def read_text(path: Path, expected: str) -> str:
    """The text of a file, unpacked if it is gzipped.

    expected : what the file should be, for the message when it is no text: "a CTD cast is ...".

    Raises
    ------
    InputError
        The file is missing, a folder, unreadable, empty, a damaged gzip file, or no text.
    """
    data = readable_file(path).read_bytes()
    data, whole = unpacked(path, data)
    if not whole:
        raise InputError(path, "is a damaged gzip file: cut short, or with wrong bytes")
    if is_utf16(data):
        raise InputError(path, "is text in UTF-16; save it in UTF-8 (iconv -f UTF-16 -t UTF-8 OLD > NEW)")
    if data.translate(None, _NOT_TEXT) != data:
        raise InputError(path, f"is not a text file; {expected}")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    if not text.strip():
        raise InputError(path, "is empty")
    return text


def listed(names: tuple[str, ...], most: int = 30) -> str:
    """Names as text for a message, at most so many."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def left_out(dropped: tuple[tuple[str, int], ...], records: int, what: str) -> tuple[str, ...]:
    """One line that counts what was dropped, by reason; none if nothing was. what : "bins", "samples"."""
    reasons = ", ".join(f"{count} {reason}" for reason, count in dropped)
    return (f"{sum(count for _, count in dropped)} of {records} {what} left out: {reasons}",) if dropped else ()
