"""How do trims read on a terminal? One as a list, a sweep as a table, the recursion pass by pass."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

__all__ = ["best_text", "passes", "rows_text", "several_trims"]

_COLUMNS = {  # of a sweep: heading, decimals
    "speed_m_s": ("speed m/s", 4),
    "angle_of_attack_deg": ("attack deg", 3),
    "sideslip_deg": ("sideslip deg", 3),
    "yaw_rate_deg_s": ("yaw deg/s", 4),
    "roll_deg": ("roll deg", 2),
    "pitch_deg": ("pitch deg", 2),
    "mass_position_m": ("position m", 4),
    "mass_rotation_deg": ("rotation deg", 2),
    "net_buoyancy_kg": ("buoyancy kg", 4),
    "turning_radius_m": ("radius m", 2),
    "stable": ("stable", 0),
    "within_limits": ("in limits", 0),
}


def several_trims(trims: Sequence[Mapping[str, Any]]) -> str:
    """Every solution, numbered where there are several."""
    titles = [f"solution {i} of {len(trims)}\n" if len(trims) > 1 else "" for i in range(1, len(trims) + 1)]
    return "\n\n".join(title + one_trim(one) for title, one in zip(titles, trims, strict=True))


def one_trim(t: Mapping[str, Any]) -> str:
    """The trim for people: the ten quantities, then what follows from them."""
    radius = f"{t['turning_radius_m']:.2f} m" if math.isfinite(t["turning_radius_m"]) else "straight"
    vertical = t["vertical_speed_m_s"]
    rows = [
        ("speed", f"{t['speed_m_s']:.4f} m/s"),
        ("angle of attack", f"{t['angle_of_attack_deg']:.4f} deg"),
        ("sideslip", f"{t['sideslip_deg']:.4f} deg"),
        ("yaw rate", f"{t['yaw_rate_rad_s']:.6f} rad/s ({t['yaw_rate_deg_s']:.4f} deg/s)"),
        ("roll", f"{t['roll_deg']:.4f} deg"),
        ("pitch", f"{t['pitch_deg']:.4f} deg"),
        ("mass position", f"{t['mass_position_m']:.4f} m"),
        ("mass rotation", f"{t['mass_rotation_deg']:.2f} deg"),
        ("net buoyancy", f"{t['net_buoyancy_kg']:.4f} kg"),
        ("turning radius", radius),
        ("vertical speed", f"{abs(vertical):.4f} m/s {'down' if vertical >= 0.0 else 'up'}"),
        ("horizontal speed", f"{t['horizontal_speed_m_s']:.4f} m/s"),
        ("glide angle", f"{t['glide_angle_deg']:.2f} deg"),
        ("lift to drag", f"{t['lift_to_drag']:.3f}"),
        ("residual", f"{t['residual']:.1e} N or N m, {t['iterations']} iterations, {t['equations']} equations"),
        ("stable", _stable(t)),
        ("within limits", "yes" if t["within_limits"] else "no"),
    ]
    text = "\n".join(f"{name:<17}{value}" for name, value in rows)
    return text + ("\n\n" + modes_text(t["modes"]) if "modes" in t else "")


def _stable(t: Mapping[str, Any]) -> str:
    """Whether it is, and how fast the slowest deviation dies or the fastest grows."""
    rate = t["growth_rate_1_s"]
    time = 1.0 / max(abs(rate), 1e-12)
    if t["stable"]:
        return f"yes, the slowest deviation decays e-fold in {time:.3g} s"
    return f"no, the worst deviation grows e-fold in {time:.3g} s"


def modes_text(modes: Sequence[Mapping[str, Any]]) -> str:
    """The modes, a line each; the two of a complex pair on one line."""
    lines = ["mode  eigenvalue, 1/s        damping  frequency, rad/s  time to half, s    dominant"]
    shown = [mode for mode in modes if mode["eigenvalue"][1] >= 0.0]
    for number, mode in enumerate(shown, start=1):
        re, im = mode["eigenvalue"]
        value = f"{re:+.5f} ± {im:.5f}i" if im else f"{re:+.5f}"
        half, double = mode["time_to_half_s"], mode["time_to_double_s"]
        time = f"{half:.4g}" if half is not None else f"doubles in {double:.4g}" if double is not None else "neutral"
        lines.append(
            f"{number:>4}  {value:<23}  {mode['damping_ratio']:>7.4f}  {mode['natural_frequency_rad_s']:>16.5f}  "
            f"{time:<17}  {mode['dominant']}"
        )
    return "\n".join(lines)


def rows_text(rows: Sequence[Mapping[str, Any]], most: int, count: int) -> str:
    """The first trims of a sweep, a line each, up to ``most`` of ``count``."""
    lines = ["  ".join(f"{heading:>12}" for heading, _ in _COLUMNS.values())]
    for row in rows[:most]:
        cells = []
        for name, (_, decimals) in _COLUMNS.items():
            value = row[name]
            if isinstance(value, bool):
                cells.append("yes" if value else "no")
            else:
                cells.append(f"{value:.{decimals}f}" if value is not None and math.isfinite(value) else "straight")
        lines.append("  ".join(f"{cell:>12}" for cell in cells))
    if count > most:
        lines.append(f"... {count - most} more; -o FILE.csv keeps all")
    return "\n".join(lines)


def passes(sequence: Mapping[str, Any]) -> str:
    """A sequence of the recursion, a line each pass."""
    rows = sequence["iterates"]
    end = sequence["outcome"]
    lines = [f"{sequence['start']}: {end}, residual {sequence['residual']:.1e} N or N m"]
    lines.append("pass  " + "  ".join(f"{name:>18}" for name in rows[0]))
    lines += [f"{i:>4}  " + "  ".join(f"{v:>18.12f}" for v in row.values()) for i, row in enumerate(rows, start=1)]
    return "\n".join(lines)


_POINTS = (
    ("best_glide", "best glide"),
    ("fastest", "fastest"),
    ("least_energy", "least energy per kilometre made good"),
    ("holds_station", "least power that holds station"),
)


def best_text(polar: Mapping[str, Any], current: float) -> str:
    """The best points of a polar, those of each way together."""
    lines = []
    for way, best in polar.items():
        lines.append(f"{way}")
        for key, title in _POINTS if current > 0.0 else _POINTS[:-1]:
            lines.append(f"  {title}")
            one = best[key]
            if one is None:
                lines.append(f"    none: {best['why_none']}")
                continue
            rows = [
                ("net buoyancy", f"{one['net_buoyancy_kg']:.4f} kg"),
                ("mass position", f"{one['mass_position_m']:.4f} m"),
                ("pitch", f"{one['pitch_deg']:.2f} deg"),
                ("angle of attack", f"{one['angle_of_attack_deg']:.2f} deg"),
                ("glide angle", f"{one['glide_angle_deg']:.2f} deg, lift to drag {one['lift_to_drag']:.2f}"),
                ("horizontal speed", f"{one['horizontal_speed_m_s']:.4f} m/s"),
                ("vertical speed", f"{one['vertical_speed_m_s']:+.4f} m/s, down positive"),
            ]
            if current:
                rows.append(("made good", f"{one['made_good_m_s']:.4f} m/s against {current:g} m/s"))
            rows.append(("power", f"{one['power_w']:.3f} W"))
            if one["energy_per_km_j"] is not None:
                rows.append(("energy", f"{one['energy_per_km_j'] / 1000.0:.3f} kJ per kilometre made good"))
            rows.append(("stable", "yes" if one["stable"] else "no"))
            lines += [f"    {name:<18}{value}" for name, value in rows]
    return "\n".join(lines)
