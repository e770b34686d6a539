"""Pictures hold the numbers of the simulation."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

import koshi
from conftest import beam
from koshi import plot


@pytest.fixture
def simulation():
    image = np.ones((4, 2, 2), dtype=np.uint8)
    image[3, 1, 1] = 0
    case = beam(body=koshi.Body(image=image, materials={0: "void", 1: "rock"}))
    simulation = koshi.Simulation(case)
    x, _, z = simulation.coordinates
    simulation.displacement[0] = 1e-3 * x
    simulation.displacement[2] = 2e-3 * z[:, None, None]
    yield simulation
    plt.close("all")


def test_section_of_a_node_field_averages_corners_and_leaves_voids_blank(simulation):
    ax = plot.section(simulation, "displacement", 2, normal="y", index=2)
    values = ax.collections[0].get_array().reshape(4, 2)
    # u_z = 2e-3 z at the middle of the cells, z = 0.5, 1.5, 2.5, 3.5 mm; the empty cell (k = 3, i = 1) is blank.
    expected = np.repeat(2e-6 * (np.arange(4) + 0.5)[:, None], 2, axis=1)
    mask = np.zeros((4, 2), dtype=bool)
    mask[3, 1] = True
    assert (np.ma.getmaskarray(values) == mask).all()
    assert values.compressed() == pytest.approx(expected[~mask])
    assert ax.get_xlabel() == "x [m]" and ax.get_ylabel() == "z [m]"


def test_section_of_a_cell_field_on_the_deformed_body(simulation):
    ax = plot.section(simulation, "strain", 0, normal="z", index=0, scale=100)
    assert ax.collections[0].get_array().compressed() == pytest.approx(np.full(4, 1e-3))
    # Corners move to x (1 + 100 * 1e-3).
    assert ax.collections[0].get_coordinates()[0, :, 0] == pytest.approx([0, 1.1e-3, 2.2e-3])


def test_curve():
    ax = plot.curve([0, 1, 2], {"tip": [0, 3, 4], "root": [0, 0, 0]}, ylabel="u [m]")
    assert [line.get_label() for line in ax.lines] == ["tip", "root"]
    assert list(ax.lines[0].get_ydata()) == [0, 3, 4]
    plt.close("all")
