"""Where did this output come from? Versions, command, inputs with their hashes, seed: one record for every output."""

from __future__ import annotations

import functools
import hashlib
import json
import platform
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

__all__ = ["file_hash", "provenance", "version"]


@functools.cache
def version() -> str:
    """Version of the installed package."""
    from importlib.metadata import version as installed

    return installed("glidercli")


def file_hash(path: Path) -> str:
    """SHA-256 of a file, hexadecimal."""
    digest = hashlib.sha256()
    with path.open("rb") as stream:
        while block := stream.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


def provenance(
    inputs: Iterable[Path] = (), seed: int | None = None, origin: str = "", command: list[str] | None = None
) -> dict[str, Any]:
    """The record as a dictionary, the same for the same command and inputs: it holds no clock and no host name.

    inputs : files that the output was made from.
    origin : "measured", "simulated", "reconstruction" or "", of the output as a whole.
    command : the command line; default: that of this process.
    """
    import numpy

    argv = command if command is not None else [Path(sys.argv[0]).name, *sys.argv[1:]]
    return {
        "program": f"glidercli {version()}",
        "python": platform.python_version(),
        "numpy": numpy.__version__,
        "command": list(map(_writable, argv)),
        "inputs": [{"path": _writable(str(path)), "sha256": file_hash(Path(path))} for path in inputs],
        "seed": seed,
        "origin": origin,
    }


def _writable(text: str) -> str:
    """A text, such as a file name, that UTF-8 can hold: bytes of a name that are none are written out."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def provenance_json(**arguments: Any) -> str:
    """The same record as compact JSON, for a log's metadata."""
    return json.dumps(provenance(**arguments), sort_keys=True)
