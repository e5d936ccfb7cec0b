"""Where do the numbers of a vehicle come from? Added mass by strip theory, the CFD cases, the fit, estimates (sections 2.5, 3)."""
