"""Does the served page show a log that plays? Headless Chromium: what it receives grows, and it draws something."""

from __future__ import annotations

import base64
import contextlib
import io
import json
import os
import shutil
import signal
import subprocess
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROOT
from live_clients import running, wait_for
from websockets.sync.client import connect

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
FLAGS = (
    "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--remote-debugging-port=0",
    "--window-size=1000,700", "--no-first-run", "--disable-background-networking",
    "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",
)  # fmt: skip


class Page:
    """A page of a browser, over its debugging protocol."""

    def __init__(self, socket: Any) -> None:
        self._socket, self._number = socket, 0
        self._urls: dict[str, str] = {}
        self.received: dict[str, int] = {}
        self.faults: list[str] = []

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._number += 1
        self._socket.send(json.dumps({"id": self._number, "method": method, "params": parameters}))
        while True:
            told = self._hear(60.0)
            if told.get("id") == self._number:
                return told.get("result", {})

    def listen(self, seconds: float) -> None:
        until = time.monotonic() + seconds
        with contextlib.suppress(TimeoutError):
            while (left := until - time.monotonic()) > 0:
                self._hear(left)

    def _hear(self, seconds: float) -> dict[str, Any]:
        told: dict[str, Any] = json.loads(self._socket.recv(seconds))
        about = told.get("params", {})
        if told.get("method") == "Network.requestWillBeSent":
            self._urls[about["requestId"]] = about["request"]["url"]
        elif told.get("method") == "Network.dataReceived":
            url = self._urls.get(about["requestId"], "")
            self.received[url] = self.received.get(url, 0) + about["dataLength"]
        elif told.get("method") == "Runtime.exceptionThrown":
            self.faults.append(str(about["exceptionDetails"]))
        elif told.get("method") == "Runtime.consoleAPICalled" and about["type"] == "error":
            self.faults.append(str([item.get("value", item.get("description")) for item in about["args"]]))
        return told

    def data(self) -> int:
        """Bytes of the recording received so far."""
        self.listen(0.2)
        return sum(size for url, size in self.received.items() if url.endswith("/ReadMessages"))

    def colours(self) -> int:
        """Different colours in a picture of it."""
        from matplotlib.image import imread

        picture = imread(io.BytesIO(base64.b64decode(self.call("Page.captureScreenshot")["data"])))
        return len(np.unique((picture[..., :3] * 255).astype(np.uint8).reshape(-1, 3), axis=0))


@contextlib.contextmanager
def opened(url: str, folder: Path) -> Iterator[Page]:
    assert CHROMIUM is not None
    command = [CHROMIUM, *FLAGS, f"--user-data-dir={folder}", "about:blank"]
    browser = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        active = folder / "DevToolsActivePort"
        wait_for(lambda: active.exists() and active.read_text().count("\n") >= 1, "the browser")
        port = active.read_text().split("\n")[0]
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/json") as answer:
            (tab,) = [tab for tab in json.load(answer) if tab["type"] == "page"]
        with connect(tab["webSocketDebuggerUrl"], max_size=None) as socket:
            page = Page(socket)
            for domain in ("Network", "Runtime", "Page"):
                page.call(f"{domain}.enable")
            page.call("Page.navigate", url=url)
            yield page
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(browser.pid, signal.SIGKILL)
        browser.wait()


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium (Debian: chromium)")
def test_the_page_receives_what_plays_and_draws_it(tmp_path: Path) -> None:
    with running("replay", ROOT / "logs" / "seaexplorer-sea035", "--serve", "--rate", "200", cwd=tmp_path) as run:
        url = run.wait_for_line(r"http://\S+")[0]
        with opened(url, tmp_path / "profile") as page:
            sizes: list[int] = []

            def grew() -> bool:
                if (size := page.data()) > (sizes[-1] if sizes else 0) + 10_000:
                    sizes.append(size)
                return len(sizes) >= 4

            wait_for(grew, f"data, {sizes}")
            wait_for(lambda: page.colours() > 200, "a picture")  # a blank page has one, a message some 50
            assert page.call("Runtime.evaluate", expression="document.title")["result"]["value"] == "Rerun Viewer"
            # the page asks hosts outside for news, which the flags above keep from it
            assert [fault for fault in page.faults if "Failed to fetch" not in fault] == []
            assert run.end(signal.SIGINT) == 0
