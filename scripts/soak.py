#!/usr/bin/python3
"""Ten million undamped steps of small bodies through the command line: does the energy drift, does the memory grow?

Usage: soak.py [KOSHI] [STEPS]. Writes docs/validation/soak.csv when STEPS is 10^7 (the default; some minutes); the
table of docs/validation/soak.md is made from it. The bodies are held at one face, struck at the other and left alone.
"""

import csv
import os
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KOSHI = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else os.path.join(ROOT, "build/release/koshi")
STEPS = int(float(sys.argv[2])) if len(sys.argv) > 2 else 10_000_000

CASE = """
[lattice]
cell = "cube-III"
spacing = "1 mm"
kinematics = "{kinematics}"
[body]
size = ["4 mm", "4 mm", "4 mm"]
material = "steel"
[material.steel]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = "7850 kg/m^3"
[material.rubber]
youngs_modulus = "1 GPa"
poissons_ratio = 0.45
density = "1200 kg/m^3"
{regions}
[[boundary]]
name = "wall"
face = "x-min"
fix = ["x", "y", "z"{rotations}]
[[load]]
name = "stroke"
face = "x-max"
force = ["30 N", "-20 N", "50 N"]
history = [["0 s", 1], ["2 us", 1], ["4 us", 0]]
[analysis]
type = "dynamic"
time_step = "{dt} s"
duration = "{duration!r} s"
damping = {{ kind = "none" }}
[output]
fields = []
history_every = "{interval!r} s"
"""
INCLUSION = """[[region]]
shape = "box"
min = ["1 mm", "1 mm", "1 mm"]
max = ["3 mm", "2 mm", "3 mm"]
material = "rubber"
"""
BODIES = {  # name: (kinematics, region, time step [s])
    "steel and rubber, rotational": ("rotational", INCLUSION, 8e-8),
    "steel, least-squares": ("least-squares", "", 1.2e-7),
}


def memory(pid):
    """Memory a process has taken for itself [kB]; pages of programs and libraries, read when first used, are not in it."""
    with open(f"/proc/{pid}/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("RssAnon"))


def soak(name, directory):
    kinematics, regions, dt = BODIES[name]
    duration = STEPS * dt
    case = os.path.join(directory, "case.toml")
    with open(case, "w") as file:
        file.write(CASE.format(kinematics=kinematics, regions=regions, dt=dt, duration=duration,
                               interval=duration / 2000,
                               rotations=', "rx", "ry", "rz"' if kinematics == "rotational" else ""))
    out = os.path.join(directory, "out")
    process = subprocess.Popen([KOSHI, "run", case, "--out", out, "--quiet"])
    # Memory while the run steps: from 2 % of its rows on to the last but a few, before it writes its results.
    history, taken = os.path.join(out, "history.csv"), []
    while process.poll() is None:
        time.sleep(0.05)
        try:
            with open(history) as file:
                done = sum(1 for _ in file)
            if 40 <= done <= 1980:
                taken.append(memory(process.pid))
        except (OSError, StopIteration):
            pass  # not yet or no longer there
    if process.returncode != 0:
        sys.exit(f"{name}: exit code {process.returncode}")
    with open(history) as file:
        rows = list(csv.DictReader(file))
    rows = [row for row in rows if float(row["time [s]"]) > 5e-6]  # left alone from 4 us on
    conserved = [float(row["leapfrog energy [J]"]) for row in rows]
    total = [float(row["elastic energy [J]"]) + float(row["kinetic energy [J]"]) for row in rows]
    tenth = len(rows) // 10
    mean = lambda values: sum(values) / len(values)
    return {
        "body": name, "steps": STEPS, "rows": len(rows),
        "largest drift": f"{max(abs(value / conserved[0] - 1) for value in conserved):.1e}",
        "drift at the end": f"{conserved[-1] / conserved[0] - 1:.1e}",
        "swing of T + V": f"{max(total) / min(total) - 1:.1e}",
        "T + V, last tenth against first": f"{mean(total[-tenth:]) / mean(total[:tenth]) - 1:.1e}",
        "memory at 2 % [kB]": taken[0], "memory at 99 % [kB]": taken[-1], "largest [kB]": max(taken),
    }


rows = []
for body in BODIES:
    with tempfile.TemporaryDirectory() as scratch:
        rows.append(soak(body, scratch))
        print(rows[-1], flush=True)
if STEPS == 10_000_000:
    with open(os.path.join(ROOT, "docs/validation/soak.csv"), "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
if any(float(row["largest drift"]) >= 1e-6 or row["largest [kB]"] > 1.01 * row["memory at 2 % [kB]"] for row in rows):
    sys.exit("the energy drifts or the memory grows")
