"""Does the simulator settle on the trim, and how far are the paper's equations from the whole model? The tables of
docs/trim.md; a minute.

Run: python benchmarks/agreement.py
"""

from __future__ import annotations

import itertools
import math

import numpy as np

import glidercli
from glidercli.errors import NoSolutionError
from glidercli.frames import dot, down_in_body
from glidercli.trim import Trim, trims

NOMINAL = 0.4016
ROTATIONS = (2, 10, 20, 31, 42, 53, 64, 75, 88)  # deg
BUOYANCIES = (0.1, 0.2, 0.3, 0.4, 0.5)  # kg
OFFSETS = (0.005, 0.02, 0.034, 0.048)  # m
QUADRANTS = {
    "descend left": (1, -1),
    "descend right": (1, 1),
    "ascend right": (-1, 1),
    "ascend left": (-1, -1),
}
COMPARED = (
    "speed_m_s", "angle_of_attack_deg", "sideslip_deg", "yaw_rate_deg_s", "roll_deg", "pitch_deg", "vertical_speed_m_s",
)  # fmt: skip
CLAIMED = ("speed_m_s", "turning_radius_m", "helix_radius_m", "pitch_deg", "roll_deg")
DEEP = 12_000.0  # m, the most allowed; a climb must not reach the surface


def points(way: int, turn: int) -> list[dict[str, float]]:
    """Controls of a quadrant, SI and rad."""
    return [
        {
            "net_buoyancy": way * mb,
            "mass_position": NOMINAL + way * offset,
            "mass_rotation": math.radians(turn * degrees),
        }
        for degrees, mb, offset in itertools.product(ROTATIONS, BUOYANCIES, OFFSETS)
    ]


def flown(controls: dict[str, float], trim: Trim) -> dict[str, float]:
    """Where the simulator ends from rest, after forty times the slowest decay."""
    seconds = min(max(40.0 / -trim.growth_rate, 1000.0), 12_000.0)
    flight = glidercli.simulate(**controls, start_depth=DEEP, duration=seconds, every=seconds)
    final = flight.document()["final"]
    k_b = down_in_body(math.radians(final["roll_deg"]), math.radians(final["pitch_deg"]))
    about_vertical = dot((final["p_deg_s"], final["q_deg_s"], final["r_deg_s"]), k_b)
    return {**final, "yaw_rate_deg_s": about_vertical, "speed_m_s": final["speed_through_water_m_s"]}


def furthest(final: dict[str, float], trim: Trim) -> float:
    """Largest relative difference of what is compared; of angles below a degree, that of a degree."""
    document = trim.document()
    sizes = [max(abs(document[name]), 1.0 if name.endswith("_deg") else 0.0) for name in COMPARED]
    return max(abs(final[name] - document[name]) / size for name, size in zip(COMPARED, sizes, strict=True))


def told(trim: Trim) -> dict[str, float]:
    """The trim, and its radius as horizontal speed over yaw rate whatever the equations say of it."""
    return {**trim.document(), "helix_radius_m": trim.horizontal_speed / trim.yaw_rate}


def main() -> None:
    print("simulator against trim, full equations; largest relative difference of", ", ".join(COMPARED))
    for name, (way, turn) in QUADRANTS.items():
        settled, elsewhere, unstable, worst = 0, [], 0, 0.0
        for controls in points(way, turn):
            stable = [one for one in trims(**controls) if one.stable]
            if not stable:
                unstable += 1
                continue
            final = flown(controls, stable[0])
            off = min(furthest(final, one) for one in stable)
            if off < 1e-3:
                settled, worst = settled + 1, max(worst, off)
            else:
                elsewhere.append((controls, off))
        print(f"{name:<14} settled {settled}, not stable {unstable}, elsewhere {len(elsewhere)}, furthest {worst:.1e}")
        for controls, off in elsewhere:
            print("   elsewhere:", controls, f"{off:.2g}")

    print("\npaper against full equations: relative difference in %, median / 95th percentile / most, share within 5 %")
    for name, (way, turn) in QUADRANTS.items():
        rows = []
        for controls in points(way, turn):
            try:
                full, paper = (told(trims(**controls, equations=form)[0]) for form in ("full", "paper"))
            except NoSolutionError:
                continue
            rows.append([100.0 * abs(paper[n] / full[n] - 1.0) for n in CLAIMED])
        table = np.array(rows)
        for column, quantity in zip(table.T, CLAIMED, strict=True):
            low, high, most = np.percentile(column, (50, 95, 100))
            within = 100.0 * float((column <= 5.0).mean())
            print(f"{name:<14} {quantity:<18} {low:6.2f} / {high:6.2f} / {most:6.2f}   {within:5.1f} %")


if __name__ == "__main__":
    main()
