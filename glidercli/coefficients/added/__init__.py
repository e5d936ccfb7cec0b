"""What water does a shape drag along? Strips, sections, the exact spheroid (section 2.5)."""
