"""What do estimates look like? Each coefficient's interval over the vehicle's own, or over the estimate itself."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from glidercli.coefficients.handbook.estimate import Estimated
from glidercli.pictures import COLOURS, WIDTH

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from glidercli.coefficients.base import Base

__all__ = ["figure"]

_LEAST = 0.05
"""Ratios are drawn down to here; what is lower, or of the other sign, stands at the edge."""


def figure(found: Estimated, base: Base | None) -> Figure:
    """Intervals and estimates as ratios, on a logarithmic axis; coefficients without a ratio are named."""
    from matplotlib.figure import Figure
    from matplotlib.ticker import FuncFormatter

    from glidercli.coefficients.handbook.output import of_base

    if base is not None and not base.coefficients:
        base = None
    drawn, left = [], []
    for one in found.coefficients.values():
        total = one.total
        own = None if base is None else of_base(base, one)
        against = total.value if base is None else own.value if own else 0.0
        ends = (total.lower / against, total.value / against, total.upper / against) if against else (0.0, 0.0, 0.0)
        if ends[1] > 0.0:
            drawn.append((one.row.symbol, min(ends), ends[1], max(ends)))
        else:
            left.append(one.row.symbol)
    made = Figure(figsize=(WIDTH, 0.8 + 0.24 * max(len(drawn), 1) + (0.2 if left else 0.0)), layout="constrained")
    axes = made.subplots()
    for place, (_, lower, value, upper) in enumerate(drawn):
        axes.plot([max(lower, _LEAST), max(upper, _LEAST)], [place, place], color=COLOURS[5], linewidth=4.0)
        axes.plot(max(value, _LEAST), place, "o", color=COLOURS[1], markersize=4.0)
    axes.axvline(1.0, color=COLOURS[0], linewidth=1.0)
    axes.set_xscale("log")
    most = max([upper for _, _, _, upper in drawn] + [2.0])
    least = max(min([lower for _, lower, _, _ in drawn] + [0.5]), _LEAST)
    axes.set_xlim(least / 1.15, most * 1.15)
    ticks = [one * 10.0**power for power in range(-2, 4) for one in (1.0, 2.0, 5.0)]
    axes.set_xticks([tick for tick in ticks if least / 1.15 <= tick <= most * 1.15])
    axes.xaxis.set_major_formatter(FuncFormatter(lambda tick, _: f"{tick:g}"))
    axes.minorticks_off()
    axes.set_yticks(range(len(drawn)), [_mathtext(symbol) for symbol, *_ in drawn])
    axes.invert_yaxis()
    over = "the estimate" if base is None else f"that of {_plain(base.name)}"
    label = f"estimate (dot) and its interval (bar), over {over}"
    axes.set_xlabel(label + (f"\nno ratio: {', '.join(map(_mathtext, left))}" if left else ""))
    axes.set_title(
        f"ESTIMATED from {_plain(found.geometry.name)} by handbook formulas, at {found.speed:g} m/s, "
        f"up to {math.degrees(found.angle):g} deg"
    )
    return made


def _plain(name: str) -> str:
    """A name with nothing in it that is set as a formula."""
    return name.replace("$", r"\$")


def _mathtext(symbol: str) -> str:
    """A symbol of the paper as it is set: K_alpha with the letter below."""
    letter, _, below = symbol.partition("_")
    greek = {"alpha": r"\alpha", "beta": r"\beta"}
    return f"${letter}_{{{greek.get(below, below)}}}$"
