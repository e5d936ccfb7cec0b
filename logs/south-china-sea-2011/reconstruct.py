"""Writes the reconstructed water, current and controls of the trial beside this file. NOT MEASURED.

The recorded series were never published. Each formula below is a stand-in that keeps what section 5 of the paper
prints; README.md says for each choice whether it is printed or invented. Run: python reconstruct.py
"""

from __future__ import annotations

import csv
import math
from pathlib import Path

FOLDER = Path(__file__).parent
ORIGIN = "reconstruction"

SURFACE_DENSITY = 1022.0  # kg/m3, invented within Fig. 10's axis, 1020..1032
DENSITY_RISE = 0.007  # printed: 0.7 % from the surface to 800 m
DENSITY_SCALE = 300.0  # m, invented; printed: "became smaller as the depth increases"


def density(depth: float) -> float:
    """In-situ density, kg/m3: rises by 0.7 % to 800 m, ever more slowly."""
    share = (1.0 - math.exp(-depth / DENSITY_SCALE)) / (1.0 - math.exp(-800.0 / DENSITY_SCALE))
    return SURFACE_DENSITY * (1.0 + DENSITY_RISE * share)


def current(depth: float) -> tuple[float, float]:
    """Current to east and north, m/s: strongest at the surface, faster there than the glider, within Fig. 11's axis."""
    fade = math.exp(-depth / 200.0)
    return 0.1 + 0.6 * fade, 0.05 + 0.3 * fade


def rotation_knots(end: float) -> list[tuple[float, float]]:
    """Mass rotation in deg by time: -60 most of the time, back to 0 for a minute in every ten, turning at 5 deg/s."""
    knots = [(0.0, 0.0), (60.0, 0.0), (72.0, -60.0)]
    start = 600.0
    while start < end:
        knots += [(start, -60.0), (start + 12.0, 0.0), (start + 60.0, 0.0), (start + 72.0, -60.0)]
        start += 600.0
    return knots


def write(name: str, columns: list[str], rows: list[list[float]]) -> None:
    """One table; its last column says of every row what it is."""
    with (FOLDER / name).open("w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream, lineterminator="\n")
        table.writerow([*columns, "origin"])
        table.writerows([*(f"{value:g}" if value == round(value, 3) else f"{value:.4f}" for value in row), ORIGIN]
                        for row in rows)  # fmt: skip


def main() -> None:
    """Write all four tables."""
    write("water.csv", ["depth_m", "density_kg_m3"], [[z, density(z)] for z in range(0, 1001, 10)])
    bins = [4.0 + 8.0 * i for i in range(100)]  # printed: 8 m bins to 800 m
    write("current.csv", ["depth_m", "current_east_m_s", "current_north_m_s"], [[z, *current(z)] for z in bins])
    controls = ["elapsed_s", "mass_position_m", "mass_rotation_deg", "net_buoyancy_kg"]
    write("dive.csv", controls, [[t, 0.4216, gamma, 0.5] for t, gamma in rotation_knots(6120.0)])
    write("climb.csv", controls, [
        [0.0, 0.4216, -60.0, 0.5], [12.0, 0.4096, 0.0, 0.4], [40.0, 0.3816, 0.0, 0.1666667], [120.0, 0.3816, 0.0, -0.5],
    ])  # fmt: skip


if __name__ == "__main__":
    main()
