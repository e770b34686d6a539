#!/usr/bin/python3
"""Static analyses end to end: iterations, seconds and memory of each case, as CSV to stdout.

    bench/static_study.py --koshi build/release/koshi > docs/validation/equilibrium.csv

The whole process is timed, from its start to the last file, on an otherwise idle machine: `wall` and `processor`
seconds (user and system). Iterations do not depend on the machine. `--only cantilever` runs the cases of that name;
`--large` adds 10 million unknowns (1 GB).
"""
import argparse
import csv
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy

CANTILEVER = """
[lattice]
spacing = {spacing}
kinematics = "{kinematics}"
[body]
size = [0.018, 0.078, 0.018]
material = "rock"
[material.rock]
youngs_modulus = 1112e6
poissons_ratio = {nu}
density = 2000
[[boundary]]
name = "root"
face = "y-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[load]]
name = "tip load"
face = "y-max"
force = [9.8, 0, 0]
[analysis]
type = "static"
tolerance = 1e-8
"""

BLOCK = """
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
youngs_modulus = 2.5e9
poissons_ratio = {nu}
density = 2000
[[boundary]]
name = "bottom"
face = "z-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[boundary]]
name = "top"
face = "z-max"
fix = ["x", "y", "rx", "ry", "rz"]
displacement = {{ z = -1e-5 }}
[analysis]
type = "static"
tolerance = 1e-8
"""


def porous(shape):
    """Overlapping spheres of radius 3.6 to 8.4 cells taken out until 30 % is void; the ends stay whole."""
    random = numpy.random.default_rng(1)
    cells = numpy.ones(shape[::-1], numpy.uint8)
    z, y, x = numpy.ogrid[: shape[2], : shape[1], : shape[0]]
    while (cells == 0).mean() < 0.3:
        centre, radius = random.random(3) * shape, 6 * (0.6 + 0.8 * random.random())
        cells[(x + 0.5 - centre[0]) ** 2 + (y + 0.5 - centre[1]) ** 2 + (z + 0.5 - centre[2]) ** 2 < radius**2] = 0
    cells[[0, -1]] = 1
    return cells


def two_phase(shape):
    """Each cell soft, a tenth as stiff, with a probability of 30 %."""
    return (1 + (numpy.random.default_rng(2).random(shape[::-1]) < 0.3)).astype(numpy.uint8)


def cases(large):
    """Name, what varies, input, cells of an image or None."""
    sizes = [0.001, 0.0005] + ([0.00025] if large else [])
    for spacing in sizes:
        yield "cantilever", 0.18, CANTILEVER.format(spacing=spacing, kinematics="rotational", nu=0.18), None
    for spacing in sizes[:2]:
        text = CANTILEVER.format(spacing=spacing, kinematics="least-squares", nu=0.18)
        yield "cantilever, least-squares", 0.18, text, None
    for nu in (0.45, 0.49):
        for spacing in sizes[:2]:
            yield "cantilever", nu, CANTILEVER.format(spacing=spacing, kinematics="rotational", nu=nu), None
    for shape in ((32, 32, 64), (64, 64, 128)):
        yield "porous block", 0.2, BLOCK.format(nu=0.2), porous(shape)
        yield "two-phase block", 0.2, BLOCK.format(nu=0.2), two_phase(shape)


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def measure(koshi, text, cells):
    with tempfile.TemporaryDirectory() as folder:
        directory = pathlib.Path(folder)
        (directory / "case.toml").write_text(text)
        if cells is not None:
            numpy.save(directory / "cells.npy", cells)
        wall, processor = time.monotonic(), processor_seconds()
        subprocess.run([koshi, "run", directory / "case.toml", "--out", directory / "out", "--quiet"], check=True)
        wall, processor = time.monotonic() - wall, processor_seconds() - processor
        summary = json.loads((directory / "out" / "summary.json").read_text())
    analysis, performance, body = summary["analysis"], summary["performance"], summary["body"]
    # All nodes of the box: where cells are empty the memory is there all the same.
    nodes = numpy.prod([n + 1 for n in body["cells"]])
    return [
        " x ".join(map(str, body["cells"])),
        analysis["unknowns"],
        analysis["levels"],
        analysis["iterations"],
        f"{analysis['residual']:.1e}",
        f"{performance['solve_seconds']:.2f}",
        f"{wall:.2f}",
        f"{processor:.2f}",
        round(performance["peak_memory"] / 1e6),
        round(performance["peak_memory"] / nodes),
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koshi", default="build/release/koshi", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["case", "nu", "cells", "unknowns", "levels", "iterations", "residual", "solve [s]", "wall [s]",
                    "processor [s]", "peak memory [MB]", "bytes per node"])
    for name, nu, text, cells in cases(options.large):
        if name.startswith(options.only):
            table.writerow([name, nu, *measure(options.koshi, text, cells)])
            sys.stdout.flush()


if __name__ == "__main__":
    main()
