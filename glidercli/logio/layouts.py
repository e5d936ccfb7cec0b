"""How do the viewers' layouts reach a user? As JSON files, for Foxglove's and Lichtblick's "import from file"."""

from __future__ import annotations

import contextlib
import json
from pathlib import Path

from glidercli.errors import OutputError
from glidercli.files import atomic
from glidercli.log import Log
from glidercli.logio.mcap.layouts import LAYOUTS, fields_of, layout, sight_of
from glidercli.logio.mcap.reader import Together, together_in

__all__ = ["LAYOUTS", "together_in", "write_layouts"]


def write_layouts(
    folder: Path, force: bool = False, log: Log | None = None, together: Together | None = None
) -> list[Path]:
    """Write each layout to FOLDER/glider-NAME.json, which is made if it is not there; all of them or none.

    force : replace files that exist; without it that is an OutputError. log : a flight that the view of the whole is to
    fit; panels of which it has nothing are left out. Without one they serve every log. together : what its file holds
    beside it, see ``together_in``.
    """
    if folder.exists() and not folder.is_dir():
        raise OutputError(folder, "is a file; a folder is needed")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(folder, f"cannot be made: {error.strerror}") from error
    sight, fields = (None, None) if log is None else (sight_of(log), fields_of(log))
    paths = {name: folder / f"glider-{name}.json" for name in LAYOUTS}
    with contextlib.ExitStack() as pending:
        parts = {name: pending.enter_context(atomic(path, force)) for name, path in paths.items()}
        for name, part in parts.items():
            content = json.dumps(layout(name, sight, fields, together), indent=2)
            part.write_text(content + "\n", encoding="utf-8")
    return list(paths.values())
