"""The largest force of the test series A on L-shaped panels of B. Winkler, read from its measured curve."""

SLICES = 10  # of 10 mm in the panel of 100 mm
PEAK, LIFT = 7219.1, 0.2078  # [N], [mm]: the top row of the measured curve


def values(run):
    result = run()
    force = result.history("jack.reaction.y")
    yield "largest force [kN]", 1e-3 * PEAK, 1e-3 * SLICES * max(force), 0.1
    yield "lift of the jack then [mm]", LIFT, result.history("load factor")[force.index(max(force))], 0.1
    taken, given = result.history("cracks")[-1], result.history("work of loads and supports")[-1]
    yield "energy of cracks and springs over work [1]", 1, (taken + result.history("elastic energy")[-1]) / given, 1e-4
