"""How does a vehicle fly through water? Full dynamics from rest, controls held or from a mission, to a Log."""

from glidercli.simulation.run import Simulation, simulate

__all__ = ["Simulation", "simulate"]
