"""How do logs come in and go out? One reader per family, one writer per output, picked by content and by ending."""

from glidercli.logio.formats import FORMATS
from glidercli.logio.overview import Overview, overview
from glidercli.logio.reading import Reading, read
from glidercli.logio.replaying import Replay, replay
from glidercli.logio.report import FileReport
from glidercli.logio.writing import SUFFIXES, VIEWERS, Saving, saving, write

__all__ = [
    "FORMATS", "SUFFIXES", "VIEWERS", "FileReport", "Overview", "Reading", "Replay", "Saving", "overview", "read",
    "replay", "saving", "write",
]  # fmt: skip
