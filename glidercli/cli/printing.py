"""Where results and messages go: results on stdout, messages on stderr; JSON in one form for every command."""

from __future__ import annotations

import json
import math
import os
import sys
import textwrap
from collections.abc import Iterable, Mapping
from typing import Any, TextIO

WIDTH = 80
"""Columns of a terminal, and the most that are used of a wider one."""
NARROW = 52
"""Columns that are used of a narrower one."""


def finite(value: Any) -> Any:
    """The value with every non-finite number replaced by None, at any depth, and numpy scalars made plain."""
    if isinstance(value, Mapping):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(item) for item in value]
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def plain(text: str) -> str:
    """A line as a terminal may show it: control characters, such as those of a hostile file name, written out."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def columns_of(stream: TextIO) -> int:
    """Columns that lines for people may take: those that COLUMNS says, else the terminal's; of a pipe 80."""
    told = os.environ.get("COLUMNS", "")
    if told.isdigit():
        columns = int(told)
    else:
        columns = os.get_terminal_size(stream.fileno()).columns if stream.isatty() else WIDTH
    return min(max(columns, NARROW), WIDTH) if columns else WIDTH


def shown(text: str, stream: TextIO) -> str:
    """A line as it goes to a stream: wrapped for a terminal, whole for a pipe, so that grep finds it."""
    return "\n".join(wrapped(text, columns_of(stream))) if stream.isatty() else plain(text)


def wrapped(text: str, width: int = WIDTH) -> list[str]:
    """A line within some columns; what goes on is indented. Names of files stay whole."""
    text = plain(text)
    indent = " " * (len(text) - len(text.lstrip()) + 2)
    return textwrap.wrap(
        text, width, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
    ) or [""]  # fmt: skip


def json_text(document: Any) -> str:
    """The document as JSON; non-finite numbers are null."""
    return json.dumps(finite(document), indent=2, allow_nan=False, ensure_ascii=False)


def warn(messages: Iterable[str], quiet: bool) -> None:
    """Each message as one line on stderr, unless quiet."""
    if not quiet:
        for message in messages:
            print(shown(f"glider: warning: {message}", sys.stderr), file=sys.stderr)


def say(message: str, quiet: bool) -> None:
    """A progress message on stderr, unless quiet."""
    if not quiet:
        print(plain(message), file=sys.stderr)
