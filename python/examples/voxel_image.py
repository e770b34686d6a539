"""A body from a voxel image: stiff grains in a soft matrix with pores, squeezed; its modulus between the bounds."""

import numpy as np

import koshi

# An image [z][y][x] of grey values: 0 pore, 1 matrix, 2 grain. Here random; np.load("scan.npy") in practice.
rng = np.random.default_rng(7)
image = rng.choice([0, 1, 2], p=[0.05, 0.65, 0.30], size=(10, 8, 8))
modulus = {0: 0.0, 1: 5e9, 2: 40e9}

strain = -1e-4
case = koshi.Case(
    title="Voxel image",
    lattice=koshi.Lattice(spacing="1 mm"),
    body=koshi.Body(image=image, materials={0: "void", 1: "matrix", 2: "grain"}),
    material={"matrix": koshi.Material("5 GPa", 0.2, 2500), "grain": koshi.Material("40 GPa", 0.2, 2700)},
    boundary=[
        koshi.Boundary("bottom", face="z-min", fix=["z"]),
        koshi.Boundary("side", face="x-min", fix=["x"]),
        koshi.Boundary("front", face="y-min", fix=["y"]),
        koshi.Boundary("top", face="z-max", displacement={"z": strain * 10e-3}),
    ],
    analysis=koshi.Analysis("quasi-static", tolerance=1e-5),
    probe=[koshi.Probe("top force", face="z-max", quantity="reaction")],
)
simulation = koshi.Simulation(case)
assert np.array_equal(simulation.cells, image), "materials are not where the image has them"

result = simulation.run()
E = result.measurement.probes["top force"][2] / (8e-3 * 8e-3) / strain
# No mixture is stiffer than all phases strained alike (Voigt's bound).
upper = sum(np.mean(image == value) * modulus[value] for value in modulus)
print(f"E = {E / 1e9:.2f} GPa, at most {upper / 1e9:.2f} GPa; {result.steps} steps")
assert 0.4 * upper < E < upper, "the modulus lies outside its bounds"

# The mean stress over the body is the force over the area: equilibrium, whatever the mixture.
stress = simulation.field("stress")[2].sum() / image.size
assert abs(stress / (E * strain) - 1) < 1e-3, "mean stress and force disagree"
