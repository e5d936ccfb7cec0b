"""Which good files are damaged? One of each kind that can be read, small ones, with what must stand beside them."""

from __future__ import annotations

import dataclasses
import functools
import tempfile
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

from glidercli.logio import read, write
from glidercli.logio.formats import format_of, read_file
from glidercli.logio.reader import Aids
from glidercli.ocean.water_file import read_casts, read_currents

Samples = dict[str, dict[int, float]]

ROOT = Path(__file__).parent.parent.parent
SLOCUM = ROOT / "tests/data/slocum"
SEAGLIDER = ROOT / "logs/seaglider-sg561"
PLAIN = "t;depth;pitch\n" + "".join(
    f"2020-01-01T00:{i // 60:02d}:{i % 60:02d}Z;{i / 4};{i % 7 - 20}\n" for i in range(400)
)
CAST = (
    ("depth", "depth", "m", 5.0),
    ("temp", "sea_water_temperature", "degree_Celsius", -0.1),
    ("psal", "sea_water_practical_salinity", "1", 0.05),
)
MAPPING = """[time]
column = "t"
format = "iso"
[columns]
depth = { column = "depth", unit = "m" }
pitch = { column = "pitch", unit = "deg" }
[file]
separator = ";"
"""
_FOLDER = tempfile.TemporaryDirectory(prefix="glider-fuzz-")


@dataclasses.dataclass(frozen=True)
class GoodFile:
    """A file to be damaged.

    text : its records are lines. guarded : checksums guard all samples. beside : files that it needs. read_instead : the
    file that is read, where the damaged one only stands beside it. water : "ctd" or "adcp" for files of profiles.
    times : at most so many times have samples of one record. origin : how the line begins that all times count from.
    """

    path: Path
    text: bool = False
    guarded: bool = False
    beside: tuple[Path, ...] = ()
    read_instead: Path | None = None
    water: str = ""
    times: int = 1
    origin: bytes = b""

    @functools.cached_property
    def target(self) -> Path:
        return self.read_instead or self.path

    @functools.cached_property
    def format(self) -> str | None:
        return format_of(self.target, Aids())

    @functools.cached_property
    def found(self) -> tuple[Samples, Any]:
        return read_samples(self.target, self, None)


def read_samples(path: Path, file: GoodFile, format: str | None) -> tuple[Samples, Any]:
    """The samples of a file by channel and time (or depth), and the account that goes with them."""
    if file.water:
        read = read_casts if file.water == "ctd" else read_currents
        profiles = read(path)
        samples = {
            f"{name} {number}": dict(enumerate(values.tolist()))
            for number, profile in enumerate(profiles)
            for name in ("depth", "temperature", "salinity", "density", "east", "north")
            if (values := getattr(profile, name, None)) is not None
        }
        return samples, [(p.records, p.dropped, p.warnings, p.moment) for p in profiles]
    part = read_file(path, format, Aids())
    report = part.report
    if report.records != report.kept + sum(count for _, count in report.dropped) or report.kept != len(part.record_ns):
        raise AssertionError("records are not kept + dropped")
    samples = {n: dict(zip(c.time_ns.tolist(), c.values.tolist(), strict=True)) for n, c in part.log.channels.items()}
    return samples, (report.error, report.records, report.kept, report.dropped, report.warnings, report.format)


@functools.cache
def _own() -> Path:
    """A folder with a short real log in each of the program's own formats."""
    folder = Path(_FOLDER.name)
    log = read([ROOT / "logs/seaexplorer-sea035/sea035.12.gli.sub.36"]).log
    write(log, *(folder / f"own{ending}" for ending in (".csv", ".mcap", ".nc", ".parquet")))
    with netCDF4.Dataset(folder / "cast.nc", "w") as cast:
        cast.createDimension("depth", 60)
        for name, standard, unit, slope in CAST:
            variable = cast.createVariable(name, "f8", ("depth",))
            variable.setncatts({"standard_name": standard, "units": unit})
            variable[:] = slope * np.arange(60.0) + (10.0 if unit != "m" else 0.0)
    (folder / "plain.csv").write_text(PLAIN)
    (folder / "plain.toml").write_text(MAPPING)
    return folder


def good_files() -> tuple[GoodFile, ...]:
    own = _own()
    return (
        GoodFile(ROOT / "logs/seaexplorer-sea035/sea035.12.gli.sub.36", text=True),
        GoodFile(ROOT / "logs/seaexplorer-sea035/sea035.12.pld1.sub.36", text=True),
        GoodFile(ROOT / "tests/data/seaexplorer/sea063.22.gli.sub.120.gz", guarded=True),
        GoodFile(own / "own.csv", text=True, beside=(own / "own.csv-metadata.json",)),
        GoodFile(own / "own.mcap", guarded=True),
        GoodFile(own / "own.nc", guarded=True),
        GoodFile(own / "own.parquet", guarded=True),
        GoodFile(own / "plain.csv", text=True, beside=(own / "plain.toml",)),
        GoodFile(SLOCUM / "comet-2019-218-00-032.sbd", beside=(SLOCUM / "62d8b5da.cac",)),
        GoodFile(SLOCUM / "comet-2019-218-00-032.tbd", beside=(SLOCUM / "21109dfa.cac",)),
        GoodFile(
            SLOCUM / "62d8b5da.cac", text=True, beside=(SLOCUM / "comet-2019-218-00-032.sbd",),
            read_instead=SLOCUM / "comet-2019-218-00-032.sbd",
        ),
        GoodFile(SLOCUM / "comet-2016-174-05-000.ebd", beside=(SLOCUM / "9e3250d8.cac",)),
        GoodFile(SEAGLIDER / "p5610003.eng", text=True, origin=b"%start:"),
        # $GC has samples where it starts, and where each of three motors stops
        GoodFile(SEAGLIDER / "p5610003.log", text=True, times=4, origin=b"start:"),
        GoodFile(SEAGLIDER / "p5610003.nc"),
        GoodFile(ROOT / "tests/data/netcdf/sg033_20100903T182416_first-rows.nc"),
        GoodFile(ROOT / "tests/data/netcdf/dfo-rosie713-20190615_adjusted.nc"),
        GoodFile(ROOT / "tests/data/ctd/dPIRX010.cnv", text=True, water="ctd"),
        GoodFile(ROOT / "logs/south-china-sea-2011/water.csv", text=True, water="ctd"),
        GoodFile(ROOT / "logs/south-china-sea-2011/current.csv", text=True, water="adcp"),
        GoodFile(own / "cast.nc", water="ctd"),
        GoodFile(ROOT / "tests/data/adcp/RDI_7f79_2.000", water="adcp"),
        GoodFile(ROOT / "tests/data/adcp/Sig100_avg.ad2cp", water="adcp"),
    )  # fmt: skip
