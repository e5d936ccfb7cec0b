"""How heavy is the vehicle in this water? Net buoyancy from the pump, the surrounding density and the hull's volume.

The paper has the pump alone, m_b. A hull of volume v0 = (ms + mr) / rho_0 displaces rho v0 (1 - kappa p + chi (T - T0))
in water of density rho, and the pumped oil, -m_b / rho_0, displaces its own share of rho. A rigid hull loses
(rho / rho_0 - 1) (ms + mr): 0.46 kg for 0.7 %, nearly all that the pump can give.
"""

from __future__ import annotations

from glidercli.kernel import kernel
from glidercli.model.parameters import Parameters

__all__ = ["displaced_mass", "hull_excess", "pumped_excess"]


@kernel
def hull_excess(density: float, pressure: float, temperature: float, p: Parameters) -> float:
    """Mass less displaced mass of the hull with the pump at neutral, kg, sinking positive; acts at the origin.

    density : kg/m3, in situ. pressure : Pa, sea pressure. temperature : degC; pass T_0 where it is unknown.
    """
    volume = 1.0 - p.kappa * pressure + p.chi * (temperature - p.T_0)  # relative to the neutral volume
    return (p.ms + p.mr) * (1.0 - density / p.rho_0 * volume)


@kernel
def pumped_excess(mb: float, density: float, p: Parameters) -> float:
    """Excess mass of the pumped volume, kg, sinking positive: m_b rho / rho_0; acts at r_b."""
    return mb * density / p.rho_0


@kernel
def displaced_mass(mb: float, density: float, pressure: float, temperature: float, p: Parameters) -> float:
    """Mass of the water displaced, kg."""
    return p.ms + p.mr - hull_excess(density, pressure, temperature, p) - pumped_excess(mb, density, p)
