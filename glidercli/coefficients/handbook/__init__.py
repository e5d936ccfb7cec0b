"""Which coefficients would a shape have? Handbook formulas, without any forces."""
