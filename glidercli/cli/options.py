"""Options that several commands share, spelled and explained once."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer


class Equations(StrEnum):
    """Which form of the model: see docs/model.md."""

    FULL = "full"
    PAPER = "paper"


Json = Annotated[bool, typer.Option("--json", help="Print one JSON document and nothing else on stdout.")]
Quiet = Annotated[bool, typer.Option("--quiet", help="No progress and no warnings on stderr.")]
Debug = Annotated[bool, typer.Option("--debug", help="Show the traceback of a failure.")]
Force = Annotated[bool, typer.Option("--force", help="Replace outputs that exist.")]
Vehicle = Annotated[str, typer.Option("--vehicle", metavar="NAME|FILE.toml", help="Vehicle, by name or file.")]
EquationsOption = Annotated[
    Equations,
    typer.Option("--equations", help="full: the whole model; paper: as printed, CA and the shear term left out."),
]
FormatOption = Annotated[str | None, typer.Option("--format", metavar="NAME", help="Read every file as this format.")]
CacheOption = Annotated[
    Path | None, typer.Option("--cache", metavar="DIR", help="Folder of Slocum caches, beside those by the files.")
]
ColumnsOption = Annotated[
    Path | None, typer.Option("--columns", metavar="FILE.toml", help="What the columns of plain tables are.")
]


def output_option(endings: str) -> typer.models.OptionInfo:
    """The repeatable -o option; ``endings`` lists what may follow, for the help text."""
    option: typer.models.OptionInfo = typer.Option(
        "-o", "--output", metavar="FILE", help=f"Write {endings}; may repeat; - is stdout."
    )
    return option


Outputs = list[Path]
