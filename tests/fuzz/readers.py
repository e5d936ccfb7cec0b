"""Do readers stand what happens to files? Mutations of good files, each read in a process with bounded memory and time.

    python tests/fuzz/readers.py --count 5000 --seed 1

What may come out: one line of error; samples of the good file and an account that tells of the damage; or, where bytes
that no checksum guards were changed into others that are possible, samples that differ in no more records than were
hit. What may not: a traceback, a crash, a hang, memory beyond the bound, samples that nothing accounts for.
"""

from __future__ import annotations

import argparse
import collections
import json
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import traceback
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from good_files import GoodFile, Samples, good_files, read_samples
from mutations import Random, mutated

MEMORY = 4_000_000_000  # bytes of address space; libraries that are loaded reserve 1 to 2 GB of it
SECONDS = 60  # for one file; the largest good one takes 2 s, an HDF5 file that never opens is given up after 10
BATCH = 100
FAULTS = ("traceback", "crash", "hang", "not one line", "samples that nothing accounts for")


def new_times(found: Samples, good: Samples) -> set[int]:
    """Times of samples that the good file does not have."""
    return {
        time
        for name, values in found.items()
        for time, value in values.items()
        if good.get(name, {}).get(time) != value
    }


def hit_times(file: GoodFile, before: bytes, after: bytes) -> int:
    """At most the samples of so many times were changed."""
    if file.guarded:
        return 0
    if file.text:
        gone = collections.Counter(after.splitlines())
        gone.subtract(collections.Counter(before.splitlines()))
        new = [line for line, count in gone.items() for _ in range(count)]
        if file.origin and any(line.startswith(file.origin) for line in new):
            # it moves every record by the same time, and nothing else in the file tells it: what lies between the
            # fixes before and after the dive cannot be noticed (test_seaglider_start.py), nor anything in a lone .eng
            return sys.maxsize
        return file.times * len(new)
    if len(before) != len(after):
        return 1
    return int((np.frombuffer(before, np.uint8) != np.frombuffer(after, np.uint8)).sum())


def judged(file: GoodFile, data: bytes, random: Random, folder: Path) -> str:
    """What became of one mutation."""
    from glidercli.errors import GliderError

    (folder / file.path.name).write_bytes(data)
    target = folder / file.target.name
    try:
        found, account = read_samples(target, file, file.format if random.random() < 0.5 else None)
    except GliderError as error:
        lines = str(error).splitlines()
        return "error" if len(lines) == 1 and file.target.stem in lines[0] else "not one line"
    expected, good = file.found
    if found == expected:
        return "equal"
    if account != good:
        return "reported"
    hit = hit_times(file, file.path.read_bytes(), data)
    # a record that is hit loses its time and may gain another: nothing beyond that
    return "undetectable" if len(new_times(found, expected)) <= hit else "samples that nothing accounts for"


def child(seed: int, start: int, count: int) -> None:
    """Judge mutations number start to start + count, a JSON line each."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    files = good_files()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for number in range(start, start + count):
            random = np.random.default_rng([seed, number])
            file = files[int(random.integers(0, len(files)))]
            for beside in file.beside:
                shutil.copy(beside, folder)
            mutation, data = mutated(random, file.path.read_bytes())
            about = {"number": number, "file": file.path.name, "mutation": mutation}
            print(json.dumps({**about, "outcome": "started"}), flush=True)
            signal.alarm(SECONDS)  # ends the process; whoever waits for it sees why
            try:
                outcome, detail = judged(file, data, random, folder), ""
            except BaseException:
                outcome, detail = "traceback", traceback.format_exc()
            signal.alarm(0)
            print(json.dumps({**about, "outcome": outcome, "detail": detail}), flush=True)
            for left in folder.iterdir():
                left.unlink()


def run(seed: int, count: int) -> list[dict[str, Any]]:
    """What became of every mutation."""
    done: list[dict[str, Any]] = []
    while len(done) < count:
        size = min(BATCH, count - len(done))
        command = [
            sys.executable,
            __file__,
            "--child",
            "--seed",
            str(seed),
            "--start",
            str(len(done)),
            "--count",
            str(size),
        ]
        process = subprocess.run(command, capture_output=True, text=True, check=False)
        lines = [json.loads(line) for line in process.stdout.splitlines()]
        done += [line for line in lines if line["outcome"] != "started"]
        if process.returncode:
            if not lines or lines[-1]["outcome"] != "started":
                raise SystemExit(f"the child itself failed:\n{process.stderr}")
            what = "hang" if process.returncode == -signal.SIGALRM else "crash"
            done.append({**lines[-1], "outcome": what, "detail": process.stderr[-2000:]})
    return done


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--start", type=int, default=0)
    parser.add_argument("--child", action="store_true")
    options = parser.parse_args()
    if options.child:
        child(options.seed, options.start, options.count)
        return 0
    done = run(options.seed, options.count)
    counts = collections.Counter((item["file"], item["outcome"]) for item in done)
    for (file, outcome), number in sorted(counts.items()):
        print(f"{file:<36} {outcome:<36} {number}")
    print({outcome: sum(1 for item in done if item["outcome"] == outcome) for outcome in {i["outcome"] for i in done}})
    faults = [item for item in done if item["outcome"] in FAULTS]
    for fault in faults[:20]:
        print(json.dumps({**fault, "detail": None}), fault.get("detail", ""), sep="\n")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
