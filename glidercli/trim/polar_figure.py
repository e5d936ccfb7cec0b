"""What does a polar look like? Vertical over horizontal speed, and glide angle over speed, by net buoyancy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from glidercli.pictures import COLOURS, WIDTH
from glidercli.trim.polars import Journey, Polar

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["figure"]

_MARKS = (
    ("best_glide", "o", "best glide"),
    ("fastest", "^", "fastest"),
    ("least_energy", "*", "least energy per km made good"),
    ("holds_station", "s", "holds station"),
)


def figure(found: Polar, journey: Journey, name: str) -> Figure:
    """The polar with its best points; a current against the vehicle is a line at its speed."""
    from matplotlib.figure import Figure

    sheet = Figure(figsize=(WIDTH, 3.9))
    left, right = (sheet.add_axes((x, 0.22, 0.4, 0.68)) for x in (0.085, 0.585))
    sheet.text(0.01, 0.985, f"{name}: straight glides", va="top", fontsize=8.5, weight="bold")
    sheet.text(0.01, 0.015, "Computed from the model, not measured.", fontsize=7, color="#444444")
    table, strengths = found.table, np.abs(found.table["net_buoyancy_kg"])
    for number in range(int(found.curve.max()) + 1):
        rows = found.curve == number
        mb = float(table["net_buoyancy_kg"][rows][0])
        style: dict[str, Any] = {
            "color": COLOURS[1 if mb > 0.0 else 0],
            "alpha": 0.35 + 0.65 * abs(mb) / float(strengths.max()),
        }
        horizontal, vertical = table["horizontal_speed_m_s"][rows], table["vertical_speed_m_s"][rows]
        left.plot(horizontal, vertical, lw=1.2, **style)
        speed, angle = table["speed_m_s"][rows], table["glide_angle_deg"][rows]
        right.plot(speed, angle, lw=1.2, **style)
        steep, below = int(np.abs(angle).argmax()), -1.0 if mb > 0.0 else 1.0
        right.annotate(
            f"{mb:g} kg", (speed[steep], angle[steep]), fontsize=6, xytext=(0, 7 * below),
            textcoords="offset points", ha="center", va="center",
        )  # fmt: skip
    for key, marker, label in _MARKS:
        rows = [row for row in (getattr(best, key) for best in found.best.values()) if row is not None]
        if rows:
            style = {"marker": marker, "ls": "none", "color": "black", "ms": 5, "label": label}
            left.plot(table["horizontal_speed_m_s"][rows], table["vertical_speed_m_s"][rows], **style)
            right.plot(table["speed_m_s"][rows], table["glide_angle_deg"][rows], **style)
    if journey.current:
        left.axvline(journey.current, color="#444444", lw=0.8, ls="--", label=f"current {journey.current:g} m/s")
    left.invert_yaxis()
    right.invert_yaxis()
    left.set_xlabel("horizontal speed, m/s")
    left.set_ylabel("vertical speed, m/s, down positive")
    right.set_xlabel("speed, m/s")
    right.set_ylabel("glide angle, deg below horizontal")
    left.set_xlim(left=0.0)
    right.margins(y=0.08)
    handles, labels = left.get_legend_handles_labels()
    sheet.legend(handles, labels, loc="lower right", ncols=5, frameon=False, bbox_to_anchor=(0.995, 0.03))
    return sheet
