"""What do plain tables hold, CSV or Parquet? What a small TOML file says of their columns and units."""

from glidercli.logio.tables.reader import ENDINGS, is_table, read_table

__all__ = ["ENDINGS", "is_table", "read_table"]
