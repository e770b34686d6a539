"""Nishimura et al.: 0.0140 cm at the tip with Cube-II, four digits after the point."""


def values(run):
    yield "tip deflection u_x [cm]", 0.0140, 100 * run().probe("tip.displacement.x"), 5e-3
