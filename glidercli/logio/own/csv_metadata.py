"""What of a Log can a CSV table not hold? It stands beside the table in FILE.csv-metadata.json."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, get_args

import numpy as np

from glidercli.errors import InputError
from glidercli.files import metadata_path
from glidercli.log import Event, Log, Origin
from glidercli.origins import BOTH
from glidercli.provenance import file_hash

__all__ = [
    "events_of", "metadata_of", "origin_word", "parsed_metadata", "read_metadata", "stranger", "texts_of",
    "write_metadata",
]  # fmt: skip

_KINDS: dict[str, type] = {"origin": str, "metadata": dict, "channels": dict, "events": list}


def origin_word(origin: str, metadata: Mapping[str, Any], of_channels: Collection[str]) -> str:
    """What a row of the table is: measured, simulated, or reconstruction for all that was made from one."""
    if "reconstruction" in metadata:
        return "reconstruction"
    return BOTH if origin == "measured" and "derived" in of_channels else origin


def metadata_of(log: Log, span_ns: tuple[int, int] | None) -> dict[str, Any]:
    """Origin, metadata with provenance, the channels' origins, events. span_ns : first and last time of the table."""
    told: dict[str, Any] = dict(log.metadata)
    record = _unpacked(told.get("provenance", ""))
    return {
        "origin": log.origin,
        "metadata": told | ({} if record is None else {"provenance": record}),
        "channels": {name: channel.origin for name, channel in log.channels.items() if len(channel)},
        "events": [{"name": e.name, "time_ns": e.time_ns, "depth_m": e.depth} for e in log.events],
        "span_ns": list(span_ns) if span_ns else None,
    }


def _unpacked(text: str) -> dict[str, Any] | None:
    """The object of a JSON text, None where it would not give back the same text."""
    try:
        found = json.loads(text)
    except ValueError:
        return None
    return found if isinstance(found, dict) and json.dumps(found) == text else None


def texts_of(metadata: Mapping[str, Any]) -> dict[str, str]:
    """The metadata of the log: what ``metadata_of`` unpacked is a text again."""
    return {key: v if isinstance(v, str) else json.dumps(v) for key, v in metadata["metadata"].items()}


def events_of(metadata: Mapping[str, Any]) -> tuple[Event, ...]:
    """The events of the log."""
    return tuple(Event(e["name"], e["time_ns"], e["depth_m"]) for e in metadata["events"])


def write_metadata(told: Mapping[str, Any], path: Path, table: Path) -> None:
    """``metadata_of`` the log of a table, and the table's hash."""
    document = {**told, "table_sha256": file_hash(table)}
    path.write_text(json.dumps(document, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


def read_metadata(table: Path) -> dict[str, Any]:
    """What ``write_metadata`` wrote beside a table, empty where nothing stands there; InputError for something else."""
    path = metadata_path(table)
    if not path.is_file():
        return {}
    try:
        text = path.read_bytes()
    except OSError as error:
        raise InputError(table, f"{path.name} cannot be read: {error.strerror}") from None
    return parsed_metadata(table, f"{path.name} is not the metadata of a log's CSV", text)


def parsed_metadata(table: Path, what: str, text: str | bytes) -> dict[str, Any]:
    """What ``metadata_of`` gave, from JSON; InputError that begins with ``what`` for anything else."""
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        fault = "it is no JSON"
    else:
        fault = _fault(found)
    if fault:
        raise InputError(table, f"{what}: {fault}")
    return dict(found)


def _fault(found: Any) -> str:
    """Why a JSON document is no metadata; "" where it is."""
    if not isinstance(found, dict):
        return "it holds no object"
    wrong = [key for key, kind in _KINDS.items() if not isinstance(found.get(key), kind)]
    wrong += [] if _is_span(found.get("span_ns")) else ["span_ns"]
    if wrong:
        return f"it is without a proper {', '.join(wrong)}"
    if not all(origin in get_args(Origin) for origin in (found["origin"], *found["channels"].values())):
        return f"origins are {', '.join(get_args(Origin))}"
    return "" if all(map(_is_event, found["events"])) else "an event of it lacks name, time_ns or depth_m"


def _is_span(span: Any) -> bool:
    """Whether this is the first and the last time of a table, ns, or None."""
    return span is None or (isinstance(span, list) and len(span) == 2 and all(map(_is_time, span)))


def _is_time(value: Any) -> bool:
    """Whether this is a time in ns that 64 bits hold."""
    return type(value) is int and abs(value) < 2**63


def _is_event(event: Any) -> bool:
    """Whether this is an event as ``write_metadata`` writes it."""
    return (
        isinstance(event, dict)
        and isinstance(event.get("name"), str)
        and _is_time(event.get("time_ns"))
        and isinstance(event.get("depth_m", ""), int | float | None)
    )


def stranger(metadata: Mapping[str, Any], channels: Collection[str], span_ns: tuple[int, int] | None) -> str | None:
    """Why metadata can only be of another table, or None.

    A table that lost rows or columns since it was written is still the same; one with a channel or a time more is not.

    channels : those of the table. span_ns : its first and last time, UTC ns, or None where it does not tell them.
    """
    more = [name for name in channels if name not in metadata["channels"]]
    if more:
        return f"it tells nothing of {', '.join(more)}"
    told = metadata.get("span_ns")
    if told and span_ns and span_ns[0] < told[0]:
        return f"it starts at {np.datetime64(told[0], 'ns')}, the table at {np.datetime64(span_ns[0], 'ns')}"
    if told and span_ns and span_ns[1] > told[1]:
        return f"it ends at {np.datetime64(told[1], 'ns')}, the table at {np.datetime64(span_ns[1], 'ns')}"
    return None
