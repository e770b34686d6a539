"""Pictures of a simulation with matplotlib. On several ranks each draws its own nodes."""

from __future__ import annotations

from typing import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from .simulation import Simulation

_AXES = "xyz"


def section(
    simulation: Simulation,
    field: str = "displacement",
    component: int = 0,
    *,
    normal: str = "z",
    index: int | None = None,
    scale: float = 0,
    ax: Axes | None = None,
) -> Axes:
    """Field on a plane of nodes or a layer of cells.

    normal: axis across the plane; index: its number along that axis, default the middle.
    scale: factor on the displacements that deform the picture. Empty cells stay blank.
    """
    ax = ax or plt.gca()
    across = _AXES.index(normal)
    right, up = (a for a in range(3) if a != across)
    coordinates = simulation.coordinates
    plane = len(coordinates[across]) // 2 if index is None else index
    layer = min(plane, simulation.cells.shape[2 - across] - 1)

    def cut(values: np.ndarray, at: int) -> np.ndarray:
        return np.take(values, at, axis=2 - across)

    x, y = np.meshgrid(coordinates[right], coordinates[up])
    if scale != 0:
        x = x + scale * cut(simulation.displacement[right], plane)
        y = y + scale * cut(simulation.displacement[up], plane)
    values = cut(simulation.field(field)[component], plane)
    empty = cut(simulation.cells, layer) == 0
    if values.shape != x.shape:  # on cells
        values = cut(simulation.field(field)[component], layer)
    else:
        values = 0.25 * (values[1:, 1:] + values[1:, :-1] + values[:-1, 1:] + values[:-1, :-1])
    shape = (x.shape[0] - 1, x.shape[1] - 1)
    mesh = ax.pcolormesh(x, y, np.ma.masked_array(values, empty)[: shape[0], : shape[1]])
    ax.figure.colorbar(mesh, ax=ax, label=f"{field} {component}")
    ax.set(aspect="equal", xlabel=f"{_AXES[right]} [m]", ylabel=f"{_AXES[up]} [m]")
    return ax


def curve(
    times: Sequence[float], values: Mapping[str, Sequence[float]], *, ylabel: str = "", ax: Axes | None = None
) -> Axes:
    """Values over time [s], gathered by a callback; one line for each name."""
    ax = ax or plt.gca()
    for name, series in values.items():
        ax.plot(times, series, label=name)
    ax.set(xlabel="time [s]", ylabel=ylabel)
    ax.legend()
    return ax
