"""How many trims does each form of the recursion recover? The grid of docs/recursion.md; some minutes.

Run: python benchmarks/recursion.py
"""

from __future__ import annotations

import itertools
import math

import glidercli
from glidercli.errors import NoSolutionError
from glidercli.model.parameters import parameters, without_coupling
from glidercli.ocean.water import Water
from glidercli.trim import Trim
from glidercli.trim.printed import Assignment, printed_recursions
from glidercli.trim.recursion import Recursion, recursions
from glidercli.vehicle import load_vehicle

NOMINAL = 0.4016
ROTATIONS = (2, 10, 20, 31, 42, 53, 64, 75, 88)  # deg
BUOYANCIES = (0.1, 0.2, 0.3, 0.4, 0.5)  # kg
OFFSETS = (0.005, 0.02, 0.034, 0.048)  # m
FORMS = {
    "printed": Assignment(),
    "printed, half of each change": Assignment(share=0.5),
    "printed, a fifth of each change": Assignment(share=0.2),
    "term of (40) restored, a fifth": Assignment(restored=True, share=0.2),
    "and r_rx from (37), gamma from (40), half": Assignment(restored=True, swapped=True, share=0.5),
    "and omega_3 from (39), half": Assignment(restored=True, swapped=True, rate_from_39=True, share=0.5),
    "and omega_3 from (39), whole": Assignment(restored=True, swapped=True, rate_from_39=True),
}


def points() -> list[Trim]:
    """Trims of the four quadrants that the root solver finds."""
    found = []
    for degrees, mb, offset, way, turn in itertools.product(ROTATIONS, BUOYANCIES, OFFSETS, (1, -1), (1, -1)):
        try:
            trim = glidercli.trim(
                net_buoyancy=way * mb, mass_position=NOMINAL + way * offset, mass_rotation=math.radians(turn * degrees),
                equations="paper",
            )  # fmt: skip
        except NoSolutionError:
            continue
        found.append(trim)
    return found


def passes(sequences: list[Recursion], point: Trim) -> int | None:
    """Passes after which a sequence stands at the point, or None."""
    wanted = (point.net_buoyancy, point.mass_position, point.mass_rotation)
    for one in sequences:
        controls = (one.last.mb, one.last.rrx, one.last.gamma)
        if one.converged and max(abs(a - b) for a, b in zip(controls, wanted, strict=True)) < 1e-6:
            return len(one.iterates)
    return None


def main() -> None:
    p = without_coupling(parameters(load_vehicle("seawing")))
    water = Water(p.rho_0, 0.0, p.T_0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 9.81)
    grid = points()
    print(f"{len(grid)} points")
    for name, how in [*FORMS.items(), ("closed form", None)]:
        needed = []
        for point in grid:
            flow = (point.speed, point.angle_of_attack, point.sideslip)
            closed = how is None
            found = (
                recursions(*flow, NOMINAL, water, p) if closed else printed_recursions(*flow, NOMINAL, water, p, how)
            )
            needed.append(passes(found, point))
        counts = sorted(count for count in needed if count is not None)
        share = 100.0 * len(counts) / len(grid)
        told = f"median {counts[len(counts) // 2]}, most {counts[-1]} passes" if counts else ""
        print(f"{name:<45} {share:6.1f} %  {told}", flush=True)


if __name__ == "__main__":
    main()
