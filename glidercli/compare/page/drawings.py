"""How do plots and tracks stand in a page? Places for the script to draw in, with words, controls and captions.

Each function gives the HTML of one section, "" where there is nothing to show.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from glidercli.compare.facts import Facts
from glidercli.compare.first import First
from glidercli.compare.page.html import escaped, flat, number, table
from glidercli.compare.page.plots import Plots
from glidercli.compare.page.tables import worded
from glidercli.log import Log

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison

__all__ = ["over_time", "tracks"]


def over_time(comparison: Comparison, drawn: Plots) -> str:
    """Plots over time with their controls; "" where nothing is drawn."""
    if not drawn.data["panels"]:
        return ""
    figures = "".join(
        f'<figure><h3>{panel["title"]}</h3><div class="plot" id="plot-{place}" role="img" '
        f'aria-label="{escaped("Plot of " + drawn.told[panel["channel"]])}"></div>'
        f"<figcaption>{escaped(_sentence(drawn.told[panel['channel']]))}</figcaption></figure>\n"
        for place, panel in enumerate(drawn.data["panels"])
    )
    buttons = "".join(
        f'<button type="button" data-time="{key}">{label}</button>'
        for key, label in (
            ("in", "Zoom in"), ("out", "Zoom out"), ("back", "Earlier"), ("on", "Later"), ("all", "Whole time"),
        )
    )  # fmt: skip
    less = f" The lower part of each plot is simulated less {comparison.first.noun}."
    below = less if isinstance(comparison.against, Log) else ""
    bands = " Grey is what was published, with its tolerance." if isinstance(comparison.against, Facts) else ""
    legs = " Dives are shaded." if any(leg["name"] == "dive" for leg in drawn.data["legs"]) else ""
    events = (
        " Open marks are events, named on pointing at them."
        if any(panel["events"] for panel in drawn.data["panels"])
        else ""
    )
    thin = (
        f" {drawn.thinned} long lines are thinned to {drawn.points:,} points each; their extremes stay."
        if drawn.thinned
        else ""
    )
    notes = "".join(f" {escaped(note)}" for note in drawn.notes)
    return (
        f"<p>Time is counted from {drawn.data['zero']}.{below}{bands}{legs}{events} Lines are broken where samples are "
        "missing for longer than usual. All plots share their time axis: drag over one, or use the buttons."
        f"{thin}{notes}</p>\n"
        f'<noscript><p class="note">The plots need JavaScript; words and tables do not.</p></noscript>\n'
        f'<div class="controls plotcontrols" role="group" aria-label="Controls of the plots">'
        f"{_toggles(comparison, drawn)}"
        f'<span class="buttons">{buttons}</span></div>\n<div class="plots">{figures}</div>\n'
    )


def tracks(comparison: Comparison, drawn: Plots, parts: Sequence[Mapping[str, Any]]) -> str:
    """Tracks from above and in three dimensions, and how far apart they are."""
    track = drawn.data["track"]
    text = ""
    if track is not None:
        shorts = [log["short"] for log in drawn.data["logs"]]
        named = _extents(track, shorts)
        remarks = []
        if track["origin"] is not None:
            remarks.append("Metres north and east of {:.5f} deg north, {:.5f} deg east.".format(*track["origin"]))
        else:
            remarks.append("Metres north and east of where each track's own count begins; no log names a place.")
        if track["apart"]:
            remarks.append(
                f"Without a place of its own, so drawn from the common origin: {_of(shorts, track['apart'])}."
            )
        if track["exaggeration"] != 1.0:
            remarks.append(f"Depth is drawn {number(track['exaggeration'])} times as large as the horizontal.")
        if track["interpolated"]:
            remarks.append(f"Depth is linear between its samples: {_of(shorts, track['interpolated'])}.")
        if track["thinned"]:
            remarks.append(f"Thinned to {drawn.points:,} evenly spread points: {_of(shorts, track['thinned'])}.")
        buttons = "".join(
            f'<button type="button" data-turn="{key}">{label}</button>'
            for key, label in (
                ("left", "Turn left"), ("right", "Turn right"), ("up", "Tilt up"), ("down", "Tilt down"),
                ("in", "Nearer"), ("out", "Farther"), ("reset", "Reset view"),
            )
        )  # fmt: skip
        text += (
            f"<p>{' '.join(map(escaped, remarks))} Circles mark where a track begins.</p>\n"
            f'<div class="plots"><figure><h3>From above</h3><div class="plot tall" id="plot-above" role="img" '
            f'aria-label="{escaped("Tracks from above, north against east, m. " + named)}"></div>'
            f"<figcaption>{escaped(named)}</figcaption></figure>\n"
            f'<figure><h3>In three dimensions</h3><div class="plot tall" id="plot-track" role="img" '
            f'aria-label="{escaped("Tracks in three dimensions, m. " + named)}"></div>'
            f'<div class="controls" role="group" aria-label="View of the tracks"><span class="buttons">{buttons}</span>'
            f"</div></figure></div>\n"
        )
    return text + "".join(
        _distances(part["name"], part["track"], comparison.first) for part in parts if part.get("track")
    )


def _toggles(comparison: Comparison, drawn: Plots) -> str:
    sides = [run.side for run in comparison.runs]
    if isinstance(comparison.against, Log):
        sides = [comparison.measured, *sides]
    return "".join(
        f'<label><input type="checkbox" data-log="{place}" checked><span class="swatch '
        f'{"measured" if log["measured"] else "sim" + str(log["colour"] % 6)}" aria-hidden="true"></span>'
        f"{escaped(log['short'])}: {escaped(side.name, 60)}</label>"
        for place, (log, side) in enumerate(zip(drawn.data["logs"], sides, strict=True))
    )


def _distances(name: str, track: Mapping[str, Any], first: First) -> str:
    """Tables of how far apart the tracks are."""
    inside = {key: one for key, one in track.items() if isinstance(one, Mapping)}
    errors = [{"track": key, **flat(one)} for key, one in inside.items() if "rmse" in one]
    origin = f" ({track['origin']})" if track.get("origin") else ""
    text = table(f"{name}: distance of the simulated track from the {first.word} one{origin}", errors)
    if track.get("relative"):
        text += table(f"{name}: error of the way made good over a time", [flat(row) for row in track["relative"]])
    captions = {
        "way_m": "level length of the tracks, m",
        "closure": f"simulated from {first.of('place')} at the last surfacing; relative to the way until then",
        "skipped": f"{first.of('samples')} of the track left out",
    }
    others = {key: flat(worded(one, first.word)) for key, one in inside.items() if "rmse" not in one}
    return text + "".join(
        table(f"{name}: {captions.get(key, key)}", [{"track": key, **one}]) for key, one in others.items()
    )


def _extents(track: Mapping[str, Any], shorts: Sequence[str]) -> str:
    told = []
    for line in track["lines"]:
        spans = [
            f"{number(min(line[key]))} to {number(max(line[key]))} m {word}"
            for key, word in (("north", "north"), ("east", "east"), ("depth", "deep"))
        ]
        told.append(f"{_sentence(shorts[line['log']])}: {', '.join(spans)}.")
    return " ".join(told)


def _of(shorts: Sequence[str], numbers: Sequence[int]) -> str:
    return ", ".join(shorts[place] for place in numbers)


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]
