"""How does an MCAP file look in a viewer? A picture by the last open Foxglove Studio, with the layout that is shipped.

    npm install --prefix /tmp/studio @foxglove/studio-base@1.48.0 react@17.0.2 react-dom@17.0.2
    python docs/pictures/studio/picture.py /tmp/studio trial.mcap trial.png --at 2011-07-20T05:00:00Z

Needs Chromium; WebGL runs in software. Studio 1.48 is what Lichtblick comes from (MPL-2.0, 180 MB; not shipped). The
page is served on 127.0.0.1 alone and reads the file in parts, as from any web server.
"""

from __future__ import annotations

import argparse
import functools
import http.server
import json
import os
import re
import shutil
import subprocess
import tempfile
import threading
import time
from pathlib import Path
from urllib.parse import quote

from glidercli.logio import read
from glidercli.logio.mcap.layouts import layout, sight_of
from glidercli.logio.mcap.reader import together_in

HERE = Path(__file__).parent


class Handler(http.server.SimpleHTTPRequestHandler):
    """Files of the folder, whole or in parts; "wait" comes late."""

    protocol_version = "HTTP/1.1"

    def __init__(self, *args: object, seconds: float, **options: object) -> None:
        self.seconds = seconds
        super().__init__(*args, **options)

    def log_message(self, *args: object) -> None:
        """Nothing is told of requests."""

    def end_headers(self) -> None:
        """Say that parts may be asked for."""
        self.send_header("Accept-Ranges", "bytes")
        super().end_headers()

    def do_GET(self) -> None:
        """Answer with a file or a part of it."""
        path, part = Path(self.translate_path(self.path)), re.match(r"bytes=(\d+)-(\d*)", self.headers.get("Range", ""))
        if path.name == "wait":
            time.sleep(self.seconds)
        if part is None or not path.is_file():
            super().do_GET()
            return
        size, first = path.stat().st_size, int(part[1])
        last = min(int(part[2] or size), size - 1)
        self.send_response(206)
        self.send_header("Content-Range", f"bytes {first}-{last}/{size}")
        self.send_header("Content-Length", str(last - first + 1))
        self.end_headers()
        with path.open("rb") as stream:
            stream.seek(first)
            self.wfile.write(stream.read(last - first + 1))


class Server(http.server.ThreadingHTTPServer):
    """A server that does not tell of a browser that leaves in the middle of an answer."""

    def handle_error(self, request: object, client_address: object) -> None:
        """Nothing: the picture shows whether the page came."""


def main() -> None:
    """Serve the page, and let Chromium photograph it."""
    parser = argparse.ArgumentParser(description="A picture of an MCAP file in the last open Foxglove Studio.")
    parser.add_argument("studio", type=Path, help="folder in which npm installed it")
    parser.add_argument("mcap", type=Path)
    parser.add_argument("png", type=Path)
    parser.add_argument("--at", default="", metavar="UTC", help="moment that is shown; the start")
    parser.add_argument("--seconds", type=float, default=40.0, help="time that the viewer gets")
    parser.add_argument("--tab", action="append", default=[], metavar="NAME:TITLE", help="tab that is in front")
    asked = parser.parse_args()
    shown = layout("foxglove", sight_of(read([asked.mcap]).log), together_in(asked.mcap))
    for name, title in (item.split(":") for item in asked.tab):
        tabs = shown["configById"][f"Tab!{name}"]
        tabs["activeTabIdx"] = [tab["title"] for tab in tabs["tabs"]].index(title)
    modules = asked.studio.resolve() / "node_modules"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        shutil.copy(HERE / "page.html", folder / "page.html")
        (folder / "layout.json").write_text(json.dumps(shown))
        os.symlink(asked.mcap.resolve(), folder / "log.mcap")
        os.symlink(modules / "@foxglove" / "studio-base" / "assets", folder / "assets")
        for part in ("react", "react-dom"):
            os.symlink(modules / part / "umd" / f"{part}.production.min.js", folder / f"{part}.js")
        handler = functools.partial(Handler, directory=name, seconds=asked.seconds)
        server = Server(("127.0.0.1", 0), handler)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        moment = f"?time={quote(asked.at)}" if asked.at else ""
        flags = [
            "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
            "--no-first-run", "--disable-background-networking", "--hide-scrollbars", "--window-size=1600,1100",
            f"--user-data-dir={folder / 'profile'}", f"--screenshot={asked.png.resolve()}",
        ]  # fmt: skip
        address = f"http://127.0.0.1:{server.server_address[1]}/page.html{moment}"
        subprocess.run(
            ["chromium", *flags, address], check=True, timeout=asked.seconds + 120, stderr=subprocess.DEVNULL
        )
        server.shutdown()


if __name__ == "__main__":
    main()
