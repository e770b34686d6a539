#!/usr/bin/python3
"""Cracks in equilibrium at several spacings: runs bars and a notched beam, and writes the tables of docs/validation/fracture.md.

    scripts/fracture_study.py [--koshi build/release/koshi]

Takes some three minutes on one core.
"""
import argparse
import csv
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/validation/fracture.md"

BAR = """
lattice = {{ spacing = "{d} mm", kinematics = "least-squares" }}
body = {{ size = ["80 mm", "10 mm", "10 mm"], material = "sound" }}
material.sound = {{ youngs_modulus = "30 GPa", poissons_ratio = 0.2, density = 2400 }}
material.weak = {{ youngs_modulus = "30 GPa", poissons_ratio = 0.2, density = 2400, fracture = {{ tensile_strength = "3 MPa", fracture_energy = "100 J/m^2", softening = "{softening}" }} }}
region = [{{ shape = "box", min = [0.04, 0, 0], max = [{end}, 0.01, 0.01], material = "weak" }}]
boundary = [
  {{ name = "wall", face = "x-min", fix = ["x"] }},
  {{ name = "point", point = [0, 0, 0], fix = ["y", "z"] }},
  {{ name = "edge", point = [0, 0.01, 0], fix = ["z"] }},
  {{ name = "pull", face = "x-max", displacement = {{ x = "{pull} mm" }}, ramp = "1 s" }},
]
analysis = {{ type = "static"{steps} }}
probe = [{{ name = "pull", face = "x-max", quantity = "reaction" }}]
"""

# A slice of 10 mm; the middle is a column of cells, whence the odd length.
BEAM = """
lattice = {{ spacing = "{d} mm", kinematics = "least-squares" }}
body = {{ size = [{length}, 0.2, 0.01], material = "concrete" }}
material.concrete = {{ youngs_modulus = "30 GPa", poissons_ratio = 0.2, density = 2400, fracture = {{ tensile_strength = "3.3 MPa", fracture_energy = "137 J/m^2" }} }}
region = [{{ shape = "box", min = [1, 0, 0], max = [{end}, 0.1, 0.01], material = "void" }}]
boundary = [
  {{ name = "left", box = {{ min = [0, 0, 0], max = [0, 0, 0.01] }}, fix = ["x", "y"] }},
  {{ name = "right", box = {{ min = [{length}, 0, 0], max = [{length}, 0, 0.01] }}, fix = ["y"] }},
  {{ name = "side", point = [0, 0, 0], fix = ["z"] }},
  {{ name = "other side", point = [{length}, 0, 0], fix = ["z"] }},
  {{ name = "load", box = {{ min = [1, 0.2, 0], max = [{end}, 0.2, 0.01] }}, displacement = {{ y = "-1 mm" }}, ramp = "1 s" }},
]
analysis = {{ type = "static", tolerance = 1e-6, {way} }}
probe = [{{ name = "load", box = {{ min = [1, 0.2, 0], max = [{end}, 0.2, 0.01] }}, quantity = "reaction" }}]
"""


def history(koshi, case):
    """Rows of a run's history, by the names of the columns without units."""
    with tempfile.TemporaryDirectory() as directory:
        (pathlib.Path(directory) / "case.toml").write_text(case)
        subprocess.run([koshi, "run", "case.toml", "--out", "out", "--quiet"], cwd=directory, check=True)
        with open(pathlib.Path(directory) / "out/history.csv", newline="") as file:
            head, *rows = csv.reader(file)
    names = [name.rsplit(" [", 1)[0] for name in head]
    return [dict(zip(names, map(float, row))) for row in rows]


def bars(koshi):
    yield "| softening | spacing | largest stress / f_t | energy / (G_f area) | events | stress | energy | steps |"
    yield "|---|---|---|---|---|---|---|---|"
    for softening, pull, steps in (("linear", 0.1, 125), ("exponential", 0.6, 750)):
        for d in (10, 5, 2.5):
            figures = []
            for way in ("", f", steps = {steps}"):
                rows = history(koshi, BAR.format(d=d, softening=softening, end=0.04 + d / 1000, pull=pull, steps=way))
                figures.append(max(row["pull.reaction.x"] for row in rows) / 300)
                figures.append(rows[-1]["cracks"] / 0.01)
                if not way:
                    events = len(rows) - 1
            peak, energy, step_peak, step_energy = (f"{figure:.4f}" for figure in figures)
            yield f"| {softening} | {d:g} mm | {peak} | {energy} | {events} | {step_peak} | {step_energy} | {steps} |"


def beams(koshi):
    yield "| spacing | way | largest force on 50 mm | deflection there |"
    yield "|---|---|---|---|"
    for d, words, way in (
        (10, "120 events", "events = 120"),
        (5, "260 events", "events = 260"),
        (10, "100 steps", "steps = 100, stop_when = { probe = \"load\", below = 0.9 }"),
    ):
        rows = history(koshi, BEAM.format(d=d, length=2 + d / 1000, end=1 + d / 1000, way=way))
        most = min(rows, key=lambda row: row["load.reaction.y"])
        # The motion of 1 mm is over after a second.
        deflection = most.get("load factor", most.get("time"))
        yield f"| {d} mm | {words} | {-5 * most['load.reaction.y']:.0f} N | {deflection:.3f} mm |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koshi", default=ROOT / "build/release/koshi", type=pathlib.Path)
    koshi = parser.parse_args().koshi.resolve()
    page = PAGE.read_text()
    for name, rows in (("bars", bars(koshi)), ("beams", beams(koshi))):
        table = "\n".join(rows)
        page = re.sub(f"(<!-- {name} -->\n).*?(<!-- end -->)", lambda m: f"{m[1]}\n{table}\n\n{m[2]}", page, flags=re.S)
    PAGE.write_text(page)


if __name__ == "__main__":
    main()
