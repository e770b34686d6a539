#!/usr/bin/python3
"""A glass plate that is pulled at its edges: whether its crack branches, and how fast it runs. Prints the table of
docs/validation/branching.md.

    scripts/branching_study.py [--koshi build/release/koshi]

Takes some five minutes on one core.
"""
import argparse
import pathlib
import subprocess
import tempfile

import numpy as np
from gallery import Results

C_R = 3160.0  # Rayleigh waves of the glass [m/s]

# A crack of half the plate's length, in the middle row of cells.
PLATE = """
lattice = {{ spacing = {d}, kinematics = "least-squares" }}
body = {{ size = [0.1, 0.04, {thickness}], material = "glass" }}
material.glass = {{ youngs_modulus = "72 GPa", poissons_ratio = 0.22, density = 2440, fracture = {{ tensile_strength = "{strength} MPa", fracture_energy = "3.8 J/m^2" }} }}
crack = [{{ name = "start", center = [0.025, {middle}, {half}], normal = [0, 1, 0], radius = 0.02501 }}]
load = [
  {{ name = "top", face = "y-max", traction = [0, "{pull} MPa", 0] }},
  {{ name = "bottom", face = "y-min", traction = [0, "-{pull} MPa", 0] }},
]
analysis = {{ type = "dynamic", duration = "{duration} us" }}
output = {{ crack_surface = true }}
"""

# Spacing [mm], strength [MPa], pull [MPa], duration [us].
RUNS = [(0.25, 12, 0.2, 43), (0.25, 12, 1, 60), (0.25, 12, 2, 43), (0.2, 12, 2, 43), (0.25, 20, 2, 43)]


def cracked(koshi, d, strength, pull, duration):
    """Places [m] and times [s] of the cells that cracked through during the run."""
    case = PLATE.format(d=d * 1e-3, thickness=2e-3 * d, middle=0.02 + 0.5e-3 * d, half=1e-3 * d, strength=strength,
                        pull=pull, duration=duration)  # fmt: skip
    with tempfile.TemporaryDirectory() as directory:
        (pathlib.Path(directory) / "case.toml").write_text(case)
        subprocess.run([koshi, "run", "case.toml", "--out", "out", "--quiet"], cwd=directory, check=True)
        cells = np.array(Results(pathlib.Path(directory) / "out").crack())
    cells = cells[cells[:, 0] > 0]
    return cells[:, 1:], cells[:, 0]


def branches(places, d):
    """Largest number of cracks that a line across the plate meets, and where the first of more than one begins [m]."""
    most, first = 1, None
    for x in np.arange(0.05, 0.1, 1e-3):
        y = np.sort(places[np.abs(places[:, 0] - x) < 0.5e-3, 1])
        count = 1 + int(np.sum(np.diff(y) > 4 * d))
        most = max(most, count)
        if count > 1 and first is None:
            first = x
    return most, first


def fastest(places, times, window=5e-6):
    """Largest speed of the foremost tip over a time [s]: [m/s]."""
    speeds = []
    for end in np.arange(times.min() + 1.001 * window, times.max(), 0.5e-6):
        tips = [places[times <= t, 0].max() for t in (end - window, end)]
        speeds.append((tips[1] - tips[0]) / window)
    return max(speeds)


def mean_speed(places, times, x):
    """Of the foremost tip from its start up to a place [m]: [m/s]."""
    there = times[places[:, 0] >= x].min()
    return (x - places[times == times.min(), 0].max()) / (there - times.min())


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--koshi", default="build/release/koshi", type=pathlib.Path)
    koshi = arguments.parse_args().koshi.resolve()
    print("| spacing [mm] | strength [MPa] | pull [MPa] | cracks side by side | first branch at x [mm] | fastest [m/s] | over c_R |")
    print("|---|---|---|---|---|---|---|")
    measured = []
    for d, strength, pull, duration in RUNS:
        places, times = cracked(koshi, d, strength, pull, duration)
        row = f"| {d} | {strength} | {pull} |"
        if len(times) < 10:
            print(f"{row} 1, does not grow | | | |")
            continue
        count, first = branches(places, d * 1e-3)
        speed = fastest(places, times)
        if first is not None:
            windows = ", ".join(f"{fastest(places, times, 1e-6 * w) / C_R:.2f}" for w in (2, 5, 10))
            measured.append(f"{d} mm, {pull} MPa: over 2, 5, 10 us {windows} c_R; mean up to the branch {mean_speed(places, times, first) / C_R:.2f}")
        print(f"{row} {count} | {'' if first is None else f'{1e3 * first:.0f}'} | {speed:.0f} | {speed / C_R:.2f} |")
    print("\n".join(measured))


if __name__ == "__main__":
    main()
