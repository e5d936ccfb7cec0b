"""What does a sweep look like? Curves over one pin, maps over two; what is not stable is marked."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from glidercli.errors import UsageError
from glidercli.pictures import COLOURS, WIDTH
from glidercli.trim.pins import QUANTITIES
from glidercli.trim.sweeping import Axis, TrimMap

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["figure"]

Array = NDArray[np.float64]


class Panel(NamedTuple):
    """A column of the table as it is drawn. signed : whether with its sign; else by its size, on a logarithmic axis."""

    column: str
    label: str
    signed: bool


PANELS = (
    Panel("turning_radius_m", "turning radius, m", False),
    Panel("speed_m_s", "speed, m/s", True),
    Panel("glide_angle_deg", "glide angle, deg below horizontal", True),
    Panel("roll_deg", "roll, deg", True),
    Panel("mass_rotation_deg", "mass rotation, deg", True),
    Panel("mass_position_m", "mass position, m", True),
    Panel("net_buoyancy_kg", "net buoyancy, kg", True),
    Panel("angle_of_attack_deg", "angle of attack, deg", True),
    Panel("sideslip_deg", "sideslip, deg", True),
    Panel("pitch_deg", "pitch, deg", True),
)
"""In the order in which they are chosen."""

_CURVES, _MAPS = 6, 3
_NONE = "#EEEEEE"


def figure(found: TrimMap, title: str) -> Figure:
    """A sweep of one pin as curves, of two as maps; UsageError for more."""
    if len(found.axes) > 2:
        raise UsageError("a picture shows one sweep or two; three make a table: .csv, .json or .parquet")
    return _curves(found, title) if len(found.axes) == 1 else _maps(found, title)


def _chosen(found: TrimMap, most: int) -> list[Panel]:
    """The first panels whose quantity varies and is not itself swept."""
    swept = {one.name for one in found.axes}
    chosen = []
    for panel in PANELS:
        values = found.table[panel.column]
        values = values[np.isfinite(values)]
        name = panel.column.rsplit("_deg", 1)[0] if panel.column.endswith("_deg") else panel.column
        if any(name.startswith(one) for one in swept) or not len(values):
            continue
        if np.ptp(values) > 1e-6 * max(1e-3, float(np.abs(values).max())):
            chosen.append(panel)
    return chosen[:most]


def _label(one: Axis) -> str:
    """The axis of a swept pin."""
    return f"{one.name.replace('_', ' ')}, {QUANTITIES[one.name].unit}"


def _shown(one: Axis) -> Array:
    """The values of a swept pin in the unit of its axis."""
    return one.values / QUANTITIES[one.name].factor


def _sheet(rows: int, title: str, remarks: list[str]) -> tuple[Figure, Any]:
    """A figure of two columns with a title and remarks at its foot, and its grid."""
    from matplotlib.figure import Figure

    head, foot = 0.52, 0.5 + 0.14 * len(remarks)
    height = head + 2.15 * rows + foot
    sheet = Figure(figsize=(WIDTH, height))
    sheet.text(0.01, 1.0 - 0.06 / height, title, va="top", fontsize=8.5, weight="bold")
    for number, line in enumerate(reversed(remarks)):
        sheet.text(0.01, (0.06 + 0.14 * number) / height, line, va="bottom", fontsize=7, color="#444444")
    grid = sheet.add_gridspec(
        rows, 2, left=0.09, right=0.965, top=1.0 - head / height, bottom=foot / height, hspace=0.34, wspace=0.26
    )
    return sheet, grid


def _remarks(found: TrimMap) -> list[str]:
    """What a reader must know of the whole: where there is no trim, what is beyond the limits or not stable."""
    lines = ["Computed from the model, not measured."]
    if found.missing:
        lines.append(f"{len(found.missing)} of {found.points} points have no trim.")
    return lines


def _curves(found: TrimMap, title: str) -> Figure:
    """One panel each quantity: stable flights within the limits as dots joined, others marked."""
    panels = _chosen(found, _CURVES)
    rows = -(-len(panels) // 2)
    sheet, grid = _sheet(rows, title, _remarks(found))
    x = _shown(found.axes[0])[found.point]
    stable, within = found.table["stable"], found.table["within_limits"]
    handles: dict[str, Any] = {}
    for number, panel in enumerate(panels):
        axes = sheet.add_subplot(grid[number // 2, number % 2])
        y = _heights(found.table[panel.column], panel)
        for solution in range(1, int(found.solution.max()) + 1):
            line = _line(x, np.where((found.solution == solution) & stable & within, y, np.nan), found, solution)
            axes.plot(*line, "-", color=COLOURS[1], lw=1.3, label="stable, within the limits")
        kinds = (
            (stable & ~within, ".", COLOURS[5], "stable, beyond the limits"),
            (~stable, "x", COLOURS[0], "not stable"),
        )
        for mask, marker, colour, label in kinds:
            if mask.any():
                axes.plot(x[mask], y[mask], marker, color=colour, ms=3, mew=0.8, ls="none", label=label)
        if not panel.signed:
            axes.set_yscale("log")
        axes.set_ylabel(panel.label if panel.signed else f"size of the {panel.label}")
        axes.set_xlim(float(_shown(found.axes[0]).min()), float(_shown(found.axes[0]).max()))
        if number >= len(panels) - 2:
            axes.set_xlabel(_label(found.axes[0]))
        handles |= dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
    sheet.legend(
        handles.values(), handles.keys(), loc="lower right", ncols=3, frameon=False, bbox_to_anchor=(0.99, 0.0)
    )
    return sheet


def _heights(values: Array, panel: Panel) -> Array:
    """Values as drawn: a turning radius by its size, a straight glide's left out."""
    if panel.signed:
        return values
    return np.where(np.isfinite(values), np.abs(values), np.nan)


def _line(x: Array, y: Array, found: TrimMap, solution: int) -> tuple[Array, Array]:
    """One solution over the sweep with a gap at every point that does not have it."""
    whole = np.full(found.points, np.nan)
    mask = found.solution == solution
    whole[found.point[mask]] = y[mask]
    return _shown(found.axes[0]), whole


def _maps(found: TrimMap, title: str) -> Figure:
    """Panels over both pins, the last of them the stability."""
    panels = _chosen(found, _MAPS)
    rows = -(-(len(panels) + 1) // 2)
    remarks = _remarks(found)
    remarks.append("Hatched: beyond the vehicle's limits. Grey: no trim. Each point shows its first-ranked trim.")
    sheet, grid = _sheet(rows, title, remarks)
    for number in range(len(panels) + 1):
        axes = sheet.add_subplot(grid[number // 2, number % 2])
        axes.set_facecolor(_NONE)
        axes.grid(visible=False)
        if number < len(panels):
            _map(axes, found, panels[number])
        else:
            _stability(axes, found)
        _limits(axes, found)
        if number % 2 == 0:
            axes.set_ylabel(_label(found.axes[1]))
        if number >= len(panels) - 1:
            axes.set_xlabel(_label(found.axes[0]))
    return sheet


def _over(found: TrimMap) -> tuple[Array, Array]:
    """Both axes as a map draws them: the first sweep across, the second up."""
    return _shown(found.axes[0]), _shown(found.axes[1])


def _map(axes: Axes, found: TrimMap, panel: Panel) -> None:
    """One quantity as colour and contours; a turning radius by its size, on a logarithmic scale."""
    from matplotlib.colors import LogNorm

    z = _heights(found.grid(panel.column), panel).T
    norm = None if panel.signed else LogNorm()
    drawn = axes.pcolormesh(*_over(found), z, norm=norm, cmap="cividis", shading="nearest", rasterized=True)
    if min(z.shape) > 2 and np.isfinite(z).any():
        levels = _levels(z, panel)
        if len(levels):
            lines = axes.contour(*_over(found), z, levels=levels, colors="white", linewidths=0.6)
            axes.clabel(lines, fontsize=6, fmt="%g")
    assert axes.figure is not None
    axes.figure.colorbar(drawn, ax=axes, pad=0.02)
    axes.set_title(panel.label if panel.signed else f"size of the {panel.label}")


def _levels(z: Array, panel: Panel) -> Array:
    """Levels of a map's contours: 1, 2, 5 and their tens for a radius, even steps otherwise."""
    from matplotlib.ticker import MaxNLocator

    low, high = float(np.nanmin(z)), float(np.nanmax(z))
    if panel.signed:
        levels = np.asarray(MaxNLocator(7).tick_values(low, high))
    else:
        tens = 10.0 ** np.arange(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
        levels = np.sort(np.concatenate([one * tens for one in (1.0, 2.0, 5.0)]))
        levels = levels[levels < 1e4]
    return levels[(levels > low) & (levels < high)]


def _stability(axes: Axes, found: TrimMap) -> None:
    """How fast the slowest deviation dies, or the fastest grows, 1/s; a line where neither."""
    from matplotlib.colors import TwoSlopeNorm

    z = -found.grid("growth_rate_1_s").T
    far = float(np.nanmax(np.abs(z)))
    drawn = axes.pcolormesh(
        *_over(found), z, norm=TwoSlopeNorm(0.0, -far, far), cmap="PuOr", shading="nearest", rasterized=True
    )
    if min(z.shape) > 2 and np.nanmin(z) < 0.0 < np.nanmax(z):
        axes.contour(*_over(found), z, levels=[0.0], colors="black", linewidths=0.9)
    assert axes.figure is not None
    axes.figure.colorbar(drawn, ax=axes, pad=0.02)
    axes.set_title("slowest decay, 1/s; negative: not stable")


def _limits(axes: Axes, found: TrimMap) -> None:
    """Hatching over what lies beyond the vehicle's limits."""
    beyond = (found.grid("within_limits") == 0.0).T
    if beyond.any() and min(beyond.shape) > 1:
        axes.contourf(*_over(found), beyond.astype(float), levels=[0.5, 1.5], colors="none", hatches=["////"])
