"""A text that ends in the middle of a line says so, and its good records are kept; a missing line end is no fault."""

from __future__ import annotations

import gzip
import shutil
from pathlib import Path

import pytest
from conftest import ROOT, Run, one_line_error

from glidercli.errors import InputError
from glidercli.logio import read
from glidercli.logio.report import FileReport

NAVIGATION = ROOT / "logs/seaexplorer-sea035/sea035.12.gli.sub.37"
PAYLOAD = ROOT / "logs/seaexplorer-sea035/sea035.12.pld1.sub.37"
PACKED = ROOT / "tests/data/seaexplorer/sea063.22.gli.sub.120.gz"
ENG = ROOT / "logs/seaglider-sg561/p5610003.eng"
LOG = ROOT / "logs/seaglider-sg561/p5610003.log"
TEXTS = (NAVIGATION, PAYLOAD, PACKED, ENG, LOG)
CUT = "ends in the middle of a line: only what stands before it was read"


def one(path: Path) -> FileReport:
    (report,) = read([path]).files
    assert report.records == report.kept + sum(count for _, count in report.dropped)
    return report


def bytes_of(path: Path) -> bytes:
    return gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.name)
def test_a_cut_text_says_so(path: Path, tmp_path: Path) -> None:
    """Cut ten bytes into each of the last lines of samples in turn."""
    lines = bytes_of(path).splitlines(keepends=True)
    target = tmp_path / path.name.removesuffix(".gz")
    told = [
        i for i, line in enumerate(lines) if not line.startswith(b"$") or line.startswith((b"$GC,", b"$ST", b"$GPS,"))
    ]
    for count in told[-6:]:
        target.write_bytes(b"".join(lines[:count]))
        before = one(target)
        assert before.error is None
        target.write_bytes(b"".join(lines[:count]) + lines[count][:10])
        cut = one(target)
        assert cut.error == CUT
        assert (cut.records, cut.kept) == (before.records + 1, before.kept)


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.name)
@pytest.mark.parametrize("end", [b"", b"\r", b"\r\n", b"\n\n  \n", b"\n  "])
def test_a_whole_last_line_is_whole_whatever_ends_it(path: Path, end: bytes, tmp_path: Path) -> None:
    target = tmp_path / path.name.removesuffix(".gz")
    target.write_bytes(bytes_of(path).rstrip(b"\r\n") + end)
    report = one(target)
    assert report.error is None
    assert report.kept == one(path).kept


def test_a_cut_position_is_no_fix(tmp_path: Path) -> None:
    """8 degrees 34 minutes cut after two digits would be 0 degrees 8 minutes."""
    data = LOG.read_bytes()
    last = data.rindex(b"$GPS,")
    cut = data[: last + data[last:].index(b",835.") + 3]
    (tmp_path / LOG.name).write_bytes(cut)
    reading = read([tmp_path / LOG.name])
    assert reading.files[0].error == CUT
    assert ("cut short", 1) in reading.files[0].dropped
    longitudes = read([LOG]).log["longitude"].values
    assert reading.log["longitude"].values.tolist() == longitudes[:-1].tolist()


def test_a_cut_log_beside_a_eng_is_told(tmp_path: Path) -> None:
    shutil.copy(ENG, tmp_path)
    (tmp_path / LOG.name).write_bytes(LOG.read_bytes()[:-30])
    assert f"{LOG.name} beside it: {CUT}" in one(tmp_path / ENG.name).warnings
    (tmp_path / f"{LOG.name}.gz").write_bytes(gzip.compress(LOG.read_bytes())[:-30])
    (tmp_path / LOG.name).unlink()
    assert any("beside it: gzip data cut short" in warning for warning in one(tmp_path / ENG.name).warnings)


def test_strict_refuses_it(tmp_path: Path, glider: Run) -> None:
    (tmp_path / NAVIGATION.name).write_bytes(NAVIGATION.read_bytes()[:-40])
    assert glider("replay", str(tmp_path / NAVIGATION.name)).returncode == 0
    assert CUT in one_line_error(glider("replay", "--strict", str(tmp_path / NAVIGATION.name)))


def test_a_eng_without_a_usable_row_beside_its_log_is_named(tmp_path: Path) -> None:
    shutil.copy(LOG, tmp_path)
    head, _, rows = ENG.read_text("latin-1").partition("%data:\n")
    names = next(line for line in head.split("\n") if line.startswith("%columns:")).removeprefix("%columns:").split(",")
    place = [name.strip() for name in names].index("elaps_t")
    garbled = []
    for row in rows.split("\n")[:-1]:
        cells = row.split()
        cells[place] = "x"
        garbled.append(" ".join(cells))
    (tmp_path / ENG.name).write_text(f"{head}%data:\n" + "\n".join(garbled) + "\n", "latin-1")
    with pytest.raises(InputError, match=f"no usable record: {len(garbled)} time cannot be read"):
        read([tmp_path / ENG.name])
    bad, good = read([tmp_path]).files
    assert (bad.kept, bad.records) == (0, len(garbled))
    assert good.kept > 0


@pytest.mark.parametrize("start", ["5 4 116 18 360 9", "5 4 116 0360 12 9", "5 4 116 18 12 9000", "2 30 116 0 0 0"])
def test_a_start_that_is_no_time_is_said_once(start: str, tmp_path: Path, glider: Run) -> None:
    """Also on stderr: a warning of the library that takes times apart stood before it."""
    lines = ENG.read_text("latin-1").split("\n")
    changed = [f"%start: {start}" if line.startswith("%start:") else line for line in lines]
    (tmp_path / "a.eng").write_text("\n".join(changed), "latin-1")
    done = glider("info", str(tmp_path / "a.eng"))
    assert f'start "{start}" is no time' in one_line_error(done)
    assert "UserWarning" not in done.stderr
