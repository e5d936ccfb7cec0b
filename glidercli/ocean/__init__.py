"""What does a glider fly through? Seawater (TEOS-10), CTD and ADCP files, and the ocean that they make.

source.py (text) -> table.py (CSV), cnv.py (Sea-Bird) -> seabird.py, downcast.py -> cast.py, current.py
-> table_profiles.py
log -> dives.py -> from_log.py; netcdf.py; adcp_file.py -> pings.py
all of them -> gathering.py -> profile.py -> water.py -> ocean.py
"""

from glidercli.ocean.cast import Cast, read_ctd
from glidercli.ocean.current import CurrentProfile, read_adcp
from glidercli.ocean.ocean import Ocean
from glidercli.ocean.water import Sea, Water, at_depth

__all__ = ["Cast", "CurrentProfile", "Ocean", "Sea", "Water", "at_depth", "read_adcp", "read_ctd"]
