"""How fast are Slocum files read? The same sensors of the same files by this reader and by dbdreader, side by side.

dbdreader is compiled C, GPL-3, and no dependency of this project but of its tests: make .venv/.installed brings it.
Each run opens the file anew, its cache of sensors included. One core; medians of the runs; files lie in memory.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from pathlib import Path

from glidercli.logio.slocum import read_slocum, sensors

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


def theirs(path: Path, names: list[str] | None) -> object:
    import dbdreader

    file = dbdreader.DBD(str(path), cacheDir=str(path.parent))
    told = file.get(*(names or file.parameterNames), decimalLatLon=False, discardBadLatLon=False)
    file.close()
    return told


def main() -> None:
    print(f"{'file':<28}{'sensors':>9}{'this, ms':>10}{'dbdreader':>11}{'ratio':>7}{'as a log, ms':>14}")
    for name, few in CASES:
        path = ROOT / name
        log = median_ms(lambda path=path: read_slocum(path))  # type: ignore[misc]
        for names in (few, None):
            ours = median_ms(lambda path=path, names=names: sensors(path, names))  # type: ignore[misc]
            other = median_ms(lambda path=path, names=names: theirs(path, names))  # type: ignore[misc]
            count = "all" if names is None else str(len(names))
            print(f"{path.name:<28}{count:>9}{ours:10.2f}{other:11.2f}{other / ours:7.1f}{log:14.1f}")
    print("ratio: times as fast as dbdreader")


if __name__ == "__main__":
    main()
