"""``glider info``: what a log holds, as replay would read it."""

from __future__ import annotations

import sys
import textwrap
from pathlib import Path
from typing import Annotated, Any

import typer

from glidercli.cli.options import CacheOption, ColumnsOption, Debug, FormatOption, Json, Quiet

_MOST_ROWS = 14  # of the tables of files and dives
_MOST_NAMES = 20  # of columns that are not read
_MOST_WARNINGS = 3  # of a file
_MOST_FILES = 5  # of which warnings are shown
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
    from glidercli.cli.printing import columns_of, json_text, plain
    from glidercli.cli.progress import progress
    from glidercli.logio import overview, read

    with progress("reading", "files", quiet) as bar:
        reading = read(log, format, bar.tell, cache=cache, columns=columns, workers=cores())
    document = overview(reading).document()
    if json:
        print(json_text(document))
        return
    width = columns_of(sys.stdout)
    for line in map(plain, _text(document, width)):
        print("\n".join(_within(line, width)))


def _text(d: dict[str, Any], width: int) -> list[str]:
    """For people; few lines are wider, and those are folded where they are printed."""
    records, kept = (sum(f[key] for f in d["files"]) for key in ("records", "kept"))
    who = d["platform"] or "vehicle not told"
    lines = [
        f"{d['kind']}: {who}" + (", as its instruments would record it" if d["instruments"] else ""),
        f"{_moment(d['start'])} to {_moment(d['end'])} UTC, {_span(d['duration_s'])}",
        f"{_count(len(d['files']), 'file')}, {_count(records, 'record')}: {kept:,} kept, {records - kept:,} dropped",
    ]
    if d["silence"]:
        lines.append(f"nothing recorded from {_moment(d['silence']['start'])} to {_moment(d['silence']['end'])}")
    if d["dives"]:
        deepest = max(dive["deepest_m"] for dive in d["dives"])
        lines.append(f"{_count(len(d['dives']), 'dive')} to {deepest:.1f} m at most")
    lines += ["", *_files(d["files"], width)]
    lines += _section("warnings:", _warnings(d["files"]), width)
    lines += _section("not looked at:", d["passed_over"], width)
    lines += ["", *_row(width, "channel", "samples", "every", "gaps", "longest", "minimum", "maximum")]
    for c in d["channels"]:
        low, high = ("-" if v is None else f"{v:z.4g}" for v in (c["minimum"], c["maximum"]))
        mark = "*" if c["origin"] == "derived" else ""
        every, longest = _span(c["interval_s"]), _span(c["longest_gap_s"])
        lines += _row(width, c["name"] + mark, f"{c['samples']:,}", every, str(c["gaps"]), longest, low, high)
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
    lines += _section("missing:", d["missing"], width)
    if d["not_read"]:
        lines += ["", *textwrap.wrap(_not_read(d["not_read"]), width, subsequent_indent="  ")]
    return lines


def _section(head: str, told: list[str], width: int) -> list[str]:
    """Lines under a head; nothing where there are none."""
    lines = [textwrap.wrap(line, width, initial_indent="  ", subsequent_indent="    ") for line in told]
    return ["", head, *(row for rows in lines for row in rows)] if told else []


def _within(line: str, width: int) -> list[str]:
    """A line as it is, or folded where it is too wide."""
    indent = " " * (len(line) - len(line.lstrip()) + 2)
    return [line] if len(line) <= width else textwrap.wrap(line, width, subsequent_indent=indent)


def _warnings(files: list[dict[str, Any]]) -> list[str]:
    """The first warnings of the first files that have any, and how many more there are."""
    told = [(Path(f["path"]).name, [w for w in f["warnings"] if w != f.get("error")]) for f in files]
    told = [(name, warnings) for name, warnings in told if warnings]
    lines = []
    for name, warnings in told[:_MOST_FILES]:
        lines += [f"{_cut(name, 34)}: {warning}" for warning in warnings[:_MOST_WARNINGS]]
        if more := len(warnings) - _MOST_WARNINGS:
            lines += [f"{_cut(name, 34)}: ... {_count(more, 'more warning')} (--json has them all)"] if more > 0 else []
    if rest := told[_MOST_FILES:]:
        more = sum(len(warnings) for _, warnings in rest)
        lines.append(f"... {_count(more, 'more warning')} of {_count(len(rest), 'more file')} (--json has them all)")
    return lines


def _not_read(names: list[str]) -> str:
    """How many columns are not read, and the first of them by name."""
    more = f" and {len(names) - _MOST_NAMES} more (--json has them all)" if len(names) > _MOST_NAMES else ""
    return f"not read, {_count(len(names), 'column')} with data: {', '.join(names[:_MOST_NAMES])}{more}"


def _row(width: int, name: str, *cells: str) -> list[str]:
    """A line of the table of channels; cells that are too wide push the others, and never touch them."""
    rest = "".join(f" {cell:>{size}}" for cell, size in zip(cells, _WIDTHS, strict=True))
    return _beside(name, min(30, width - sum(_WIDTHS) - len(_WIDTHS)), rest)


def _beside(name: str, room: int, rest: str) -> list[str]:
    """A name with the rest of its line; a name that needs more room has a line of its own."""
    return [f"{name:<{room}}{rest}"] if len(name) <= room else [name, f"{'':<{room}}{rest}"]


def _files(files: list[dict[str, Any]], width: int) -> list[str]:
    """A line for each file, and what it dropped."""
    rows, room = [], width - 46
    for f in files:
        ordered = sorted(f["dropped"], key=lambda item: -item["count"])
        gone = [f"{item['count']:,} {item['reason']}" for item in ordered]
        told = "; ".join([*([f["error"]] if "error" in f else []), *gone])
        kept = f" {f['format'] or '-':<13}{f['kept']:>9,} of {f['records']:,}"
        rows += _beside(_cut(Path(f["path"]).name, 34), room, kept)
        rows += textwrap.wrap(told, width, initial_indent="    ", subsequent_indent="      ")
    return [*_beside("file", room, f" {'format':<13}{'kept':>9} of records"), *_shortened(rows, "lines of files")]


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
