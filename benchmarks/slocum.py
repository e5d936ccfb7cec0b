"""How fast are Slocum files read? The same sensors of the same files by this reader and by dbdreader, side by side.

dbdreader is compiled C, GPL-3, and no dependency of this project but of its tests: make .venv/.installed brings it.
Each run opens the file anew. "this" parses its list of sensors anew too, as for the first file of a mission; "next" has
it from a file before, as this reader does by itself. One core; medians of the runs; files lie in memory.

Fixed costs of Python, 0.2 ms a file and 10 us a sensor, make it slower in the smallest: 0.7 to 0.8 in the .tbd of 7 kB,
0.9 to 1.0 for all 84 sensors of the .ebd of 58 kB. In all others it is faster.
"""

from __future__ import annotations

import functools
import statistics
import time
from collections.abc import Callable
from pathlib import Path

from glidercli.logio.slocum import read_slocum, sensors
from glidercli.logio.slocum.sensor_lists import sensor_list

RUNS = 21
ROOT = Path(__file__).parent.parent
FLIGHT = ["m_depth", "m_pitch", "m_roll", "m_heading", "m_battpos", "m_ballast_pumped", "m_fin"]
SHORT = ["m_depth", "m_pitch"]
CTD = ["sci_water_temp", "sci_water_cond", "sci_water_pressure"]
CASES = [
    ("logs/slocum-comet-2019/comet-2019-218-00-034.dbd", FLIGHT),
    ("logs/slocum-comet-2019/comet-2019-218-00-034.ebd", CTD),
    ("tests/data/slocum/comet-2016-174-05-000.dbd", FLIGHT),
    ("tests/data/slocum/comet-2016-174-05-000.ebd", CTD),
    ("tests/data/slocum/modena-2015-174-8-0.dbd", FLIGHT),
    ("tests/data/slocum/modena-2015-174-8-0.ebd", CTD),
    ("tests/data/slocum/comet-2019-218-00-032.sbd", SHORT),
    ("tests/data/slocum/comet-2019-218-00-032.tbd", CTD),
]


def median_ms(run: Callable[[], object]) -> float:
    walls = []
    run()
    for _ in range(RUNS):
        began = time.perf_counter()
        run()
        walls.append(time.perf_counter() - began)
    return statistics.median(walls) * 1e3


def first(path: Path, names: list[str] | None) -> object:
    sensor_list.cache_clear()
    return sensors(path, names)


def theirs(path: Path, names: list[str] | None) -> object:
    import dbdreader

    file = dbdreader.DBD(str(path), cacheDir=str(path.parent))
    told = file.get(*(names or file.parameterNames), decimalLatLon=False, discardBadLatLon=False)
    file.close()
    return told


def main() -> None:
    print(
        f"{'file':<28}{'sensors':>8}{'dbdreader, ms':>15}{'this':>8}{'ratio':>7}{'next':>8}{'ratio':>7}{'as a log':>10}"
    )
    for name, few in CASES:
        path = ROOT / name
        log = median_ms(functools.partial(read_slocum, path))
        for names in (few, None):
            other, ours, after = (median_ms(functools.partial(read, path, names)) for read in (theirs, first, sensors))
            told = f"{path.name:<28}{'all' if names is None else len(names):>8}{other:15.2f}"
            print(f"{told}{ours:8.2f}{other / ours:7.1f}{after:8.2f}{other / after:7.1f}{log:10.1f}")
    print("ratio: times as fast as dbdreader")


if __name__ == "__main__":
    main()
