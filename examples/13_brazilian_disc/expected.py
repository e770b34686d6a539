"""Elastic stress at the centre of a disc between jaws, the strength from the largest load, and where the crack starts."""
import math

DIAMETER, THICKNESS, LOAD, STRENGTH = 0.1, 0.002, 1000, 5  # [m], [m], [N] at load factor 1, [MPa]
NOMINAL = 1e-6 * 2 * LOAD / (math.pi * DIAMETER * THICKNESS)  # [MPa]: 2P/(pi D t), of a load at a point


def values(run):
    result = run()
    factor = result.history("load factor")
    # The state of the first event is elastic: what cracks there softens after it.
    yield "elastic stress at the centre over 2P/(πDt) [1]", 1, 1e-6 * result.history("centre.stress.xx")[1] / (factor[1] * NOMINAL), 0.01
    yield "strength 2P/(πDt) [MPa]", STRENGTH, NOMINAL * max(factor), 0.05
    first = min(cell[0] for cell in result.crack())
    heights = [1e3 * y for time, _, y, _ in result.crack() if time == first]
    yield "first crack over the lower jaw [mm]", 50, 50 + sum(heights) / len(heights), 0.05
