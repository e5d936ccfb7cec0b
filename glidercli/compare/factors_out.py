"""How is a table of factors shown and kept? As text for people, and as .csv."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from glidercli.aligned import table
from glidercli.compare.factors import ANGLES, MEASURES
from glidercli.files import atomic, metadata_path

if TYPE_CHECKING:
    from glidercli.compare.factors import Factors, Flown

__all__ = ["text", "write"]

_FORMATS = {"time_to_depth": ".0f", "pitch": ".2f", "pitch_mean": ".2f", "roll": ".1f", "turn": ".0f",
            "turn_rate": ".3f", "window": ".0f"}  # fmt: skip
_SHARES = ("pitch", "turn", "roll", "time_to_depth")
"""Measures whose share the text gives; the .csv has all."""
_BEYOND = ("roll, s", "attack, s", "sideslip, s")
_LEGEND = (
    "deg, on the dive: pitch and roll are medians, mean is the pitch's by time, turn and deg/s are of the heading.",
    "%: share of the base's difference to the published value that is taken away; * further from it than the base.",
    "roll, attack, sideslip: s of the flight with roll beyond 90 deg, with the flow's angles beyond the fitted one.",
)


def text(found: Factors) -> str:
    """The table for people, and what its columns are."""
    numbers = [f"to {found.depth:.0f} m, s", "pitch", "mean", "roll", "turn", "deg/s", "window, s"]
    shares = [f"{name.replace('time_to_depth', 'time')} %" for name in _SHARES]
    rest = [""] * (len(_SHARES) + len(ANGLES))
    rows = [["published", "", *(_number(found.published.get(name), name) for name in MEASURES), *rest]]
    rows += [_row(found, flown) for flown in (found.base, *found.variants)]
    lines = table(["factor", "variant", *numbers, *shares, *_BEYOND], rows, 2)
    return "\n".join([*lines, "", *_LEGEND])


def _row(found: Factors, flown: Flown) -> list[str]:
    numbers = [_number(flown.numbers[name], name) for name in MEASURES]
    shares = [_share(found, flown, name) for name in _SHARES] if flown is not found.base else [""] * len(_SHARES)
    beyond = [f"{flown.beyond[name]:.0f}" for name in ANGLES]
    return [flown.variant.factor, flown.variant.name, *numbers, *shares, *beyond]


def _number(value: float | None, name: str) -> str:
    return "-" if value is None else f"{value:z{_FORMATS[name]}}"


def _share(found: Factors, flown: Flown, name: str) -> str:
    share = found.explained(flown, name)
    return "-" if share is None else f"{share:z.1f}{' *' if found.worse(flown, name) else '  '}"


def write(found: Factors, path: Path, provenance: dict[str, Any], force: bool) -> None:
    """The table as .csv, one row a flight, its provenance beside it; see Factors.write."""
    with atomic(path, force) as part, atomic(metadata_path(path), force) as beside:
        record = json.dumps(provenance, indent=2, allow_nan=False, ensure_ascii=False)
        beside.write_text(record + "\n", encoding="utf-8")
        _rows(found, part)


def _rows(found: Factors, path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as stream:
        out = csv.writer(stream, lineterminator="\n")
        names = [f"{name}_{unit.replace('/', '_')}" for name, (unit, _) in MEASURES.items()]
        shares = [name for name in MEASURES if name in found.published]
        out.writerow(
            ["factor", "variant", "basis", *names, *(f"{name}_explained_percent" for name in shares),
             *(f"{name}_worse" for name in shares), *(f"{name.replace(' ', '_')}_beyond_s" for name in ANGLES),
             "warnings"]
        )  # fmt: skip
        for flown in (found.base, *found.variants):
            one = flown.variant
            out.writerow(
                [one.factor, one.name, one.basis, *(flown.numbers[name] for name in MEASURES),
                 *(found.explained(flown, name) for name in shares), *(found.worse(flown, name) for name in shares),
                 *(flown.beyond[name] for name in ANGLES), "; ".join(flown.warnings)]
            )  # fmt: skip
