#!/usr/bin/python3
"""Paths of curved cracks: the double-edge-notched specimen of Nooru-Mohamed under shear and tension, and the L-shaped panel. Writes their
tables into docs/validation/fracture.md and the picture docs/images/shear_and_tension.png.

    scripts/fracture_paths_study.py [--koshi build/release/koshi]

Takes some ten minutes on one core.
"""
import argparse
import math
import pathlib
import re
import subprocess
import tempfile

import numpy as np

from gallery import EXAMPLES, ROOT, Results
from gallery_drawing import BLUE, RED, drawn, figure

PAGE, PICTURE = ROOT / "docs/validation/fracture.md", ROOT / "docs/images/shear_and_tension.png"

# One layer of cells of 50 mm; the frames are stiff and glued to the specimen. Shear grows up to 0.3 s, tension from then on.
SPECIMEN = """
lattice = {{ spacing = "{d} mm", kinematics = "least-squares" }}
body = {{ image = "cells.npy", materials = {{ 0 = "void", 1 = "sound", 2 = "concrete", 3 = "upper frame", 4 = "lower frame" }} }}
[material]
concrete = {{ youngs_modulus = "29 GPa", poissons_ratio = 0.2, density = 2400, fracture = {{ tensile_strength = "3 MPa", fracture_energy = "110 J/m^2" }} }}
sound = {{ youngs_modulus = "29 GPa", poissons_ratio = 0.2, density = 2400 }}
"upper frame" = {{ youngs_modulus = "2900 GPa", poissons_ratio = 0.2, density = 2400 }}
"lower frame" = {{ youngs_modulus = "2900 GPa", poissons_ratio = 0.2, density = 2400 }}
[analysis]
type = "static"
tolerance = 1e-6
steps = 200
[output]
crack_surface = true
[[boundary]]
name = "bed"
face = "y-min"
fix = ["x", "y", "z"]
[[boundary]]
name = "pull"
face = "y-max"
displacement = {{ y = "0.1 mm" }}
history = [[0, 0], [0.3, 0], [1, 1]]
[[load]]
name = "push"
face = "y-max"
force = ["{push} N", 0, 0]
history = [[0, 0], [0.3, 1], [1, 1]]
[[probe]]
name = "pull"
face = "y-max"
quantity = "reaction"
"""
SIZE, DEPTH, THICKNESS = 200, 25, 50  # of the specimen, its notches, across [mm]


def specimen(d):
    """Cells (ny, nx) of the specimen and its two L-shaped frames, 5 mm thick: one above and at the left of the upper half, the
    other below and at the right of the lower one. What is glued to a frame does not crack."""
    frame = round(5 / d)
    at = (np.arange(round(SIZE / d) + 2 * frame) - frame + 0.5) * d
    x, y = np.meshgrid(at, at)
    inside = (x > 0) & (x < SIZE) & (y > 0) & (y < SIZE)
    cells = np.where(inside, np.where((abs(y - 100) > 70) | (abs(x - 100) > 92), 1, 2), 0)
    cells[inside & (abs(y - 100) < 2.51) & (abs(x - 100) > 100 - DEPTH)] = 0
    cells[((y > SIZE) & (x < SIZE)) | ((x < 0) & (y > 102.5))] = 3
    cells[((y < 0) & (x > 0)) | ((x > SIZE) & (y < 97.5))] = 4
    return cells, frame * d


def pulled(koshi, d, shear):
    """The largest tension [kN] under a shear [kN] that is held, and the places of the cells cracked through [mm]."""
    cells, frame = specimen(d)
    with tempfile.TemporaryDirectory() as directory:
        folder = pathlib.Path(directory)
        np.save(folder / "cells.npy", cells[None].astype(np.uint8))
        (folder / "case.toml").write_text(SPECIMEN.format(d=d, push=1e3 * shear * d / THICKNESS))
        subprocess.run([koshi, "run", "case.toml", "--out", "out", "--quiet"], cwd=folder, check=True)
        results = Results(folder / "out")
        places = 1e3 * np.array(results.crack())[:, 1:3] - frame
    return 1e-3 * THICKNESS / d * max(results.history("pull.reaction.y")), places


def from_notches(places, d):
    """Of the cracks from the right and the left notch, as if both were the right one: the way from the notch's end towards the other
    side, and the height over the middle of the notches [mm]. Only what hangs together with the notch counts."""
    for side in (places, SIZE - places):
        way, height = SIZE - DEPTH - side[:, 0], side[:, 1] - SIZE / 2
        there = (np.hypot(way, height) < 10) & (height > -3)
        for _ in way:
            near = np.hypot(way[:, None] - way[there], height[:, None] - height[there]).min(axis=1) < 2.3 * d
            grown = there | (near & (height > -3))
            if (grown == there).all():
                break
            there = grown
        yield way[there], height[there]


def height_at(way, height, x, d):
    there = abs(way - x) <= 0.5 * d + 0.1
    return f"{height[there].mean():.0f}" if there.any() else "–"


def specimens(koshi):
    ways = (25, 50, 75, 100, 125, 150)
    yield "| spacing | shear | largest tension | crack from | height at " + " | ".join(f"{way} mm" for way in ways) + " | largest height | there |"
    yield "|" + "---|" * (len(ways) + 6)
    fig, axes = figure(2)
    drawings = dict(zip((5, 10), axes))
    for d, shear in ((2.5, 5), (2.5, 10), (1.25, 10)):
        force, places = pulled(koshi, d, shear)
        for name, (way, height) in zip(("the right", "the left"), from_notches(places, d)):
            top = height.argmax()
            heights = " | ".join(height_at(way, height, x, d) for x in ways)
            yield f"| {d} mm | {shear} kN | {force:.1f} kN | {name} | {heights} | {height[top]:.0f} mm | {way[top]:.0f} mm |"
        if d == 2.5:
            draw(drawings[shear], places, d, shear)
    drawn(fig).quantize(32).save(PICTURE, optimize=True)


def draw(ax, places, d, shear):
    cells, frame = specimen(d)
    edges = (np.arange(cells.shape[0] + 1)) * d - frame
    colours = np.array([1.0, 0.88, 0.88, 0.6, 0.6])[cells]
    ax.grid(visible=False)
    ax.pcolormesh(edges, edges, colours, cmap="gray", vmin=0, vmax=1)
    above = places[:, 1] > SIZE / 2
    for which, colour in ((above, BLUE), (~above, RED)):
        ax.plot(*places[which].T, "s", color=colour, markersize=3)
    ax.set(aspect="equal", xlabel="x [mm]", ylabel="y [mm]", title=f"shear of {shear} kN, then tension")


def panels(koshi):
    ways = (20, 50, 100, 150, 200)
    yield "| spacing | leaves the corner at | height at " + " | ".join(f"{way} mm" for way in ways) + " |"
    yield "|" + "---|" * (len(ways) + 2)
    for d, events in ((10, 400), (5, 1500)):
        with tempfile.TemporaryDirectory() as directory:
            subprocess.run(
                [koshi, "run", EXAMPLES / "12_l_panel/case.toml", "--out", directory + "/out", "--quiet", "--set", f'lattice.spacing="{d} mm"',
                 "--set", f'body.size=["500 mm", "500 mm", "{d} mm"]', "--set", f"analysis.events={events}", "--set",
                 "output.crack_surface=true"], check=True)  # fmt: skip
            places = 1e3 * np.array(Results(pathlib.Path(directory) / "out").crack())[:, 1:3]
        way, height = 250 - places[:, 0], places[:, 1] - 250
        first = (way > 0) & (way < 50)
        angle = math.degrees(math.atan2((way[first] * height[first]).sum(), (way[first] ** 2).sum()))
        yield f"| {d} mm | {angle:.0f}° | " + " | ".join(height_at(way, height, x, d) for x in ways) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koshi", default=ROOT / "build/release/koshi", type=pathlib.Path)
    koshi = parser.parse_args().koshi.resolve()
    for name, rows in (("specimens", specimens(koshi)), ("panels", panels(koshi))):
        table = "\n".join(rows)
        text = re.sub(f"(<!-- {name} -->\n).*?(<!-- end -->)", lambda m: f"{m[1]}\n{table}\n\n{m[2]}", PAGE.read_text(), flags=re.S)
        PAGE.write_text(text)
        print(table)


if __name__ == "__main__":
    main()
