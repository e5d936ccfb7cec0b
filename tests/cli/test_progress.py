"""Progress: a bar on a terminal after two seconds, nothing elsewhere; an interruption says how far it came."""

from __future__ import annotations

import io
import math
import sys
import time

import pytest

from glidercli.cli import progress as module
from glidercli.cli.progress import progress
from glidercli.errors import Interrupted


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def shown(monkeypatch: pytest.MonkeyPatch, stream: io.StringIO, quiet: bool = False) -> str:
    monkeypatch.setattr(module, "_AFTER", 0.05)
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setenv("TERM", "xterm")
    with progress("the flight", "s", quiet) as bar:
        bar.tell(50.0, 100.0)
        time.sleep(0.6)  # rich draws ten times a second
        bar.stage("writing")
        time.sleep(0.3)
    return stream.getvalue()


def test_a_terminal_sees_what_is_done_and_how_much(monkeypatch: pytest.MonkeyPatch) -> None:
    text = shown(monkeypatch, Terminal())
    assert "the flight" in text
    assert "50%" in text
    assert "writing" in text


def test_elsewhere_and_when_quiet_nothing_is_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    assert shown(monkeypatch, io.StringIO()) == ""
    assert shown(monkeypatch, Terminal(), quiet=True) == ""


@pytest.mark.parametrize(("whole", "words"), [(900.0, "after 300 of 900 s"), (math.inf, "after 300 s")])
def test_an_interruption_says_how_far_it_came(whole: float, words: str) -> None:
    def interrupted() -> None:
        with progress("the flight", "s", quiet=True) as bar:
            bar.tell(300.0, whole)
            raise KeyboardInterrupt

    with pytest.raises(Interrupted, match=f"the flight was interrupted {words}; nothing was written"):
        interrupted()


def test_a_bar_that_is_late_does_not_appear_after_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    bar = module.Bar("the flight", "s", quiet=False)
    bar.stop()
    bar._show()  # what the timer does, had it run out while the bar was being stopped
    bar.tell(1.0, 2.0)
    assert stream.getvalue() == ""
