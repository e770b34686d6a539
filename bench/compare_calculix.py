#!/usr/bin/python3
"""The cantilever by Koshi and by CalculiX on the same cells, side by side: a table in Markdown to stdout.

    apt-get install calculix-ccx        # not among Koshi's packages: only this comparison needs it
    bench/compare_calculix.py --koshi build/release/koshi [--spacing 0.1 0.06]

Koshi: bending-exact springs, relative residual 1e-8. CalculiX: C3D8I, its best low-order brick, with its direct solver
(spooles) and with conjugate gradients preconditioned by incomplete Cholesky factors. One core each; the whole process
is timed, input and output included, and the most memory it held. The deflection is the mean over the end face by area;
three-dimensional elasticity has 0.0164472 cm (docs/theory/09_numbers.md).
"""
import argparse
import os
import pathlib
import re
import resource
import subprocess
import tempfile
import time

from static_study import CANTILEVER

CONVERGED = 0.0164472
PROBE = '[[probe]]\nname = "tip"\nface = "y-max"\nreduce = "area-mean"\n'


def timed(command, directory):
    """Wall seconds and peak memory [MB] of a process on one core."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "CCX_NPROC_STIFFNESS": "1"}
    start = time.monotonic()
    process = subprocess.Popen(command, cwd=directory, env=environment, stdout=subprocess.PIPE, text=True)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"{command[0]} failed:\n{output[-2000:]}")
    return time.monotonic() - start, usage.ru_maxrss / 1024, output


def by_koshi(koshi, spacing, kinematics, directory):
    text = CANTILEVER.format(spacing=spacing / 100, kinematics=kinematics, nu=0.18) + PROBE
    (directory / "case.toml").write_text(text + "[output]\nfields = []\n")
    seconds, memory, output = timed([koshi, "run", "case.toml", "--out", "out"], directory)
    return seconds, memory, 100 * float(re.search(r"x = (\S+),", output)[1])


def calculix_input(cells, spacing, solver):
    """The deck, and the share of the end face that each of its nodes has."""
    nx, ny, nz = (n + 1 for n in cells)
    lines = ["*NODE,NSET=ALL"]
    number = lambda i, j, k: 1 + i + nx * (j + ny * k)
    for k in range(nz):
        for j in range(ny):
            lines += [f"{number(i, j, k)},{i * spacing:.9g},{j * spacing:.9g},{k * spacing:.9g}" for i in range(nx)]
    lines.append("*ELEMENT,TYPE=C3D8I,ELSET=BODY")
    element = 0
    for k in range(nz - 1):
        for j in range(ny - 1):
            for i in range(nx - 1):
                element += 1
                base = [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k)]
                lines.append(",".join(map(str, [element, *base, *(n + nx * ny for n in base)])))
    root = [number(i, 0, k) for k in range(nz) for i in range(nx)]
    end = lambda index, count: 0.5 if index in (0, count - 1) else 1.0
    share = {number(i, ny - 1, k): end(i, nx) * end(k, nz) / (cells[0] * cells[2]) for k in range(nz) for i in range(nx)}
    # Centimetres, newtons.
    lines += ["*NSET,NSET=ROOT", *(f"{n}," for n in root), "*NSET,NSET=TIP", *(f"{n}," for n in share)]
    lines += ["*MATERIAL,NAME=ROCK", "*ELASTIC", "111200,0.18", "*SOLID SECTION,ELSET=BODY,MATERIAL=ROCK"]
    lines += ["*BOUNDARY", "ROOT,1,3", "*STEP", f"*STATIC,SOLVER={solver}", "1,1", "*CLOAD"]
    lines += [f"{n},1,{9.8 * s:.12g}" for n, s in share.items()]
    lines += ["*NODE PRINT,NSET=TIP", "U", "*END STEP", ""]
    return "\n".join(lines), share


def by_calculix(cells, spacing, solver, directory):
    deck, share = calculix_input(cells, spacing, solver)
    (directory / "beam.inp").write_text(deck)
    seconds, memory, _ = timed(["ccx", "beam"], directory)
    rows = [line.split() for line in (directory / "beam.dat").read_text().splitlines()]
    u = {int(row[0]): float(row[1]) for row in rows if len(row) == 4 and row[0].isdigit()}
    if u.keys() != share.keys():
        raise SystemExit("CalculiX printed other nodes than the end face has")
    return seconds, memory, sum(share[n] * u[n] for n in share)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koshi", default="build/release/koshi", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--spacing", nargs="+", type=float, default=[0.2, 0.1, 0.06], help="in cm")
    parser.add_argument("--direct-below", type=int, default=40000, help="nodes up to which spooles is run too")
    options = parser.parse_args()
    version = subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout.strip()
    print(subprocess.run([options.koshi, "--version"], capture_output=True, text=True).stdout.strip(), version, sep="; ")
    print("\n| cells | program | unknowns | seconds | over Koshi's | MB | deflection [cm] | error |")
    print("|---|---|---|---|---|---|---|---|")
    for spacing in options.spacing:
        cells = [round(size / spacing) for size in (1.8, 7.8, 1.8)]
        nodes = (cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1)
        runs = [("Koshi, rotational", 6, lambda at: by_koshi(options.koshi, spacing, "rotational", at)),
                ("Koshi, least-squares", 3, lambda at: by_koshi(options.koshi, spacing, "least-squares", at)),
                ("CalculiX, iterative", 3, lambda at: by_calculix(cells, spacing, "ITERATIVE CHOLESKY", at))]
        if nodes <= options.direct_below:
            runs.append(("CalculiX, spooles", 3, lambda at: by_calculix(cells, spacing, "SPOOLES", at)))
        first = None
        for name, components, run in runs:
            with tempfile.TemporaryDirectory() as folder:
                seconds, memory, deflection = run(pathlib.Path(folder))
            first = first or seconds
            print(f"| {' x '.join(map(str, cells))} | {name} | {nodes * components} | {seconds:.2f} | {seconds / first:.1f} "
                  f"| {memory:.0f} | {deflection:.7f} | {100 * (deflection / CONVERGED - 1):+.2f} % |", flush=True)


if __name__ == "__main__":
    main()
