#!/usr/bin/python3
"""Makes a table of benchmark results: each rate, and its fraction of what the machine allows.

usage: table.py ONE_RANK.json [TWO_RANKS.json]

The files come from `koshi_bench --benchmark_out=FILE`. The model of bytes and operations is explained in
docs/development/performance.md.
"""

import json
import sys

# Bytes between memory and processor and floating-point operations, per node and step.
BYTES = {"rotational": 208, "least-squares": 104}
CELL_BYTES = 6  # the material of a cell and its factor, where cells differ
OPERATIONS = {"rotational": 577, "least-squares": 199}
PREPARATION = 31  # operations for the constants of a cell, where cells differ


def read(path):
    """Rates by benchmark name: million node-steps/s, GB/s, GFLOP/s."""
    rates = {}
    for run in json.load(open(path, encoding="utf-8"))["benchmarks"]:
        name = run["name"].split("/iterations")[0]
        for counter in ("Mnode-steps/s", "GB/s", "GFLOP/s"):
            if counter in run:
                rates[name] = max(rates.get(name, 0), run[counter])
    return rates


def limit(name, rates):
    """Million node-steps/s that memory and arithmetic of the machine would allow."""
    kinematics = "rotational" if "rotational" in name else "least-squares"
    mixed = "mixed" in name
    count = BYTES[kinematics] + (CELL_BYTES if mixed else 0)
    operations = OPERATIONS[kinematics] + (PREPARATION if mixed else 0)
    return min(1e3 * rates["triad"] / count, 1e3 * rates["fused_multiply_add"] / operations)


def main(paths):
    files = [read(path) for path in paths]
    one = files[0]
    for name, unit in (("triad", "GB/s"), ("fused_multiply_add", "GFLOP/s")):
        print(f"{name.replace('_', ' ')}: " + ", ".join(f"{rates[name]:.1f} {unit}" for rates in files))
    columns = ["step", "nodes", "million node-steps/s", "of its limit"] + (["two ranks", "speed-up"] if files[1:] else [])
    print("\n| " + " | ".join(columns) + " |\n|" + "---|" * len(columns))
    for name, rate in one.items():
        if not name.startswith("explicit_step/"):
            continue
        _, what, nodes = name.split("/")
        row = [what, f"{nodes}³", f"{rate:.1f}", f"{100 * rate / limit(what, one):.0f} %"]
        if files[1:]:
            two = files[1].get(name)
            row += [f"{two:.1f}", f"{two / rate:.2f}"] if two else ["", ""]
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    main(sys.argv[1:])
