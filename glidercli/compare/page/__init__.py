"""The page of a comparison: one HTML file that works offline."""
