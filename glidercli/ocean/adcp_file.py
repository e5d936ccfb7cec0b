"""What current does an ADCP's binary file show? RDI PD0 and Nortek .ad2cp, read by mhkit in a process of its own."""

from __future__ import annotations

import dataclasses
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import InputError
from glidercli.ocean.current import CurrentProfile
from glidercli.ocean.pings import currents_of_pings, is_pings, pings_of
from glidercli.ocean.record_ends import remarks_on_ends

__all__ = ["adcp_currents"]

_SECONDS, _SECONDS_PER_MB = 60.0, 5.0  # real files of 0.1 to 2 MB took 1.6 to 2.3 s, most of it imports
_ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in ("OPENBLAS", "OMP", "MKL")}  # threads reserve memory
_MEMORY, _MEMORY_PER_BYTE = 4 << 30, 200  # address space, bytes; real files took 1.6 GB with all libraries


def adcp_currents(path: Path, kind: str, latitude: float | None = None) -> tuple[CurrentProfile, ...]:
    """The current profiles of a file; see pings.py. kind : of the file. latitude : deg, for depth of pressure.

    Of an .ad2cp the library leaves out the last record, whole or not.

    The file is read through a link in a folder that is removed afterwards: the library writes an index beside it.

    Raises
    ------
    InputError
        mhkit is not installed, the file is damaged, or what it holds cannot be used.
    """
    if importlib.util.find_spec("mhkit") is None:
        raise InputError(path, f"is a {kind} file; to read it, pip install 'glidercli[adcp]'")
    variables, attributes = _read(path, kind)
    if not is_pings(variables):
        raise InputError(path, f"is a {kind} file without velocities by depth")
    first, *others = currents_of_pings(path, pings_of(variables, attributes, latitude))
    remarks = remarks_on_ends(path.read_bytes(), kind)
    return (dataclasses.replace(first, warnings=first.warnings + remarks), *others)


def _read(path: Path, kind: str) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
    """Variables and attributes as mhkit's dolfyn names them."""
    size = path.stat().st_size
    with tempfile.TemporaryDirectory(prefix="glider-adcp-") as folder:
        link = Path(folder) / f"input{path.suffix}"
        link.symlink_to(path.resolve())
        target = Path(folder) / "output.npz"
        command = [sys.executable, "-P", "-W", "ignore", "-m", "glidercli.ocean.adcp_child", str(link), str(target)]
        seconds = _SECONDS + _SECONDS_PER_MB * size / 1e6
        try:
            done = subprocess.run(
                [*command, str(_MEMORY + _MEMORY_PER_BYTE * size)],
                capture_output=True, text=True, errors="replace", timeout=seconds, stdin=subprocess.DEVNULL,
                env={**os.environ, **_ONE_THREAD},
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            raise InputError(path, f"is a damaged {kind} file: not read within {seconds:.0f} s") from None
        if done.returncode != 0 or not target.exists():
            lines = [line.strip() for line in done.stderr.splitlines() if line.strip()] or ["no word"]
            raise InputError(path, f"is a {kind} file that mhkit cannot read, most likely damaged: {lines[-1][:200]}")
        with np.load(target, allow_pickle=False) as arrays:
            attributes = json.loads(str(arrays["attributes"]))
            return {name: arrays[name] for name in arrays.files if name != "attributes"}, attributes
