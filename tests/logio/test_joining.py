"""Files of one dive interleave; of twins the fullest is read; every record stays accounted for."""

from __future__ import annotations

import dataclasses
import gzip
import json
import shutil
import time
from pathlib import Path

import gsw
import numpy as np
import pytest
from conftest import ROOT

from glidercli.log import Channel, Log
from glidercli.logio import overview, read
from glidercli.logio.joining import joined
from glidercli.logio.reader import Part
from glidercli.logio.reading import Reading
from glidercli.logio.report import FileReport

LOGS = ROOT / "logs/seaexplorer-sea035"
SECOND = 10**9


def part(name: str, times: list[int], *channels: str, **about: object) -> Part:
    ns = np.array(times, np.int64) * SECOND
    log = Log({c: Channel(c, ns, ns * 1e-9) for c in channels}, "measured")
    return dataclasses.replace(Part(log, FileReport(Path(name), "made", len(ns), len(ns)), ns), **about)  # type: ignore[arg-type]


def accounted(reports: list[FileReport]) -> bool:
    return all(r.records == r.kept + sum(count for _, count in r.dropped) for r in reports)


def test_a_raw_file_goes_before_its_sub_file(tmp_path: Path) -> None:
    whole = LOGS / "sea035.12.gli.sub.37"
    lines = whole.read_bytes().splitlines(keepends=True)
    (tmp_path / "sea035.12.gli.raw.37.gz").write_bytes(gzip.compress(b"".join(lines)))
    (tmp_path / "sea035.12.gli.sub.37").write_bytes(b"".join([lines[0], *lines[1::4]]))
    reading = read([tmp_path])
    raw, sub = reading.files
    assert (raw.kept, raw.dropped) == (504, ())
    assert (sub.records, sub.kept) == (126, 0)
    assert sub.dropped == (("its recording is in sea035.12.gli.raw.37.gz", 126),)
    assert sub.error is None  # nothing is wrong with it
    assert len(reading.log["depth"]) == 504


def test_navigation_and_payload_of_a_dive_interleave() -> None:
    nav = part("n", [0, 10, 20, 30], "depth", dive="d1")
    pay = part("p", [5, 10, 15], "depth", "temperature", dive="d1")
    log, reports = joined([pay, nav])
    assert (log["depth"].time_ns // SECOND).tolist() == [0, 5, 10, 15, 20, 30]
    assert accounted(reports)


def test_what_another_file_has_is_given_up() -> None:
    nav = part("n", [0, 10], "depth", "temperature", dive="d1", yields=frozenset({"temperature"}))
    relayed = part("r", [3, 4], "temperature", dive="d1", yields=frozenset({"temperature"}))
    science = part("s", [1, 2, 3], "temperature", dive="d1")
    log, reports = joined([nav, relayed, science])
    assert (log["temperature"].time_ns // SECOND).tolist() == [1, 2, 3]
    assert [r.kept for r in reports] == [2, 0, 3]
    assert reports[1].dropped == (("no other value than those left out", 2),)
    assert "temperature: 2 values left out" in reports[0].warnings[0]
    assert accounted(reports)


def test_without_the_other_file_nothing_is_given_up() -> None:
    relays = frozenset({"temperature"})
    one = part("n", [0, 10], "depth", "temperature", dive="d1", yields=relays)
    two = part("m", [5, 15], "depth", "temperature", dive="d1", yields=relays)
    log, _ = joined([one, two])
    assert len(log["temperature"]) == 4


def test_files_come_in_any_order(tmp_path: Path) -> None:
    names = sorted(LOGS.glob("*.sub.*"))
    forward, backward = read(names), read(names[::-1])
    assert list(map(len, forward.log.channels.values())) == [len(backward.log[name]) for name in forward.log.channels]
    for name, channel in forward.log.channels.items():
        np.testing.assert_array_equal(channel.values, backward.log[name].values)


def test_many_processes_read_what_one_does(tmp_path: Path, monkeypatch) -> None:
    from glidercli.logio import spreading

    for path in LOGS.glob("*.sub.*"):
        shutil.copy(path, tmp_path)
    (tmp_path / "broken").write_text("nothing\n")
    one = read([tmp_path])
    monkeypatch.setattr(spreading, "LARGE", 0)
    told: list[tuple[float, float]] = []
    two = read([tmp_path], progress=lambda done, whole: told.append((done, whole)), workers=2)
    assert one.files == two.files
    assert one.log.metadata == two.log.metadata
    for name, channel in one.log.channels.items():
        np.testing.assert_array_equal(channel.values, two.log[name].values)
        np.testing.assert_array_equal(channel.time_ns, two.log[name].time_ns)
    assert told == [(done, 7) for done in range(8)]


def test_a_cut_file_takes_no_whole_one_with_it(tmp_path: Path) -> None:
    """A raw file that ends early goes first as far as it reaches; the sub file has the rest."""
    whole = LOGS / "sea035.12.gli.sub.37"
    lines = whole.read_bytes().splitlines(keepends=True)
    (tmp_path / "sea035.12.gli.raw.37").write_bytes(b"".join(lines[:101]))
    shutil.copy(whole, tmp_path)
    reading = read([tmp_path])
    raw, sub = reading.files
    assert (raw.kept, sub.kept) == (100, 404)
    assert sub.dropped == (("its recording is in sea035.12.gli.raw.37", 100),)
    assert len(reading.log["depth"]) == 504
    (tmp_path / "sea035.12.gli.raw.37").write_bytes(b"".join(lines[:102])[:-20])
    raw, sub = read([tmp_path]).files
    assert raw.error is not None  # and yet what it holds is good
    assert (raw.kept, sub.kept) == (100, 404)
    with_error = gzip.compress(b"".join(lines))[:-2000]
    (tmp_path / "sea035.12.gli.raw.37").write_bytes(with_error)
    raw, sub = read([tmp_path]).files
    assert raw.error is not None
    assert (raw.kept, sub.kept) == (0, 504)


def test_closures_of_joined_logs_are_one_list(tmp_path: Path) -> None:
    """Each file is one of this program's own, with closures in its metadata."""
    one, other = {"start": "a"}, {"start": "b"}
    parts = []
    for number, closures in enumerate(([one], [one, other])):
        made = part(f"{number}", [10 * number, 10 * number + 5], "depth")
        parts.append(dataclasses.replace(made, log=made.log.with_metadata(closures=json.dumps(closures))))
    log, _ = joined(parts)
    assert json.loads(log.metadata["closures"]) == [one, other]


def test_dives_far_apart_in_number_cost_no_memory() -> None:
    """Numbers come from headers that may hold anything."""
    log, reports = joined([part("n", [0], "depth")])
    reading = Reading(log, tuple(reports), ("m.1", "m.5", "m.7", f"m.{10**15}"))
    assert f"dives 2-4, 6, 8-{10**15 - 1} of m are not among the files" in overview(reading).missing


def year_off(folder: Path, year: str) -> None:
    """Three dives of sea035, the payload's clock in the first of them in another year."""
    for path in LOGS.glob("*.sub.*"):
        shutil.copy(path, folder)
    path = folder / "sea035.12.pld1.sub.36"
    path.write_bytes(path.read_bytes().replace(b"/2019 ", f"/{year} ".encode()))


@pytest.mark.parametrize("year", ["2018", "2020"])
def test_a_payload_a_year_off_its_navigation_is_told_and_costs_no_other(tmp_path: Path, year: str) -> None:
    year_off(tmp_path, year)
    reading = read([tmp_path])
    assert [report.kept for report in reading.files] == [report.kept for report in read([LOGS]).files]
    told = [w for report in reading.files for w in report.warnings if "shares no time with" in w]
    assert len(told) == 1
    assert "2019-07-21T23:24:49Z to 2019-07-21T" in told[0]
    assert f"{year}-07-21T23:" in told[0]
    assert "of the same dive" in told[0]


def test_density_takes_no_position_from_another_year(tmp_path: Path) -> None:
    year_off(tmp_path, "2018")
    log = read([tmp_path]).log
    times, (s, t, p, density) = log.together("salinity", "temperature", "pressure", "density")
    off = times < log["depth"].time_ns[0] - 100 * 86400 * SECOND
    assert 0 < off.sum() < 30
    wanted = gsw.rho_t_exact(gsw.SR_from_SP(s[off]), t[off], np.maximum(p[off] / 1e4, 0.0))
    np.testing.assert_allclose(density[off], wanted, rtol=1e-14)  # the same formula; rounding alone
    placed = gsw.SA_from_SP(s[~off], p[~off] / 1e4, -130.6, 48.9)
    wanted = gsw.rho_t_exact(placed, t[~off], p[~off] / 1e4)
    np.testing.assert_allclose(density[~off], wanted, atol=1e-4)  # the positions of the fixes vary by 0.1 deg at most
    assert f"reference salinity for {int(off.sum())} samples" in log.metadata["density_note"]


def test_the_order_in_which_files_are_given_changes_no_value(tmp_path: Path) -> None:
    """Two navigation files of one dive that overlap and differ: one is of another folder, or was mended by hand."""
    whole = LOGS / "sea035.12.gli.sub.37"
    for folder, old, new in (("a", "", ""), ("b", ";117;", ";100;")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / whole.name).write_text(whole.read_text("latin-1").replace(old, new), "latin-1")
    files = sorted(tmp_path.glob("*/*"))
    forward, backward = read(files).log, read(files[::-1]).log
    assert forward.metadata == backward.metadata
    for name, channel in forward.channels.items():
        np.testing.assert_array_equal(channel.values, backward[name].values)


def test_thousands_of_files_of_one_dive_take_no_time() -> None:
    """Each looked at each other one: 37 s for 4,000 that overlap, 20 s for as many that hold the same."""
    start = time.process_time()
    for dive, holds in (("d", ()), ("", ("r",))):
        log, reports = joined([part(str(i), [0, 10], "depth", dive=dive, holds=holds) for i in range(4000)])
        assert len(log["depth"]) == 2
        assert accounted(reports)
    assert time.process_time() - start < 15.0  # 1.2 s; not the clock's, which others at work slow down
