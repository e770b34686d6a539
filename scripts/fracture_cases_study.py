#!/usr/bin/python3
"""Cracks oblique to the lattice, wing cracks, a double cantilever beam and a compact tension specimen, event by event: writes the tables of
docs/validation/fracture.md.

    scripts/fracture_cases_study.py [--koshi build/release/koshi]

Takes some ten minutes on one core.
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


def direction(koshi, angle, d, toughness):
    """A disc of 100 mm with a slot of 30 mm at an angle, pulled across the slot: by how much the crack turns off it [degrees], its
    length [mm] and its energy over G_f, from 10 to 40 mm behind the slot; the cells cracked through."""
    size, slot = 100, 30
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    half = size // 2
    n = 2 * math.ceil(size / d / 2) + 3
    x, y = np.meshgrid((np.arange(n) - n // 2) * d, (np.arange(n) - n // 2) * d)
    # A slot one to two cells wide, off the middle if oblique: else its two corners are alike.
    along, across = x * c + y * s, y * c - x * s - (0.3 * d if angle else 0)
    cells = np.where(x**2 + y**2 < half**2, np.where(abs(across) < 0.2 * size, 2, 1), 0)
    cells[(abs(across) < 0.75 * d) & (along < slot - half)] = 0
    conditions = pulled((-s, c), (n * d, n * d), 0.75 * half, ', stop_when = { probe = "pull", below = 0.3 }')
    results = run(koshi, cells, d, conditions, strength=8, toughness=toughness)
    event, *place = np.array(sorted(results.cracked))[:, :3].T
    x, y = (1e3 * np.array(axis) - n * d / 2 for axis in place)
    path, off = x * c + y * s, y * c - x * s
    tip = np.maximum.accumulate(path) + half - slot
    # What all cells took while the tip went on.
    first, last = (int(event[np.argmax(tip > reach)]) for reach in (10, 40))
    taken = results.history("cracks")
    energy = (taken[last] - taken[first]) / (1e-6 * toughness * d * (tip[event <= last].max() - tip[event <= first].max()))
    return math.degrees(math.atan(np.polyfit(path, off, 1)[0])), tip.max(), energy, len(event)


def directions(koshi):
    yield "| slot to x | crack to the slot | length | energy / (G_f area) |"
    yield "|---|---|---|---|"
    for angle in (0, 10, 22.5, 35, 45):
        turn, length, energy, _ = direction(koshi, angle, 2.5, 20)
        yield f"| {angle:g}° | {turn:+.1f}° | {length:.0f} mm | {energy:.3f} |"


def opened(koshi, cells, d, at):
    """Results of a specimen whose nodes at a place (x, lower y, upper y) [mm] are pulled apart."""
    x, *ys = at
    low, up = (f'box = {{ min = ["{x} mm", "{y} mm", 0], max = ["{x} mm", "{y} mm", "{d} mm"] }}' for y in ys)
    sides = "".join(f'  {{ name = "side {i}", point = [{place}], fix = ["z"] }},\n' for i, place in enumerate(
        [f'"{x} mm", "{ys[0]} mm", 0', f'"{x} mm", "{ys[1]} mm", 0', f'"{cells.shape[1] * d} mm", 0, 0']))
    return run(koshi, cells, d, f"""
boundary = [
  {{ name = "up", {up}, displacement = {{ x = 0, y = "0.1 mm" }} }},
  {{ name = "low", {low}, displacement = {{ y = "-0.1 mm" }} }},
{sides}]
analysis = {{ type = "static", tolerance = 1e-7, events = 2500 }}
probe = [{{ name = "up", {up}, quantity = "reaction" }}]
""", strength=8, toughness=20)


def released(koshi, d, lengths, between, at, specimen):
    """Of a specimen(length of the slit [mm], whether it cracks): what a crack released over G_f, by the compliance of whole
    bodies with longer slits and by the energy it took, while its length lay between two [mm]; and the number of events."""
    opening = 2e-4
    measured = [opening / opened(koshi, specimen(length, False), d, at).probe("up.reaction.y") for length in lengths]
    fit = np.polyfit(1e-3 * lengths, np.cbrt(measured), 3)
    a = 1e-3 * np.linspace(lengths[0], lengths[-1], 2000)
    compliance = np.polyval(fit, a) ** 3
    results = opened(koshi, specimen(lengths[0], True), d, at)
    force = np.array(results.history("up.reaction.y"))[1:]
    length = np.interp(opening * np.array(results.history("load factor"))[1:] / force, compliance, a)
    rate = force**2 / (2e-3 * d) * np.interp(length, a, np.gradient(compliance, a))
    there = np.flatnonzero((length > 1e-3 * between[0]) & (length < 1e-3 * between[1]))
    first, last = there[0], there[-1]
    taken = np.array(results.history("cracks"))[1:]
    energy = (taken[last] - taken[first]) / (length[last] - length[first]) / (1e-3 * d)
    return f"| {d} mm | {rate[there].mean() / 20:.3f} | {energy / 20:.3f} | {len(force)} |"


def cantilevers(koshi):
    """160 mm long with arms of 15 mm; only the middle row of cells can crack."""
    yield "| spacing | P² dC/da / (2b G_f), mean | energy over length / G_f | events |"
    yield "|---|---|---|---|"
    for d in (5, 2.5):
        arm = round(15 / d)

        def specimen(length, cracks):
            cells = np.ones((2 * arm + 1, round(160 / d)), int)
            cells[arm] = 2 if cracks else 1
            cells[arm, : round(length / d)] = 0
            return cells

        yield released(koshi, d, np.arange(50, 111, 10), (65, 95), (0, 0, (2 * arm + 1) * d), specimen)


def compact(koshi):
    """W = 80 mm behind the pins, 20 mm before them, 96 mm high; cells within 10 mm of the middle can crack."""
    yield "| spacing | P² dC/da / (2b G_f), mean | energy over length / G_f | events |"
    yield "|---|---|---|---|"
    for d in (4, 2):
        half = round(48 / d)
        y = (np.arange(2 * half + 1) - half) * d

        def specimen(length, cracks):
            cells = np.ones((2 * half + 1, round(100 / d)), int)
            x = (np.arange(cells.shape[1]) + 0.5) * d - 20
            if cracks:
                cells[(abs(y) < 10)[:, None] & (x > 20)] = 2
            cells[half, x < length] = 0
            return cells

        middle = (half + 0.5) * d
        yield released(koshi, d, np.arange(40, 69, 4), (46, 60), (20, middle - 24 - d / 2, middle + 24 + d / 2), specimen)


def wings(koshi):
    """A closed flaw of 40 mm that slides, at 45 degrees in a plate of 100 mm that is pressed; whether wings begin at 70 degrees to it."""
    yield "| wing | first 5 mm | first 8 mm | end |"
    yield "|---|---|---|---|"
    d, n, length, gone = 1, 101, 40, 10
    cells = np.full((n, n), 2)
    cells[:gone] = cells[-gone:] = 1
    middle, side = n * d / 2, math.sqrt(0.5)
    results = run(koshi, cells, d, f"""
crack = [{{ center = ["{middle} mm", "{middle} mm", "{d / 2} mm"], normal = [-1, 1, 0], shape = "rectangle", along = [1, 1, 0], length = "{length} mm", width = "{4 * d} mm" }}]
boundary = [
  {{ name = "bed", face = "y-min", fix = ["y"] }},
  {{ name = "corner", point = [0, 0, 0], fix = ["x", "z"] }},
  {{ name = "side", point = ["{n * d} mm", 0, 0], fix = ["z"] }},
  {{ name = "top corner", point = [0, "{n * d} mm", 0], fix = ["z"] }},
  {{ name = "press", face = "y-max", displacement = {{ y = "-0.1 mm" }} }},
]
analysis = {{ type = "static", tolerance = 1e-6, events = 1200 }}
""", strength=8, toughness=5)
    place = 1e3 * np.array(results.cracked)[:, 1:3] - middle
    for name, sign in (("upper", 1), ("lower", -1)):
        from_tip = sign * place - side * length / 2
        reach, across = np.hypot(*from_tip.T), (from_tip[:, 1] - from_tip[:, 0]) * side
        # Not the flaw, which is two cells wide.
        wing = (from_tip.sum(axis=1) > -0.5 * length) & ((from_tip.sum(axis=1) > 0) | (abs(across) > d))

        def angle(least, most):
            chosen = from_tip[wing & (reach > least) & (reach < most)]
            slope = np.linalg.svd(chosen - chosen.mean(axis=0))[2][0]
            return (math.degrees(math.atan2(slope[1], slope[0])) - 45) % 180

        yield f"| {name} | {angle(0, 5):.0f}° | {angle(0, 8):.0f}° | {angle(15, 25):.0f}° |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koshi", default=PAGE.parents[2] / "build/release/koshi", type=pathlib.Path)
    koshi = parser.parse_args().koshi.resolve()
    for name, rows in (
        ("bands", bands(koshi)), ("directions", directions(koshi)), ("wings", wings(koshi)), ("cantilevers", cantilevers(koshi)), ("compact", compact(koshi))):
        table = "\n".join(rows)
        text = re.sub(f"(<!-- {name} -->\n).*?(<!-- end -->)", lambda m: f"{m[1]}\n{table}\n\n{m[2]}", PAGE.read_text(), flags=re.S)
        PAGE.write_text(text)


if __name__ == "__main__":
    main()
