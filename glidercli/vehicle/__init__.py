"""What is this vehicle? Frozen parameter classes, and vehicle files in TOML, checked whole."""

from glidercli.vehicle.load import load_vehicle, shipped_vehicles
from glidercli.vehicle.vehicle import Vehicle

__all__ = ["Vehicle", "load_vehicle", "shipped_vehicles"]
