"""Speeds sqrt(E/rho) of a thin bar and c_p of a plane wave; velocities of a free end."""
import math

E, NU, RHO = 200e9, 0.3, 7850.0
PRESSURE, BETWEEN_GAUGES = 1e6, 0.3  # [Pa], [m]


def speed(result):
    """From the times at which half the pressure passes the two gauges. Compression is negative: it ends with a rise."""
    first, second = (result.rises(f"gauge {i}.stress.xx", -PRESSURE / 2)[0] for i in (1, 2))
    return BETWEEN_GAUGES / (second - first)


def values(run):
    bar, plane = math.sqrt(E / RHO), math.sqrt(E * (1 - NU) / ((1 + NU) * (1 - 2 * NU)) / RHO)
    result = run()
    yield "speed in the bar, c_0 [m/s]", bar, speed(result), 2e-3
    # sigma = rho c v in a wave; the reflected wave doubles the velocity at the free end.
    yield "velocity of the free end, 2 p / (rho c_0) [mm/s]", 2e3 * PRESSURE / (RHO * bar), \
        1e3 * max(result.history("free end.velocity.x")), 0.01
    # Reflected at the free end, compression comes back as tension.
    yield "tension at gauge 2 [MPa]", 1e-6 * PRESSURE, 1e-6 * max(result.history("gauge 2.stress.xx")), 0.01
    sides = run("body.periodic=[false, true, true]")
    yield "speed without sides, c_p [m/s]", plane, speed(sides), 1e-3
