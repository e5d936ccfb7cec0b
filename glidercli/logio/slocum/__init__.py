"""What does a Slocum glider record? Navigation and science files, full, medium and short, compressed or not."""

from glidercli.logio.slocum.reader import is_slocum, read_slocum
from glidercli.logio.slocum.sensors import sensors

__all__ = ["is_slocum", "read_slocum", "sensors"]
