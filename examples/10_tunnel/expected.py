"""Kirsch: a circular hole of radius R in a plate under p vertically and k p laterally, in plane strain."""

E, NU = 10e9, 0.25
RADIUS, PRESSURE = 3.0, 5e6
LATERAL = NU / (1 - NU)  # k, from the walls


def vertical_stress(distance):
    """Hoop stress on the horizontal axis at a distance from the centre [Pa], compression negative."""
    q = (RADIUS / distance) ** 2
    return -PRESSURE / 2 * ((1 + LATERAL) * (1 + q) + (1 - LATERAL) * (1 + 3 * q**2))


def closure(along, across):
    """How much the ends of a diameter come together, with the hole there from the start [m]."""
    plane = E / (1 - NU**2)  # the modulus of plane strain
    return 2 * RADIUS * (3 * along - across) / plane


def values(run):
    result = run()
    for name, distance in (("half a radius", 1.5 * RADIUS), ("a radius", 2 * RADIUS)):
        yield f"vertical stress, {name} into the rock [MPa]", 1e-6 * vertical_stress(distance), \
            1e-6 * result.probe(f"{name} in.stress.zz"), 0.03
    found = result.probe("floor.displacement.z") - result.probe("crown.displacement.z")
    yield "closure, crown to floor [mm]", 1e3 * closure(PRESSURE, LATERAL * PRESSURE), 1e3 * found, 0.02
