"""ADCP binaries against a parse of their bytes that shares nothing with the library that reads them."""

from __future__ import annotations

import importlib.util
import os
import struct
import sys
from pathlib import Path

import gsw
import numpy as np
import pytest

from glidercli.errors import InputError
from glidercli.ocean.kind import AD2CP, PD0
from glidercli.ocean.record_ends import remarks_on_ends
from glidercli.ocean.water_file import read_currents

from .pd0 import ensembles, in_frame

ADCP = Path(__file__).parents[2] / "data" / "adcp"


def test_the_extra_is_installed():
    assert importlib.util.find_spec("mhkit"), "make installs it; without it nothing below is tested"


def test_a_moored_instrument_that_looks_up(tmp_path):
    (profile,) = read_currents(ADCP / "RDI_7f79_2.000")
    both = ensembles((ADCP / "RDI_7f79_2.000").read_bytes())
    assert len(both) == 2
    depth = both[0].depth - both[0].ranges
    velocity = np.nanmean([one.velocity for one in both], axis=0)
    kept = both[0].ranges <= both[0].depth * np.cos(np.radians(20.0))  # the beams of a WorkHorse stand at 20 deg
    assert profile.depth == pytest.approx(depth[kept][::-1], abs=1e-5)  # single precision of 20 m
    assert profile.east == pytest.approx(velocity[0, kept][::-1], abs=1e-7)  # single precision of 0.4 m/s
    assert profile.north == pytest.approx(velocity[1, kept][::-1], abs=1e-7)
    assert profile.up == pytest.approx(velocity[2, kept][::-1], abs=1e-7)
    assert profile.records == 40
    assert any("declination is 0" in line for line in profile.warnings)
    assert any("no bottom track" in line for line in profile.warnings)


def test_a_boats_motion_is_taken_off_by_bottom_track():
    profiles = read_currents(ADCP / "RDI_withBT.000")
    all_pings = ensembles((ADCP / "RDI_withBT.000").read_bytes())
    usable = [
        one
        for one in all_pings
        if np.isfinite(one.velocity[:3]).all(axis=0).any() and np.isfinite(one.bottom_velocity[:3]).all()
    ]
    told = profiles[0].warnings[0]
    assert told.startswith(f"{len(usable)} ensembles averaged over 10 min to {len(profiles)} profiles")
    # The first bin, over the whole record: means of means weigh pings a little differently, 0.01 m/s. The boat itself
    # moves at up to 0.2 m/s.
    expected = np.nanmean([one.velocity[:2, 0] - one.bottom_velocity[:2] for one in usable], axis=0)
    found = np.mean([(p.east[0], p.north[0]) for p in profiles], axis=0)
    assert found == pytest.approx(expected, abs=0.01)
    assert all(p.depth[0] == pytest.approx(usable[0].ranges[0] + 0.3, abs=0.4) for p in profiles)  # 0 to 0.7 m deep
    assert all(np.abs(p.east).max() < 1.0 for p in profiles)  # no -32.768, no difference with one
    assert all(p.depth[-1] < 11.5 for p in profiles)  # the deepest bottom range there
    assert not any("no bottom track" in line for line in profiles[0].warnings)


def averages(data: bytes) -> list[dict[str, np.ndarray]]:
    """Average records (0x16, version 3) of an .ad2cp by the maker's description (Integrators Guide AD2CP)."""
    found, at = [], 0
    while at + 10 <= len(data):
        size, kind, length = data[at + 1], data[at + 2], struct.unpack_from("<H", data, at + 4)[0]
        body = data[at + size : at + size + length]
        if kind == 0x16 and len(body) == length:
            cells, beams = struct.unpack_from("<H", body, 30)[0] & 0x3FF, struct.unpack_from("<H", body, 30)[0] >> 12
            scale = 10.0 ** struct.unpack_from("<b", body, 58)[0]
            raw = np.frombuffer(body, "<i2", cells * beams, body[1]).reshape(beams, cells)
            found.append(
                {
                    "velocity": np.where(raw == -32768, np.nan, raw * scale),
                    "dbar": struct.unpack_from("<I", body, 20)[0] / 1000.0,
                    "cell": struct.unpack_from("<H", body, 32)[0] / 1000.0,
                    "blank": struct.unpack_from("<H", body, 34)[0] / 100.0,
                }
            )
        at += size + length
    return found


def test_a_signature_that_sank_to_the_bottom():
    profiles = read_currents(ADCP / "Sig100_avg.ad2cp")
    records = averages((ADCP / "Sig100_avg.ad2cp").read_bytes())
    assert len(records) == 116
    records = records[:-1]  # the library leaves out the last record of a file
    account = " ".join(profiles[0].warnings)
    assert "8 while the instrument sinks or rises by more than 0.05 m/s" in account  # 0 to 2367 dbar in 48 min
    last = records[-1]
    ranges = last["blank"] + last["cell"] * (1 + np.arange(last["velocity"].shape[1]))
    depth = -gsw.z_from_p(last["dbar"], 0.0) - ranges
    bins = [int(np.argmin(np.abs(depth - d))) for d in profiles[-1].depth]
    assert np.abs(depth[bins] - profiles[-1].depth).max() < 0.05  # the mooring moves by a centimetre
    apart = []
    for several in (records[-1:], records[-2:]):  # the last window of ten minutes holds one record of six, or two
        velocity = np.array([record["velocity"][0, bins] for record in several])
        good = np.array([np.isfinite(record["velocity"][:3, bins]).all(axis=0) for record in several])
        mean = np.where(good, velocity, 0.0).sum(axis=0) / good.sum(axis=0)
        apart.append(np.abs(profiles[-1].east - mean).max())
    assert min(apart) < 1e-6  # single precision
    assert all(np.abs(p.east).max() < 2.0 for p in profiles)


@pytest.mark.parametrize(("bits", "frame"), [(0, "beam"), (1, "inst"), (2, "ship")])
def test_frames_other_than_earth_are_refused(write, bits, frame):
    data = (ADCP / "RDI_7f79_2.000").read_bytes()
    assert in_frame(data, 3) == data
    with pytest.raises(InputError, match=f"'{frame}'; earth is needed"):
        read_currents(write("other.000", in_frame(data, bits)))


@pytest.mark.parametrize("name", ["RDI_7f79_2.000", "Sig100_avg.ad2cp"])
@pytest.mark.parametrize("damage", ["cut", "overwritten", "noise", "head"])
def test_damaged_files_are_an_error_or_are_read_as_far_as_they_go(write, capfd, name, damage):
    data = bytearray((ADCP / name).read_bytes())
    noise = np.random.default_rng(7).integers(0, 256, len(data), dtype=np.uint8).tobytes()
    if damage == "cut":
        data = data[: len(data) // 2 + 3]
    elif damage == "overwritten":
        data[5000:9000] = noise[5000:9000]
    elif damage == "noise":
        data[4:] = noise[4:]
    else:
        data = data[:2]
    path = write(name, bytes(data))
    profiles, told = (), None
    try:
        profiles = read_currents(path)
    except InputError as error:
        told = str(error)
    assert bool(profiles) != bool(told)
    assert told is None or (told.startswith(f"{path}: ") and "\n" not in told)
    assert all(np.isfinite(p.east).all() and np.abs(p.east).max() < 5.0 for p in profiles)
    assert capfd.readouterr() == ("", "")
    assert os.listdir(path.parent) == [name]  # nothing is written beside it


def test_without_the_extra_the_message_says_what_to_install(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"pip install 'glidercli\[adcp\]'"):
        read_currents(ADCP / "RDI_7f79_2.000")


def test_the_library_stays_out_of_this_process():
    read_currents(ADCP / "RDI_7f79_2.000")
    assert "mhkit" not in sys.modules


@pytest.mark.parametrize("name", ["RDI_withBT.000", "Sig100_avg.ad2cp"])
def test_a_file_that_is_cut_says_so(tmp_path: Path, name: str) -> None:
    data = (ADCP / name).read_bytes()
    cut = tmp_path / name
    cut.write_bytes(data[: len(data) * 4 // 5 + 7])
    first = read_currents(cut)[0]
    assert any("belong to no whole record" in line for line in first.warnings)


def test_a_wrong_checksum_is_counted() -> None:
    data = bytearray((ADCP / "RDI_withBT.000").read_bytes())
    data[300] ^= 1
    assert remarks_on_ends(bytes(data), PD0)[0] == "1 of 1721 records have a wrong checksum"
    nortek = bytearray((ADCP / "Sig100_avg.ad2cp").read_bytes())
    nortek[30_000] ^= 1
    assert remarks_on_ends(bytes(nortek), AD2CP)[0].startswith("1 of 117 records")
