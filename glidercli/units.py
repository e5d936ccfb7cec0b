"""Units other than SI, each as the factor that brings it to SI.

Inside the program everything is SI and radians, without suffix. A value in any other unit wears a suffix
(``pitch_deg``, ``pressure_dbar``) and lives in readers, writers, reports and the command line.
"""

from __future__ import annotations

import math

DEGREE = math.pi / 180.0  # rad
KNOT = 1852.0 / 3600.0  # m/s, international knot
DBAR = 1.0e4  # Pa
BAR = 1.0e5  # Pa
CM3 = 1.0e-6  # m3
CENTIMETRE = 1.0e-2  # m
INCH = 2.54e-2  # m
MILLIMETRE = 1.0e-3  # m
MINUTE = 60.0  # s
HOUR = 3600.0  # s
NANOSECOND = 1.0e-9  # s

STANDARD_GRAVITY = 9.81
"""Acceleration of gravity without a latitude, m/s2. The paper prints none; 9.81 reproduces its worked example."""
