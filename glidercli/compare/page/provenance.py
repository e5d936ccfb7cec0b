"""Where does a page come from, and what do the logs say of themselves?"""

from __future__ import annotations

import itertools
import json
import shlex
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from glidercli.compare.page.html import escaped, table
from glidercli.log import Log

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison

__all__ = ["origins"]

MOST_METADATA = 100
"""Texts that a log says of itself that are shown."""

_INPUTS = (("path", "file"), ("sha256", "SHA-256"))


def origins(comparison: Comparison, record: Mapping[str, Any]) -> str:
    """The record of the page, and what each log says of itself."""
    text = _record(record)
    logs = [(comparison.measured, comparison.against), *((run.side, run.log) for run in comparison.runs)]
    for side, log in logs:
        if isinstance(log, Log) and log.metadata:
            text += _says(side.name, log)
    return text


def _record(record: Mapping[str, Any]) -> str:
    """One provenance record: what it names, then its inputs."""
    command = record.get("command")
    rows = {key: value for key, value in record.items() if key not in ("command", "inputs") and value != ""}
    items = "".join(
        f"<dt>{escaped(str(key))}</dt><dd>{'none' if value is None else escaped(_shown(value))}</dd>"
        for key, value in itertools.islice(rows.items(), MOST_METADATA)
    )
    text = f"<dl>{items}</dl>\n"
    if isinstance(command, list):
        text += f"<p>Command:</p><pre>{escaped(shlex.join(map(str, command)))}</pre>\n"
    inputs = record.get("inputs")
    if isinstance(inputs, list) and all(isinstance(one, Mapping) for one in inputs):
        text += table("Inputs", [{headed: one.get(key) for key, headed in _INPUTS} for one in inputs])
    return text


def _shown(value: Any) -> str:
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _says(name: str, log: Log) -> str:
    """What a log says of itself, its own provenance set out."""
    entries = [(key, text) for key, text in log.metadata.items() if key != "provenance"]
    items = "".join(f"<dt>{escaped(key, 200)}</dt><dd>{escaped(text)}</dd>" for key, text in entries[:MOST_METADATA])
    more = f"<p>{len(entries) - MOST_METADATA} more are not shown.</p>" if len(entries) > MOST_METADATA else ""
    own = ""
    if "provenance" in log.metadata:
        try:
            record = json.loads(log.metadata["provenance"])
        except (ValueError, RecursionError):
            record = None
        told = _record(record) if isinstance(record, dict) else f"<p>{escaped(log.metadata['provenance'])}</p>"
        own = f"<h3>How it was made</h3>\n{told}"
    return (
        f"<details><summary>What {escaped(name, 120)} says of itself</summary>\n<dl>{items}</dl>{more}\n"
        f"{own}</details>\n"
    )
