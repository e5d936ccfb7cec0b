"""What stands in a Rerun recording? Logs to write, and what Rerun's own reader and verifier say of the file."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import numpy as np

from glidercli.log import Channel, Event, Log
from glidercli.logio.rerun.writer import write_rerun

START = 1_315_000_000_123_456_789


def channel(name: str, seconds: Any, values: Any, origin: Any = "simulated") -> Channel:
    time_ns = START + np.round(np.asarray(seconds, dtype=float) * 1e9).astype(np.int64)
    return Channel(name, time_ns, np.broadcast_to(np.asarray(values, dtype=float), time_ns.shape), origin)


def log_of(channels: list[Channel], origin: Any, metadata: dict[str, str], events: tuple[Event, ...] = ()) -> Log:
    return Log({c.name: c for c in channels}, origin, metadata, events)


def written(log: Log, folder: Path, name: str = "log.rrd", **beside: Any) -> Path:
    write_rerun(log, folder / name, **beside)
    return folder / name


def stored(path: Path, blueprint: bool = False) -> list[tuple[str, Any]]:
    """Entity and record batch of each chunk of the recording or of its blueprint, by the library's own reader."""
    from rerun.chunk import RrdReader

    reader = RrdReader(path)
    chunks = reader.stream(store=reader.blueprints()[0] if blueprint else None).to_chunks()
    return [(chunk.entity_path, chunk.to_record_batch()) for chunk in chunks]


def rows(path: Path, entity: str, component: str) -> tuple[Any, Any, list[Any]]:
    """Times in both timelines (None where static) and values of one component."""
    for place, batch in stored(path):
        if place == entity and component in batch.schema.names:
            known = {name: batch.column(name) for name in ("utc", "elapsed") if name in batch.schema.names}
            times = {name: column.to_numpy(zero_copy_only=False).astype(np.int64) for name, column in known.items()}
            return times.get("utc"), times.get("elapsed"), batch.column(component).to_pylist()
    raise KeyError(f"{entity} {component}")


def samples(path: Path, entity: str) -> tuple[Any, Any, Any]:
    """Times in both timelines and numbers of a line, without the NaN that break it at gaps."""
    utc, elapsed, values = rows(path, entity, "Scalars:scalars")
    numbers = np.ravel(values)
    sampled = ~np.isnan(numbers)
    return utc[sampled], elapsed[sampled], numbers[sampled]


def panels(path: Path) -> set[str]:
    """Names of the views in the file's blueprint."""
    name = "ViewBlueprint:display_name"
    return {b.column(name).to_pylist()[0][0] for _, b in stored(path, blueprint=True) if name in b.schema.names}


def sights(path: Path) -> list[Any]:
    """From the eye of each three-dimensional view in the file's blueprint to the point that it looks at."""
    ends = ("EyeControls3D:look_target", "EyeControls3D:position")
    views = [batch for _, batch in stored(path, blueprint=True) if ends[1] in batch.schema.names]
    return [np.subtract(*(batch.column(name).to_pylist()[0][0] for name in ends)) for batch in views]


def page(path: Path) -> str:
    return str(rows(path, "/about", "TextDocument:text")[2][0][0])


def rerun(home: Path, *arguments: Any) -> subprocess.CompletedProcess[str]:
    """Rerun's own program, with settings of its own in that folder: nothing is sent, nothing of the user's is read."""
    import rerun_cli

    settings = home / "config" / "rerun" / "analytics.json"
    settings.parent.mkdir(parents=True, exist_ok=True)
    quiet = {"analytics_enabled": False, "analytics_id": "", "metadata": {}}
    settings.write_text(json.dumps({**quiet, "config_file_path": str(settings), "data_dir_path": str(home)}))
    own = {"HOME": str(home), "XDG_CONFIG_HOME": str(home / "config"), "XDG_DATA_HOME": str(home)}
    command = [Path(str(rerun_cli.__file__)).with_name("rerun"), *map(str, arguments)]
    return subprocess.run(command, env={**os.environ, **own}, capture_output=True, text=True, timeout=300)


def told_by_the_verifier(path: Path, home: Path) -> str:
    """What ``rerun rrd verify`` prints; a failure is an error."""
    done = rerun(home, "rrd", "verify", path)
    assert done.returncode == 0, done.stderr
    return done.stdout + done.stderr
