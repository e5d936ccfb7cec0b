"""What does mhkit's dolfyn read in an ADCP's binary file? Run as a process of its own, which writes arrays to a file.

A library that prints, warns, writes beside its input, loops or asks for too much memory where a file is damaged does so
here, not in the program. Usage: python -m glidercli.ocean.adcp_child INPUT OUTPUT.npz BYTES
"""

from __future__ import annotations

import contextlib
import json
import sys
from typing import Any


def _limit_memory(most: int) -> None:
    """Let the process have no more than so many bytes, where the system can hold it to that."""
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def main(source: str, target: str, most: str) -> None:
    """Read a file and write what is used of it."""
    import numpy as np

    _limit_memory(int(most))
    from mhkit.dolfyn.io.api import read

    from glidercli.ocean.pings import PING_VARIABLES

    data = read(source, userdata=False)
    data = data[0] if isinstance(data, (list, tuple)) else data
    arrays: dict[str, Any] = {}
    for name in (full for short in PING_VARIABLES for full in (short, f"{short}_avg") if full in data.variables):
        values = data[name].values
        if name.startswith("time"):
            seconds = values.astype("datetime64[ns]").astype(np.int64) / 1e9
            values = np.where(np.isnat(values), np.nan, seconds)
        arrays[name] = np.asarray(values, dtype=np.float64)
    kept = ("coord_sys", "orientation", "beam_angle", "magnetic_var_deg")
    told = {name: data.attrs[name] for name in kept if name in data.attrs}
    with contextlib.suppress(KeyError, TypeError, ValueError):
        told["declination"] = float(json.loads(data.attrs["filehead_config"])["USER"]["DECL"])
    words = {name: value if isinstance(value, str) else float(value) for name, value in told.items()}
    np.savez(target, attributes=np.array(json.dumps(words)), **arrays)


if __name__ == "__main__":
    main(*sys.argv[1:])
