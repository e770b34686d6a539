"""Small bodies for the tests."""

import pytest

import koshi


def beam(**changes) -> koshi.Case:
    """A bar of 2 x 2 x 4 cells along z, held below with fixed rotations, pulled at the top."""
    parts = {
        "lattice": koshi.Lattice(spacing="1 mm", kinematics="least-squares"),
        "body": koshi.Body(size=("2 mm", "2 mm", "4 mm"), material="rock"),
        "material": {"rock": koshi.Material("1 GPa", 0.0, 2000)},
        "boundary": [koshi.Boundary("bottom", face="z-min", fix=["x", "y", "z"])],
        "load": [koshi.Load("pull", face="z-max", force=(0, 0, "4 N"))],
        "analysis": koshi.Analysis("quasi-static", tolerance=1e-9),
        "probe": [
            koshi.Probe("top", face="z-max"),
            koshi.Probe("support", face="z-min", quantity="reaction"),
        ],
    }
    return koshi.Case(**parts | changes)


@pytest.fixture
def case():
    return beam()
