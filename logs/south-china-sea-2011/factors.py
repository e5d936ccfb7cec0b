"""How much of the trial's differences does each factor explain that the paper suspects? FROM A RECONSTRUCTION.

    python factors.py [-o factors.csv] [--force]

Flies the reconstruction as it stands and once for each variant below, and prints what each does to pitch, roll, turn
and time, with its share of the difference to what the paper prints (glidercli/compare/factors.py). Nothing is tuned:
the base is the shipped mission, and each number of a variant has its origin beside it.
"""

from __future__ import annotations

import argparse
import csv
import math
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from glidercli.compare import read_facts
from glidercli.compare.factors import Factors, Variant, factors
from glidercli.errors import GliderError
from glidercli.files import check_not_inputs, check_outputs
from glidercli.provenance import provenance

FOLDER = Path(__file__).parent
INPUTS = [
    FOLDER / name
    for name in ("mission.toml", "facts.toml", "factors.py", "water.csv", "current.csv", "dive.csv", "climb.csv")
]

DEPTH = 800.0  # m, printed
SURFACE, RISE = 1022.0, 0.007  # kg/m3, and the rise to DEPTH: as in reconstruct.py

SOFT_HULL = 4e-10  # 1/Pa: 4e-6 per dbar, of the order of a Seaglider's; none is printed
ALUMINIUM = 7e-5  # 1/K, of volume: three times the metal's 23e-6; none is printed
WARM, COLD = 29.0, 5.0  # degC at the surface and at DEPTH, invented

# The tail wings, estimated. Strip theory gives a hull with equal ends no N_v'; if the printed 2.57 kg m is all the
# tail's, 1 m aft (half of the hull's 1.99 m), its added mass is 2.57 kg = rho pi (h/2)^2 c: with a chord c of 0.08 m
# two wings of 0.1 m. The lift slope 2 pi A / (A + 2) of their aspect ratio A makes 28.6 kg/m per rad, a quarter of
# K_beta.
ARM, CHORD = 1.0, 0.08  # m
SPAN = 2.0 * math.sqrt(2.57 / ARM / (1025.0 * math.pi * CHORD))  # m, of both wings
ASPECT = SPAN / CHORD
TAIL = 0.5 * 1025.0 * SPAN * CHORD * 2.0 * math.pi * ASPECT / (ASPECT + 2.0)  # kg/m per rad
SPEED = 0.4  # m/s, where the paper's K_r r V^2 stands for a damping that goes with r V


def tail(share: float, height: float = 0.0) -> dict[str, float]:
    """Table 3 with this share of the estimated tail's lift added; height : m above the axis that it acts at."""
    k = share * TAIL
    return {
        "Kbeta": -115.65 - k,
        "KMY": 34.10 + k * ARM,
        "Kr": -389.30 - k * ARM**2 / SPEED,
        "KMR": -58.27 - k * height,
    }


def variants(folder: Path) -> list[Variant]:
    """What is varied. folder : where tables of other water are written."""
    straight = water(folder / "straight.csv", lambda z: min(z, DEPTH) / DEPTH)
    parabola = water(folder / "parabola.csv", lambda z: 1.0 - (1.0 - min(z, DEPTH) / DEPTH) ** 2)
    warm = water(folder / "warm.csv", as_reconstructed, lambda z: WARM + (COLD - WARM) * as_reconstructed(z))

    def density(name: str, basis: str, **mission: str | float | None) -> Variant:
        return Variant("density", name, basis, mission=mission)

    def mass(name: str, basis: str, **parameters: float | tuple[float, ...]) -> Variant:
        return Variant("mass distribution", name, basis, parameters)

    def forward(position: float, basis: str) -> Variant:
        return Variant("mass distribution", f"r_rx {position:g} m", basis, controls={"dive.mass_position_m": position})

    def coupling(name: str, basis: str, **parameters: float) -> Variant:
        return Variant("coupling", name, basis, parameters)

    def wings(name: str, basis: str, **parameters: float) -> Variant:
        return Variant("tail wings", name, basis, parameters)

    uniform = density("uniform water", "the paper's model", ctd=None)
    soft = Variant("hull", "4e-6 per dbar", "the order of a Seaglider's", {"kappa": SOFT_HULL})
    expansion = {"chi": ALUMINIUM, "T_0": WARM}
    expanding = Variant("hull", "7e-5 per K", "aluminium; 29 degC falling to 5, invented", expansion, {"ctd": warm})
    steep = forward(0.423, "what a pitch of -40 deg needs")
    small = Variant(
        "roll moment", "K_MR -20", "about where a climb's turn reverses, as on real gliders", {"KMR": -20.0}
    )
    none = Variant("roll moment", "K_MR 0", "static balance alone", {"KMR": 0.0})
    digit, oil = "half a unit of the last printed digit", "the paper has 0 and names the oil; the size is invented"
    lifting = wings("lift", "estimated, see factors.py", **tail(1.0))
    return [
        uniform,
        density("neutral at 1025 kg/m3", "the density of the CFD", neutral_density_kg_m3=1025.0),
        density("rise straight to 800 m", "0.7 % too; the paper has it ever slower", ctd=straight),
        density("rise a parabola to 800 m", "0.7 % too, ever slower", ctd=parabola),
        soft,
        expanding,
        soft.and_(expanding, factor="hull", name="both"),
        steep,
        forward(0.42165, digit),
        mass("r_s x -0.08135 m", digit, rs=(-0.08135, 0.0, 0.0032)),
        mass("r_s z 0.00315 m", digit, rs=(-0.0814, 0.0, 0.00315)),
        mass("R_r 0.0135 m", digit, Rr=0.0135),
        mass("these four digits", digit, rs=(-0.08135, 0.0, 0.00315), Rr=0.0135).and_(
            forward(0.42165, digit), factor="mass distribution", name="these four digits"
        ),
        mass("oil 0.05 m forward", oil, rb=(0.05, 0.0, 0.0)),
        mass("oil 0.05 m aft", oil, rb=(-0.05, 0.0, 0.0)),
        coupling("N_v' -2.57", "sign not printed; strip theory with fins aft", Nv=-2.57),
        coupling("Z_q' -3.61", "sign not printed", Mw=-3.61),
        coupling("N_v' -2.57, Z_q' -3.61", "signs not printed", Nv=-2.57, Mw=-3.61),
        Variant("inertia", "10.16 kg m2", "the misprint, which no rigid body can have", {"Ir0": (0.02, 10.16, 0.17)}),
        lifting,
        wings("lift, N_v' -2.57", "and the sign of their added mass", **tail(1.0), Nv=-2.57),
        wings("lift 0.1 m above the axis", "the upper wing alone", **tail(1.0, 0.1)),
        wings("lift 0.1 m below the axis", "the lower wing alone", **tail(1.0, -0.1)),
        wings("lift taken away", "if Table 3 had it", **tail(-1.0)),
        Variant("current", "none", "the reconstruction has 0.77 m/s at 4 m", mission={"adcp": None}),
        Variant("current", "no shear term", "eq. (50) alone, as printed", equations="paper"),
        Variant("controls", "always at -60 deg", "returns are invented", controls={"dive.mass_rotation_deg": -60.0}),
        small,
        none,
        none.and_(uniform, name="K_MR 0, uniform water"),
        none.and_(soft, name="K_MR 0, 4e-6 per dbar"),
        none.and_(soft, steep, name="K_MR 0, 4e-6, r_rx 0.423"),
        small.and_(soft, steep, name="K_MR -20, 4e-6, r_rx 0.423"),
        lifting.and_(soft, steep, name="tail lift, 4e-6, r_rx 0.423"),
        soft.and_(steep, name="4e-6, r_rx 0.423"),
    ]


def as_reconstructed(depth: float) -> float:
    """Share of its rise that the reconstructed density has made at a depth, m."""
    return (1.0 - math.exp(-depth / 300.0)) / (1.0 - math.exp(-DEPTH / 300.0))


def water(path: Path, share: Callable[[float], float], temperature: Callable[[float], float] | None = None) -> str:
    """Write a table of water that has made this share of its rise at each depth; its path."""
    with path.open("w", newline="", encoding="utf-8") as stream:
        rows = csv.writer(stream, lineterminator="\n")
        rows.writerow(["depth_m", "density_kg_m3", *(["temperature_degC"] if temperature else []), "origin"])
        for z in range(0, 1001, 10):
            warmth = [f"{temperature(z):.4f}"] if temperature else []
            rows.writerow([z, f"{SURFACE * (1.0 + RISE * share(z)):.4f}", *warmth, "reconstruction"])
    return str(path)


def table() -> Factors:
    """The base and all variants, flown."""
    with tempfile.TemporaryDirectory() as folder:
        return factors(FOLDER / "mission.toml", variants(Path(folder)), read_facts(FOLDER / "facts.toml"), DEPTH)


def main() -> None:
    """Print the table, and keep it if asked."""
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("-o", metavar="FILE.csv", type=Path, help="keep the table too")
    options.add_argument("--force", action="store_true", help="replace the file")
    given = options.parse_args()
    try:
        files = [given.o] if given.o else []
        check_outputs(files, (".csv",), given.force)
        check_not_inputs(files, INPUTS)
        found = table()
        for file in files:
            found.write(file, provenance(inputs=INPUTS, origin="simulated, from a reconstruction"), given.force)
    except GliderError as error:
        sys.exit(f"factors.py: error: {error}")
    print(f"SIMULATED FROM A RECONSTRUCTION\n\n{found.text()}")


if __name__ == "__main__":
    main()
