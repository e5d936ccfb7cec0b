"""Which variables of an OG1 file are the controls of a Seaglider? pitchCtl, rollCtl and vbdCC under other names.

seagliderOG1 (config/OG1_variable_names.yaml) writes the columns of the basestation as PITCH_CTL, ROLL_CTL and VBD_CC,
in older releases as eng_pitchCtl, eng_rollCtl and eng_vbdCC, unchanged and without units; its table of attributes
calls the first two "counts", which they are not: counts of a Seaglider's converters are whole numbers, and in
sg033_20100903 and sg033_20100729 they have fractions and lie where the .eng's cm and deg do (-9.1 to 3.4 and -40 to
40). There pitch follows PITCH_CTL (correlation 0.97), roll ROLL_CTL (0.99), and the depth rate VBD_CC (-0.89), with the
signs that seaglider/columns.py tells.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from glidercli.logio.netcdf.variables import Values, attributes, stored_numbers
from glidercli.logio.seaglider.columns import CONTROLS, NOTES
from glidercli.netcdf_packing import packing_of

__all__ = ["CONTROL_NAMES", "controls"]

NAMES = {
    "pitchCtl": ("PITCH_CTL", "eng_pitchCtl"),
    "rollCtl": ("ROLL_CTL", "eng_rollCtl"),
    "vbdCC": ("VBD_CC", "eng_vbdCC"),
}
CONTROL_NAMES = tuple(name for names in NAMES.values() for name in names)
UNITS = {"cm": ("cm",), "deg": ("deg", "degree", "degrees"), "cm3": ("cm3", "cc", "cm^3")}
COUNTS = "counts"
NOTED = {"mass_position": "mass_position_zero", "mass_rotation": "mass_rotation_note"}


def controls(file: Any, dimension: str, model: str, metadata: dict[str, str], warnings: list[str]) -> dict[str, Values]:
    """The controls of a file by channel, SI; what is to be known of them goes to metadata.

    model : what the file tells of its vehicle. The names alone tell a Seaglider where they begin with eng_.
    """
    found = {}
    for column, names in NAMES.items():
        name = next((n for n in names if n in file.variables and file[n].dimensions == (dimension,)), None)
        if name is None:
            continue
        try:
            packing = packing_of(attributes(file[name]))
        except ValueError as fault:
            warnings.append(f"{name}: left out, {fault}")
            continue
        quantity, values = CONTROLS[column], stored_numbers(file[name], packing)
        told = str(attributes(file[name]).get("units", "")).strip()
        whole = bool((values[np.isfinite(values)] % 1.0 == 0.0).all())
        if not name.startswith("eng_") and "seaglider" not in model.lower():
            warnings.append(f"{name}: left out, the file does not say that it is of a Seaglider")
        elif told == COUNTS and whole:
            warnings.append(f"{name}: left out, in counts, and the file tells no centre and conversion")
        elif told not in ("", COUNTS, *UNITS[quantity.unit]):
            warnings.append(f"{name}: left out, the unit {told!r} is not known; {quantity.unit} is needed")
        else:
            if told in ("", COUNTS):
                says = f"says {told}, which its fractions are not" if told else "no unit is told"
                warnings.append(f"{name}: {says}; taken as the {quantity.unit} of a Seaglider's {column}")
            warnings += [f"{name}: {note}" for note in packing.notes]
            found[quantity.channel] = Values(name, quantity.factor * values, "measured")
            if quantity.channel in NOTED:
                metadata[NOTED[quantity.channel]] = NOTES[NOTED[quantity.channel]]
    if "mass_position" in found or "ballast_volume" in found:
        metadata["motor_note"] = "samples at the rows of the file alone: starts and stops of the motors are not told"
    return found
