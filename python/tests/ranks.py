"""Under mpiexec: fields are this rank's boxes, measurements are those of the whole body, mpi4py's communicators work."""

import sys

import numpy as np
from mpi4py import MPI

import koshi
from conftest import beam

world = MPI.COMM_WORLD
assert world.size == 2, f"{world.size} ranks"
case = beam()
whole = koshi.Simulation(case, comm=MPI.COMM_SELF)
parts = koshi.Simulation(case)

# Each node belongs to one rank; the boxes lie side by side along the longest axis.
nodes = world.allreduce(parts.displacement[0].size)
assert nodes == whole.displacement[0].size == 45, nodes
assert parts.displacement[0].size < 45

# What one rank writes into its box counts in the sums of all.
for simulation in (whole, parts):
    simulation.displacement[2] = 1e-3 * simulation.coordinates[2][:, None, None]
assert parts.measure().elastic_energy == whole.measure().elastic_energy
assert np.isclose(whole.measure().elastic_energy, 8e-6, rtol=1e-12)

# Steps are bit-identical.
for simulation in (whole, parts):
    simulation.step(200)
ours = [np.searchsorted(w, p) for w, p in zip(whole.coordinates, parts.coordinates)]
assert (whole.displacement[:, ours[2][:, None, None], ours[1][:, None], ours[0]] == parts.displacement).all()
assert world.allreduce(int(np.count_nonzero(parts.displacement))) == np.count_nonzero(whole.displacement) > 50
for name, value in whole.measure().probes.items():
    assert (parts.measure().probes[name] == value).all(), name
if world.rank == 0:
    print("2 ranks agree with one")
sys.exit(0)
