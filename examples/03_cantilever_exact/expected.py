"""Converged three-dimensional elasticity, mean over the end face; and statics: the reaction is minus the load."""


def values(run):
    result = run()
    # High-order finite elements, graded to the clamped edges (docs/theory/09_numbers.md).
    yield "tip deflection u_x [cm]", 0.0164472, 100 * result.probe("tip.displacement.x"), 3e-3
    # Clapeyron: half the load times the displacement of its point of application, the mean over the face.
    yield "elastic energy [uJ]", 1e6 * 0.5 * 9.8 * 0.000164472, 1e6 * result.summary["energy"]["elastic"], 3e-3
