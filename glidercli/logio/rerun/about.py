"""What is this recording? A page that says where its values come from, how they are drawn, and what made it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from typing import Any

from glidercli.channels import CHANNELS
from glidercli.log import Log
from glidercli.logio.rerun.clocks import CLOCK_NOTE

__all__ = ["about", "about_several"]

ORIGINS = {
    "simulated": "Computed by a model. Nothing here was measured.",
    "measured": "Recorded by an instrument at sea. Channels that were computed from it are named below.",
    "reconstruction": "Rebuilt from published values. It is not a recording.",
    "derived": "Computed from measured channels.",
}


def about(log: Log, notes: Sequence[str]) -> str:
    """The page, Markdown: where the values come from, how they are drawn, metadata, provenance."""
    return "\n".join(_page(log, log.kind, notes)) + "\n"


def about_several(sides: Sequence[tuple[str, str, Log]], notes: Sequence[str]) -> str:
    """The page of logs side by side. sides : label, name of the colour, log."""
    lines = [f"# {' beside '.join(_plain(label) for label, _, _ in sides)}", ""]
    for label, colour, log in sides:
        clock = log.metadata.get(CLOCK_NOTE)
        lines.append(f"- **{colour}**: {_plain(label)}" + (f". Its clock is {_plain(clock)}." if clock else ""))
    lines += ["", "## How it is drawn", "", *(f"- {_plain(note)}" for note in notes)]
    for label, _, log in sides:
        lines += ["", *_page(log, _plain(label), ())]
    return "\n".join(lines) + "\n"


def _page(log: Log, title: str, notes: Sequence[str]) -> list[str]:
    lines = [f"# {title}", "", ORIGINS[log.origin], ""]
    told = {key: value for key, value in log.metadata.items() if key != "provenance"}
    if remade := told.pop("reconstruction", ""):
        lines += [f"**Reconstruction**: {_plain(remade)}", ""]
    others: dict[str, list[str]] = {}
    for name in (name for name in CHANNELS if name in log):
        if log[name].origin != log.origin:
            others.setdefault(log[name].origin, []).append(name.replace("_", " "))
    lines += [f"- **{origin}**: {', '.join(names)}" for origin, names in others.items()]
    if notes:
        lines += ["", "## How it is drawn", "", *(f"- {note}" for note in notes)]
    for heading, entries in (("Metadata", told), ("Provenance", _record(log))):
        lines += ["", f"## {heading}", "", *_entries(entries)] if entries else []
    return lines


def _record(log: Log) -> dict[str, Any]:
    """The provenance as a dictionary; a record that is no JSON object stands as it is, under "record"."""
    text = log.metadata.get("provenance", "{}")
    try:
        record = json.loads(text)
    except ValueError:
        record = text
    return record if isinstance(record, dict) else {"record": text}


def _entries(entries: dict[str, Any]) -> Iterator[str]:
    """A Markdown list of keys and values, which wraps where a table would be cut off; an item each of many inputs."""
    for key, value in entries.items():
        for one in value if isinstance(value, list) and key != "command" else [value]:
            words = [f"{k} {v}" for k, v in one.items()] if isinstance(one, dict) else one
            yield f"- **{_plain(key)}**: {_plain(' '.join(map(str, words)) if isinstance(words, list) else str(words))}"


def _plain(text: str) -> str:
    """Text as it stands, on one line, whatever Markdown would make of its signs."""
    return re.sub(r"([\\`*_<>|\[\]#~])", r"\\\1", " ".join(text.split()))
