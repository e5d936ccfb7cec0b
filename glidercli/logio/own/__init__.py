"""How do the program's own tables come and go? CSV, Parquet and NetCDF: written, and read back."""
