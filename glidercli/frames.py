"""Frames, rotations and sign conventions, said once for the whole program.

Frames
    ned     inertial: north, east, down. Depth and z are positive down.
    body    at the centre of buoyancy: x forward, y starboard, z down (eq. (1) of Zhang et al. 2013).
    enu     east, north, up; only at the edge, for viewers that want it.

Attitude is ZYX Euler: heading psi clockwise from true north, pitch theta positive nose up, roll phi positive starboard
down. A rotation matrix is named by what it makes from what: ``v_ned = R_ned_body @ v_body``; it is the paper's R_EB.
Quaternions say their order: ``q_wxyz`` here; viewers get ``q_xyzw``. Euler angles are for reports: they are singular at
pitch +-90 deg, where roll is set to zero and heading carries the turn; the quaternion has no such place.

The functions below work on plain floats and 3-tuples, so that they run as they stand or compiled (see kernel.py).
Those that end in ``_arrays`` take whole numpy arrays.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from glidercli.kernel import kernel

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]
Quaternion = tuple[float, float, float, float]


@kernel
def dot(a: Vector, b: Vector) -> float:
    """Scalar product of two 3-vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def cross(a: Vector, b: Vector) -> Vector:
    """Vector product a x b; the paper's hat(a) b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@kernel
def add(a: Vector, b: Vector) -> Vector:
    """Sum a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@kernel
def scale(factor: float, a: Vector) -> Vector:
    """The vector a times a number."""
    return (factor * a[0], factor * a[1], factor * a[2])


@kernel
def times(m: Matrix, a: Vector) -> Vector:
    """Matrix times vector, m a."""
    return (dot(m[0], a), dot(m[1], a), dot(m[2], a))


@kernel
def transposed(m: Matrix) -> Matrix:
    """Transpose of a 3 x 3 matrix."""
    return ((m[0][0], m[1][0], m[2][0]), (m[0][1], m[1][1], m[2][1]), (m[0][2], m[1][2], m[2][2]))


@kernel
def rotation_ned_body(q_wxyz: Quaternion) -> Matrix:
    """R_ned_body from a unit quaternion: v_ned = R_ned_body v_body; equals eq. (2) for the same attitude."""
    w, x, y, z = q_wxyz
    return (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
        (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
    )


@kernel
def down_in_body(roll: float, pitch: float) -> Vector:
    """k_b = R_ned_body^T k, the direction of gravity in the body frame, for angles in rad.

    k_b = (-sin theta, sin phi cos theta, cos phi cos theta), the third row of eq. (2).
    """
    return (-math.sin(pitch), math.sin(roll) * math.cos(pitch), math.cos(roll) * math.cos(pitch))


@kernel
def quaternion_rate(q_wxyz: Quaternion, omega: Vector) -> Quaternion:
    """Time derivative of the attitude quaternion for body rates omega = (p, q, r), rad/s: q (0, omega) / 2.

    It stands for eq. (3), which is singular at pitch +-90 deg.
    """
    w, x, y, z = q_wxyz
    p, q, r = omega
    return (
        0.5 * (-x * p - y * q - z * r),
        0.5 * (w * p + y * r - z * q),
        0.5 * (w * q + z * p - x * r),
        0.5 * (w * r + x * q - y * p),
    )


def quaternion_from_euler(roll: float, pitch: float, heading: float) -> Quaternion:
    """Unit quaternion q_wxyz of ZYX Euler angles in rad."""
    cr, sr = math.cos(roll / 2.0), math.sin(roll / 2.0)
    cp, sp = math.cos(pitch / 2.0), math.sin(pitch / 2.0)
    ch, sh = math.cos(heading / 2.0), math.sin(heading / 2.0)
    return (
        ch * cp * cr + sh * sp * sr,
        ch * cp * sr - sh * sp * cr,
        ch * sp * cr + sh * cp * sr,
        sh * cp * cr - ch * sp * sr,
    )


def quaternion_from_euler_arrays(roll: Array, pitch: Array, heading: Array) -> Array:
    """Unit quaternions, shape (n, 4) in the order w, x, y, z, of ZYX Euler angles in rad, each of shape (n,)."""
    import numpy as np

    cr, sr, cp, sp = np.cos(roll / 2), np.sin(roll / 2), np.cos(pitch / 2), np.sin(pitch / 2)
    ch, sh = np.cos(heading / 2), np.sin(heading / 2)
    return np.stack(
        [
            ch * cp * cr + sh * sp * sr,
            ch * cp * sr - sh * sp * cr,
            ch * sp * cr + sh * cp * sr,
            sh * cp * cr - ch * sp * sr,
        ],
        axis=-1,
    )


def quaternion_product_arrays(a_wxyz: Array, b_wxyz: Array) -> Array:
    """The quaternions a b, shape (..., 4): the attitude R_a R_b, b turned in the frame of a."""
    import numpy as np

    w, x, y, z = np.moveaxis(np.asarray(a_wxyz, dtype=float), -1, 0)
    s, i, j, k = np.moveaxis(np.asarray(b_wxyz, dtype=float), -1, 0)
    return np.stack(
        [
            w * s - x * i - y * j - z * k,
            w * i + x * s + y * k - z * j,
            w * j - x * k + y * s + z * i,
            w * k + x * j - y * i + z * s,
        ],
        axis=-1,
    )


def euler_from_quaternion_arrays(q_wxyz: Array) -> tuple[Array, Array, Array]:
    """Roll, pitch in [-pi/2, pi/2] and heading in [0, 2 pi), rad, each (n,), from unit quaternions of shape (n, 4).

    Within 1e-7 rad of pitch +-90 deg roll and heading are not separate: roll is zero there and heading carries both.
    """
    import numpy as np

    w, x, y, z = np.moveaxis(np.asarray(q_wxyz, dtype=float), -1, 0)
    level = np.hypot(w * x + y * z, 0.5 - x * x - y * y) * 2.0  # cos(pitch)
    upright = level < 1e-7
    roll = np.where(upright, 0.0, np.arctan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)))
    heading = np.where(
        upright,
        np.arctan2(2.0 * (w * z - x * y), 1.0 - 2.0 * (x * x + z * z)),
        np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)),
    )
    return roll, np.arctan2(2.0 * (w * y - z * x), level), np.mod(heading, 2.0 * np.pi)


def wrapped(angle: Array) -> Array:
    """Angles in rad brought to (-pi, pi], so that differences lie on the circle."""
    import numpy as np

    return -np.mod(np.pi - np.asarray(angle, dtype=float), 2.0 * np.pi) + np.pi
