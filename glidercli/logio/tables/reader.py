"""How does a plain table become a Part? By its mapping; every row kept or dropped by a named rule, cells counted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from collections.abc import Mapping as MappingOf
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.channels import PHASES
from glidercli.errors import InputError
from glidercli.log import Channel, Log, Origin
from glidercli.logio.reader import Aids, Part
from glidercli.logio.report import FileReport

__all__ = ["ENDINGS", "is_table", "read_table"]

Array = NDArray[np.float64]
Times = NDArray[np.int64]

ENDINGS = (".csv", ".tsv", ".txt", ".dat", ".asc", ".parquet")
"""Of tables that a mapping beside them is sought for."""
LARGEST = 1e200
"""Larger numbers are impossible for any channel, and products with them stay numbers."""
FEW = 3
"""Of fewer channels zeros alone are no sign of a record without content: a depth may be 0."""
UNSAID = "taken as measured: the mapping does not say where the values come from ([file] origin)"


def is_table(path: Path) -> bool:
    """Whether a mapping of columns stands beside the file: NAME.toml, or columns.toml."""
    if path.suffix.lower() not in ENDINGS:
        return False
    from glidercli.logio.tables.mapping_file import mapping_beside

    return mapping_beside(path) is not None


def read_table(path: Path, aids: Aids = Aids()) -> Part:
    """One table by the mapping of ``aids.columns``, else by that beside it; a record is a row.

    Cells that are no number or impossible are left out and counted. Positions of a measured table count as fixes where
    they change at the surface. Raises InputError where there is no mapping, it has faults, or names columns that the
    table does not have.
    """
    from glidercli.logio.netcdf.fixes import fixes
    from glidercli.logio.own.rules import unread_times, unusable
    from glidercli.logio.plausible import quantity_of
    from glidercli.logio.quantities import channel_of
    from glidercli.logio.records import sampled, usable
    from glidercli.logio.tables.cells import read_cells
    from glidercli.logio.tables.mapping_file import load_mapping, mapping_beside
    from glidercli.logio.tables.times import times_of
    from glidercli.logio.whereabouts import whereabouts

    found = aids.columns or mapping_beside(path)
    if found is None:
        raise InputError(path, f"is a table without a mapping; {path.stem}.toml, columns.toml or --columns is needed")
    mapping = load_mapping(found)
    names = list(dict.fromkeys([*mapping.time.names, *(column.column for column in mapping.columns.values())]))
    cells = read_cells(path, names, mapping.file)
    warnings: list[str] = []
    origin: Origin = mapping.file.origin or "measured"
    time_ns = times_of(cells.columns, mapping.time, mapping.missing, mapping.file.decimal)
    shown = _shower(path, mapping.file, cells.columns)
    times, how = mapping.time.names, f'[time] format = "{mapping.time.format}"'
    if line := unread_times(" ".join(times), time_ns, lambda _, row: shown(times, row), f"{how} does not fit"):
        warnings.append(line)
    values = _values(cells.columns, mapping, warnings, shown)
    dropped: Counter[str] = Counter({"wrong number of fields": cells.cut} if cells.cut else {})
    good = usable(time_ns, values if len(values) >= FEW else values | {"": _any(values)}, dropped)
    channels = {}
    for channel, column in mapping.columns.items():
        made = channel_of(
            column.column, time_ns[good], values[channel][good], quantity_of(channel), warnings, column.origin or origin
        )
        if len(made):
            channels[channel] = made
    near = None
    if origin == "measured" and {"latitude", "longitude"} <= values.keys():
        near = whereabouts(time_ns[good], values["latitude"][good], values["longitude"][good])
        places = (values["latitude"][good], values["longitude"][good])
        at = fixes(time_ns[good], *places, channels.get("depth"), None)
        if others := int(np.isfinite(places).all(axis=0).sum()) - len(at):
            warnings.append(f"latitude, longitude: {others} positions left out that are no new fix at the surface")
        for name, place in zip(("latitude", "longitude"), places, strict=True):
            channels[name] = Channel(name, time_ns[good][at], place[at], mapping.columns[name].origin or origin)
    channels = {name: channel for name, channel in channels.items() if len(channel)}
    kept = sampled(time_ns[good], channels)
    if unused := int((~kept).sum()):
        dropped["no usable value"] += unused
    told = {
        "platform": mapping.file.platform,
        "title": mapping.file.title or f"{mapping.file.platform or path.stem} log",
    }
    metadata = {key: text for key, text in told.items() if text} | {
        "columns_note": f"columns and units by {found.name}"
    }
    if mapping.file.origin is None:
        metadata["origin_note"] = UNSAID
        warnings.append(UNSAID)
    error = None if kept.any() or not len(time_ns) + cells.cut else unusable(dropped, warnings)
    report = FileReport(
        path, "table", len(time_ns) + cells.cut, int(kept.sum()), tuple(sorted(dropped.items())), tuple(warnings),
        error, beside=(found,),
    )  # fmt: skip
    return Part(Log(channels, origin, metadata), report, time_ns[good][kept], unread=cells.others, near=near)


def _any(values: MappingOf[str, Array]) -> Array:
    """One where a row has a value, else NaN."""
    return np.where(np.any([np.isfinite(v) for v in values.values()], axis=0), 1.0, np.nan)


def _shower(path: Path, how: Any, columns: MappingOf[str, Any]) -> Callable[[Sequence[str], int], str]:
    """Shows the cells of some columns in a row, and where it stands."""
    from glidercli.logio.tables.cells import place_of

    def shown(names: Sequence[str], row: int) -> str:
        cells = [columns[name][row].as_py() for name in names]
        text = " ".join("" if cell is None else str(cell) for cell in cells)
        return f"{place_of(path, how, row)}: {text[:40]!r}"

    return shown


def _values(
    columns: MappingOf[str, Any], mapping: Any, warnings: list[str], shown: Callable[[Sequence[str], int], str]
) -> dict[str, Array]:
    """The mapped columns by channel, SI, NaN where there is no value."""
    from glidercli.logio.own.cells import has_decimal_comma
    from glidercli.logio.quantities import without_sentinels
    from glidercli.logio.tables.cells import numbers
    from glidercli.named_units import conversion

    values = {}
    for channel, column in mapping.columns.items():
        if channel == "phase":
            values[channel] = _phases(columns[column.column], column, mapping.missing, warnings)
            continue
        recorded = numbers(columns[column.column], mapping.missing, mapping.file.decimal)
        if strange := np.flatnonzero(np.isinf(recorded)).tolist():
            comma = has_decimal_comma(str(columns[column.column][strange[0]].as_py()))
            hint = ' (a decimal comma? [file] decimal = "," reads it)' if comma else ""
            first = shown([column.column], strange[0])
            line = f"{column.column}: {len(strange)} cells left out that are no number, the first in {first}{hint}"
            warnings.append(line)
            recorded[strange] = np.nan
        recorded = without_sentinels(column.column, recorded, mapping.missing.values, warnings)
        to_si = conversion(column.unit, channel)
        assert to_si is not None  # load_mapping has checked it
        bounded = np.clip(recorded, -LARGEST, LARGEST)
        values[channel] = (column.scale * bounded + column.offset) * to_si.factor + to_si.offset
    return values


def _phases(cells: Any, column: Any, missing: Any, warnings: list[str]) -> Array:
    """Phases as indices, NaN where a cell is empty or no phase."""
    from glidercli.logio.tables.cells import words

    known = column.phases or {word: word for word in PHASES}
    texts = np.array(words(cells, missing).to_pylist(), dtype=object)
    values = np.full(len(texts), np.nan)
    for word, phase in known.items():
        values[texts == word] = PHASES.index(phase)
    strange = [text for text, value in zip(texts, values, strict=True) if text is not None and np.isnan(value)]
    if strange:
        few = ", ".join(sorted(set(strange))[:5])
        warnings.append(f"{column.column}: {len(strange)} cells left out that are no phase of the mapping ({few})")
    return values
