"""The tables of an input file, one dataclass each, with the same names.

A number is in SI units; text may carry a unit ("0.2 cm", "9.8 N"). ``None`` leaves a key out, and the input's default
holds; `koshi schema` lists all keys with their defaults.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Literal, Mapping, Sequence, Union

import numpy as np

Quantity = Union[float, str]
Vector = Sequence[Quantity]
Face = Literal["x-min", "x-max", "y-min", "y-max", "z-min", "z-max"]


@dataclass
class Lattice:
    """Unit cell, spacing and springs."""

    spacing: Quantity
    """side d of a cell [m]"""
    cell: Literal["cube-I", "cube-II", "cube-III"] | None = None
    """default "cube-III" """
    springs: Literal["shared", "plain"] | None = None
    """springs belong to cells (default), or every bond carries its full stiffness"""
    calibration: Literal["bending-exact", "beam-exact", "isotropic", "paper"] | None = None
    """default: bending-exact for shared Cube-III, isotropic for shared Cube-I and -II, paper for plain springs"""
    kinematics: Literal["rotational", "least-squares"] | None = None
    """three rotations per node (default), or the rotation fitted to each cell"""
    equations: Sequence[str] | None = None
    """calibration "paper": entries of C set equal to the elastic tensor"""
    axes: str | None = None
    """calibration "paper": which body axes are 1, 2, 3 of C"""


@dataclass
class Body:
    """The box of cells: of one material, or cell by cell from an image."""

    size: Vector | None = None
    """edges of the box [m], multiples of the spacing; none with an image"""
    material: str | None = None
    """name of the material, or "void"; none with an image"""
    image: str | os.PathLike | np.ndarray | None = None
    """value of each cell: a file, or an array of whole numbers (nz, ny, nx)"""
    materials: Mapping[int, str] | None = None
    """material, or "void", of each value in the image"""
    scan: Mapping[str, object] | None = None
    """how the values of the image become cells: crop, axes, coarsen, thresholds, grey ..., and what a raw file holds"""
    factor: str | os.PathLike | np.ndarray | None = None
    """factor 0 ... 1 on the stiffness of each cell: a file, or an array (nz, ny, nx); default 1"""
    strength: str | os.PathLike | np.ndarray | None = None
    """factor > 0 on the strength of each cell: a file, or an array (nz, ny, nx); default 1"""
    grain_boundary: Mapping[str, str | float | os.PathLike | np.ndarray] | None = None
    """cells with a face neighbour of another grain: labels (file or array; default: materials), material or strength"""
    origin: Vector | None = None
    """lower corner [m], default (0, 0, 0)"""
    periodic: Sequence[str] | Sequence[bool] | None = None
    """axes across which opposite faces are joined, such as ["x", "y"]; default none"""
    surface: Literal["stairs", "cut"] | None = None
    """cells that a region's surface passes through: whole or empty by their centre (default), or the part inside"""


@dataclass
class Material:
    """Isotropic elastic solid."""

    youngs_modulus: Quantity
    """E [Pa] > 0"""
    poissons_ratio: float
    """-1 < nu < 0.5"""
    density: Quantity
    """[kg/m^3] > 0"""
    fracture: Mapping[str, Quantity | Mapping[str, Quantity]] | None = None
    """how it cracks: law, tensile_strength [Pa], fracture_energy [J/m^2], softening, cohesion [Pa], friction_angle and
    residual_friction_angle [rad], strength_scatter, of bonds critical_stretch and critical_shear; default: never"""
    stiffness_scatter: Mapping[str, Quantity] | None = None
    """how E differs from cell to cell: distribution with modulus or variation, correlation_length [m], seed; default:
    not"""


@dataclass
class Region:
    """Cells whose centre lies inside a shape get another material; later regions win."""

    shape: Literal["box", "sphere", "cylinder", "half-space", "stl"]
    """decides which of the others count"""
    material: str
    """a material's name, or "void" """
    min: Vector | None = None
    """box: lower corner [m]"""
    max: Vector | None = None
    """box: upper corner [m]"""
    center: Vector | None = None
    """sphere [m]"""
    radius: Quantity | None = None
    """sphere, cylinder [m]"""
    start: Vector | None = None
    """cylinder: one end of the axis [m]"""
    end: Vector | None = None
    """cylinder: other end of the axis [m]"""
    point: Vector | None = None
    """half-space: a point of its plane [m]"""
    normal: Sequence[float] | None = None
    """half-space: direction that points out of it"""
    file: str | os.PathLike | None = None
    """stl: a closed surface"""
    scale: Quantity | None = None
    """stl: length of the file's unit, default 1 m"""
    name: str | None = None
    """by which selections find its surface"""


@dataclass
class Selection:
    """A selection with a name, for others to use: exactly one of what follows the name."""

    name: str
    """unlike any other"""
    face: Face | None = None
    """all nodes of a face of the box"""
    box: Mapping[Literal["min", "max"], Vector] | None = None
    """what lies inside or on the border [m]"""
    point: Vector | None = None
    """the nearest node [m]"""
    surface: str | None = None
    """name of a region: its surface"""
    sphere: Mapping[str, Quantity | Vector] | None = None
    """what lies in a ball: center, radius [m]"""
    cylinder: Mapping[str, Quantity | Vector] | None = None
    """what lies in a round bar: start, end, radius [m]"""
    half_space: Mapping[str, Vector] | None = None
    """what lies on one side of a plane: point [m], normal"""
    union: Sequence[str] | None = None
    """what is in any of these selections"""
    intersection: Sequence[str] | None = None
    """what is in all of these selections"""
    difference: Sequence[str] | None = None
    """what is in the first of these selections and in none of the others"""


@dataclass
class Crack:
    """Cells that a piece of a plane cuts have cracked along it before the run begins."""

    center: Vector
    """[m]"""
    normal: Sequence[float]
    """of the plane"""
    name: str | None = None
    """for messages"""
    shape: Literal["disc", "rectangle"] | None = None
    """decides which of the others count, default "disc" """
    radius: Quantity | None = None
    """disc [m]"""
    along: Sequence[float] | None = None
    """rectangle: direction of its length; what of it lies in the plane"""
    length: Quantity | None = None
    """rectangle: side along that [m]"""
    width: Quantity | None = None
    """rectangle: other side [m]"""


@dataclass
class Boundary:
    """Prescribed motion of the nodes of a face, box or point."""

    name: str | None = None
    """for messages and factors"""
    face: Face | None = None
    """all nodes of a face of the box"""
    box: Mapping[Literal["min", "max"], Vector] | None = None
    """nodes inside or on the border [m]"""
    point: Vector | None = None
    """the nearest node [m]"""
    surface: str | None = None
    """name of a region: the corners of the cells at its surface"""
    selection: str | None = None
    """name of a selection"""
    fix: Sequence[Literal["x", "y", "z", "rx", "ry", "rz"]] | None = None
    """components held at zero"""
    displacement: Mapping[str, Quantity] | None = None
    """by component [m], [rad]"""
    velocity: Mapping[str, Quantity] | None = None
    """by component [m/s], [rad/s]"""
    twist: Mapping[Literal["x", "y", "z"], Quantity] | None = None
    """angle of a turn as a rigid body [rad]"""
    center: Vector | None = None
    """of the twist [m], default the mean of the nodes"""
    ramp: Quantity | None = None
    """time over which the motion rises from zero [s], default 0"""
    history: Sequence[tuple[Quantity, float]] | None = None
    """factor on the motion: pairs (time [s], factor)"""
    support: Literal["roller", "bonded"] | None = None
    """by the surface at its true place: along its normal, or in every direction"""


@dataclass
class Load:
    """Forces: exactly one of force, traction, pressure, acceleration."""

    name: str | None = None
    """for messages and factors"""
    face: Face | None = None
    """all nodes of a face of the box"""
    box: Mapping[Literal["min", "max"], Vector] | None = None
    """nodes inside or on the border [m]"""
    point: Vector | None = None
    """the nearest node [m]"""
    surface: str | None = None
    """name of a region: its surface"""
    selection: str | None = None
    """name of a selection"""
    force: Vector | None = None
    """in total [N]"""
    traction: Vector | None = None
    """[Pa]"""
    pressure: Quantity | None = None
    """against the outward normal [Pa]"""
    acceleration: Vector | None = None
    """body force per mass [m/s^2], on the whole body"""
    distribution: Literal["area", "nodes"] | None = None
    """of the force, default "area" """
    profile: str | None = None
    """factor on a traction, pressure or acceleration: a formula in x, y, z [m] and t [s]"""
    history: Sequence[tuple[Quantity, float]] | None = None
    """factor on the load: pairs (time [s], factor)"""


@dataclass
class Macroscopic:
    """What a periodic body does as a whole; components xx, yy, zz, yz, xz, xy, zero strain where nothing is given."""

    strain: Mapping[str, float] | None = None
    """mean strain, components of the tensor"""
    stress: Mapping[str, Quantity] | None = None
    """mean stress over the box, voids too [Pa]; its components have the strain that leads to it"""
    history: Sequence[tuple[Quantity, float]] | None = None
    """factor on both: pairs (time [s], factor)"""


@dataclass
class Analysis:
    """What is computed."""

    type: Literal["static", "quasi-static", "dynamic", "modes"] | None = None
    """equilibrium solved directly (default), reached by damped stepping, motion, or natural frequencies"""
    tolerance: float | None = None
    """static: relative residual; quasi-static: unbalanced forces; modes: error of squared frequencies; default 1e-8"""
    duration: Quantity | None = None
    """[s], required for dynamic"""
    time_step: Quantity | None = None
    """[s], default "auto" """
    allow_unstable_step: bool | None = None
    """run with a time step above the stable limit all the same"""
    safety: float | None = None
    """ratio of the automatic step to the stable limit, default 0.9"""
    damping: Mapping[str, Quantity] | None = None
    """{"kind": "local", "factor": 0.8} (default of quasi-static), {"kind": "viscous", "rate": ...} or {"kind": "none"}"""
    events: int | None = None
    """static, of a body that can crack: the most events, default 1000"""
    steps: int | None = None
    """the same: equal steps through the histories of loads and motions, default event by event"""
    stop_when: Mapping[str, Quantity] | None = None
    """what ends the run: probe (of a reaction) with below (part of its largest), face (a crack is there), after [s]"""
    start_from: str | os.PathLike | None = None
    """output directory of an earlier run whose displacements are the start"""
    count: int | None = None
    """number of modes, default 10"""
    near: Quantity | None = None
    """modes closest to this frequency [1/s], default 0: the lowest"""
    allow_floating: bool | None = None
    """modes of a body in several parts of which some are free, default False"""


@dataclass
class Probe:
    """A value reported by name."""

    name: str
    """in the results"""
    face: Face | None = None
    """all nodes of a face of the box"""
    box: Mapping[Literal["min", "max"], Vector] | None = None
    """nodes inside or on the border [m]"""
    point: Vector | None = None
    """the nearest node [m]"""
    surface: str | None = None
    """name of a region: the corners of the cells at its surface"""
    selection: str | None = None
    """name of a selection"""
    quantity: Literal["displacement", "rotation", "velocity", "reaction", "moment", "stress", "strain"] | None = None
    """default "displacement" """
    reduce: Literal["mean", "area-mean", "sum", "max", "percentile"] | None = None
    """default: sum for reactions and moments, else mean"""
    percentile: float | None = None
    """of reduce "percentile", default 95"""
    center: Vector | None = None
    """point about which a moment is taken, default the mean of the selected nodes"""
    minus: str | None = None
    """name of a selection whose mean is taken off"""


@dataclass
class Output:
    """What a run with an output directory writes."""

    fields: Sequence[str] | None = None
    """default ["displacement"] """
    every: Quantity | None = None
    """simulated time between samples of the fields [s], default the end only"""
    every_events: int | None = None
    """of a static body that cracks: events between samples of the fields, default the end only"""
    history_every: Quantity | None = None
    """simulated time between rows of history.csv [s]"""
    checkpoint_every: Quantity | None = None
    """simulated time between checkpoints [s]"""
    checkpoint_every_wall: Quantity | None = None
    """wall time between checkpoints [s]"""
    report: bool | None = None
    """write report.html at the end, default False"""
    crack_surface: bool | None = None
    """write cracks.vtp with each sample, default False"""
    surface: bool | None = None
    """write surface.vtp with each sample, default False"""
