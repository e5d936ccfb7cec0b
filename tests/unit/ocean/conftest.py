from pathlib import Path

import pytest


@pytest.fixture
def ctd() -> Path:
    """Folder of the real casts; SOURCES.md there says where they come from."""
    return Path(__file__).parents[2] / "data" / "ctd"


@pytest.fixture
def write(tmp_path: Path):
    """Writes text or bytes to a file of the test's own and gives its path."""

    def to(name: str, content: str | bytes) -> Path:
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return to
