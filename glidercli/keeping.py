"""How is a command's answer kept? Columns as .csv and .parquet, a document as .json, a picture, a vehicle file."""

from __future__ import annotations

import contextlib
import csv
import json
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TextIO

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import OutputError
from glidercli.files import atomic, metadata_path
from glidercli.pictures import PICTURES, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["TABLES", "Kept", "keep", "plain", "write_csv"]

TABLES = (".json", ".csv", ".parquet")


class Kept(NamedTuple):
    """What a command found, ready to be kept.

    columns : a sequence each, by name with unit. document : what .json holds. draw : the picture, or None.
    vehicle : text of a vehicle file, or "".
    """

    columns: Mapping[str, Sequence[Any] | NDArray[Any]]
    document: Mapping[str, Any]
    draw: Callable[[], Figure] | None = None
    vehicle: str = ""


def keep(found: Kept, *paths: Path, record: Mapping[str, Any], force: bool = False) -> None:
    """Write every output, or none. record : provenance; it stands inside, but for a .csv beside it."""
    with contextlib.ExitStack() as all_or_none:
        for path in paths:
            part = all_or_none.enter_context(atomic(path, force))
            kind = path.suffix.lower()
            if kind in PICTURES and found.draw is not None:
                save(found.draw, part, json.dumps(record, sort_keys=True))
            elif kind == ".toml" and found.vehicle:
                part.write_text(found.vehicle + _comment(record), encoding="utf-8")
            elif kind == ".json":
                part.write_text(_json({**found.document, "provenance": record}), encoding="utf-8")
            elif kind == ".csv":
                beside = all_or_none.enter_context(atomic(metadata_path(path), force))
                beside.write_text(_json(record), encoding="utf-8")
                with part.open("w", encoding="utf-8", newline="") as stream:
                    write_csv(found, stream)
            elif kind == ".parquet":
                _write_parquet(found, part, record)
            else:
                raise OutputError(path, f"unknown output {kind or 'without ending'}")


def write_csv(found: Kept, stream: TextIO) -> None:
    """The columns as CSV; what is not finite is an empty cell."""
    rows = csv.writer(stream, lineterminator="\n")
    rows.writerow(found.columns)
    rows.writerows(zip(*map(plain, found.columns.values()), strict=True))


def plain(column: Sequence[Any] | NDArray[Any]) -> list[Any]:
    """A column as Python values, None for what is not finite."""
    values = column.tolist() if isinstance(column, np.ndarray) else list(column)
    return [None if isinstance(value, float) and not math.isfinite(value) else value for value in values]


def _comment(record: Mapping[str, Any]) -> str:
    """Provenance at the end of a vehicle file: the command, then a line for each file that it read."""
    lines = [f"# Made by {record['program']}, {json.dumps(record['command'], ensure_ascii=False)}"]
    lines += [
        f"#   from {json.dumps(item['path'], ensure_ascii=False)}, sha256 {item['sha256']}" for item in record["inputs"]
    ]
    return "".join(f"\n{line}" for line in lines) + "\n"


def _write_parquet(found: Kept, path: Path, record: Mapping[str, Any]) -> None:
    import pyarrow
    from pyarrow import parquet

    columns = {name: pyarrow.array(plain(column)) for name, column in found.columns.items()}
    table = pyarrow.table(columns).replace_schema_metadata({"provenance": json.dumps(record, sort_keys=True)})
    parquet.write_table(table, path)


def _json(value: Any) -> str:
    return json.dumps(value, indent=2, allow_nan=False, ensure_ascii=False) + "\n"
