"""How viscous is the sea, and what is the Reynolds number of a flight? Eq. (23), and a published viscosity."""

from __future__ import annotations

from glidercli.errors import InputError

__all__ = ["LOW_REYNOLDS", "PAPER_DENSITY", "PAPER_VISCOSITY", "reynolds_number", "seawater_viscosity", "turbulence"]

PAPER_DENSITY = 1025.0
"""kg/m3, section 3.1."""
PAPER_VISCOSITY = 1.2124e-3
"""Pa s. Not printed: the middle of 1.21206e-3 to 1.21276e-3, within which eq. (23) gives both printed Reynolds numbers,
4.32e5 at 0.257 m/s and 8.65e5 at 0.514 m/s, to their digits. Seawater has it at 15.25 degC (35.165 g/kg)."""
LOW_REYNOLDS = (1e5, 1e6)
"""Between these the low-Reynolds turbulence models give good estimates: section 3.1, after Jagadeesh et al. (2009)."""


def reynolds_number(speed: float, length: float, density: float, viscosity: float) -> float:
    """Re = rho V L / mu, eq. (23), no unit. speed : m/s. length : of the hull without the tail, m."""
    return density * speed * length / viscosity


def turbulence(reynolds: float) -> str:
    """Why the turbulence models of section 3.1 are not known to serve at a Reynolds number; "" where they are."""
    low, high = LOW_REYNOLDS
    if low < reynolds < high:
        return ""
    return (
        f"Reynolds number {reynolds:.3g} is outside {low:.0e} to {high:.0e}, where low-Reynolds turbulence models "
        "give good estimates (section 3.1)"
    )


def seawater_viscosity(temperature: float, absolute_salinity: float) -> float:
    """Dynamic viscosity of seawater at atmospheric pressure, Pa s: Sharqawy, Lienhard & Zubair (2010), eqs (22), (23).

    mu = mu_w (1 + A S + B S^2), mu_w = 4.2844e-5 + 1 / (0.157 (t + 64.993)^2 - 91.296),
    A = 1.541 + 1.998e-2 t - 9.52e-5 t^2, B = 7.974 - 7.561e-2 t + 4.724e-4 t^2, S in kg/kg; accurate to 1.5 %.

    temperature : t, degC (ITS-90), 0 to 40. absolute_salinity : g/kg, 0 to 150. InputError outside; the formula itself
    goes on to 180 degC, the sea does not.
    """
    for name, value, top, unit in (("temperature", temperature, 40.0, "degC"), ("salinity", absolute_salinity, 150.0,
        "g/kg")):  # fmt: skip
        if not 0.0 <= value <= top:
            raise InputError(name, f"{value:g} {unit} is not allowed; 0 to {top:g} is")
    t, S = temperature, 1e-3 * absolute_salinity
    fresh = 4.2844e-5 + 1.0 / (0.157 * (t + 64.993) ** 2 - 91.296)
    A = 1.541 + 1.998e-2 * t - 9.52e-5 * t * t
    B = 7.974 - 7.561e-2 * t + 4.724e-4 * t * t
    return float(fresh * (1.0 + A * S + B * S * S))
