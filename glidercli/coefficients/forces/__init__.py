"""Which coefficients do forces tell? The table, the fit, what was made of it (section 3.3)."""
