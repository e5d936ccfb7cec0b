"""How is the table of cases told on a terminal? How many of what, the water, the domain, a line a radius."""

from __future__ import annotations

from glidercli.coefficients.flows.case_table import CaseTable

__all__ = ["text"]


def text(table: CaseTable, vehicle: str) -> str:
    """The table for people. vehicle : whose it is."""
    column = table.columns
    counts = table.counts()
    first = {name: values[0] for name, values in column.items()}
    lines = [
        f"{len(column['case'])} cases for {vehicle}",
        f"straight         {counts['straight']}, k-epsilon: angle of attack or sideslip -12 to 12 deg by 1",
        f"turning          {counts['about-p3']} about p3, {counts['about-p2']} about p2, k-omega, at each radius:",
        "                 sideslip -3 0 3 6 9 12 deg, angle of attack -3 3 6 9 deg",
        f"speed            {first['speed_m_s']:g} m/s, Reynolds number {first['reynolds_number']:.3g}",
        f"water            {first['density_kg_m3']:.6g} kg/m3, {first['viscosity_Pa_s']:.5g} Pa s",
        f"domain           {first['domain_length_m']:.4g} m long, {first['domain_width_m']:.4g} m wide and high,",
        f"                 inlet {first['inlet_distance_m']:.4g} m ahead of the centre of buoyancy",
        "",
        "radius m   rate rad/s   inlet m/s: inner edge   centre   outer edge",
    ]
    turning = column["set"] == "about-p3"
    names = ("turning_radius_m", "angular_speed_rad_s", "inlet_speed_inner_m_s", "inlet_speed_centre_m_s",
             "inlet_speed_outer_m_s")  # fmt: skip
    shown = dict.fromkeys(zip(*(column[name][turning].tolist() for name in names), strict=True))
    lines += [f"{r:>8g}   {w:>10.5f}   {a:>21.4f}   {b:>6.4f}   {c:>10.4f}" for r, w, a, b, c in shown]
    return "\n".join(lines)
