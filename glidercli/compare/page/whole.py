"""How is a comparison sent to a colleague? One HTML file: words, tables, plots that work offline, provenance.

The file holds all it needs and asks nothing of a network: its policy (CSP) forbids every request and every script but
its own, whose hashes it names. Texts of logs are escaped. Its size is bounded, see MOST_POINTS, MOST_ROWS and so on.
"""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from glidercli.compare.document import document
from glidercli.compare.facts import Facts
from glidercli.compare.page.drawings import over_time, tracks
from glidercli.compare.page.html import embedded, escaped, flat, table
from glidercli.compare.page.plots import plots
from glidercli.compare.page.provenance import origins
from glidercli.compare.page.tables import errors, events, facts, outcomes
from glidercli.compare.page.words import overview, run_words

if TYPE_CHECKING:
    from glidercli.compare.comparison import Comparison, Side

__all__ = ["page", "save"]

_RECORDED = ("measured", "derived")


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
        ("facts", "Published values", facts(comparison, parts)),
        ("plots", "Plots", over_time(comparison, drawn)),
        ("track", "Tracks", tracks(comparison, drawn, parts)),
        ("errors", "Errors", errors(comparison, parts)),
        ("figures", "Figures of the flights", outcomes(comparison, parts)),
        ("events", "Events", events(comparison, parts)),
        ("reading", "How to read this", _reading(comparison)),
        ("provenance", "Provenance", origins(comparison, provenance)),
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
    return (files("glidercli.compare.page") / "files" / name).read_text(encoding="utf-8")


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
    return [comparison.first.word, *words]


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
    """The comparison in words."""
    text = f"<p>{overview(comparison)}</p>\n"
    for run, part in zip(comparison.runs, parts, strict=True):
        head = f"<h3>{escaped(run.side.name)}</h3>\n" if len(parts) > 1 else ""
        points = "".join(f"<li>{sentence}</li>" for sentence in run_words(comparison, run, part))
        notes = "".join(f'<li class="note"><b>Note:</b> {escaped(note)}.</li>' for note in run.notes)
        text += f'{head}<ul class="said">{points}{notes}</ul>\n'
    if len(told["ranking"]) > 1:
        text += table("Simulations, the closest first", [flat(row) for row in told["ranking"]])
    return text


def _reading(comparison: Comparison) -> str:
    """What the terms mean."""
    if isinstance(comparison.against, Facts):
        return (
            "<p>A value <b>agrees</b> where it differs from the published one by no more than the tolerance. A value "
            "that was given to the simulation agrees by construction. Angles are compared on the circle.</p>\n"
        )
    first, samples = comparison.first, comparison.first.of("samples")
    terms = {
        "n": f"{samples} that were compared",
        "RMSE": "root of the mean squared error",
        "MAE": "mean of the error's magnitude",
        "bias": "mean error; positive where the simulation reads more",
        "standard deviation": "of the error about its mean; RMSE² = bias² + standard deviation²",
        "largest": "largest magnitude of an error",
        "correlation": "Pearson's, angles unwrapped in time first",
        "RMSE / range": f"RMSE over the largest less the smallest {first.of('value')}",
        "left out": f"{samples} outside the simulated times, or inside a gap of theirs longer than "
        f"{comparison.max_gap:g} s",
    }
    rows = "".join(f"<dt>{term}</dt><dd>{meaning}</dd>" for term, meaning in terms.items())
    return (
        f"<p>Errors are simulated less {first.noun}. The {samples} set the times; simulated values are linear "
        "between their samples, never beyond them or across a gap. Angles are differenced the short way round. A dash "
        f"is no value.</p>\n<dl>{rows}</dl>\n"
    )
