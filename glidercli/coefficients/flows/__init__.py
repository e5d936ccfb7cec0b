"""Which flows does CFD have to compute? The cases of Table 2 (sections 3.1, 3.2)."""
