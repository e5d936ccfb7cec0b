"""Which tables does a page hold? Verdicts, errors, figures of the flight and events, from the document.

Each function gives the HTML of one section, "" where there is nothing to show. parts : the document of each simulation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from glidercli.compare.facts import Facts
from glidercli.compare.page.html import flat, number, table

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison

__all__ = ["errors", "events", "facts", "outcomes", "worded"]

_VERDICTS = {"agrees": "agrees", "agrees, as given": "open", "disagrees": "disagrees", "not simulated": "open"}
_ERRORS = ("unit", "n", "rmse", "mae", "bias", "std", "max", "correlation", "nrmse")


def facts(comparison: Comparison, parts: Sequence[Mapping[str, Any]]) -> str:
    """Published values with their verdicts; "" for a comparison of logs."""
    if not isinstance(comparison.against, Facts):
        return ""
    text = ""
    for part in parts:
        rows = []
        for one in part["facts"]:
            phase = "" if one["phase"] == "flight" or one["phase"] in one["name"].split() else f" ({one['phase']})"
            remarks = [
                one["tolerance_reason"] and f"tolerance: {one['tolerance_reason']}",
                one["reason"],
                one["note"],
            ]
            rows.append(
                {
                    "value": one["name"] + phase,
                    "published": f"{number(one['published'])} ± {number(one['tolerance'])}",
                    "simulated": one["simulated"],
                    "difference": _difference(one),
                    "unit": one["unit"],
                    "verdict": one["verdict"] + (", as given" if one["given"] and one["verdict"] == "agrees" else ""),
                    "place": one["place"],
                    "remarks": "; ".join(word for word in remarks if word),
                }
            )
        caption = f"{part['name']}: published and simulated values, and simulated less published"
        text += table(caption, rows, classes=_VERDICTS)
    return text


def errors(comparison: Comparison, parts: Sequence[Mapping[str, Any]]) -> str:
    """Errors by channel: side by side, over the flight, by phase and by depth; "" for published values."""
    if isinstance(comparison.against, Facts):
        return ""
    text, word = "", comparison.first.word
    if len(parts) > 1:
        names = dict.fromkeys(name for part in parts for name in part["channels"])
        rows = []
        for name in names:
            units = [part["channels"][name]["unit"] for part in parts if name in part["channels"]]
            rmse = {
                f"{place}: {part['name']}"[:60]: part["channels"].get(name, {}).get("rmse")
                for place, part in enumerate(parts, start=1)
            }
            known = [key for key in rmse if rmse[key] is not None]
            least = min(known, key=lambda key: float(rmse[key]), default=None)
            closest = "" if least is None or len(known) < 2 else least.partition(":")[0]
            rows.append({"channel": name.replace("_", " "), "unit": _unit(units[0]), **rmse, "closest": closest})
        text += table("RMSE of every simulation side by side", rows)
    for part in parts:
        name = part["name"]
        for caption, channels in (
            (f"{name}: errors over the whole flight", part["channels"]),
            (f"{name}: on dives of the {word} log", part["phases"]["dive"]),
            (f"{name}: on climbs of the {word} log", part["phases"]["climb"]),
        ):
            text += table(caption, [_row(channel, one, word) for channel, one in channels.items()])
        for band in part.get("bands") or []:
            caption = f"{name}: from {number(band['from_m'])} to {number(band['to_m'])} m of depth"
            text += table(caption, [_row(channel, one, word) for channel, one in band["channels"].items()])
    return text


def outcomes(comparison: Comparison, parts: Sequence[Mapping[str, Any]]) -> str:
    """Figures of both flights, where the document has them."""
    word = comparison.first.word
    return "".join(
        table(f"{part['name']}: {word} and simulated", [flat(worded(row, word)) for row in part["outcomes"]])
        for part in parts
        if part.get("outcomes")
    )


def events(comparison: Comparison, parts: Sequence[Mapping[str, Any]]) -> str:
    """Events of both logs."""
    text = ""
    heads = {"measured": comparison.first.word, "simulated": "simulated"}
    for part in parts:
        rows = []
        for one in part["events"]:
            sides = {
                f"{word}: {head}": (one[side] or {}).get(key)
                for side, word in heads.items()
                for key, head in (("time_utc", "time, UTC"), ("depth_m", "depth, m"))
            }
            more = {key: one[key] for key in one if key not in ("name", *heads)}
            rows.append({"event": one["name"], **sides, **flat(more)})
        text += table(f"{part['name']}: events in both logs, or in one of them", rows)
    return text


def worded(row: Mapping[str, Any], word: str) -> dict[str, Any]:
    """A row of the document with its key "measured" as the word for the first log, for a head."""
    return {word if key == "measured" else key: value for key, value in row.items()}


def _difference(one: Mapping[str, Any]) -> float | None:
    """Simulated less published; rounding in the last digits is none."""
    difference: float | None = one["difference"]
    if difference is None:
        return None
    return 0.0 if abs(difference) <= 1e-12 * abs(one["published"]) else difference


def _row(channel: str, one: Mapping[str, Any], word: str) -> dict[str, Any]:
    found = flat({"channel": channel.replace("_", " "), **{key: one[key] for key in _ERRORS}})
    found["unit"] = _unit(one["unit"])
    found["left out"] = sum(one["skipped"].values())
    if one.get("origins"):
        found[f"{word} is"], found["simulated is"] = one["origins"]["measured"], one["origins"]["simulated"]
    return found


def _unit(unit: str) -> str | None:
    return None if unit == "1" else unit
