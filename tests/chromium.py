"""A page in headless Chromium: what it asks for, what it complains of, how it looks, prints and takes keys."""

from __future__ import annotations

import base64
import contextlib
import json
import os
import shutil
import signal
import subprocess
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeVar

from websockets.sync.client import connect

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
FLAGS = (
    "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--remote-debugging-port=0",
    "--no-first-run", "--disable-background-networking", "--force-color-profile=srgb",
    "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",
)  # fmt: skip
PATIENCE = 20.0
"""s; much more than anything takes, so that a busy machine is no failure."""


class Tab:
    """A tab of a browser, over its debugging protocol.

    more : what else the browser is to tell of. requests : URLs asked for. faults : console messages of level error, exceptions, and what the policy refused.
    """

    more: tuple[str, ...] = ("Log",)

    def __init__(self, socket: Any) -> None:
        self._socket, self._number = socket, 0
        self.requests: list[str] = []
        self.faults: list[str] = []

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._number += 1
        self._socket.send(json.dumps({"id": self._number, "method": method, "params": parameters}))
        while True:
            told = self.heard(PATIENCE)
            if told.get("id") == self._number:
                assert "error" not in told, told
                result: dict[str, Any] = told["result"]
                return result

    def heard(self, seconds: float) -> dict[str, Any]:
        """The next thing that the browser tells; TimeoutError where it tells nothing for so long."""
        told: dict[str, Any] = json.loads(self._socket.recv(seconds))
        about = told.get("params", {})
        if told.get("method") == "Network.requestWillBeSent":
            self.requests.append(about["request"]["url"])
        elif told.get("method") == "Runtime.exceptionThrown":
            self.faults.append(str(about["exceptionDetails"]))
        elif told.get("method") == "Runtime.consoleAPICalled" and about["type"] in ("error", "assert"):
            self.faults.append(str([item.get("value", item.get("description")) for item in about["args"]]))
        elif told.get("method") == "Log.entryAdded" and about["entry"]["level"] == "error":
            self.faults.append(about["entry"]["text"])
        return told

    def run(self, script: str) -> Any:
        """The value of a JavaScript expression."""
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def open(
        self, page: Path, width: int = 1280, height: int = 900, scheme: str = "light", touch: bool = False
    ) -> None:
        """Load a file in a window of this size, px, until its plots are drawn."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=touch)
        self.call("Emulation.setTouchEmulationEnabled", enabled=touch)
        self.scheme(scheme)
        self.call("Page.navigate", url=page.as_uri())
        self.wait("document.readyState === 'complete' && document.documentElement.dataset.ready === 'yes'")
        self.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def wait(self, script: str) -> None:
        until = time.monotonic() + PATIENCE
        while not self.run(script):
            assert time.monotonic() < until, (script, self.faults)
            time.sleep(0.05)

    def scheme(self, scheme: str) -> None:
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def key(self, key: str, shift: bool = False, text: str = "") -> None:
        """Press and release a key."""
        about = {"key": key, "code": key, "windowsVirtualKeyCode": {"Tab": 9, "Enter": 13, " ": 32}[key]}
        more = {"text": text} if text else {}
        self.call("Input.dispatchKeyEvent", type="keyDown", modifiers=8 if shift else 0, **about, **more)
        self.call("Input.dispatchKeyEvent", type="keyUp", modifiers=8 if shift else 0, **about)

    def picture(self, whole: bool = False) -> bytes:
        """A PNG of what is seen, or of the whole page."""
        return base64.b64decode(self.call("Page.captureScreenshot", captureBeyondViewport=whole)["data"])

    def printed(self) -> bytes:
        """A PDF."""
        return base64.b64decode(self.call("Page.printToPDF", printBackground=False, preferCSSPageSize=False)["data"])


T = TypeVar("T", bound=Tab)


@contextlib.contextmanager
def browser(folder: Path, kind: type[T] = Tab) -> Iterator[T]:  # type: ignore[assignment]
    """A tab of a browser of its own, whose profile is in this folder."""
    assert CHROMIUM is not None
    command = [CHROMIUM, *FLAGS, f"--user-data-dir={folder}", "about:blank"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        active = folder / "DevToolsActivePort"
        until = time.monotonic() + PATIENCE
        while not (active.exists() and active.read_text().count("\n") >= 1):
            assert time.monotonic() < until, "waited in vain for the browser"
            time.sleep(0.02)
        port = active.read_text().split("\n")[0]
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/json") as answer:
            (tab,) = [tab for tab in json.load(answer) if tab["type"] == "page"]
        with connect(tab["webSocketDebuggerUrl"], max_size=None) as socket:
            found = kind(socket)
            for domain in ("Network", "Runtime", "Page", *kind.more):
                found.call(f"{domain}.enable")
            yield found
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
