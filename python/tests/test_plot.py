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
    assert ax.collections[0].colorbar.ax.get_ylabel() == "u$_{z}$ [m]"
    # The same by its name; one sign, hence the plain map over the values.
    assert (plot.section(simulation, component="z", normal="y", ax=plt.figure().gca()).collections[0].get_array() == values.ravel()).all()
    assert ax.collections[0].get_clim() == pytest.approx((1e-6, 7e-6))


def test_section_of_a_cell_field_on_the_deformed_body(simulation):
    ax = plot.section(simulation, "strain", 0, normal="z", index=0, scale=100)
    assert ax.collections[0].get_array().compressed() == pytest.approx(np.full(4, 1e-3))
    # Corners move to x (1 + 100 * 1e-3).
    assert ax.collections[0].get_coordinates()[0, :, 0] == pytest.approx([0, 1.1e-3, 2.2e-3])


def test_signed_values_lie_about_zero_and_unknown_components_are_refused(simulation):
    x, _, _ = simulation.coordinates
    simulation.displacement[0] = -2e-3 * x * (x > 1e-3) + 1e-3 * x * (x <= 1e-3)
    mesh = plot.section(simulation, "strain", "xx", normal="z", index=0).collections[0]
    # u_x = 0, 1e-6, -4e-6 m at x = 0, 1, 2 mm: strains of 1e-3 and -5e-3.
    assert mesh.get_array().compressed() == pytest.approx([1e-3, -5e-3, 1e-3, -5e-3])
    assert mesh.get_clim() == pytest.approx((-5e-3, 5e-3))
    with pytest.raises(ValueError, match="no component 'w'; take one of x, y, z or its number"):
        plot.section(simulation, component="w")


def test_curve():
    ax = plot.curve([0, 1, 2], {"tip": [0, 3, 4], "root": [0, 0, 0]}, ylabel="u [m]")
    assert [line.get_label() for line in ax.lines] == ["tip", "root"]
    assert list(ax.lines[0].get_ydata()) == [0, 3, 4]
    plt.close("all")
