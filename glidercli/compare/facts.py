"""Which published values is a simulation held against? A facts file: TOML, each value with unit, tolerance and place.

    [facts]
    source = "Zhang et al. (2013), Ocean Engineering 60, 1-13"    # required: where the values were published
    title = "Sea trial of 20 July 2011"                           # optional

    [[fact]]
    name = "pitch on the dive"            # required, once per file
    quantity = "mean"                     # required, see the table
    channel = "pitch"                     # for the quantities "of a channel" only, required there
    phase = "dive"                        # "flight" (default: the whole log), "dive" or "climb"
    value = -40.0                         # required
    unit = "deg"                          # required, the quantity's own unit
    tolerance = 5.0                       # required, 0 or more, same unit: agreement is |difference| <= tolerance
    place = "section 5, p. 11"            # required: where in the source
    tolerance_reason = "printed as about" # optional
    given = true                          # optional: the simulation was given this value, so agreeing shows nothing
    note = "..."                          # optional

    quantity                                   unit
    max_depth                                  m
    time_to_max_depth                          s      from the first depth sample of the phase to the deepest one
    duration                                   s      of the phase; of the whole log: from first to last depth sample
    heading_change                             deg    turn made, unwrapped, clockwise positive; summed over all dives
    turn_rate                                  deg/s  heading_change over the time it took
    density_change                             %      of the density at the shallowest sample, to the deepest
    other                                      any    what no log holds: never simulated; the note, required, says why
    mean, median, minimum, maximum, range,     the channel's unit in tables (pitch: deg)
    first, last                                of a channel; the mean by time (trapezoids), the median by samples

Every fault of a file is reported at once. Angles on the circle are unwrapped in time, and a mean, median, minimum,
maximum, first or last of them is compared on the circle.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from glidercli.channels import CHANNELS
from glidercli.dives import LEGS
from glidercli.errors import InputError
from glidercli.files import read_toml

__all__ = ["CHANNEL_QUANTITIES", "FLIGHT", "LOG_QUANTITIES", "OTHER", "Fact", "Facts", "read_facts"]

FLIGHT = "flight"
"""The phase that stands for the whole log."""

LOG_QUANTITIES = {
    "max_depth": "m",
    "time_to_max_depth": "s",
    "duration": "s",
    "heading_change": "deg",
    "turn_rate": "deg/s",
    "density_change": "%",
}
"""Quantities of a log and their units."""

OTHER = "other"
"""The quantity of a published value that no log holds, as the sampling of an instrument; its unit is free."""

CHANNEL_QUANTITIES = ("mean", "median", "minimum", "maximum", "range", "first", "last")
"""Quantities of one channel, in its table unit."""


@dataclasses.dataclass(frozen=True)
class Fact:
    """One published value; value and tolerance in ``unit``; the other fields as in the file."""

    name: str
    quantity: str
    value: float
    unit: str
    tolerance: float
    place: str
    phase: str = FLIGHT
    channel: str | None = None
    tolerance_reason: str = ""
    given: bool = False
    note: str = ""


@dataclasses.dataclass(frozen=True)
class Facts:
    """The published values of one source."""

    source: str
    title: str
    facts: tuple[Fact, ...]


_HEAD = {"source": True, "title": False}
_TEXTS = {
    "name": True, "quantity": True, "unit": True, "place": True, "phase": False, "channel": False,
    "tolerance_reason": False, "note": False,
}  # fmt: skip
"""Keys that hold text, and whether each is required."""
_NUMBERS = ("value", "tolerance")


def read_facts(path: Path) -> Facts:
    """The facts of a TOML file.

    Raises InputError naming every fault of the file: unknown or missing keys, wrong kinds, units, quantities, names.
    """
    document = read_toml(path, "a facts file")
    faults = [f"{key}: unknown; allowed: [facts], [[fact]]" for key in document if key not in ("facts", "fact")]
    head, entries = document.get("facts"), document.get("fact")
    if not isinstance(head, dict):
        faults.append("[facts]: missing; it names the source")
        head = None
    else:
        faults += _texts("facts", head, _HEAD)
    if not isinstance(entries, list) or not entries or not all(isinstance(entry, dict) for entry in entries):
        faults.append("[[fact]]: missing; at least one published value is needed")
        entries = []
    names: set[str] = set()
    for number, entry in enumerate(entries, start=1):
        where = f"fact {number}"
        name = entry.get("name")
        if isinstance(name, str) and name:
            where += f" ({name})"
            if name in names:
                faults.append(f"{where}.name: used twice")
            names.add(name)
        faults += _faults(where, entry)
    if faults or head is None:
        raise InputError(path, "; ".join(faults))
    facts = tuple(Fact(**{**entry, **{key: float(entry[key]) for key in _NUMBERS}}) for entry in entries)
    return Facts(head["source"], head.get("title", ""), facts)


def _texts(where: str, table: Mapping[str, Any], keys: Mapping[str, bool], others: tuple[str, ...] = ()) -> list[str]:
    """Faults of the texts of a table, and keys that it does not know."""
    faults = [
        f"{where}.{key}: unknown; allowed: {', '.join((*keys, *others))}"
        for key in table
        if key not in keys and key not in others
    ]
    for key, required in keys.items():
        if key not in table:
            if required:
                faults.append(f"{where}.{key}: missing")
        elif not isinstance(table[key], str) or (required and not table[key].strip()):
            faults.append(f"{where}.{key} = {table[key]!r}; allowed: a text")
    return faults


def _faults(where: str, entry: Mapping[str, Any]) -> list[str]:
    """Faults of one [[fact]]."""
    faults = _texts(where, entry, _TEXTS, (*_NUMBERS, "given"))
    if not isinstance(entry.get("given", False), bool):
        faults.append(f"{where}.given = {entry['given']!r}; allowed: true, false")
    for key in _NUMBERS:
        value = entry.get(key)
        if key not in entry:
            faults.append(f"{where}.{key}: missing")
        elif isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
            faults.append(f"{where}.{key} = {value!r}; allowed: a finite number")
        elif key == "tolerance" and value < 0:
            faults.append(f"{where}.tolerance = {value!r}; allowed: 0 or more")
    phase = entry.get("phase", FLIGHT)
    if isinstance(phase, str) and phase not in (FLIGHT, *LEGS):
        faults.append(f"{where}.phase = {phase!r}; allowed: {', '.join((FLIGHT, *LEGS))}")
    quantity = entry.get("quantity")
    if isinstance(quantity, str):
        faults += _quantity_faults(where, quantity, entry)
    return faults


def _quantity_faults(where: str, quantity: str, entry: Mapping[str, Any]) -> list[str]:
    """Faults of quantity, channel and unit together."""
    channel, unit = entry.get("channel"), entry.get("unit")
    if quantity in LOG_QUANTITIES:
        faults = [f"{where}.channel: {quantity} takes none"] if "channel" in entry else []
        right = LOG_QUANTITIES[quantity]
    elif quantity in CHANNEL_QUANTITIES:
        known = [name for name in CHANNELS if name != "phase"]
        if "channel" not in entry:
            return [f"{where}.channel: missing; {quantity} needs one"]
        if not isinstance(channel, str) or channel not in known:
            return [f"{where}.channel = {channel!r}; allowed: {', '.join(known)}"]
        faults, right = [], CHANNELS[channel].column_unit
    elif quantity == OTHER:
        faults = [f"{where}.{key}: {OTHER} takes none" for key in ("channel", "phase") if key in entry]
        noted = isinstance(entry.get("note"), str) and entry["note"].strip()
        return faults if noted else [*faults, f"{where}.note: missing; it says why no log holds the value"]
    else:
        allowed = ", ".join((*LOG_QUANTITIES, OTHER, *CHANNEL_QUANTITIES))
        return [f"{where}.quantity = {quantity!r}; allowed: {allowed}"]
    if isinstance(unit, str) and unit != right:
        faults.append(f"{where}.unit = {unit!r}; allowed for this quantity: {right}")
    return faults
