"""What does a fit of coefficients look like? The panels of Fig. 8: forces of every case, the fit, and the residuals."""

from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli import pictures
from glidercli.coefficients.forces.fitting import Fitted
from glidercli.coefficients.forces.result import Result
from glidercli.units import DEGREE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["figure"]

Array = NDArray[np.float64]


class _Panel(NamedTuple):
    """equation : whose data it shows. across : what is along the axis. by : what tells lines apart, or ""."""

    title: str
    equation: str
    across: str
    by: str
    label: str


_PANELS = (
    _Panel("drag", "drag", "alpha", "", "D, N"),
    _Panel("lift", "lift", "alpha", "", "L, N"),
    _Panel("pitch moment, straight", "pitch moment, straight", "alpha", "", "T2, N m"),
    _Panel("pitch moment, turning", "pitch moment, turning", "q", "alpha", "T2, N m"),
    _Panel("side force", "side force", "beta", "", "SF, N"),
    _Panel("yaw moment", "yaw moment", "r", "beta", "T3, N m"),
    _Panel("roll moment", "roll moment", "beta", "", "T1, N m"),
    _Panel("roll moment", "roll moment", "p", "beta", "T1, N m"),
)
_AXES = {
    "alpha": "angle of attack, deg", "beta": "sideslip, deg", "p": "p, rad/s", "q": "q, rad/s", "r": "r, rad/s",
}  # fmt: skip
_WORDS = {"alpha": "angle of attack", "beta": "sideslip"}
_SMALL: dict[str, Any] = {"fontsize": 5.5, "title_fontsize": 5.5}
_ROW = 2.25  # inch


def figure(result: Result) -> Figure:
    """The panels of Fig. 8 of the paper that the table has data for, at most three in a row."""
    from matplotlib.figure import Figure

    equations = {one.equation.name: one for one in result.fit.fitted}
    shown = [panel for panel in _PANELS if panel.equation in equations]
    ratio = {"drag", "lift"} <= set(equations) and np.array_equal(equations["drag"].rows, equations["lift"].rows)
    count = len(shown) + ratio
    across = 2 if count == 4 else min(count, 3)
    down = -(-count // across)
    values = "; ".join(
        f"{symbol} {value:.4g} ± {error:.2g}" for symbol, (value, error, _) in result.fit.values().items()
    )
    lines = textwrap.wrap(values + " (standard errors; units as in a vehicle file)", 132)
    head, foot = 0.72, 0.5 + 0.11 * len(lines)
    height = head + foot + _ROW * down
    drawing = Figure(figsize=(pictures.WIDTH, height))
    grid = drawing.add_gridspec(
        down, across, left=0.085, right=0.985, top=1.0 - head / height, bottom=foot / height, hspace=0.42, wspace=0.42,
    )  # fmt: skip
    letters = iter("abcdefghi")
    if ratio:
        _ratio(drawing.add_subplot(grid[0, 0]), result, equations["drag"], equations["lift"], next(letters))
    for number, panel in enumerate(shown, start=int(ratio)):
        inner = grid[number // across, number % across].subgridspec(2, 1, height_ratios=(2.4, 1.0), hspace=0.1)
        main = drawing.add_subplot(inner[0])
        beneath = drawing.add_subplot(inner[1], sharex=main)
        _panel(main, beneath, result, panel, equations[panel.equation], next(letters))
        drawing.align_ylabels([main, beneath])
    taken = ", forces of added mass taken off" if result.subtracted else ""
    drawing.text(0.01, 1.0 - 0.1 / height, f"Coefficients fitted to {result.forces.path.name}{taken}", va="top", size=9)
    used = f"{result.used} of {len(result.forces.lines)} cases, {result.fit.density:.6g} kg/m³"
    hollow = "; hollow: turning nose down" if _turns_both_ways(result) else ""
    named = f"{used}. Dots: the table; lines: the fit; below: table less fit{hollow}."
    drawing.text(0.01, 1.0 - 0.3 / height, named, va="top", color="#444444")
    drawing.text(0.01, 0.06 / height, "\n".join(lines), va="bottom", size=6.5, color="#444444")
    return drawing


def _turns_both_ways(result: Result) -> bool:
    """Whether the roll moment was measured nose up and nose down, as in Fig. 8(h) and (i); it is fitted as one."""
    rows = [one.rows for one in result.fit.fitted if one.equation.name == "roll moment"]
    return bool(rows) and bool((result.forces.Omega[rows[0], 1] < 0.0).any())


def _quantity(result: Result, name: str, rows: NDArray[np.int64]) -> Array:
    f = result.forces
    if name in ("alpha", "beta"):
        return np.asarray((f.alpha if name == "alpha" else f.beta)[rows] / DEGREE)
    return np.asarray(f.Omega[rows, "pqr".index(name)])


def _panel(main: Axes, beneath: Axes, result: Result, panel: _Panel, one: Fitted, letter: str) -> None:
    """Data and fit above, residuals below."""
    x = _quantity(result, panel.across, one.rows)
    groups = [("", np.arange(len(x)))]
    if panel.by:
        other = np.round(_quantity(result, panel.by, one.rows), 2)
        groups = [(f"{value:g}°", np.flatnonzero(other == value)) for value in np.unique(other)]
        groups = groups if len(groups) <= len(pictures.COLOURS) else [("", np.arange(len(x)))]
    down = result.forces.Omega[one.rows, 1] < 0.0 if "roll" in panel.title else np.zeros(len(x), dtype=bool)
    for number, (name, rows) in enumerate(groups):
        colour = pictures.COLOURS[number] if len(groups) > 1 else "#000000"
        order = rows[np.argsort(x[rows], kind="stable")]
        if len(groups) > 1 or len(np.unique(np.round(x, 9))) == len(x):
            main.plot(x[order], one.fitted[order], color=colour if len(groups) > 1 else pictures.COLOURS[1], lw=0.9)
        else:
            main.plot(x[order], one.fitted[order], "_", color=pictures.COLOURS[1], ms=6, mew=0.9)
        hollow: dict[str, Any] = {"mfc": "white", "mew": 0.7}
        for part, style in ((rows[~down[rows]], dict[str, Any]()), (rows[down[rows]], hollow)):
            main.plot(x[part], one.measured[part], ".", color=colour, ms=4 if style else 3.5, **style)
            beneath.plot(x[part], one.found.residual[part], ".", color=colour, ms=3 if style else 2.5, **style)
        main.plot([], [], ".", color=colour, ms=3.5, label=name)
    if len(groups) > 1:
        low, high = main.get_ylim()
        main.set_ylim(low, high + 0.3 * (high - low))  # room for the legend
        main.legend(
            title=_WORDS[panel.by], loc="upper center", ncols=len(groups), frameon=False, handletextpad=0.0,
            columnspacing=0.4, borderpad=0.0, borderaxespad=0.2, handlelength=0.9, **_SMALL,
        )  # fmt: skip
    beneath.axhline(0.0, color="#666666", lw=0.6)
    _residual_axis(beneath, float(np.abs(one.found.residual).max()), panel.label.split(", ")[1])
    main.set_title(f"({letter}) {panel.title}", loc="left")
    main.set_ylabel(panel.label)
    beneath.set_xlabel(_AXES[panel.across])
    beneath.locator_params(axis="x", nbins=5)
    main.tick_params(labelbottom=False)


def _residual_axis(axes: Axes, most: float, unit: str) -> None:
    """The axis of residuals, in a power of thousand of their unit that keeps its numbers short."""
    from matplotlib.ticker import FuncFormatter

    most = most or 1.0
    power = 3 * math.floor(math.log10(1.3 * most) / 3.0)
    axes.set_ylim(-1.3 * most, 1.3 * most)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value / 10.0**power:.3g}".replace("-", "−")))
    told = {0: unit, -3: f"m{unit}"}.get(power, f"1e{power} {unit}")
    axes.set_ylabel(f"off, {told}", fontsize=6.5)


def _ratio(axes: Axes, result: Result, drag: Fitted, lift: Fitted, letter: str) -> None:
    """Lift over drag, Fig. 8(a): of the table and of the two fits."""
    x = _quantity(result, "alpha", drag.rows)
    order = np.argsort(x, kind="stable")
    axes.plot(x[order], (lift.fitted / drag.fitted)[order], color=pictures.COLOURS[1], lw=0.9)
    axes.plot(x, lift.measured / drag.measured, ".", color="#000000", ms=3.5)
    axes.set_title(f"({letter}) lift over drag", loc="left")
    axes.set_ylabel("L / D")
    axes.set_xlabel(_AXES["alpha"])
