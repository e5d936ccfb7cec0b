"""What does a Slocum glider record? Navigation and science files, full, medium and short, compressed or not."""
