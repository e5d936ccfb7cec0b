"""Density of a recording: derived wherever it can be, against gsw; where it cannot be the log says why."""

from __future__ import annotations

import shutil
from pathlib import Path

import gsw
import netCDF4
import numpy as np
import pytest
import xarray as xr
from conftest import ROOT

from glidercli.log import Channel, Log
from glidercli.logio import read
from glidercli.logio.derived.seawater import with_seawater

DEPLOYMENT = ROOT / "tests/data/netcdf/dfo-rosie713-20190615_adjusted.nc"
TIMES = np.arange(4, dtype=np.int64) * 10**9
WATER = {
    "temperature": 10.0, "salinity": 35.0, "pressure": 1e6, "depth": 99.0, "absolute_salinity": 35.2,
    "conservative_temperature": 9.9,
}  # fmt: skip


def log_of(*names: str, **late: int) -> Log:
    return Log({n: Channel(n, TIMES + late.get(n, 0), np.full(4, WATER[n])) for n in names}, "measured")


def test_an_ioos_file_without_pressure_has_density_from_depth(tmp_path: Path) -> None:
    """The file records both, and its depth comes from its pressure: the density must be the same."""
    path = tmp_path / "no-pressure.nc"
    shutil.copy(DEPLOYMENT, path)
    with netCDF4.Dataset(path, "r+") as file:
        for name in [n for n, v in file.variables.items() if "density" in n or "pressure" in n or "conductivity" in n]:
            file.renameVariable(name, f"x_{name}")
            for key in ("standard_name", "units"):
                file[f"x_{name}"].setncattr(key, "none")
    log = read([path]).log
    assert "pressure" not in log
    times, (density, s, t) = log.together("density", "salinity", "temperature")
    assert len(times) > 1000
    with xr.open_dataset(DEPLOYMENT) as file:
        at = file.sel(time=times.astype("datetime64[ns]"), method="nearest")
        p, longitude, latitude = (at[name].values for name in ("pressure", "longitude", "latitude"))
    seen = gsw.rho_t_exact(gsw.SA_from_SP(s, p, longitude % 360.0, latitude), t, p)
    assert np.isfinite(seen).sum() > 1000
    # the file's depth is that of its pressure to 0.1 m, which is 0.0005 kg/m3
    np.testing.assert_allclose(density[np.isfinite(seen)], seen[np.isfinite(seen)], atol=0.001)
    assert log["density"].origin == "derived"
    assert "that of depth and latitude (gsw.p_from_z)" in log.metadata["density_note"]


def test_without_a_place_the_latitude_is_45_and_it_is_said() -> None:
    log = with_seawater(log_of("temperature", "salinity", "depth"))
    p = gsw.p_from_z(-99.0, 45.0)
    np.testing.assert_allclose(log["density"].values, gsw.rho_t_exact(gsw.SR_from_SP(35.0), 10.0, p), rtol=1e-12)
    assert "at latitude 45 deg, none is known" in log.metadata["density_note"]


def test_a_recorded_pressure_goes_before_depth() -> None:
    log = with_seawater(log_of("temperature", "salinity", "pressure", "depth"))
    np.testing.assert_allclose(log["density"].values, gsw.rho_t_exact(gsw.SR_from_SP(35.0), 10.0, 100.0), rtol=1e-12)
    assert "gsw.p_from_z" not in log.metadata["density_note"]


def test_absolute_salinity_and_conservative_temperature_do() -> None:
    log = with_seawater(log_of("conservative_temperature", "absolute_salinity", "pressure"))
    np.testing.assert_allclose(log["density"].values, gsw.rho(35.2, 9.9, 100.0), rtol=1e-12)
    assert log.metadata["density_note"] == "derived: TEOS-10, in situ, absolute salinity as recorded (gsw.rho)"
    log = with_seawater(log_of("temperature", "absolute_salinity", "pressure"))
    np.testing.assert_allclose(log["density"].values, gsw.rho_t_exact(35.2, 10.0, 100.0), rtol=1e-12)


@pytest.mark.parametrize(
    ("log", "why"),
    [
        (log_of("temperature", "salinity"), "the log has no pressure or depth"),
        (log_of("temperature", "pressure"), "the log has no salinity"),
        (log_of("salinity", "depth"), "the log has no temperature"),
        (log_of("temperature"), "the log has no salinity and no pressure or depth"),
        (
            log_of("temperature", "salinity", "pressure", pressure=10**10),
            "salinity, temperature and pressure have no sample at one time",
        ),
    ],
)
def test_where_it_is_not_derived_the_log_says_why(log: Log, why: str) -> None:
    made = with_seawater(log)
    assert "density" not in made
    assert made.metadata["density_note"] == f"not derived: {why}"


def test_a_log_without_water_has_no_word_of_it() -> None:
    assert "density_note" not in with_seawater(log_of("depth", "pressure")).metadata
