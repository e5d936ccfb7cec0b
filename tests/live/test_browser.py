"""Does the served page show a log that plays? Headless Chromium: what it receives grows, and it draws something."""

from __future__ import annotations

import base64
import contextlib
import io
import signal
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from chromium import CHROMIUM, Tab, browser
from conftest import ROOT
from live_clients import running, wait_for


class Viewer(Tab):
    """The page of a viewer; what comes from a network outside, which it cannot reach, is not told of.

    received : bytes by URL.
    """

    more = ()

    def __init__(self, socket: Any) -> None:
        super().__init__(socket)
        self._urls: dict[str, str] = {}
        self.received: dict[str, int] = {}

    def listen(self, seconds: float) -> None:
        until = time.monotonic() + seconds
        with contextlib.suppress(TimeoutError):
            while (left := until - time.monotonic()) > 0:
                self.heard(left)

    def heard(self, seconds: float) -> dict[str, Any]:
        told = super().heard(seconds)
        about = told.get("params", {})
        if told.get("method") == "Network.requestWillBeSent":
            self._urls[about["requestId"]] = about["request"]["url"]
        elif told.get("method") == "Network.dataReceived":
            url = self._urls.get(about["requestId"], "")
            self.received[url] = self.received.get(url, 0) + about["dataLength"]
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


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium (Debian: chromium)")
def test_the_page_receives_what_plays_and_draws_it(tmp_path: Path) -> None:
    with running("replay", ROOT / "logs" / "seaexplorer-sea035", "--serve", "--rate", "200", cwd=tmp_path) as run:
        url = run.wait_for_line(r"http://\S+")[0]
        with browser(tmp_path / "profile", Viewer) as page:
            page.call("Page.navigate", url=url)
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
