#!/usr/bin/python3
"""Effective stiffness of arrays of cylinders and spheres and of a sphere pack; writes docs/validation/digital-rock.md.

    scripts/digital_rock_study.py [--koshi build/release/koshi]
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/validation/digital-rock.md"
K, G = 37e9, 44e9  # quartz [Pa]
FINER = 8  # voxels along the edge of a cell where it is partly filled

SUMMARY = """## What it says

Cells that are filled by volume meet the series of cylindrical holes to 0.1 % at 16 to 64 cells a period; cells that are in or out scatter by some per cent, since their stairs have another
area. Where two solids meet in a cell one of them is lost, and stiff cylinders keep an error of 1 to 1.5 % at 64 cells. Where
the shape does not matter, with equal shear moduli, the bulk modulus is that of Hill within 0.2 % for the array and 0.5 % for the pack at 64 cells. The necks between the grains of the pack are a few cells wide at 64 cells: its
moduli still fall as cells shrink, and `--coarser` says by how much.

"""

HEAD = """# Effective stiffness of rocks and composites

Written by `scripts/digital_rock_study.py`, with the default springs and a tolerance of 1e-8. Exact answers (layers, one material, Hill's equal shear moduli, mirror
images, the order of the boundary types) are tests: [theory, chapter 14](../theory/14_effective_stiffness.md#what-is-exact). "By centres": a cell is
in or out; "by volume": from an image of {0} x {0} x {0} voxels a cell, with `body.scan.coarsen = {0}`.

"""


def constants(bulk, shear):
    return 9 * bulk * shear / (3 * bulk + shear), (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))


def material(name, bulk, shear):
    E, nu = constants(bulk, shear)
    return f"[material.{name}]\nyoungs_modulus = {E!r}\npoissons_ratio = {nu!r}\ndensity = 2650\n"


class Study:
    def __init__(self, koshi, folder):
        self.koshi, self.folder, self.count = koshi, folder, 0

    def __call__(self, image, inclusion=None, edge=1, options=(), tolerance=1e-8):
        """stiffness.json of an image [z][y][x]: 1 matrix, 0 void or inclusion (bulk, shear)."""
        self.count += 1
        np.save(self.folder / "image.npy", image.astype(np.uint8))
        zero = "ball" if inclusion else "void"
        case = (f'[lattice]\nspacing = 1.0\n[body]\nimage = "image.npy"\nmaterials = {{ 0 = "{zero}", 1 = "rock" }}\n'
                f'periodic = ["x", "y", "z"]\nscan = {{ coarsen = {edge} }}\n[analysis]\ntolerance = {tolerance}\n' + material("rock", K, G))
        if inclusion:
            case += material("ball", *inclusion)
        (self.folder / "case.toml").write_text(case)
        out = self.folder / str(self.count)
        subprocess.run([self.koshi, "homogenize", self.folder / "case.toml", "--out", out, "--quiet", *options], check=True)
        return json.loads((out / "stiffness.json").read_text())


def grid(n):
    return (np.arange(n) + 0.5) / n - 0.5


def cylinders(n, fraction, thickness):
    x = grid(n)
    inside = x[:, None] ** 2 + x[None, :] ** 2 < fraction / np.pi
    return np.broadcast_to(~inside, (thickness, n, n))


def balls(n, fraction):
    x, radius = grid(n), np.cbrt(3 * fraction / (4 * np.pi))
    return x[:, None, None] ** 2 + x[None, :, None] ** 2 + x[None, None, :] ** 2 >= radius**2


def perrins(f, ratio):
    """Conductivity of a square array of cylinders over that of the matrix, `ratio` that of the cylinders; shear along them is the same
    problem. Perrins, McKenzie and McPhedran 1979, Proc. R. Soc. Lond. A 369, 207."""
    T = (1 + ratio) / (1 - ratio)
    return 1 - 2 * f / (T + f - 0.305827 * f**4 * T / (T**2 - 1.402958 * f**8) - 0.013362 * f**8 / T)


def hill_table(study):
    yield ""
    yield "## Equal shear moduli"
    yield ""
    yield ("Whatever the geometry, $1/(K + \\frac43 G)$ is the mean of those of the phases (Hill 1963, *J. Mech. Phys. Solids* 11) and $G$ is theirs. Balls on a simple cubic array, and the pack "
           "[below](#a-pack-of-overlapping-spheres) with its pores filled, of four times the bulk modulus of the matrix, 37 GPa; the share of the balls is that of their cells.")
    yield ""
    yield "| geometry | n | share of the balls | K [GPa] | Hill | error | largest error of a shear modulus |"
    yield "|---|---|---|---|---|---|---|"
    shapes = [("simple cubic", n, balls(n, 0.2)) for n in (16, 32, 64)] + [("pack", n, ~pack(n)) for n in (32, 64)]
    for name, n, matrix in shapes:
        result = study(matrix, (4 * K, G))
        share = result["phases"]["ball"]
        right = 1 / ((1 - share) / (K + 4 * G / 3) + share / (4 * K + 4 * G / 3)) - 4 * G / 3
        C = np.array(result["stiffness"])
        bulk = C[:3, :3].sum() / 9
        shears = [C[3, 3], C[4, 4], C[5, 5], *((C[i, i] + C[j, j]) / 4 - C[i, j] / 2 for i, j in ((0, 1), (1, 2), (0, 2)))]
        worst = max(abs(shear / G - 1) for shear in shears)
        yield (f"| {name} | {n} | {share:.4f} | {bulk / 1e9:.4f} | {right / 1e9:.4f} | {100 * (bulk / right - 1):+.3f} % | {100 * worst:.3f} % |")


def hashin(f):
    """Upper bounds of K and G with a part f of voids."""
    zeta = G / 6 * (9 * K + 8 * G) / (K + 2 * G)
    bulk, shear = 4 * G / 3, zeta
    return 1 / ((1 - f) / (K + bulk) + f / bulk) - bulk, 1 / ((1 - f) / (G + shear) + f / shear) - shear


def cylinder_table(study):
    yield "## Square array of cylinders, sheared along them"
    yield ""
    yield ("The shear modulus $C_{44}$ over that of the matrix, against the series of Perrins, McKenzie and McPhedran (1979, *Proc. R. Soc. Lond. A* 369, 207) for conduction, the same "
           "equation. $n$ cells a period.")
    yield ""
    yield "| volume of cylinders | their shear modulus over the matrix | series | n | by centres | by volume |"
    yield "|---|---|---|---|---|---|"
    for fraction, ratio in ((0.2, 0), (0.5, 0), (0.2, 10), (0.5, 10)):
        right = perrins(fraction, ratio)
        stiff = (ratio * K, ratio * G) if ratio else None
        for n in (16, 32, 64):
            plain = study(cylinders(n, fraction, 2), stiff)["stiffness"][3][3] / G
            row = f"| {fraction} | {ratio} | {right:.5f} | {n} | {plain:.5f} ({100 * (plain / right - 1):+.2f} %) |"
            if ratio:  # two solids in a cell: the one with fewer voxels is lost
                yield row + " |"
                continue
            cut = study(cylinders(FINER * n, fraction, 2 * FINER), stiff, FINER)["stiffness"][3][3] / G
            yield row + f" {cut:.5f} ({100 * (cut / right - 1):+.2f} %) |"


def ball_table(study):
    yield ""
    yield "## Simple cubic array of spherical voids"
    yield ""
    yield ("Quartz, K = 37 GPa, G = 44 GPa. The numbers of Nunan and Keller (1984) and of Iwakuma and Nemat-Nasser (1983) could not be read for this page, so the "
           "comparison is with the upper bound of Hashin and Shtrikman, which no array exceeds, and to which the bulk modulus of such arrays comes very close "
           "while the voids are far apart. $C_{44}$ and $(C_{11} - C_{12})/2$ are the two shear moduli of the cubic array; their closest isotropic one is below the bound.")
    yield ""
    yield "| volume of voids | n | K over its bound, by centres | by volume | closest isotropic G over its bound, by centres | by volume |"
    yield "|---|---|---|---|---|---|"
    for fraction in (0.05, 0.2):
        bulk, shear = hashin(fraction)
        for n in (16, 32, 64):
            pair = study(balls(n, fraction)), study(balls(4 * n, fraction), None, 4)
            moduli = [result["closest_isotropic"] for result in pair]
            yield (f"| {fraction} | {n} |" + "".join(f" {m['bulk'] / bulk:.5f} |" for m in moduli)
                   + "".join(f" {m['shear'] / shear:.5f} |" for m in moduli))


def stiff_table(study):
    yield ""
    yield "## Simple cubic array of stiff balls"
    yield ""
    yield ("Balls ten times as stiff as quartz, by centres, over the lower bounds of Hashin and Shtrikman for the share of their cells: that of K holds for the array, that of G between its two shear "
           "moduli. The numbers of Nunan and Keller (1984) and of Sangani and Lu (1987, *J. Mech. Phys. Solids* 35, 1) could not be read for this page.")
    yield ""
    yield "| volume of balls | n | K over its bound | $C_{44}$ over the bound of G | $(C_{11} - C_{12})/2$ over it |"
    yield "|---|---|---|---|---|"
    zeta = G / 6 * (9 * K + 8 * G) / (K + 2 * G)
    for fraction in (0.05, 0.2):
        for n in (16, 32, 64):
            result = study(balls(n, fraction), (10 * K, 10 * G))
            f, C = result["phases"]["ball"], result["stiffness"]
            bulk, shear = (1 / ((1 - f) / (x + shift) + f / (10 * x + shift)) - shift for x, shift in ((K, 4 * G / 3), (G, zeta)))
            yield (f"| {fraction} | {n} | {result['closest_isotropic']['bulk'] / bulk:.5f} | {C[3][3] / shear:.5f} "
                   f"| {(C[0][0] - C[0][1]) / 2 / shear:.5f} |")


def pack(n):
    """Balls of one size at random places that overlap, porosity about 0.2: as in examples/30_sandstone, without clay."""
    random = np.random.RandomState(7)
    places, x = random.random_sample((60, 3)), (np.arange(n) + 0.5) / n
    square = np.full((n, n, n), 9.0)
    for place in places:
        z2, y2, x2 = (((x - c + 0.5) % 1 - 0.5) ** 2 for c in place)
        square = np.minimum(square, z2[:, None, None] + y2[None, :, None] + x2[None, None, :])
    return square < 0.19**2


def self_consistent(f):
    """K and G of a mixture whose grains and pores are balls in the mixture itself (Hill 1965; Berryman 1980)."""
    k, g = K, G
    for _ in range(500):
        zeta = g / 6 * (9 * k + 8 * g) / (k + 2 * g)
        k, g = (1 / ((1 - f) / (K + 4 * g / 3) + f / (4 * g / 3)) - 4 * g / 3, 1 / ((1 - f) / (G + zeta) + f / zeta) - zeta)
    return k, g


def pack_table(study):
    yield ""
    yield "## A pack of overlapping spheres"
    yield ""
    yield "Sixty balls of quartz in a periodic box, about a fifth of it pores. The estimate is self-consistent (Hill 1965, Berryman 1980); it knows only the porosity."
    yield ""
    yield "| n | porosity | K [GPa] | G [GPa] | upper bounds of Hashin and Shtrikman | self-consistent estimate | iterations of the six cases |"
    yield "|---|---|---|---|---|---|---|"
    for n in (32, 64):
        result = study(pack(n), tolerance=1e-6)
        f, moduli = result["porosity"], result["closest_isotropic"]
        pairs = [", ".join(f"{1e-9 * v:.2f}" for v in values) for values in (hashin(f), self_consistent(f))]
        yield (f"| {n} | {f:.4f} | {moduli['bulk'] / 1e9:.3f} | {moduli['shear'] / 1e9:.3f} | {pairs[0]} | {pairs[1]} | "
               + " ".join(str(case["iterations"]) for case in result["cases"]) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--koshi", default=ROOT / "build/release/koshi", type=pathlib.Path)
    with tempfile.TemporaryDirectory() as folder:
        study = Study(parser.parse_args().koshi.resolve(), pathlib.Path(folder))
        lines = [*cylinder_table(study), *hill_table(study), *ball_table(study), *stiff_table(study), *pack_table(study)]
    PAGE.write_text(HEAD.format(FINER) + SUMMARY + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
