"""A bar set swinging: sampled by a callback, loaded and released between steps."""

import numpy as np

import koshi

E, rho, length = 1e9, 1000, 0.02  # wave speed 1000 m/s
case = koshi.Case(
    title="Bar released",
    lattice=koshi.Lattice(spacing="1 mm", cell="cube-I", kinematics="least-squares"),
    body=koshi.Body(size=("1 mm", "1 mm", length), material="steel"),
    material={"steel": koshi.Material(E, 0.0, rho)},
    boundary=[koshi.Boundary("held", face="z-min", fix=["x", "y", "z"])],
    load=[koshi.Load("pull", face="z-max", force=(0, 0, "1 N"))],
    analysis=koshi.Analysis("dynamic", duration=400e-6, damping={"kind": "none"}),
    probe=[koshi.Probe("tip", face="z-max")],
)
simulation = koshi.Simulation(case)

# Equilibrium under the pull is a straight line; start from it, written through the view.
_, _, z = simulation.coordinates
simulation.displacement[2] = (1.0 / (E * 1e-6) * z)[:, None, None]
before = simulation.measure()
assert before.unbalanced_ratio < 1e-9, "a straight line is not in equilibrium with the pull"

# Let go, and look at the tip now and then; the run ends at its duration.
simulation.set_load_factor("pull", 0)
times, tip = [], []


def sample(simulation):
    times.append(simulation.time)
    tip.append(simulation.measure().probes["tip"][2])


result = simulation.run(sample)
assert abs(simulation.time / 400e-6 - 1) < 1e-9, "the run did not end on its duration"

# The tip swings as a triangle wave of period 4 L / c = 80 microseconds, between +u and -u.
times, tip = np.array(times), np.array(tip)
u = length / (E * 1e-6)
triangle = u * (1 - 4 * np.abs((times / 80e-6 + 0.5) % 1 - 0.5))
error = np.sqrt(np.mean((tip - triangle) ** 2)) / u
print(f"{len(times)} samples in {result.steps} steps, rms deviation from the triangle wave {error:.3f}")
assert len(times) == result.steps // 10 and error < 0.05, "the bar does not swing with its period"

# Nothing is lost: all of the energy of the start.
after = simulation.measure()
energy = after.elastic_energy + after.kinetic_energy
assert abs(energy / before.elastic_energy - 1) < 0.02, f"energy {energy / before.elastic_energy - 1} is not conserved"
