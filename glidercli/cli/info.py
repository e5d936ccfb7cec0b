"""``glider info``: what a log holds, as replay would read it."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import Annotated, Any

import typer

from glidercli.cli.options import CacheOption, ColumnsOption, Debug, FormatOption, Json, Quiet

_MOST_ROWS = 14  # of the tables of files and dives
_MOST_NAMES = 20  # of columns that are not read
_WIDTH = 80  # columns of a terminal
_WIDTHS = (8, 8, 4, 8, 8, 8)  # of the cells of a channel


def info(
    log: Annotated[
        list[str], typer.Argument(metavar="LOG...", help="Files, folders or quoted globs.", show_default=False)
    ],
    format: FormatOption = None,
    cache: CacheOption = None,
    columns: ColumnsOption = None,
    json: Json = False,
    quiet: Quiet = False,
    debug: Debug = False,
) -> None:
    """What a log holds: spans, sampling, gaps, dives, and what is missing."""
    from glidercli.cli.logs_in import cores
    from glidercli.cli.printing import json_text, plain
    from glidercli.cli.progress import progress
    from glidercli.logio import overview, read

    with progress("reading", "files", quiet) as bar:
        reading = read(log, format, bar.tell, cache=cache, columns=columns, workers=cores())
    document = overview(reading).document()
    print(json_text(document) if json else "\n".join(map(plain, _text(document))))


def _text(d: dict[str, Any]) -> list[str]:
    """For people, within 80 columns."""
    records, kept = (sum(f[key] for f in d["files"]) for key in ("records", "kept"))
    who = d["platform"] or "vehicle not told"
    lines = [
        f"{d['kind']}: {who}",
        f"{_moment(d['start'])} to {_moment(d['end'])} UTC, {_span(d['duration_s'])}",
        f"{_count(len(d['files']), 'file')}, {_count(records, 'record')}: {kept:,} kept, {records - kept:,} dropped",
    ]
    if d["silence"]:
        lines.append(f"nothing recorded from {_moment(d['silence']['start'])} to {_moment(d['silence']['end'])}")
    if d["dives"]:
        deepest = max(dive["deepest_m"] for dive in d["dives"])
        lines.append(f"{_count(len(d['dives']), 'dive')} to {deepest:.1f} m at most")
    lines += ["", *_files(d["files"])]
    lines += ["", _row("channel", "samples", "every", "gaps", "longest", "minimum", "maximum")]
    for c in d["channels"]:
        low, high = ("-" if v is None else f"{v:z.4g}" for v in (c["minimum"], c["maximum"]))
        mark = "*" if c["origin"] == "derived" else ""
        every, longest = _span(c["interval_s"]), _span(c["longest_gap_s"])
        lines.append(_row(c["name"] + mark, f"{c['samples']:,}", every, str(c["gaps"]), longest, low, high))
    if any(c["origin"] == "derived" for c in d["channels"]):
        lines.append("* derived, not recorded; how: glider replay, or --json")
    if d["dives"]:
        lines += ["", f"{'dive':>4}  {'start, UTC':<19}  {'lasts':>8}  {'deepest':>9}"]
        rows = [
            f"{i:>4}  {_moment(dive['start'])}  {_span(dive['duration_s']):>8}  {dive['deepest_m']:>7.1f} m"
            + ("" if dive["gap_s"] is None else f"  with a gap of {_span(dive['gap_s'])}")
            for i, dive in enumerate(d["dives"], 1)
        ]
        lines += _shortened(rows, "dives")
    for event, count in _counted(d["events"]):
        lines.append(f"event {event}: {count}")
    if d["missing"]:
        lines += ["", "missing:"]
        for line in d["missing"]:
            lines += textwrap.wrap(line, _WIDTH, initial_indent="  ", subsequent_indent="    ")
    if d["not_read"]:
        lines += ["", *textwrap.wrap(_not_read(d["not_read"]), _WIDTH, subsequent_indent="  ")]
    return lines


def _not_read(names: list[str]) -> str:
    """How many columns are not read, and the first of them by name."""
    more = f" and {len(names) - _MOST_NAMES} more (--json has them all)" if len(names) > _MOST_NAMES else ""
    return f"not read, {_count(len(names), 'column')} with data: {', '.join(names[:_MOST_NAMES])}{more}"


def _row(name: str, *cells: str) -> str:
    """A line of the table of channels; cells that are too wide push the others, and never touch them."""
    return f"{name:<30}" + "".join(f" {cell:>{width}}" for cell, width in zip(cells, _WIDTHS, strict=True))


def _files(files: list[dict[str, Any]]) -> list[str]:
    """A line for each file, and what it dropped."""
    rows = []
    for f in files:
        ordered = sorted(f["dropped"], key=lambda item: -item["count"])
        gone = [f"{item['count']:,} {item['reason']}" for item in ordered]
        told = "; ".join([*([f["error"]] if "error" in f else []), *gone])
        rows.append(f"{_cut(Path(f['path']).name, 34):<35}{f['format'] or '-':<13}{f['kept']:>9,} of {f['records']:,}")
        rows += textwrap.wrap(told, _WIDTH, initial_indent="    ", subsequent_indent="      ")
    return [f"{'file':<35}{'format':<13}{'kept':>9} of records", *_shortened(rows, "lines of files")]


def _shortened(rows: list[str], what: str) -> list[str]:
    """The first and last rows of many."""
    half = _MOST_ROWS // 2
    if len(rows) <= _MOST_ROWS:
        return rows
    return [*rows[:half], f"  ... {len(rows) - 2 * half} more {what} (--json has them all)", *rows[-half:]]


def _counted(events: list[dict[str, Any]]) -> list[tuple[str, int]]:
    names = [event["name"] for event in events]
    return [(name, names.count(name)) for name in dict.fromkeys(names)]


def _cut(text: str, width: int) -> str:
    return text if len(text) <= width else text[: width - 3] + "..."


def _count(number: int, what: str) -> str:
    return f"{number:,} {what}" + ("" if number == 1 else "s")


def _moment(iso: str) -> str:
    """2019-07-21T23:24:49.000Z as 2019-07-21 23:24:49."""
    return iso[:19].replace("T", " ")


def _span(seconds: float | None) -> str:
    """A time in the unit that suits it."""
    if seconds is None:
        return "-"
    for unit, size in (("yr", 365.25 * 86400.0), ("d", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.1f} {unit}"
    return f"{seconds:.3g} s"
