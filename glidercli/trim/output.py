"""How are trims kept? As a document (.json), a table (.csv, .parquet) or, for sweeps and polars, a picture."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import OutputError
from glidercli.keeping import TABLES, Kept, keep, plain
from glidercli.pictures import PICTURES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["SUFFIXES", "Answer", "columns_of", "rows_of", "write"]

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


def write(answer: Answer, *paths: Path, record: Mapping[str, Any], force: bool = False) -> None:
    """Write every output, or none. record : provenance; it stands inside, but for a .csv beside it."""
    pictures = [path for path in paths if path.suffix.lower() in PICTURES]
    if pictures and answer.draw is None:
        told = f"one trim makes no picture, a --sweep or --polar does; {' '.join(TABLES)}"
        raise OutputError(pictures[0], told)
    keep(Kept(answer.columns, answer.document(), answer.draw), *paths, record=record, force=force)
