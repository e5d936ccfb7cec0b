"""What does a SeaExplorer record? Navigation and payload files, sub or raw."""

from glidercli.logio.seaexplorer.reader import is_seaexplorer, read_seaexplorer

__all__ = ["is_seaexplorer", "read_seaexplorer"]
