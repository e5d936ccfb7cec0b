"""How does a text become HTML that shows it, and nothing else? Escaping, numbers, and tables of plain values."""

from __future__ import annotations

import html
import json
import math
import unicodedata
from collections.abc import Mapping, Sequence
from typing import Any

__all__ = ["LONGEST", "MOST_ROWS", "embedded", "escaped", "flat", "headed", "number", "table"]

LONGEST = 2000
"""Characters of one text that are shown."""
MOST_ROWS = 200
"""Rows of one table that are shown."""

_UNITS = {
    "s": "s", "m": "m", "deg": "deg", "kg": "kg", "utc": "UTC", "pct": "%", "m_s": "m/s", "deg_s": "deg/s",
}  # fmt: skip
_WORDS = {
    "n": "n", "rmse": "RMSE", "mae": "MAE", "nrmse": "RMSE / range", "std": "standard deviation", "max": "largest",
    "max_time_utc": "largest at, UTC", "utc": "UTC",
}  # fmt: skip


def escaped(text: str, longest: int = LONGEST) -> str:
    """A text as HTML that shows it: markup escaped, what does not print written out, a long one cut and said so.

    Written out as in Python are controls, invisible marks (writing direction, zero width), line separators,
    surrogates and code points without a character.
    """
    cut = text[:longest]
    visible = "".join(
        c if c == "\n" or (unicodedata.category(c)[0] != "C" and c not in "\u2028\u2029") else _written(c) for c in cut
    )
    more = f" … ({len(text):,} characters)" if len(text) > longest else ""
    return html.escape(visible) + more


def _written(c: str) -> str:
    return c.encode("unicode_escape").decode("ascii")


def embedded(value: Any) -> str:
    """A value as JSON for a <script>: pure ASCII, and without the characters that could end the element."""
    text = json.dumps(value, allow_nan=False, ensure_ascii=True, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def number(value: float, digits: int = 4) -> str:
    """A number for people, with so many significant digits."""
    if not math.isfinite(value):
        return "–"
    if 10.0**digits <= abs(value) < 1e9:
        text = f"{value:,.0f}"
    elif 1e-7 <= abs(value) < 1e-4:
        text = f"{value:.{digits - 1 - math.floor(math.log10(abs(value)))}f}".rstrip("0")
    else:
        text = f"{value:z.{digits}g}"
    return text.replace("-", "−")


def headed(key: str) -> str:
    """A key of a document as the head of a column: words, then the unit."""
    if key in _WORDS:
        return _WORDS[key]
    words = key.split("_")
    for count in (2, 1):
        unit = _UNITS.get("_".join(words[-count:]))
        if unit is not None and len(words) > count:
            return f"{' '.join(words[:-count])}, {unit}"
    return " ".join(words)


def flat(row: Mapping[str, Any]) -> dict[str, Any]:
    """A dictionary with those inside it spread out: {a: {b: 1}} becomes {"a: b": 1}."""
    found: dict[str, Any] = {}
    for key, value in row.items():
        if isinstance(value, Mapping):
            found.update({f"{headed(key)}: {inner}": item for inner, item in flat(value).items()})
        else:
            found[headed(key)] = value
    return found


def table(caption: str, rows: Sequence[Mapping[str, Any]], *, classes: Mapping[str, str] | None = None) -> str:
    """A table of flat rows; the first column heads each row.

    Columns are the keys of all rows in the order met; a column without any value is left out. At most MOST_ROWS rows
    are shown. classes : CSS class by a cell's text, for verdicts.
    """
    keys = [
        key
        for key in dict.fromkeys(key for row in rows for key in row)
        if any(row.get(key) is not None for row in rows)
    ]
    if not keys:
        return ""
    numeric = {key for key in keys if all(isinstance(row.get(key), int | float | None) for row in rows)}
    shown = rows[:MOST_ROWS]
    more = f"The first {len(shown)} of {len(rows):,} rows; a .json of this comparison has all."
    beside = f' <span class="more">{more}</span>' if len(rows) > len(shown) else ""
    heads = [
        f'<th scope="col"{_class("number" if key in numeric and key != keys[0] else "")}>{escaped(key)}</th>'
        for key in keys
    ]
    body = "".join(f"<tr>{_cells(row, keys, numeric, classes or {})}</tr>\n" for row in shown)
    name = escaped(caption, 300)
    return (
        f'<div class="wide" role="group" tabindex="0" aria-label="{name}"><table>\n'
        f"<caption><span>{name}{beside}</span></caption>\n"
        f"<thead><tr>{''.join(heads)}</tr></thead>\n<tbody>\n{body}</tbody></table></div>\n"
    )


def _cells(row: Mapping[str, Any], keys: Sequence[str], numeric: set[str], classes: Mapping[str, str]) -> str:
    cells = []
    for place, key in enumerate(keys):
        text = _text(row.get(key))
        kind = "number" if key in numeric else "unit" if key == "unit" or key.endswith("UTC") else ""
        marks = " ".join(filter(None, (kind, classes.get(str(row.get(key)), ""))))
        cells.append(f'<th scope="row">{text}</th>' if place == 0 else f"<td{_class(marks)}>{text}</td>")
    return "".join(cells)


def _class(marks: str) -> str:
    return f' class="{marks}"' if marks else ""


def _text(value: Any) -> str:
    """A cell."""
    if value is None or value == "":
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int | float):
        return f"{value:,}".replace("-", "−") if isinstance(value, int) else number(value)
    if isinstance(value, list | tuple):
        return ", ".join(_text(item) for item in value)
    return escaped(str(value))
