#!/usr/bin/python3
"""Cracks oblique to the lattice and a double cantilever beam, event by event: writes the tables of docs/validation/fracture.md.

    scripts/fracture_cases_study.py [--koshi build/release/koshi]

Takes some two minutes on one core.
"""
import argparse
import math
import pathlib
import re
import subprocess
import tempfile

import numpy as np

from gallery import Results

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs/validation/fracture.md"

# Bodies come as an image of cells, one layer of them: 0 empty, 1 never cracks, 2 can.
CASE = """
lattice = {{ spacing = "{d} mm", kinematics = "least-squares" }}
body = {{ image = "cells.npy", materials = {{ {materials} }} }}
material.sound = {{ youngs_modulus = "30 GPa", poissons_ratio = 0.2, density = 2400 }}
material.weak = {{ youngs_modulus = "30 GPa", poissons_ratio = 0.2, density = 2400, fracture = {{ tensile_strength = "{strength} MPa", fracture_energy = "{toughness} J/m^2", softening = "linear" }} }}
output = {{ fields = [], crack_surface = {cracks} }}
"""


def run(koshi, cells, d, conditions, strength=3, toughness=100):
    """Results of a body of cells, (ny, nx), of side d [mm]."""
    names = {0: "void", 1: "sound", 2: "weak"}
    materials = ", ".join(f'{value} = "{names[value]}"' for value in np.unique(cells))
    head = CASE.format(d=d, materials=materials, strength=strength, toughness=toughness, cracks=str(bool((cells == 2).any())).lower())
    with tempfile.TemporaryDirectory() as directory:
        folder = pathlib.Path(directory)
        np.save(folder / "cells.npy", cells[None].astype(np.uint8))
        (folder / "case.toml").write_text(head + conditions)
        subprocess.run([koshi, "run", "case.toml", "--out", "out", "--quiet"], cwd=folder, check=True)
        results = Results(folder / "out")
        results.cracked = results.crack() if (folder / "out/cracks.vtp").exists() else []
    return results


def turned(angle, d, length, width):
    """Coordinates [mm] of the centres of an odd number of cells, around the middle: along and across a direction; their box's sides."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    nx, ny = (2 * math.ceil((length * a + width * b) / d / 2) + 3 for a, b in ((c, s), (s, c)))
    x, y = np.meshgrid((np.arange(nx) - nx // 2) * d, (np.arange(ny) - ny // 2) * d)
    return x * c + y * s, y * c - x * s, (c, s), (nx * d, ny * d)


def pulled(direction, sides, reach, way):
    """Conditions: the two ends beyond `reach` [mm] along a direction from the middle are clamped and pulled apart by 0.1 mm."""
    (c, s), (x, y) = direction, (side / 2 for side in sides)
    return f"""
selection = [
  {{ name = "lower", half_space = {{ point = ["{x - c * reach} mm", "{y - s * reach} mm", 0], normal = [{c}, {s}, 0] }} }},
  {{ name = "upper", half_space = {{ point = ["{x + c * reach} mm", "{y + s * reach} mm", 0], normal = [{-c}, {-s}, 0] }} }},
]
boundary = [
  {{ name = "wall", selection = "lower", fix = ["x", "y", "z"] }},
  {{ name = "pull", selection = "upper", displacement = {{ x = "{0.1 * c} mm", y = "{0.1 * s} mm", z = 0 }} }},
]
analysis = {{ type = "static", tolerance = 1e-6, events = 4000{way} }}
probe = [{{ name = "pull", selection = "upper", quantity = "reaction" }}]
"""


def bands(koshi):
    yield "| normal to x | cells cracked through | band's cells | energy / (G_f area) | largest stress / f_t |"
    yield "|---|---|---|---|---|"
    d, length, width = 2.5, 60, 40
    for angle in (0, 22.5, 45):
        along, across, direction, sides = turned(angle, d, length, width)
        band = d * sum(direction)
        # Off the middle, so that no two rows of cells are equally far.
        along += 0.2 * d
        bar = (abs(along) < length / 2) & (abs(across) < width / 2)
        cells = np.where(bar, np.where(abs(along) < band / 2, 2, 1), 0)
        area = 1e-9 * (bar & (abs(along) < length / 4)).sum() * d**3 / (1e-3 * length / 2)
        results = run(koshi, cells, d, pulled(direction, sides, length / 2 - 1.5 * d, ""))
        force = np.hypot(results.history("pull.reaction.x"), results.history("pull.reaction.y")).max()
        energy = results.history("cracks")[-1] / (100 * area)
        expected = 1e6 * area * sum(direction) / d**2
        yield f"| {angle:g}° | {len(results.cracked)} | {expected:.1f} | {energy:.3f} | {force / (3e6 * area):.3f} |"


def directions(koshi):
    yield "| slot to x | crack to the slot | length |"
    yield "|---|---|---|"
    d, size, slot = 2.5, 100, 30
    for angle in (0, 22.5, 45):
        along, across, (c, s), sides = turned(angle, d, size / 2, size / 2)
        half = size // 2
        n = 2 * math.ceil(size / d / 2) + 3
        x, y = np.meshgrid((np.arange(n) - n // 2) * d, (np.arange(n) - n // 2) * d)
        # A slot one to two cells wide, off the middle if oblique: else its two corners are alike.
        along, across = x * c + y * s, y * c - x * s - (0.3 * d if angle else 0)
        cells = np.where(x**2 + y**2 < half**2, np.where(abs(across) < 0.2 * size, 2, 1), 0)
        cells[(abs(across) < 0.75 * d) & (along < slot - half)] = 0
        conditions = pulled((-s, c), (n * d, n * d), 0.75 * half, ', stop_when = { probe = "pull", below = 0.3 }')
        cracked = 1e3 * np.array(run(koshi, cells, d, conditions, strength=8).cracked)[:, 1:3] - n * d / 2
        path, off = cracked @ (c, s), cracked @ (-s, c)
        turn = math.degrees(math.atan(np.polyfit(path, off, 1)[0]))
        yield f"| {angle:g}° | {turn:+.1f}° | {path.max() + half - slot:.0f} mm |"


def cantilever(koshi, d, length, cracks):
    """Results of a double cantilever beam, 160 mm long with arms of 15 mm, whose middle row of cells is gone over a length [mm]."""
    nx, arm = round(160 / d), round(15 / d)
    cells = np.ones((2 * arm + 1, nx), int)
    cells[arm] = 2 if cracks else 1
    cells[arm, : round(length / d)] = 0
    top = (2 * arm + 1) * d
    up, low = (f'box = {{ min = [0, "{y} mm", 0], max = [0, "{y} mm", "{d} mm"] }}' for y in (top, 0))
    return run(koshi, cells, d, f"""
boundary = [
  {{ name = "up", {up}, displacement = {{ x = 0, y = "0.1 mm" }} }},
  {{ name = "low", {low}, displacement = {{ y = "-0.1 mm" }} }},
  {{ name = "side", point = [0, 0, 0], fix = ["z"] }},
  {{ name = "other side", point = [0, "{top} mm", 0], fix = ["z"] }},
  {{ name = "end", point = ["160 mm", 0, 0], fix = ["z"] }},
]
analysis = {{ type = "static", tolerance = 1e-7, events = 2500 }}
probe = [{{ name = "up", {up}, quantity = "reaction" }}]
""", strength=8, toughness=20)


def cantilevers(koshi):
    yield "| spacing | P² dC/da / (2b G_f), mean | energy over length / G_f | events |"
    yield "|---|---|---|---|"
    lengths, opening = np.arange(50, 111, 10), 2e-4
    for d in (5, 2.5):
        # Whole bodies with open slits give the length of a crack from its compliance.
        measured = [opening / cantilever(koshi, d, length, False).probe("up.reaction.y") for length in lengths]
        fit = np.polyfit(1e-3 * lengths, np.cbrt(measured), 3)
        a = np.linspace(0.05, 0.11, 2000)
        compliance = np.polyval(fit, a) ** 3
        results = cantilever(koshi, d, lengths[0], True)
        force = np.array(results.history("up.reaction.y"))[1:]
        length = np.interp(opening * np.array(results.history("load factor"))[1:] / force, compliance, a)
        released = force**2 / (2e-3 * d) * np.interp(length, a, np.gradient(compliance, a))
        there = np.flatnonzero((length > 0.065) & (length < 0.095))
        first, last = there[0], there[-1]
        taken = np.array(results.history("cracks"))[1:]
        energy = (taken[last] - taken[first]) / (length[last] - length[first]) / (1e-3 * d)
        yield f"| {d} mm | {released[there].mean() / 20:.3f} | {energy / 20:.3f} | {len(force)} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koshi", default=PAGE.parents[2] / "build/release/koshi", type=pathlib.Path)
    koshi = parser.parse_args().koshi.resolve()
    for name, rows in (("bands", bands(koshi)), ("directions", directions(koshi)), ("cantilevers", cantilevers(koshi))):
        table = "\n".join(rows)
        text = re.sub(f"(<!-- {name} -->\n).*?(<!-- end -->)", lambda m: f"{m[1]}\n{table}\n\n{m[2]}", PAGE.read_text(), flags=re.S)
        PAGE.write_text(text)


if __name__ == "__main__":
    main()
