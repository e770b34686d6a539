"""First bending frequency of a clamped beam by Timoshenko's theory, and its deflection under the load."""
import math

E, NU, RHO = 20e9, 0.25, 2600.0
SIDE, LENGTH, FORCE = 0.02, 0.2, 10.0  # [m], [m], [N]
SHEAR = 5 / 6  # shear coefficient of a rectangle
RELEASE = 9.001e-3  # [s]


def timoshenko_frequency():
    """First root of the frequency equation of a clamped-free beam (Huang 1961), [Hz]."""
    area, inertia, shear_modulus = SIDE**2, SIDE**4 / 12, E / (2 * (1 + NU))
    r2, s2 = inertia / (area * LENGTH**2), E * inertia / (SHEAR * area * shear_modulus * LENGTH**2)

    def equation(b):
        root = math.sqrt((r2 - s2) ** 2 + 4 / b**2)
        a, c = b * math.sqrt((root - r2 - s2) / 2), b * math.sqrt((root + r2 + s2) / 2)
        return (2 + (b**2 * (r2 - s2) ** 2 + 2) * math.cosh(a) * math.cos(c)
                - b * (r2 + s2) / math.sqrt(1 - b**2 * r2 * s2) * math.sinh(a) * math.sin(c))

    low, high = 2.0, 3.516  # Euler-Bernoulli's root 1.8751^2 = 3.516 lies above
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if equation(middle) * equation(2.0) > 0 else (low, middle)
    return low / (2 * math.pi * LENGTH**2) * math.sqrt(E * inertia / (RHO * area))


def values(run):
    result = run()
    rises = result.rises("tip.displacement.y", 0, after=RELEASE)
    yield "frequency [Hz]", timoshenko_frequency(), (len(rises) - 1) / (rises[-1] - rises[0]), 0.01
    # Bending and shear, P L^3 / (3 E I) + P L / (kappa G A).
    bending = FORCE * LENGTH**3 / (3 * E * SIDE**4 / 12)
    shear = FORCE * LENGTH / (SHEAR * E / (2 * (1 + NU)) * SIDE**2)
    yield "deflection when let go [um]", 1e6 * (bending + shear), 1e6 * result.at("tip.displacement.y", 9e-3), 0.02
    # Nothing damps: the energy it was let go with stays.
    energy = [e + k for e, k in zip(result.history("elastic energy"), result.history("kinetic energy"))]
    free = [e for e, t in zip(energy, result.time) if t > RELEASE]
    yield "energy, end over release", 1.0, free[-1] / free[0], 1e-4
