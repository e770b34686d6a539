"""The same beam of half the spacing, linear fracture mechanics for the mouth of the notch, and the balance of energies."""

SLICES = 5                      # of 10 mm in the width of 50 mm
FINER = 774.0                   # [N]: largest force at a spacing of 5 mm, scripts/fracture_study.py
E, SPAN, DEPTH, NOTCH, WIDTH = 30e9, 2.0, 0.2, 0.1, 0.05


def mouth_of_linear_beam():
    """Opening over force [m/N]: 4 sigma a V/E with sigma = 3 F L/(2 b h^2); V of Tada, Paris and Irwin for a span of 4 depths."""
    ratio = NOTCH / DEPTH
    v = 0.76 - 2.28 * ratio + 3.87 * ratio**2 - 2.04 * ratio**3 + 0.66 / (1 - ratio) ** 2
    return 4 * 3 * SPAN / (2 * WIDTH * DEPTH**2) * NOTCH * v / E


def values(run):
    result = run()
    force = [-SLICES * f for f in result.history("load.reaction.y")]
    mouth = result.history("mouth.displacement.x")
    yield "largest force [N]", FINER, max(force), 0.03
    yield "opening of the mouth over force before the crack [µm/kN]", 1e9 * mouth_of_linear_beam(), 1e9 * mouth[1] / force[1], 0.15
    taken, given = result.history("cracks")[-1], result.history("work of loads and supports")[-1]
    yield "energy of cracks and springs over work [1]", 1, (taken + result.history("elastic energy")[-1]) / given, 3e-4
