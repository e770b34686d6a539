"""What a type checker sees of the module: it accepts this file and finds each mistake marked below."""

from typing import assert_type

import numpy as np

import koshi
from koshi import plot


def use(case: koshi.Case) -> koshi.Result:
    simulation = koshi.Simulation(case, overrides=["analysis.tolerance=1e-3"])
    assert_type(simulation.displacement, np.ndarray)
    assert_type(simulation.time, float)
    plot.section(simulation, "stress", "yy", normal="x")
    return simulation.run(lambda s: s.steps > 10, out="out")


case = koshi.Case(
    lattice=koshi.Lattice(spacing="1 mm", cell="cube-III"),
    body=koshi.Body(image=np.ones((3, 3, 3), dtype=np.uint8), materials={1: "rock"}),
    material={"rock": koshi.Material(1e9, 0.2, 2000)},
    boundary=[koshi.Boundary("root", face="z-min", fix=["x", "y", "z"])],
)
try:
    assert_type(use(case).measurement.probes["tip"], np.ndarray)
except koshi.InputError as error:
    assert_type(error, koshi.InputError)

koshi.Lattice(spacing=1, cell="cube-IV")  # type: ignore[arg-type]
koshi.Boundary(fix=["w"])  # type: ignore[list-item]
koshi.Simulation(case).displacement = np.zeros(3)  # type: ignore[misc]
koshi.Simulation(case).run(lambda s: s.speed > 1)  # type: ignore[attr-defined]
