"""What current did a glider ADCP find? The basestation's inverse solution, at the glider's own times and depths.

Variables ad2cp_inv_glider_*: uocn, vocn, wocn are the ocean's velocity east, north and up at the glider, uttw, vttw,
wttw the glider's through the water, m/s, -999 where there is none. wttw is negative on dives: up is positive. All are a
solution of the basestation, not measured by one instrument alone: derived. The solution runs on over the hours before
and after the dive; what it says of a glider at the surface is left out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from glidercli.logio.quantities import Quantity, channel_of
from glidercli.logio.seaglider.gathering import Gathering
from glidercli.logio.seaglider.netcdf_file import NetcdfFile
from glidercli.logio.seaglider.series import series

__all__ = ["take_adcp"]

ENDING = "_inv_glider_time"
VELOCITIES = {
    "uocn": Quantity("current_east", 1.0, -5.0, 5.0, "m/s"),
    "vocn": Quantity("current_north", 1.0, -5.0, 5.0, "m/s"),
    "wocn": Quantity("current_up", 1.0, -5.0, 5.0, "m/s"),
}
SPEED = Quantity("speed_through_water", 1.0, 0.0, 2.0, "m/s")
THROUGH_WATER = ("uttw", "vttw", "wttw")


def take_adcp(file: NetcdfFile, gathering: Gathering) -> None:
    """Take the current at the glider, and its speed through water instead of the flight model's."""
    time = next((name for name in sorted(file.names) if name.endswith(ENDING)), None)
    if time is None:
        return
    keys = (*VELOCITIES, *THROUGH_WATER, "depth")
    kind, time_ns, table = series(file, time, {key: time.removesuffix("time") + key for key in keys})
    depth = table.pop("depth", np.full(len(time_ns), np.nan))
    below: NDArray[np.bool_] = depth > 0.0
    gathering.records += int((~below).sum())
    gathering.drop(kind, "at the surface or at no depth", int((~below).sum()))
    time_ns, table = time_ns[below], {key: values[below] for key, values in table.items()}
    good = gathering.usable(kind, time_ns, table)
    time_ns, table = time_ns[good], {key: values[good] for key, values in table.items()}
    channels = [
        channel_of(key, time_ns, table[key], quantity, gathering.warnings, "derived")
        for key, quantity in VELOCITIES.items()
        if key in table
    ]
    if set(THROUGH_WATER) <= table.keys():
        speed = np.sqrt(sum(table[key] ** 2 for key in THROUGH_WATER))
        model = sum(len(channel) for channel in gathering.channels if channel.name == SPEED.channel)
        gathering.channels = [channel for channel in gathering.channels if channel.name != SPEED.channel]
        if model:
            gathering.warnings.append(f"speed: {model} values of the flight model left out, the ADCP gives the speed")
        channels.append(channel_of("speed of uttw, vttw, wttw", time_ns, speed, SPEED, gathering.warnings, "derived"))
        gathering.metadata["speed_note"] = "speed_through_water is that of the ADCP's inverse solution (derived)"
    gathering.metadata["current_note"] = (
        f"current at the glider, by the inverse solution of the ADCP {time.removesuffix(ENDING)} (derived)"
    )
    gathering.keep_rows(kind, time_ns, channels)
