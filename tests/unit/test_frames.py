"""Rotations against scipy and against eqs (2), (3)."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from glidercli.frames import (
    down_in_body,
    euler_from_quaternion_arrays,
    quaternion_from_euler,
    quaternion_from_euler_arrays,
    quaternion_rate,
    rotation_ned_body,
    wrapped,
)  # fmt: skip

roll = st.floats(-3.1, 3.1)
pitch = st.floats(-1.55, 1.55)
heading = st.floats(0.0, 6.28)


@given(roll, pitch, heading)
def test_rotation_is_zyx_euler(phi: float, theta: float, psi: float) -> None:
    q = quaternion_from_euler(phi, theta, psi)
    expected = Rotation.from_euler("ZYX", [psi, theta, phi]).as_matrix()
    np.testing.assert_allclose(rotation_ned_body(q), expected, atol=1e-14)  # rounding
    np.testing.assert_allclose(rotation_ned_body(q)[2], down_in_body(phi, theta), atol=1e-14)
    np.testing.assert_allclose(quaternion_from_euler_arrays(*(np.array([a]) for a in (phi, theta, psi)))[0], q)


@given(roll, pitch, heading)
def test_euler_angles_come_back(phi: float, theta: float, psi: float) -> None:
    q = np.array([quaternion_from_euler(phi, theta, psi)])
    back = np.hstack(euler_from_quaternion_arrays(q))
    np.testing.assert_allclose(wrapped(back - [phi, theta, psi]), 0.0, atol=1e-12)  # 1 / cos(89 deg) times rounding


def test_pitch_through_ninety_degrees_keeps_the_rotation() -> None:
    for theta in (math.pi / 2, -math.pi / 2):
        q = np.array([quaternion_from_euler(0.4, theta, 1.1)])
        phi, pitch_back, psi = (float(a[0]) for a in euler_from_quaternion_arrays(q))
        again = quaternion_from_euler(phi, pitch_back, psi)
        np.testing.assert_allclose(
            rotation_ned_body(again), rotation_ned_body(tuple(q[0])), atol=1e-7
        )  # sqrt of rounding


def test_quaternion_rate_is_eq_3() -> None:
    phi, theta, psi, omega = 0.3, -0.6, 1.0, np.array([0.02, -0.01, 0.03])
    rates = np.array([
        [1, math.sin(phi) * math.tan(theta), math.cos(phi) * math.tan(theta)],
        [0, math.cos(phi), -math.sin(phi)],
        [0, math.sin(phi) / math.cos(theta), math.cos(phi) / math.cos(theta)],
    ]) @ omega  # fmt: skip
    h = 1e-6
    ahead, behind = (
        np.array(quaternion_from_euler(*(np.array([phi, theta, psi]) + sign * h * rates))) for sign in (1, -1)
    )
    np.testing.assert_allclose(
        quaternion_rate(quaternion_from_euler(phi, theta, psi), tuple(omega)), (ahead - behind) / (2 * h), atol=1e-9
    )  # central differences
