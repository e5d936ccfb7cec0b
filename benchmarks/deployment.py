"""A deployment of some 500 MB: how long it takes to replay, on one core and on all, and how much memory.

The dives are real ones of logs/seaexplorer-sea035, again and again, each time a day later: a load, and no more.
"""

from __future__ import annotations

import datetime
import os
import re
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

ROOT = Path(__file__).parent.parent
GLIDER = Path(sys.executable).with_name("glider")
STAMP = re.compile(rb"^(\d\d)/(\d\d)/(\d{4})", re.MULTILINE)


def deployment(folder: Path, megabytes: float) -> None:
    """Files of so many MB together."""
    sources = sorted((ROOT / "logs/seaexplorer-sea035").glob("*.sub.3[78]"))
    day, written = 0, 0
    while written < megabytes * 1e6:
        for source in sources:
            mission, number = source.name.rsplit(".", 1)
            data = STAMP.sub(partial(_later, day), source.read_bytes())
            (folder / f"{mission}.{int(number) - 36 + 2 * day}").write_bytes(data)
            written += len(data)
        day += 1


def _later(days: int, match: re.Match[bytes]) -> bytes:
    day, month, year = (int(match[i]) for i in (1, 2, 3))
    later = datetime.date(year, month, day) + datetime.timedelta(days)
    return later.strftime("%d/%m/%Y").encode()


def replayed(folder: Path, output: str) -> tuple[float, float]:
    """Seconds, and the peak of memory of the first process, MB."""
    start = time.perf_counter()
    process = subprocess.Popen(
        [str(GLIDER), "replay", "logs", "--quiet", "-o", output], cwd=folder, stdout=subprocess.DEVNULL
    )
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        raise SystemExit(f"{output}: exit {status}")
    return time.perf_counter() - start, usage.ru_maxrss / 1e3


def main() -> None:
    megabytes = float(sys.argv[1]) if len(sys.argv) > 1 else 500.0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "logs").mkdir()
        deployment(folder / "logs", megabytes)
        print(f"{len(list((folder / 'logs').iterdir()))} files, {megabytes:g} MB")
        for output in sys.argv[2:] or ["out.parquet", "out.nc", "out.csv"]:
            seconds, peak = replayed(folder, output)
            print(f"{output:<14}{seconds:7.1f} s   at most {peak:.0f} MB")


if __name__ == "__main__":
    main()
