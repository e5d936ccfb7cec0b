"""How much of a difference to published values does each suspected factor explain? One change of a mission at a time.

A variant is a mission flown again with parameters of the model, fields of the mission, columns of its control tables or
the equations changed. Of each flight the same numbers are taken as of the base, and with a published value P

    explained = 100 (base - variant) / (base - P)    %

100 % meets P, more passes it, a negative share leads away from it. Shares of several variants need not add up.
"""

from __future__ import annotations

import csv
import dataclasses
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from glidercli.compare.facts import Fact, Facts
from glidercli.compare.verdicts import judged
from glidercli.errors import InputError
from glidercli.log import Log
from glidercli.units import NANOSECOND

__all__ = ["ANGLES", "MEASURES", "Factors", "Flown", "Variant", "explained", "factors", "measured", "worse"]

BASE = "base"


def _on_the_dive(quantity: str, unit: str, channel: str | None = None) -> Fact:
    return Fact("", quantity, 0.0, unit, 0.0, "", phase="dive", channel=channel)


MEASURES: dict[str, tuple[str, Fact | None]] = {
    "time_to_depth": ("s", None),
    "pitch": ("deg", _on_the_dive("median", "deg", "pitch")),
    "pitch_mean": ("deg", _on_the_dive("mean", "deg", "pitch")),
    "roll": ("deg", _on_the_dive("median", "deg", "roll")),
    "turn": ("deg", _on_the_dive("heading_change", "deg")),
    "turn_rate": ("deg/s", _on_the_dive("turn_rate", "deg/s")),
    "window": ("s", Fact("", "duration", 0.0, "s", 0.0, "")),
}
"""What is taken of each flight: unit, and the quantity of facts.py that it is. pitch and roll are medians, pitch_mean
is by time; time_to_depth is until a given depth is first reached, between samples by a straight line."""

ANGLES = ("roll", "angle of attack", "sideslip")
"""What leaves the model: roll beyond 90 deg, the flow's angles beyond what the coefficients were fitted to."""


@dataclasses.dataclass(frozen=True)
class Variant:
    """One change of a mission.

    factor, name : what is suspected, and what of it this variant changes. basis : where its numbers come from.
    parameters : of the model by symbol, SI (``simulate``'s changes). mission : fields of the Mission; None takes one
    out. controls : "leg.column" of control tables, each held at one value throughout. equations : "full" or "paper".
    """

    factor: str
    name: str
    basis: str = ""
    parameters: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    mission: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    controls: Mapping[str, float] = dataclasses.field(default_factory=dict)
    equations: str = "full"

    def and_(self, *others: Variant, factor: str = "together", name: str = "") -> Variant:
        """This change and others at once; where two change the same, the last one holds."""
        parts = (self, *others)
        unlike = [part.equations for part in parts if part.equations != "full"]
        return Variant(
            factor,
            name or ", ".join(part.name for part in parts),
            "; ".join(dict.fromkeys(part.basis for part in parts)),
            {key: value for part in parts for key, value in part.parameters.items()},
            {key: value for part in parts for key, value in part.mission.items()},
            {key: value for part in parts for key, value in part.controls.items()},
            unlike[-1] if unlike else "full",
        )


@dataclasses.dataclass(frozen=True)
class Flown:
    """A variant's flight.

    numbers : by the names of MEASURES, None where it has none. beyond : s, by ANGLES. warnings : simulate's.
    """

    variant: Variant
    numbers: Mapping[str, float | None]
    beyond: Mapping[str, float]
    warnings: tuple[str, ...]


@dataclasses.dataclass(frozen=True)
class Factors:
    """The base and its variants. published : by the names of MEASURES, where there is such a fact."""

    base: Flown
    variants: tuple[Flown, ...]
    published: Mapping[str, float]
    depth: float

    def explained(self, flown: Flown, measure: str) -> float | None:
        """Share of the base's difference to the published value that a variant takes away, %."""
        return explained(self.base.numbers[measure], flown.numbers[measure], self.published.get(measure))

    def worse(self, flown: Flown, measure: str) -> bool:
        """Whether a variant is further from the published value than the base is."""
        return worse(self.base.numbers[measure], flown.numbers[measure], self.published.get(measure))

    def text(self) -> str:
        """The table for people, and what its columns are."""
        from glidercli.compare.factors_out import text

        return text(self)

    def write(self, path: Path, provenance: dict[str, Any], force: bool = False) -> None:
        """The table as .csv, with its provenance beside it; an empty cell is no value.

        Raises OutputError when the file exists and force is not given, or cannot be written.
        """
        from glidercli.compare.factors_out import write

        write(self, path, provenance, force)


def explained(base: float | None, variant: float | None, published: float | None) -> float | None:
    """100 (base - variant) / (base - published), %; None where a number is missing or the base has no difference."""
    if base is None or variant is None or published is None or base == published:
        return None
    return 100.0 * (base - variant) / (base - published)


def worse(base: float | None, variant: float | None, published: float | None) -> bool:
    """Whether the variant is further from the published value than the base; False where a number is missing."""
    if base is None or variant is None or published is None:
        return False
    return abs(variant - published) > abs(base - published)


def factors(mission: str | Path, variants: Sequence[Variant], facts: Facts, depth: float) -> Factors:
    """Fly a mission as it stands and in each variant.

    mission : file or shipped name. depth : m, of time_to_depth.
    facts : published values; the one of the same quantity, channel and phase is a measure's, that of
        time_to_max_depth time_to_depth's.

    Raises InputError for a variant of what is not there, and as ``simulate`` does.
    """
    base, *others = (_flown(mission, one, depth) for one in (Variant(BASE, "as it stands"), *variants))
    return Factors(base, tuple(others), _published(facts), depth)


def _published(facts: Facts) -> dict[str, float]:
    of = {(fact.quantity, fact.channel, fact.phase): fact.value for fact in reversed(facts.facts)}
    found = {"time_to_depth": of.get(("time_to_max_depth", None, "flight"))}
    asked = {name: fact for name, (_, fact) in MEASURES.items() if fact is not None}
    found |= {name: of.get((fact.quantity, fact.channel, fact.phase)) for name, fact in asked.items()}
    return {name: value for name, value in found.items() if value is not None}


def measured(log: Log, depth: float) -> dict[str, float | None]:
    """The numbers of MEASURES of a log; None where it does not hold one. depth : m, of time_to_depth."""
    asked = {name: fact for name, (_, fact) in MEASURES.items() if fact is not None}
    verdicts = judged(Facts("", "", tuple(asked.values())), log)
    numbers = dict(zip(asked, (one.simulated for one in verdicts), strict=True))
    return {"time_to_depth": _time_to(log, depth), **numbers}


def _time_to(log: Log, depth: float) -> float | None:
    """Time from the first sample until a depth, m, is first reached, s."""
    channel = log["depth"]
    deep = channel.values >= depth
    if not deep.any():
        return None
    last = max(int(np.argmax(deep)), 1)
    times = (channel.time_ns[last - 1 : last + 1] - channel.time_ns[0]) * NANOSECOND
    return float(np.interp(depth, channel.values[last - 1 : last + 1], times))


def _flown(mission: str | Path, variant: Variant, depth: float) -> Flown:
    """A variant's flight."""
    from glidercli.simulation import simulate
    from glidercli.simulation.mission_file import load_mission

    plan, path = load_mission(mission)
    known = {field.name for field in dataclasses.fields(plan)}
    if strange := [key for key in variant.mission if key not in known]:
        allowed = ", ".join(sorted(known))
        raise InputError(f"variant {variant.name}", f"mission.{strange[0]}: unknown; allowed: {allowed}")
    plan = dataclasses.replace(plan, **variant.mission)
    with tempfile.TemporaryDirectory() as folder:
        for leg in {key.partition(".")[0] for key in variant.controls}:
            plan = _with_table(plan, path, leg, variant, Path(folder))
        run = simulate((plan, path), changes=variant.parameters, equations=variant.equations)
    beyond = {name: sum(one.duration for one in run.excursions if one.name == name) for name in ANGLES}
    return Flown(variant, measured(run.log, depth), beyond, run.warnings)


def _with_table(plan: Any, path: Path, name: str, variant: Variant, folder: Path) -> Any:
    """The mission with columns of the table of one leg held at a variant's values."""
    values = {key.partition(".")[2]: value for key, value in variant.controls.items() if key.startswith(f"{name}.")}
    leg = next((leg for leg in plan.leg if getattr(leg, "name", None) == name and hasattr(leg, "controls")), None)
    if leg is None:
        raise InputError(f"variant {variant.name}", f"controls: {path} has no leg {name} with a table")
    with (path.parent / leg.controls).open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    if strange := [column for column in values if column not in rows[0]]:
        raise InputError(f"variant {variant.name}", f"controls: {leg.controls} has no column {strange[0]}")
    with (folder / f"{name}.csv").open("w", encoding="utf-8", newline="") as stream:
        out = csv.DictWriter(stream, rows[0])
        out.writeheader()
        out.writerows({**row, **values} for row in rows)
    changed = dataclasses.replace(leg, controls=str(folder / f"{name}.csv"))
    return dataclasses.replace(plan, leg=tuple(changed if one is leg else one for one in plan.leg))
