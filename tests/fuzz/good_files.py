"""Which good files are damaged? One of each kind that can be read, small ones, with what must stand beside them."""

from __future__ import annotations

import dataclasses
import functools
import tempfile
from pathlib import Path

from glidercli.logio import read, write
from glidercli.logio.formats import format_of, read_file
from glidercli.logio.reader import Aids, Part

ROOT = Path(__file__).parent.parent.parent
_FOLDER = tempfile.TemporaryDirectory(prefix="glider-fuzz-")


@dataclasses.dataclass(frozen=True)
class GoodFile:
    """text : its records are lines. guarded : checksums guard all samples. beside : files that it needs."""

    path: Path
    text: bool = False
    guarded: bool = False
    beside: tuple[Path, ...] = ()
    aids: Aids = dataclasses.field(default_factory=Aids)

    @functools.cached_property
    def format(self) -> str | None:
        return format_of(self.path, self.aids)

    @functools.cached_property
    def part(self) -> Part:
        return read_file(self.path, None, self.aids)


@functools.cache
def _own() -> Path:
    """A folder with a short real log in each of the program's own formats."""
    folder = Path(_FOLDER.name)
    log = read([ROOT / "logs/seaexplorer-sea035/sea035.12.gli.sub.36"]).log
    write(log, *(folder / f"own{ending}" for ending in (".csv", ".mcap")))
    return folder


def good_files() -> tuple[GoodFile, ...]:
    own = _own()
    return (
        GoodFile(ROOT / "logs/seaexplorer-sea035/sea035.12.gli.sub.36", text=True),
        GoodFile(ROOT / "logs/seaexplorer-sea035/sea035.12.pld1.sub.36", text=True),
        GoodFile(ROOT / "tests/data/seaexplorer/sea063.22.gli.sub.120.gz", guarded=True),
        GoodFile(own / "own.csv", text=True, beside=(own / "own.csv-metadata.json",)),
        GoodFile(own / "own.mcap", guarded=True),
    )
