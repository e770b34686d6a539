"""The cantilever of Nishimura et al. with exact springs, built in Python; its deflection against beam theory.

usage: cantilever.py [PICTURE.png]
"""

import sys

import numpy as np

import koshi

E, nu, F = 1112e6, 0.18, 9.8  # Pa, 1, N
width, length = 0.018, 0.078  # m

case = koshi.Case(
    title="Cantilever",
    lattice=koshi.Lattice(spacing="0.3 cm"),
    body=koshi.Body(size=(width, length, width), material="rock"),
    material={"rock": koshi.Material(E, nu, "2000 kg/m^3")},
    boundary=[koshi.Boundary("root", face="y-min", fix=["x", "y", "z", "rx", "ry", "rz"])],
    load=[koshi.Load("tip load", face="y-max", force=(F, 0, 0))],
    analysis=koshi.Analysis("quasi-static", tolerance=1e-5),
    probe=[koshi.Probe("tip", face="y-max", reduce="area-mean"), koshi.Probe("root", face="y-min", quantity="reaction")],
)
simulation = koshi.Simulation(case)
result = simulation.run()
tip = result.measurement.probes["tip"][0]

# Along the axis of the beam: u_x of the middle line, against Timoshenko's beam (shear factor 10 (1 + nu) / (12 + 11 nu)).
y = simulation.coordinates[1]
deflection = simulation.displacement[0, 3, :, 3]
I, A, G = width**4 / 12, width**2, E / (2 * (1 + nu))
beam = F * y**2 * (3 * length - y) / (6 * E * I) + F * y / (10 * (1 + nu) / (12 + 11 * nu) * G * A)
print(f"tip {100 * tip:.6f} cm, beam theory {100 * beam[-1]:.6f} cm, {result.steps} steps")

assert abs(tip / beam[-1] - 1) < 0.01, "the tip differs from beam theory"
assert np.all(np.abs(deflection - beam) < 0.01 * beam[-1]), "the deflection curve differs from beam theory"
assert np.allclose(result.measurement.probes["root"], (-F, 0, 0), atol=1e-3 * F), "the support does not carry the load"

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    from koshi import plot

    _, axes = plt.subplots(2, 1, figsize=(7, 6))
    plot.section(simulation, "displacement", 0, normal="z", scale=20, ax=axes[0])
    axes[1].plot(100 * y, 100 * deflection, "o", label="Koshi")
    axes[1].plot(100 * y, 100 * beam, label="Timoshenko's beam")
    axes[1].set(xlabel="y [cm]", ylabel="u_x [cm]")
    axes[1].legend()
    plt.savefig(sys.argv[1])
