"""Equilibrium of the tooth's load with the shaft's reactions; and the tooth's displacement against half the spacing."""
import math

P, B, THICKNESS = 400e6, 2e-3, 10e-3
CONTACT, NORMAL = (26.33635e-3, -2.778528e-3), (0.1601627, -0.9870906)
FORCE = P * math.pi * B / 2 * THICKNESS  # an ellipse over the width 2 B
FINER = 38.836e-6  # y displacement [m] of the flank with a spacing of 0.25 mm


def values(run):
    results = run()
    # The load pushes against the normal.
    yield "force on the shaft along y [kN]", 1e-3 * -FORCE * NORMAL[1], 1e-3 * -results.probe("shaft.reaction.y"), 0.01
    arm = CONTACT[0] * NORMAL[1] - CONTACT[1] * NORMAL[0]
    yield "torque on the shaft [N m]", -FORCE * arm, -results.probe("torque.moment.z"), 0.01
    yield "displacement of the flank along y [µm]", 1e6 * FINER, 1e6 * results.probe("flank.displacement.y"), 0.06
