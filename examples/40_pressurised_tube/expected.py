"""Lame's tube with free ends (Timoshenko & Goodier, Theory of Elasticity, section 28)."""
E, NU, A, B, P = 210e9, 0.3, 25e-3, 50e-3, 50e6
K = P * A**2 / (B**2 - A**2)


def widening(r):
    return K / E * ((1 - NU) * r + (1 + NU) * B**2 / r)


def hoop(r):
    return K * (1 + B**2 / r**2)


def values(run):
    results = run()
    grown = results.probe("right.displacement.x") - results.probe("left.displacement.x")
    yield "widening between the probes [µm]", 1e6 * (widening(36.5e-3) + widening(36e-3)), 1e6 * grown, 0.01
    yield "hoop stress in the middle of the wall [MPa]", 1e-6 * hoop(36.5e-3), 1e-6 * results.probe("wall.stress.yy"), 0.01
    yield ("hoop stress near the bore [MPa]", 1e-6 * hoop(31.5e-3), 1e-6 * results.probe("near the bore.stress.yy"),
           0.02)
