"""A case on the ranks of a run: stepping, solving, reading and writing its fields."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Callable, Sequence

import numpy as np

from . import _koshi
from .case import Case, _definition


@dataclass(frozen=True)
class Measurement:
    """Sums over the body and probes, the same on every rank; SI units."""

    elastic_energy: float
    kinetic_energy: float
    unbalanced_ratio: float
    """unbalanced forces over loads and reactions"""
    probes: dict[str, np.ndarray]
    """by name: 3 components, or 6 (xx, yy, zz, yz, xz, xy) of stress and strain"""


@dataclass(frozen=True)
class Mode:
    """One way to swing; components are x, y, z and turns about the same axes through the centre of mass."""

    number: int
    """1: the lowest vibration"""
    frequency: float
    """[Hz]"""
    residual: float
    """of the eigenvalue problem, over the squared frequency"""
    modal_mass: float
    """[kg] of the shape whose largest displacement is 1"""
    participation: np.ndarray
    """of the motion of the whole in each direction: 6 factors [1], [m]"""
    effective_mass: np.ndarray
    """6 values [kg], [kg m^2]"""
    shape: np.ndarray
    """on this rank's nodes, (6 or 3, nz, ny, nx); the largest displacement of the body is 1"""


@dataclass(frozen=True)
class MeanState:
    """Of a periodic body as a whole; components xx, yy, zz, yz, xz, xy."""

    strain: np.ndarray
    """components of the tensor"""
    stress: np.ndarray
    """over the box, voids too [Pa]"""


@dataclass(frozen=True)
class Result:
    """How a run went."""

    steps: int
    """explicit steps in all"""
    time_step: float
    """[s], 0 for a static analysis"""
    iterations: int
    """of a static analysis"""
    residuals: np.ndarray
    """relative residual of a static analysis after 0, 1, 2, ... iterations"""
    stopped: bool
    """the callback asked to stop"""
    seconds: float
    """wall time"""
    measurement: Measurement
    """at the end; empty for modes"""
    modes: list[Mode]
    """by frequency, of an analysis of type "modes" """
    macroscopic: MeanState | None
    """mean strain and stress of a case with [macroscopic]"""


class Simulation:
    """A model with its state.

    case: a Case or an input file. comm: an mpi4py communicator; default: all ranks of the program. Raises InputError.
    Under mpiexec every rank makes the same calls; fields hold the nodes of this rank's box.
    """

    def __init__(self, case: Case | str | os.PathLike, *, overrides: Sequence[str] = (), comm=None) -> None:
        self._definition = _definition(case, overrides)
        self._core = _koshi.Simulation(self._definition, None if comm is None else comm.py2f())

    @property
    def displacement(self) -> np.ndarray:
        """Displacements [m], then rotations [rad] of this rank's nodes: a view (6 or 3, nz, ny, nx); write to set."""
        return self._core.displacement()

    @property
    def velocity(self) -> np.ndarray:
        """Velocities [m/s], [rad/s] as a view of the same shape, in the middle of the last explicit step."""
        return self._core.velocity()

    @property
    def mass(self) -> np.ndarray:
        """Mass [kg] and, with rotational kinematics, inertia [kg m^2] of the nodes: a read-only view."""
        return self._core.mass()

    @property
    def cells(self) -> np.ndarray:
        """Material of this rank's cells, 0 = empty, else 1 + its place among the materials: a read-only view."""
        return self._core.cells()

    @property
    def coordinates(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """x, y, z [m] of this rank's planes of nodes."""
        return self._core.coordinates()

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._core.time()

    @property
    def steps(self) -> int:
        """Explicit steps so far."""
        return self._core.steps()

    @property
    def time_step(self) -> float:
        """Step of `step` [s]: that of the case, or its safety times the stable limit. Raises InputError."""
        return self._core.time_step()

    def step(self, count: int = 1) -> None:
        """Explicit steps, whatever the type of the analysis.

        Other threads run meanwhile, and must leave this simulation alone; Ctrl-C ends it after the present step.
        """
        self._core.step(count)

    def run(
        self,
        callback: Callable[[Simulation], bool | None] | None = None,
        *,
        out: str | os.PathLike | None = None,
        progress: Callable[[float, str], None] | None = None,
        petsc_options: Sequence[str] = (),
    ) -> Result:
        """Runs the analysis of the case from the present state to its end.

        callback: called with the simulation every ten explicit steps, or after each iteration of a static analysis;
        True stops the run. While a static analysis iterates its displacements are not defined: they are those of the
        last iteration once it is stopped, else it is called once more with the solution.
        out: a directory for summary, history and fields, as written by `koshi run`.
        progress: called with the part of the work done (negative: unknown) and a few words, in a static analysis
        after each iteration. Other threads run meanwhile, and must leave this simulation alone; Ctrl-C ends the run.
        Raises InputError for an unstable step or a missing support, RunError when the run fails or does not come to
        rest.
        """
        poll = None if callback is None else lambda: bool(callback(self))
        outcome = self._core.run(poll, None if out is None else os.fspath(out), progress, list(petsc_options))
        measurement = Measurement(**outcome.pop("measurement"))
        modes = [Mode(**mode) for mode in outcome.pop("modes")]
        whole = outcome.pop("macroscopic")
        macroscopic = None if whole is None else MeanState(**whole)
        return Result(measurement=measurement, modes=modes, macroscopic=macroscopic, **outcome)

    def measure(self) -> Measurement:
        """Balance and probes of the present state."""
        return Measurement(**self._core.measure())

    def field(self, name: str) -> np.ndarray:
        """A field of output.fields, computed from the present state: a copy (components, nz, ny, nx).

        Strain, stress [Pa] (xx, yy, zz, yz, xz, xy) and energy [J/m^3] are those of the cells.
        """
        return self._core.field(name)

    @property
    def damage(self) -> np.ndarray:
        """Damage of this rank's cells, 0 whole, 1 parted: a copy (nz, ny, nx). Raises InputError where nothing cracks."""
        return self._core.damage()

    def set_damage(self, damage: np.ndarray, normal: Sequence[float] = (1, 0, 0)) -> None:
        """Raises the damage of this rank's cells to (nz, ny, nx) values where they are above what the cells have.

        A cell that had no crack gets one of this normal, as uniaxial tension across it would have made it; others keep
        theirs. Under mpiexec all ranks call it. Raises InputError for a value outside 0 ... 1 and for damage of a cell
        that cannot crack; then nothing has changed.
        """
        self._core.set_damage(damage, tuple(normal))

    def set_load_factor(self, name: str, factor: float) -> None:
        """From now on the load is `factor` times what the case says; its history no longer counts."""
        self._core.set_load_factor(name, factor)

    def set_boundary_factor(self, name: str, factor: float) -> None:
        """From now on the boundary's motion is `factor` times what the case says; ramp and history no longer count."""
        self._core.set_boundary_factor(name, factor)


def run(case: Case | str | os.PathLike, *, overrides: Sequence[str] = (), comm=None, **options) -> Result:
    """Runs a case to its end: `Simulation(case).run(**options)`."""
    return Simulation(case, overrides=overrides, comm=comm).run(**options)
