"""How does a Log stand in a Parquet file? The table of the CSV, units and origin of every column in its schema."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from glidercli.channels import by_column
from glidercli.log import Log

__all__ = ["METADATA_KEY", "ParquetTable"]

METADATA_KEY = "glidercli"
"""Of the file's metadata: the JSON that stands beside a CSV."""


class ParquetTable:
    """A log as Parquet, piece by piece, each a row group; columns and units of the contract."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._writer: Any = None
        self._zero_ns = 0

    def add(self, log: Log) -> None:
        """Append a piece; all have the same channels."""
        import pyarrow as pa
        from pyarrow import parquet

        if self._writer is None:
            self._zero_ns = log.start_ns if any(map(len, log.channels.values())) else 0
        table = log.table(self._zero_ns)
        table["time_utc"] = table["time_utc"].dt.tz_localize("UTC")
        if self._writer is None:
            self._schema = pa.schema([_field(pa, log, str(name)) for name in table.columns])
            self._writer = parquet.ParquetWriter(self._path, self._schema, compression="zstd", write_page_checksum=True)
        self._writer.write_table(pa.Table.from_pandas(table, self._schema, preserve_index=False))

    def close(self, metadata: Mapping[str, Any]) -> None:
        """Finish the file. metadata : what else the log says, as for CSV."""
        self._writer.add_key_value_metadata({METADATA_KEY: json.dumps(metadata)})
        self._writer.close()


def _field(pa: Any, log: Log, column: str) -> Any:
    """A column's type, unit, meaning and origin."""
    if column == "time_utc":
        return pa.field(column, pa.timestamp("ns", tz="UTC"))
    spec = by_column(column)
    if spec is None:
        return pa.field(column, pa.float64(), metadata={"unit": "s", "meaning": "since the first sample"})
    told = {"unit": spec.column_unit, "meaning": spec.meaning, "origin": log[spec.name].origin}
    return pa.field(column, pa.string() if spec.name == "phase" else pa.float64(), metadata=told)
