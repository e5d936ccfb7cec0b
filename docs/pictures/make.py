"""How are the pictures of docs/viewers.md made? By Rerun's own viewer, from recordings that the program writes.

    python docs/pictures/make.py [NAME...]

The viewer needs no display, but Vulkan: Debian's mesa-vulkan-drivers and libvulkan1 compute it without a graphics card.
Look at each picture before it is kept.
"""

from __future__ import annotations

import contextlib
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from PIL import Image
from rerun.experimental import ViewerClient

from glidercli.live.rerun_viewer import binary, quiet_environment

HERE = Path(__file__).parent
LOGS = HERE.parent.parent / "logs"
GLIDER = Path(sys.executable).with_name("glider")
SIZE, ZOOM, BAR = "1600x1000", 2, 44
"""Window, steps of enlarging, px of the menu bar that is cut off."""


class Picture(NamedTuple):
    """One picture: commands of glider that write OUT.rrd, the time to look at, s since the start, and open tabs."""

    commands: tuple[str, ...]
    seconds: float
    tabs: tuple[str, ...] = ()


PICTURES = {
    "slocum-spiral": Picture((f"replay {LOGS}/slocum-comet-2019 -o OUT.rrd",), 3000.0, ("Sections",)),
    "slocum-water": Picture((f"replay {LOGS}/slocum-comet-2019 -o OUT.rrd",), 5150.0, ("Temperature", "Map")),
    "seaglider-dive": Picture((f"replay {LOGS}/seaglider-sg561 -o OUT.rrd",), 830.0),
    "trial-rerun": Picture(("simulate south-china-sea-2011 -o OUT.rrd",), 2700.0, ("Current",)),
    "side-by-side": Picture(
        (
            f"simulate --vehicle seaglider --controls {LOGS}/seaglider-sg561 --initial {LOGS}/seaglider-sg561 "
            f"--ctd {LOGS}/seaglider-sg561 -o twin.nc",
            f"replay {LOGS}/seaglider-sg561 --with twin.nc -o OUT.rrd",
        ),
        1200.0,
    ),
}


def main() -> None:
    for name in sys.argv[1:] or PICTURES:
        picture = PICTURES[name]
        with tempfile.TemporaryDirectory() as folder:
            for command in picture.commands:
                glider = [GLIDER, *command.split(), "--force", "--quiet"]
                subprocess.run(glider, cwd=folder, check=True, stdout=subprocess.DEVNULL)
            shot = Path(folder) / "shot.png"
            with viewer(Path(folder) / "OUT.rrd", folder) as client:
                open_tabs(client, picture.tabs)
                client.set_time("elapsed", duration=picture.seconds, play_state="paused")
                time.sleep(3.0)
                client.save_screenshot(str(shot))
            with Image.open(shot) as whole:
                cut = whole.convert("RGB").crop((0, BAR, whole.width, whole.height))
            target = HERE / f"{name}.png"
            cut.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=4, dither=Image.Dither.NONE).save(
                target, optimize=True
            )
            print(target, target.stat().st_size // 1000, "kB")


@contextlib.contextmanager
def viewer(recording: Path, folder: str) -> Iterator[ViewerClient]:
    """A viewer without a window that shows a recording; it listens to this machine alone, and sends nothing."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    own = {"XDG_RUNTIME_DIR": folder, "XDG_CONFIG_HOME": folder, "XDG_DATA_HOME": folder}
    command = [binary(), recording, "--headless", "--hide-welcome-screen"]
    command += ["--bind", "127.0.0.1", "--port", str(port), "--window-size", SIZE]
    process = subprocess.Popen(command, env=quiet_environment() | own)
    try:
        client = connected(port)
        for _ in range(ZOOM):
            client.run_command("ui.zoom_in_ui")
        yield client
    finally:
        process.terminate()
        process.wait()


def connected(port: int) -> ViewerClient:
    """A client of the viewer, as soon as it listens and has the recording."""
    for _ in range(100):
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), 1.0):
            break
        time.sleep(0.1)
    time.sleep(2.0)
    return ViewerClient.connect(f"rerun+http://127.0.0.1:{port}/proxy")


def open_tabs(client: ViewerClient, names: tuple[str, ...]) -> None:
    """Bring tabs to the front."""
    views = client.get_blueprint().blueprint
    boxes = {path.lstrip("/"): view["ContainerBlueprint"] for path, view in views.items() if "/container/" in path}
    wanted = {path for path, box in boxes.items() if box.get("display_name") in names}
    for box in boxes.values():
        if box["container_kind"] == "Tabs" and (found := wanted & {*box["contents"]}):
            box["active_tab"] = found.pop()
    client.set_blueprint(views, of="recording")


if __name__ == "__main__":
    main()
