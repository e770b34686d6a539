#!/usr/bin/python3
"""Equilibria that are hard to solve: iterations and seconds of each, as a table of Markdown to stdout.

    bench/hard_cases.py --koshi build/release/koshi

Nearly incompressible solids, thin clamped plates, strong contrasts, random voids; relative residual 1e-8. Seconds are
those of setting up and iterating alone, and depend on the machine; iterations do not. `--only plate` runs the cases of
that name.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy

CASE = """
[lattice]
spacing = 1e-3
[body]
image = "cells.npy"
materials = {{ 0 = "void", 1 = "hard", 2 = "soft" }}
[material.hard]
youngs_modulus = 25e9
poissons_ratio = {nu}
density = 2000
[material.soft]
youngs_modulus = {soft}
poissons_ratio = {nu}
density = 2000
{conditions}
[analysis]
type = "static"
tolerance = 1e-8
"""

# Held below, pulled sideways above.
CLAMPED = """
[[boundary]]
name = "bottom"
face = "z-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[load]]
name = "pull"
face = "z-max"
traction = [1e5, 0, 1e5]
"""

# Pressed between rough platens.
PRESSED = """
[[boundary]]
name = "bottom"
face = "z-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[boundary]]
name = "top"
face = "z-max"
fix = ["x", "y", "rx", "ry", "rz"]
displacement = { z = -1e-5 }
"""

# Held along its four edges, pressed on from above.
PLATE = "".join(
    f'[[boundary]]\nname = "{face}"\nface = "{face}"\nfix = ["x", "y", "z", "rx", "ry", "rz"]\n'
    for face in ("x-min", "x-max", "y-min", "y-max")
) + '[[load]]\nname = "wind"\nface = "z-max"\npressure = 1e3\n'


def solid(x, y, z):
    return numpy.ones((z, y, x), numpy.uint8)


def two_phase(n, share, other):
    """Each cell `other` by chance; the two ends stay whole."""
    cells = numpy.where(numpy.random.default_rng(2).random((n, n, n)) < share, other, 1).astype(numpy.uint8)
    cells[[0, -1]] = 1
    return cells


def cases():
    """Name, what varies, cells, Poisson's ratio, modulus of the soft cells, conditions."""
    for nu in (0.3, 0.49, 0.499, 0.4999):
        yield "cube", f"nu = {nu}", solid(40, 40, 40), nu, 25e9, CLAMPED
    for nu in (0.3, 0.499):
        yield "cantilever", f"nu = {nu}", solid(18, 18, 78), nu, 25e9, CLAMPED
    for layers in (2, 3, 4):
        yield "plate clamped along its edges", f"{layers} layers", solid(60, 60, layers), 0.3, 25e9, PLATE
    for contrast in (1e2, 1e4, 1e6):
        yield "30 % of the cells softer", f"contrast {contrast:.0e}", two_phase(40, 0.3, 2), 0.2, 25e9 / contrast, PRESSED
    yield "random voids", "50 %", two_phase(40, 0.5, 0), 0.2, 25e9, PRESSED


def solve(koshi, cells, nu, soft, conditions):
    with tempfile.TemporaryDirectory() as folder:
        directory = pathlib.Path(folder)
        (directory / "case.toml").write_text(CASE.format(nu=nu, soft=soft, conditions=conditions))
        numpy.save(directory / "cells.npy", cells)
        ended = subprocess.run([koshi, "run", directory / "case.toml", "--out", directory / "out", "--quiet"],
                               capture_output=True, text=True)  # fmt: skip
        if ended.returncode != 0:
            return None, ended.stderr.strip().splitlines()[-1]
        return json.loads((directory / "out/summary.json").read_text()), ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koshi", default="build/release/koshi", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    print("| case | | cells | unknowns | iterations | seconds |\n|---|---|---|---|---|---|")
    for name, what, cells, nu, soft, conditions in cases():
        if not name.startswith(options.only):
            continue
        shape = " × ".join(map(str, cells.shape[::-1]))
        summary, error = solve(options.koshi, cells, nu, soft, conditions)
        if summary is None:
            print(f"| {name} | {what} | {shape} | | {error} | |", flush=True)
            continue
        run, time = summary["analysis"], summary["performance"]
        seconds = time["setup_seconds"] + time["solve_seconds"]
        print(f"| {name} | {what} | {shape} | {run['unknowns']} | {run['iterations']} | {seconds:.2f} |", flush=True)


if __name__ == "__main__":
    main()
