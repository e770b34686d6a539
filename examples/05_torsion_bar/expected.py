"""Saint-Venant's torsion of a square: T = 0.1406 G a^4 alpha / L."""
import math

E, NU = 20e9, 0.25
SIDE, LENGTH, ANGLE = 0.02, 0.1, 0.01  # [m], [m], [rad]


def torsion_constant():
    """J / a^4 of a square by the series of Timoshenko and Goodier: 0.14058."""
    series = sum(math.tanh(n * math.pi / 2) / n**5 for n in range(1, 40, 2))
    return (1 - 192 / math.pi**5 * series) / 3


def values(run):
    shear_modulus = E / (2 * (1 + NU))
    torque = torsion_constant() * shear_modulus * SIDE**4 * ANGLE / LENGTH
    result = run()
    yield "torque [N m]", torque, result.probe("torque.moment.z"), 0.01
    yield "elastic energy, T alpha / 2 [mJ]", 1e3 * torque * ANGLE / 2, 1e3 * result.summary["energy"]["elastic"], 0.01
    # The error falls with the square of the spacing: a quarter at twenty cells across.
    fine = run("lattice.spacing='1 mm'")
    yield "torque, spacing 1 mm [N m]", torque, fine.probe("torque.moment.z"), 0.0025
