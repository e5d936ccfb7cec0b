"""Where do a vehicle's numbers come from? Added mass, the CFD cases, the fit, estimates: sections 2.5 and 3."""

from glidercli.coefficients.flows.case_table import cases
from glidercli.coefficients.forces.result import fit

__all__ = ["cases", "fit"]
