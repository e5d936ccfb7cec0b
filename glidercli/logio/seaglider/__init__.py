"""What does a Seaglider record? A basestation .nc, and the .eng and .log texts that it was made of."""

from glidercli.logio.seaglider.reader import is_seaglider, read_seaglider

__all__ = ["is_seaglider", "read_seaglider"]
