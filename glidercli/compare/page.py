"""How is a comparison sent to a colleague? One HTML file: words, tables, plots that work offline, provenance.

The file holds all it needs and asks nothing of a network: its policy (CSP) forbids every request and every script but
its own, whose hashes it names. Texts of logs are escaped. Its size is bounded, see MOST_POINTS, MOST_ROWS and so on.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from glidercli.compare.document import document
from glidercli.compare.facts import Facts
from glidercli.compare.page_html import embedded, escaped, flat, number, table
from glidercli.compare.page_plots import Plots, plots
from glidercli.compare.page_words import overview, run_words
from glidercli.log import Log

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison, Side

__all__ = ["page", "save"]

_VERDICTS = {"agrees": "agrees", "agrees, as given": "open", "disagrees": "disagrees", "not simulated": "open"}
_ERRORS = ("unit", "n", "rmse", "mae", "bias", "std", "max", "correlation", "nrmse")

_RECORDED = ("measured", "derived")

MOST_METADATA = 100
"""Texts that a log says of itself that are shown."""


def save(comparison: Comparison, path: Path, provenance: Mapping[str, Any]) -> None:
    """Write the page."""
    path.write_text(page(comparison, provenance), encoding="utf-8", newline="\n")


def page(comparison: Comparison, provenance: Mapping[str, Any]) -> str:
    """The page as HTML.

    provenance : versions, command, inputs with hashes, seed; see provenance.py.
    """
    told = document(comparison)
    parts = told.get("simulations") or [{"name": comparison.runs[0].side.name, **told}]
    drawn = plots(comparison, _shorts(comparison))
    sections = [
        ("summary", "Summary", _summary(comparison, told, parts)),
        ("facts", "Published values", _facts(comparison, parts)),
        ("plots", "Plots", _plots(comparison, drawn)),
        ("track", "Tracks", _track(comparison, drawn, parts)),
        ("errors", "Errors", _errors(comparison, parts)),
        ("figures", "Figures of the flight", _tables("Measured and simulated", parts, "figures")),
        ("events", "Events", _events(parts)),
        ("reading", "How to read this", _reading(comparison, drawn)),
        ("provenance", "Provenance", _provenance(comparison, provenance)),
    ]
    sections = [section for section in sections if section[2]]
    title = _title(comparison)
    plotly, script, style = (_file(name) for name in ("plotly-gl3d.min.js", "page.js", "page.css"))
    policy = (
        f"default-src 'none'; script-src {_hash(plotly)} {_hash(script)}; style-src 'unsafe-inline'; "
        "img-src data: blob:; base-uri 'none'; form-action 'none'"
    )
    links = "".join(f'<li><a href="#{name}">{head}</a></li>' for name, head, _ in sections)
    body = "".join(
        f'<section aria-labelledby="{name}"><h2 id="{name}">{head}</h2>\n{content}</section>\n'
        for name, head, content in sections
    )
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="{escaped(str(provenance.get("program", "glidercli")))}">
<title>{title}</title>
<style>{style}</style>
</head>
<body>
<a class="skip" href="#content">Skip to the content</a>
<header>
<div class="top"><h1>{title}</h1><button type="button" id="theme" hidden>Dark colours</button></div>
{_sides(comparison)}
</header>
<nav aria-label="On this page"><ul>{links}</ul></nav>
<main id="content" tabindex="-1">
{body}</main>
<script type="application/json" id="data">{embedded(drawn.data)}</script>
<script>{plotly}</script>
<script>{script}</script>
</body>
</html>
"""


def _file(name: str) -> str:
    return (files("glidercli.compare") / "page_files" / name).read_text(encoding="utf-8")


def _hash(script: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'"


def _title(comparison: Comparison) -> str:
    runs = comparison.runs
    first = escaped(runs[0].side.name, 80) if len(runs) == 1 else f"{len(runs)} simulations"
    if isinstance(comparison.against, Facts):
        return f"{first} against {escaped(comparison.against.title or 'published values', 120)}"
    return f"{first} against {escaped(comparison.measured.name, 80)}"


def _shorts(comparison: Comparison) -> list[str]:
    """What the plots call each log: short, and no text of the log's."""
    words = ["compared" if run.side.origin in _RECORDED else run.side.origin for run in comparison.runs]
    if len(words) > 1:
        words = [f"{word} {count}" for count, word in enumerate(words, start=1)]
    if isinstance(comparison.against, Facts):
        return words
    return ["measured", *words]


def _sides(comparison: Comparison) -> str:
    """What each side is: said before anything else."""
    rows = [
        _side(side, place - 1)
        for place, side in enumerate([comparison.measured, *(run.side for run in comparison.runs)])
    ]
    return f'<ul class="sides" aria-label="What is compared">{"".join(rows)}</ul>'


def _side(side: Side, colour: int) -> str:
    words = {"published": "Published values", "reconstruction": "A reconstruction"}
    kind = words.get(side.origin, side.origin.capitalize())
    if colour >= 0 and side.origin in _RECORDED:
        kind += ", stands here as a simulation:"
    remade = ""
    if side.reconstruction:
        what = "Reconstruction" if side.origin == "reconstruction" else "Made with a reconstruction"
        remade = f'<p class="remade">{what}: {escaped(side.reconstruction)}</p>'
    mark = "published" if side.origin == "published" else "measured" if colour < 0 else f"sim{colour % 6}"
    return (
        f'<li><span class="swatch {mark}" aria-hidden="true"></span><span class="kind">{escaped(kind)}</span> '
        f'<span class="name">{escaped(side.name)}</span>{remade}</li>'
    )


def _summary(comparison: Comparison, told: Mapping[str, Any], parts: Sequence[Mapping[str, Any]]) -> str:
    text = f"<p>{overview(comparison)}</p>\n"
    for run, part in zip(comparison.runs, parts, strict=True):
        head = f"<h3>{escaped(run.side.name)}</h3>\n" if len(parts) > 1 else ""
        points = "".join(f"<li>{sentence}</li>" for sentence in run_words(comparison, run, part))
        notes = "".join(f'<li class="note"><b>Note:</b> {escaped(note)}.</li>' for note in run.notes)
        text += f'{head}<ul class="said">{points}{notes}</ul>\n'
    if told.get("ranking"):
        text += table("Simulations, the closest first", [flat(row) for row in told["ranking"]])
    return text


def _facts(comparison: Comparison, parts: Sequence[Mapping[str, Any]]) -> str:
    if not isinstance(comparison.against, Facts):
        return ""
    text = ""
    for part in parts:
        rows = []
        for one in part["facts"]:
            phase = "" if one["phase"] == "flight" or one["phase"] in one["name"].split() else f" ({one['phase']})"
            remarks = [
                one["tolerance_reason"] and f"tolerance: {one['tolerance_reason']}",
                one["reason"],
                one["note"],
            ]
            rows.append(
                {
                    "value": one["name"] + phase,
                    "published": f"{number(one['published'])} ± {number(one['tolerance'])}",
                    "simulated": one["simulated"],
                    "difference": _difference(one),
                    "unit": one["unit"],
                    "verdict": one["verdict"] + (", as given" if one["given"] and one["verdict"] == "agrees" else ""),
                    "place": one["place"],
                    "remarks": "; ".join(word for word in remarks if word),
                }
            )
        caption = (
            f"{escaped(part['name'])}: published and simulated values. The difference is simulated less published."
        )
        text += table(caption, rows, classes=_VERDICTS)
    return text


def _difference(one: Mapping[str, Any]) -> float | None:
    """Simulated less published; rounding in the last digits is none."""
    difference: float | None = one["difference"]
    if difference is None:
        return None
    return 0.0 if abs(difference) <= 1e-12 * abs(one["published"]) else difference


def _plots(comparison: Comparison, drawn: Plots) -> str:
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
    below = " The lower part of each plot is simulated less measured." if isinstance(comparison.against, Log) else ""
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
        f"missing. All plots share their time axis: drag over one, or use the buttons.{thin}{notes}</p>\n"
        f'<noscript><p class="note">The plots need JavaScript; words and tables do not.</p></noscript>\n'
        f'<div class="controls plotcontrols" role="group" aria-label="Controls of the plots">'
        f"{_toggles(comparison, drawn)}"
        f'<span class="buttons">{buttons}</span></div>\n<div class="plots">{figures}</div>\n'
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


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]


def _track(comparison: Comparison, drawn: Plots, parts: Sequence[Mapping[str, Any]]) -> str:
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
    return text + "".join(_distances(part["name"], part["track"]) for part in parts if part.get("track"))


def _distances(name: str, track: Mapping[str, Any]) -> str:
    """Tables of how far apart the tracks are."""
    inside = {key: one for key, one in track.items() if isinstance(one, Mapping)}
    errors = [{"track": key, **flat(one)} for key, one in inside.items() if "rmse" in one]
    origin = f" ({track['origin']})" if track.get("origin") else ""
    text = table(f"{name}: distance of the simulated track from the measured one{origin}", errors)
    if track.get("relative"):
        text += table(f"{name}: error of the way made good over a time", [flat(row) for row in track["relative"]])
    others = [{"track": key, **flat(one)} for key, one in inside.items() if "rmse" not in one]
    return text + "".join(table(f"{name}: {row['track']} of the track", [row]) for row in others)


def _of(shorts: Sequence[str], numbers: Sequence[int]) -> str:
    return ", ".join(shorts[place] for place in numbers)


def _extents(track: Mapping[str, Any], shorts: Sequence[str]) -> str:
    told = []
    for line in track["lines"]:
        spans = [
            f"{number(min(line[key]))} to {number(max(line[key]))} m {word}"
            for key, word in (("north", "north"), ("east", "east"), ("depth", "deep"))
        ]
        told.append(f"{_sentence(shorts[line['log']])}: {', '.join(spans)}.")
    return " ".join(told)


def _errors(comparison: Comparison, parts: Sequence[Mapping[str, Any]]) -> str:
    if isinstance(comparison.against, Facts):
        return ""
    text = ""
    if len(parts) > 1:
        names = dict.fromkeys(name for part in parts for name in part["channels"])
        rows = []
        for name in names:
            units = [part["channels"][name]["unit"] for part in parts if name in part["channels"]]
            rmse = {
                f"{place}: {part['name']}"[:60]: part["channels"].get(name, {}).get("rmse")
                for place, part in enumerate(parts, start=1)
            }
            known = [key for key in rmse if rmse[key] is not None]
            least = min(known, key=lambda key: float(rmse[key]), default=None)
            closest = "" if least is None or len(known) < 2 else least.partition(":")[0]
            rows.append({"channel": name.replace("_", " "), "unit": _unit(units[0]), **rmse, "closest": closest})
        text += table("RMSE of every simulation side by side", rows)
    for part in parts:
        name = part["name"]
        for caption, channels in (
            (f"{name}: errors over the whole flight", part["channels"]),
            (f"{name}: on dives of the measured log", part["phases"]["dive"]),
            (f"{name}: on climbs of the measured log", part["phases"]["climb"]),
        ):
            text += table(caption, [_row(channel, one) for channel, one in channels.items()])
        for band in part.get("bands") or []:
            caption = f"{name}: from {number(band['from_m'])} to {number(band['to_m'])} m of depth"
            text += table(caption, [_row(channel, one) for channel, one in band["channels"].items()])
    return text


def _row(channel: str, one: Mapping[str, Any]) -> dict[str, Any]:
    found = flat({"channel": channel.replace("_", " "), **{key: one[key] for key in _ERRORS}})
    found["unit"] = _unit(one["unit"])
    found["left out"] = sum(one["skipped"].values())
    if one.get("origins"):
        found["measured is"], found["simulated is"] = one["origins"]["measured"], one["origins"]["simulated"]
    return found


def _unit(unit: str) -> str | None:
    return None if unit == "1" else unit


def _events(parts: Sequence[Mapping[str, Any]]) -> str:
    text = ""
    for part in parts:
        rows = []
        for one in part["events"]:
            sides = {
                f"{side}: {head}": (one[side] or {}).get(key)
                for side in ("measured", "simulated")
                for key, head in (("time_utc", "time, UTC"), ("depth_m", "depth, m"))
            }
            more = {key: one[key] for key in one if key not in ("name", "measured", "simulated")}
            rows.append({"event": one["name"], **sides, **flat(more)})
        text += table(f"{part['name']}: events in both logs, or in one of them", rows)
    return text


def _tables(caption: str, parts: Sequence[Mapping[str, Any]], key: str) -> str:
    return "".join(
        table(f"{part['name']}: {caption.lower()}", [flat(row) for row in part[key]]) for part in parts if part.get(key)
    )


def _reading(comparison: Comparison, drawn: Plots) -> str:
    if isinstance(comparison.against, Facts):
        return (
            "<p>A value <b>agrees</b> where it differs from the published one by no more than the tolerance. A value "
            "that was given to the simulation agrees by construction. Angles are compared on the circle.</p>\n"
        )
    terms = {
        "n": "measured samples that were compared",
        "RMSE": "root of the mean squared error",
        "MAE": "mean of the error's magnitude",
        "bias": "mean error; positive where the simulation reads more",
        "standard deviation": "of the error about its mean; RMSE² = bias² + standard deviation²",
        "largest": "largest magnitude of an error",
        "correlation": "Pearson's, angles unwrapped in time first",
        "RMSE / range": "RMSE over the largest less the smallest measured value",
        "left out": "measured samples outside the simulated times, or inside a gap of theirs longer than "
        f"{comparison.max_gap:g} s",
    }
    rows = "".join(f"<dt>{term}</dt><dd>{meaning}</dd>" for term, meaning in terms.items())
    return (
        "<p>Errors are simulated less measured. The measured samples set the times; simulated values are linear "
        "between their samples, never beyond them or across a gap. Angles are differenced the short way round. A dash "
        f"is no value.</p>\n<dl>{rows}</dl>\n"
    )


def _provenance(comparison: Comparison, record: Mapping[str, Any]) -> str:
    text = _record(record)
    logs = [(comparison.measured, comparison.against), *((run.side, run.log) for run in comparison.runs)]
    for side, log in logs:
        if isinstance(log, Log) and log.metadata:
            text += _says(side.name, log)
    return text


def _record(record: Mapping[str, Any]) -> str:
    """One provenance record: what it names, then its inputs."""
    command = record.get("command")
    rows = {key: value for key, value in record.items() if key not in ("command", "inputs") and value != ""}
    items = "".join(
        f"<dt>{escaped(str(key))}</dt><dd>{'none' if value is None else escaped(_shown(value))}</dd>"
        for key, value in rows.items()
    )
    text = f"<dl>{items}</dl>\n"
    if isinstance(command, list):
        import shlex

        text += f"<p>Command:</p><pre>{escaped(shlex.join(map(str, command)))}</pre>\n"
    inputs = record.get("inputs")
    if isinstance(inputs, list) and all(isinstance(one, Mapping) for one in inputs):
        text += table("Inputs", [{headed: one.get(key) for key, headed in _INPUTS} for one in inputs])
    return text


_INPUTS = (("path", "file"), ("sha256", "SHA-256"))


def _shown(value: Any) -> str:
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _says(name: str, log: Log) -> str:
    """What a log says of itself, its own provenance set out."""
    entries = [(key, text) for key, text in log.metadata.items() if key != "provenance"]
    items = "".join(f"<dt>{escaped(key, 200)}</dt><dd>{escaped(text)}</dd>" for key, text in entries[:MOST_METADATA])
    more = f"<p>{len(entries) - MOST_METADATA} more are not shown.</p>" if len(entries) > MOST_METADATA else ""
    own = ""
    if "provenance" in log.metadata:
        try:
            record = json.loads(log.metadata["provenance"])
        except ValueError:
            record = None
        told = _record(record) if isinstance(record, dict) else f"<p>{escaped(log.metadata['provenance'])}</p>"
        own = f"<h3>How it was made</h3>\n{told}"
    return (
        f"<details><summary>What {escaped(name, 120)} says of itself</summary>\n<dl>{items}</dl>{more}\n"
        f"{own}</details>\n"
    )
