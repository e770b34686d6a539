#!/usr/bin/python3
"""Bonds that may break by Koshi and by Yade's JCFpm, in turn on one core: a table in Markdown to stdout.

    apt-get install yade        # not among Koshi's packages: only this comparison needs it
    bench/compare_yade.py [--koshi build/release/koshi] [--nodes 30]

A cube on a cubic lattice, each node joined to its nearest and second nearest neighbours (18), under gravity; no bond breaks while
the clock runs. Koshi: Cube-II, law "bonds"; and, with as many bonds, the law of cells. The rates are those of the steps
alone, without input, output and start.
"""
import argparse
import pathlib
import re
import subprocess
import tempfile

BODY = """
lattice = {{ spacing = "1 mm", cell = "cube-II", calibration = "isotropic" }}
body = {{ size = [{side}, {side}, {side}], material = "rock" }}
material.rock = {{ youngs_modulus = "1 GPa", poissons_ratio = 0.18, density = 2000, fracture = {{ {fracture} }} }}
boundary = [{{ name = "floor", face = "z-min", fix = ["x", "y", "z"] }}]
load = [{{ name = "gravity", acceleration = [0, 0, -1] }}]
analysis = {{ type = "dynamic", duration = {duration}, time_step = 2e-7, damping = {{ kind = "local", factor = 0.8 }} }}
output = {{ fields = [] }}
"""
LAWS = {"bonds": 'law = "bonds", fracture_energy = 1e6', "cells": 'tensile_strength = "1 MPa", fracture_energy = 1e6'}

YADE = """
import time
from yade import pack
radius, side = 0.5e-3, {nodes}e-3
O.materials.append(JCFpmMat(young=1e9, poisson=0.3, density=2000, frictionAngle=0.5, tensileStrength=1e6, cohesion=1e7, type=1, label="rock"))
O.bodies.append(pack.regularOrtho(pack.inAlignedBox((0, 0, 0), (side, side, side)), radius=radius, gap=0, material="rock"))
sphere, pair = Bo1_Sphere_Aabb(aabbEnlargeFactor=1.45), Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.45)
O.engines = [ForceResetter(), InsertionSortCollider([sphere]),
             InteractionLoop([pair], [Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=1)],
                             [Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM()]),
             NewtonIntegrator(damping=0.8, gravity=(0, 0, -1))]
O.dt = 0.3 * PWaveTimeStep()
O.step()  # bonds are made by the first step, from spheres that are farther apart than touching ones
sphere.aabbEnlargeFactor = pair.interactionDetectionFactor = 1
O.run(5, True)
start = time.monotonic()
O.run({steps}, True)
seconds = time.monotonic() - start
bonds = sum(1 for i in O.interactions if i.phys.isCohesive)
print("RATE", len(O.bodies), bonds, 1e-6 * bonds * {steps} / seconds)
"""


def bonds_of(nodes):
    """Edges and face diagonals of a cube of nodes."""
    return 3 * nodes**2 * (nodes - 1) + 6 * nodes * (nodes - 1) ** 2


def by_koshi(koshi, nodes, law, steps, directory):
    text = BODY.format(side=1e-3 * (nodes - 1), fracture=LAWS[law], duration=steps * 2e-7)
    (directory / "case.toml").write_text(text)
    output = subprocess.run([koshi, "run", "case.toml", "--out", "out"], cwd=directory, check=True,
                            capture_output=True, text=True).stdout  # fmt: skip
    rate = float(re.search(r"\(([\d.e+-]+) million node-steps/s\)", output)[1])
    return rate * bonds_of(nodes) / nodes**3


def by_yade(nodes, steps, directory):
    (directory / "step.py").write_text(YADE.format(nodes=nodes + 1, steps=steps))
    output = subprocess.run(["yade", "-j1", "-n", "-x", "step.py"], cwd=directory, check=True,
                            capture_output=True, text=True).stdout  # fmt: skip
    _, count, bonds, rate = re.search(r"RATE .*", output)[0].split()
    if int(count) != nodes**3 or int(bonds) != bonds_of(nodes):
        raise SystemExit(f"Yade has {count} spheres and {bonds} bonds instead of {nodes**3} and {bonds_of(nodes)}")
    return float(rate)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koshi", default="build/release/koshi", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--nodes", type=int, default=30, help="along an edge")
    options = parser.parse_args()
    nodes = options.nodes
    runs = {"Yade, JCFpm": lambda at: by_yade(nodes, 50, at),
            "Koshi, bonds": lambda at: by_koshi(options.koshi, nodes, "bonds", 1000, at),
            "Koshi, cells": lambda at: by_koshi(options.koshi, nodes, "cells", 1000, at)}  # fmt: skip
    rates = {name: [] for name in runs}
    for _ in range(3):
        for name, run in runs.items():
            with tempfile.TemporaryDirectory() as folder:
                rates[name].append(run(pathlib.Path(folder)))
    print(f"{bonds_of(nodes)} bonds; medians of three runs in turn\n")
    print("| program | million bonds a second | over Yade's |")
    print("|---|---|---|")
    peer = sorted(rates["Yade, JCFpm"])[1]
    for name, values in rates.items():
        print(f"| {name} | {sorted(values)[1]:.1f} | {sorted(values)[1] / peer:.0f} |")


if __name__ == "__main__":
    main()
