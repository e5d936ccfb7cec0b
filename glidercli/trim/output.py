"""How are trims kept? As a document (.json), a table (.csv, .parquet) or, for sweeps and polars, a picture."""

from __future__ import annotations

import contextlib
import csv
import json
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import OutputError
from glidercli.files import atomic, metadata_path
from glidercli.pictures import PICTURES, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["SUFFIXES", "TABLES", "Answer", "columns_of", "rows_of", "write"]

TABLES = (".json", ".csv", ".parquet")
SUFFIXES = TABLES + PICTURES


class Answer(NamedTuple):
    """What ``glider trim`` found, ready to be kept.

    columns : an array each, by the names of ``Trim.document``. trims : the same as rows for JSON, where they hold more
    than the columns do. beside : what JSON says besides "trims". draw : the picture; None for a single question.
    """

    columns: Mapping[str, NDArray[Any]]
    trims: list[dict[str, Any]] | None
    beside: dict[str, Any]
    draw: Callable[[], Figure] | None

    def document(self) -> dict[str, Any]:
        """The contract's JSON document; non-finite numbers are None."""
        return {"trims": rows_of(self.columns) if self.trims is None else self.trims, **self.beside}


def rows_of(columns: Mapping[str, NDArray[Any]]) -> list[dict[str, Any]]:
    """The rows of a table."""
    names, lists = list(columns), [plain(column) for column in columns.values()]
    return [dict(zip(names, row, strict=True)) for row in zip(*lists, strict=True)]


def columns_of(rows: Sequence[Mapping[str, Any]]) -> dict[str, NDArray[Any]]:
    """The columns of rows that share their names."""
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def plain(column: NDArray[Any]) -> list[Any]:
    """A column as Python values, None for what is not finite."""
    values: list[Any] = column.tolist()
    if column.dtype.kind != "f" or np.isfinite(column).all():
        return values
    return [value if math.isfinite(value) else None for value in values]


def write(answer: Answer, *paths: Path, record: Mapping[str, Any], force: bool = False) -> None:
    """Write every output, or none. record : provenance; it stands inside, but for a .csv beside it."""
    with contextlib.ExitStack() as all_or_none:
        for path in paths:
            part = all_or_none.enter_context(atomic(path, force))
            kind = path.suffix.lower()
            if kind in PICTURES:
                if answer.draw is None:
                    raise OutputError(path, f"one trim makes no picture, a --sweep or --polar does; {' '.join(TABLES)}")
                save(answer.draw, part, json.dumps(record, sort_keys=True))
            elif kind == ".json":
                part.write_text(_json({**answer.document(), "provenance": record}), encoding="utf-8")
            elif kind == ".csv":
                metadata = all_or_none.enter_context(atomic(metadata_path(path), force))
                metadata.write_text(_json(record), encoding="utf-8")
                with part.open("w", encoding="utf-8", newline="") as stream:
                    rows = csv.writer(stream, lineterminator="\n")
                    rows.writerow(answer.columns)
                    rows.writerows(zip(*map(plain, answer.columns.values()), strict=True))
            else:
                _write_parquet(answer, part, record)


def _write_parquet(answer: Answer, path: Path, record: Mapping[str, Any]) -> None:
    """The columns as Parquet, nulls for what is not finite; provenance in the file's own metadata."""
    import pyarrow
    from pyarrow import parquet

    columns = {name: pyarrow.array(plain(column)) for name, column in answer.columns.items()}
    table = pyarrow.table(columns).replace_schema_metadata({"provenance": json.dumps(record, sort_keys=True)})
    parquet.write_table(table, path)


def _json(value: Any) -> str:
    return json.dumps(value, indent=2, allow_nan=False, ensure_ascii=False) + "\n"
