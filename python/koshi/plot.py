"""Pictures of a simulation with matplotlib. On several ranks each draws its own nodes."""

from __future__ import annotations

from typing import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from .simulation import Simulation

_AXES = "xyz"
_VECTOR = ("x", "y", "z")
_TENSOR = ("xx", "yy", "zz", "yz", "xz", "xy")
# Of each field: how a label names a component, and the unit.
_LABELS = {
    "displacement": ("u", "m"),
    "rotation": ("w", "rad"),
    "orientation": ("orientation", "rad"),
    "velocity": ("v", "m/s"),
    "reaction": ("reaction", "N"),
    "strain": ("strain", ""),
    "stress": ("stress", "Pa"),
    "energy": ("energy", "J/m^3"),
}


def _component(values: np.ndarray, component: int | str) -> tuple[int, str]:
    """Number and name of a component given by either."""
    names = {1: ("",), 3: _VECTOR, 6: _TENSOR}[len(values)]
    if isinstance(component, int) and 0 <= component < len(names):
        return component, names[component]
    if component in names:
        return names.index(str(component)), str(component)
    raise ValueError(f"there is no component {component!r}; take one of {', '.join(names)} or its number")


def _label(field: str, name: str) -> str:
    symbol, unit = _LABELS.get(field, (field, ""))
    index = f"$_{{{name}}}$" if len(symbol) == 1 and name else f" {name}".rstrip()
    return f"{symbol}{index}" + (f" [{unit}]" if unit else "")


def section(
    simulation: Simulation,
    field: str = "displacement",
    component: int | str = 0,
    *,
    normal: str = "z",
    index: int | None = None,
    scale: float = 0,
    ax: Axes | None = None,
) -> Axes:
    """Field on a plane of nodes or a layer of cells.

    component: its number or name ("x", "yy"). normal: axis across the plane; index: its number along that axis,
    default the middle. scale: factor on the displacements that deform the picture. Empty cells stay blank. Values of
    both signs get a diverging map about zero. Raises ValueError for an unknown component.
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
    components = simulation.field(field)
    number, name = _component(components, component)
    values = cut(components[number], plane)
    empty = cut(simulation.cells, layer) == 0
    if values.shape != x.shape:  # on cells
        values = cut(components[number], layer)
    else:
        values = 0.25 * (values[1:, 1:] + values[1:, :-1] + values[:-1, 1:] + values[:-1, :-1])
    shape = (x.shape[0] - 1, x.shape[1] - 1)
    shown = np.ma.masked_array(values, empty)[: shape[0], : shape[1]]
    largest = np.abs(shown).max()
    signed = {"cmap": "RdBu_r", "vmin": -largest, "vmax": largest} if shown.min() < 0 < shown.max() else {}
    mesh = ax.pcolormesh(x, y, shown, **signed)
    bar = ax.figure.colorbar(mesh, ax=ax, label=_label(field, name))
    bar.formatter.set_powerlimits((-3, 4))
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
