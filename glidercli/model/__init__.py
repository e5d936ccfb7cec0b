"""The flight model of Zhang et al. (2013), eq. (19), in the order of the paper.

parameters.py (symbols) -> mass.py (eqs 6, 9, 12, 15) -> hydrodynamics.py (eqs 20-22) -> buoyancy.py -> equations.py
(eqs 18, 19) -> derivatives.py (their first derivatives). Every function is a kernel (see glidercli/kernel.py): plain
Python that numba can compile.
"""

from glidercli.model.parameters import Controls, Parameters, parameters

__all__ = ["Controls", "Parameters", "parameters"]
