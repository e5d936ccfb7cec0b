"""What do NetCDF files of others hold? OceanGliders 1.0 and IOOS glider files."""
