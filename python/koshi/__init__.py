"""Koshi: a lattice spring engine for elastic solids.

Describe a case with the dataclasses below, or load one from a file, make a `Simulation` of it and run or step it::

    import koshi

    simulation = koshi.Simulation("case.toml")
    result = simulation.run()
    print(result.measurement.probes["tip"])
"""

from .calibration import calibrate
from .case import Case, InputError, RunError, load
from .simulation import MeanState, Measurement, Mode, Result, Simulation, run
from .tables import (
    Analysis,
    Body,
    Boundary,
    Crack,
    Lattice,
    Load,
    Macroscopic,
    Material,
    Output,
    Probe,
    Region,
    Selection,
)
from ._koshi import __version__

__all__ = [
    "Analysis",
    "Body",
    "Boundary",
    "Case",
    "Crack",
    "InputError",
    "Lattice",
    "Load",
    "Macroscopic",
    "Material",
    "MeanState",
    "Measurement",
    "Mode",
    "Output",
    "Probe",
    "Region",
    "Result",
    "RunError",
    "Selection",
    "Simulation",
    "calibrate",
    "load",
    "run",
]
