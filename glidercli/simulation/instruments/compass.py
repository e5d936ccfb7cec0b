"""What does the compass read? The attitude of its own axes, its deviation, its errors."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from glidercli.frames import euler_from_quaternion_arrays, quaternion_from_euler, quaternion_product_arrays, wrapped
from glidercli.simulation.instruments.effects import Chain, Unwrapped
from glidercli.simulation.instruments.sensor import Readings, Sensor
from glidercli.simulation.instruments.settings import Compass
from glidercli.simulation.instruments.truth import Truth
from glidercli.units import DEGREE

__all__ = ["CompassSensor"]

_CIRCLE = 2.0 * math.pi
_ROUNDING = 1e-9  # rad; multiples of a resolution that come so close to a full circle are north


class CompassSensor(Sensor):
    """Heading, pitch and roll of a sensor whose axes are turned in the hull.

    R_ned_sensor = R_ned_body R_body_sensor, with R_body_sensor of mount_heading, mount_pitch and mount_roll in this
    order (ZYX); the angles are those of R_ned_sensor. Heading is true: the declination is taken as known. The deviation
    B sin(heading) + C cos(heading) is of the magnetic field and so comes before the lag.
    """

    channels = ("heading", "pitch", "roll")

    def __init__(self, settings: Compass, seed: int) -> None:
        self._settings = s = settings
        angles = (s.mount_roll_deg, s.mount_pitch_deg, s.mount_heading_deg)
        self._mount = quaternion_from_euler(*(angle * DEGREE for angle in angles)) if any(angles) else None
        tilt = {"noise": s.noise_tilt_deg, "bias_sigma": s.bias_tilt_sigma_deg, "resolution": s.resolution_tilt_deg}
        heading = {
            "noise": s.noise_heading_deg, "bias_sigma": s.bias_heading_sigma_deg,
            "resolution": s.resolution_heading_deg,
        }  # fmt: skip
        self.chains = {
            name: Chain(seed, f"compass/{name}", unit=DEGREE, lag=s.lag_s, bias=bias, **errors)
            for name, bias, errors in (
                ("heading", s.bias_heading_deg, heading),
                ("pitch", s.bias_pitch_deg, tilt),
                ("roll", s.bias_roll_deg, tilt),
            )
        }
        self._unwrapped = {"heading": Unwrapped(), "roll": Unwrapped()}

    def read(self, truth: Truth, taken: NDArray[np.intp]) -> Readings:
        """Readings of a piece at the rows that are sampled."""
        q_wxyz = truth.q_wxyz
        if self._mount is not None:
            q_wxyz = quaternion_product_arrays(q_wxyz, np.array(self._mount))
        angles = dict(zip(("roll", "pitch", "heading"), euler_from_quaternion_arrays(q_wxyz), strict=True))
        B, C = self._settings.deviation_sin_deg * DEGREE, self._settings.deviation_cos_deg * DEGREE
        heading = angles["heading"]
        angles["heading"] = heading + B * np.sin(heading) + C * np.cos(heading)
        if self._settings.lag_s:
            angles |= {name: unwrapped(angles[name]) for name, unwrapped in self._unwrapped.items()}
        read = {name: self.chains[name](truth.times, angles[name], taken) for name in self.channels}
        read["heading"] = np.mod(read["heading"], _CIRCLE)
        full = _CIRCLE - (_ROUNDING if self._settings.resolution_heading_deg else 0.0)
        read["heading"][read["heading"] >= full] = 0.0
        outside = np.abs(read["roll"]) > math.pi
        read["roll"][outside] = wrapped(read["roll"][outside])
        return {name: (taken, values) for name, values in read.items()}
