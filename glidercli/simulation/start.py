"""How does a flight begin? From rest, or in the motion of a trim that ``glider trim`` found."""

from __future__ import annotations

import dataclasses
import json
import math
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from glidercli.errors import InputError
from glidercli.files import readable_file
from glidercli.frames import Vector, down_in_body, quaternion_from_euler, scale
from glidercli.model.hydrodynamics import velocity_from_flow

__all__ = ["REST", "Start", "from_trim", "read_trim"]

_TRIM_KEYS = (
    "speed_m_s", "angle_of_attack_deg", "sideslip_deg", "yaw_rate_deg_s", "roll_deg", "pitch_deg", "mass_position_m",
    "mass_rotation_deg", "net_buoyancy_kg",
)  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Start:
    """State of motion. depth : m. roll, pitch, heading : rad. V : m/s through water, Omega : rad/s, body frame."""

    depth: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    heading: float = 0.0
    V: Vector = (0.0, 0.0, 0.0)
    Omega: Vector = (0.0, 0.0, 0.0)

    @property
    def q_wxyz(self) -> tuple[float, float, float, float]:
        """The attitude as a quaternion."""
        return quaternion_from_euler(self.roll, self.pitch, self.heading)


REST = Start()
"""Level, heading north, at the surface."""


def read_trim(path: Path) -> Mapping[str, Any]:
    """The first trim of what ``glider trim --json`` printed; "-" is standard input.

    Raises InputError where that is no such document, or holds no trim.
    """
    said = "-" if str(path) == "-" else str(path)
    if said == "-":
        text = sys.stdin.read()
    else:  # a pipe has no size, and is no empty file
        text = (path if path.is_fifo() else readable_file(path)).read_text(encoding="utf-8", errors="replace")
    wanted = 'needed is what glider trim --json prints, {"trims": [...]}'
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError(said, f"is no JSON ({error}); {wanted}") from None
    found = document.get("trims") if isinstance(document, dict) else None
    if not isinstance(found, list) or not found or not isinstance(found[0], dict):
        raise InputError(said, f"holds no trim; {wanted}")
    for key in _TRIM_KEYS:
        value = found[0].get(key)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
            raise InputError(said, f"trims[0].{key} = {value!r}, a finite number is needed")
    return dict(found[0])


def from_trim(trim: Mapping[str, Any], depth: float = 0.0, heading: float = 0.0) -> Start:
    """The motion of a trim in the contract's names: its attitude and velocity, turning about the vertical, eq. (32)."""
    angle = {key: math.radians(trim[key]) for key in _TRIM_KEYS if "_deg" in key}
    roll, pitch = angle["roll_deg"], angle["pitch_deg"]
    V = velocity_from_flow(trim["speed_m_s"], angle["angle_of_attack_deg"], angle["sideslip_deg"])
    Omega = scale(angle["yaw_rate_deg_s"], down_in_body(roll, pitch))
    return Start(depth, roll, pitch, heading, V, Omega)
