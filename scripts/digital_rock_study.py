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

from sphere_array_series import array_stiffness

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/validation/digital-rock.md"
K, G = 37e9, 44e9  # quartz [Pa]
FINER = 8  # voxels along the edge of a cell where it is partly filled: of cylinders
BALLS_FINER = 4  # of balls

SUMMARY = """## What it says

At 64 cells a period, filled by volume, the lattice meets the series of cylindrical holes and spherical voids to 0.1 %, those of cylinders and balls ten times as stiff as the
matrix to 0.7 % and 0.4 %, and, with equal shear moduli, the bulk modulus of Hill to 0.1 % for the array and 0.3 % for the pack. Cells that are in or out scatter by some per cent, since their stairs
have another area and volume; stiff arrays have up to 1.5 % at 64 cells there. What remains by volume falls in proportion to the spacing. The necks between the grains of the pack are a few cells wide at 64 cells: its
moduli still fall as cells shrink, and `--coarser` says by how much.

"""

HEAD = """# Effective stiffness of rocks and composites

Written by `scripts/digital_rock_study.py`, with the default springs and a tolerance of 1e-8. Exact answers (layers, one material, Hill's equal shear moduli, mirror
images, the order of the boundary types) are tests: [theory, chapter 14](../theory/14_effective_stiffness.md#what-is-exact). "By centres": a cell is
in or out; "by volume": from an image of {0} x {0} x {0} voxels a cell (balls {1} x {1} x {1}), with `body.scan.coarsen`: voids by the factor on the stiffness, two solids by
their [mixture](../theory/14_effective_stiffness.md#two-solids-in-a-cell).

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
           "[below](#a-pack-of-overlapping-spheres) with its pores filled, of four times the bulk modulus of the matrix, 37 GPa; the share of the balls is that of their cells or voxels.")
    yield ""
    yield "| geometry | n | share of the balls | K [GPa] | Hill | by centres: error | largest of a shear modulus | share by volume | K [GPa] | Hill | by volume: error | largest of a shear modulus |"
    yield "|---" * 12 + "|"
    shapes = [("simple cubic", n, balls(n, 0.2), balls(BALLS_FINER * n, 0.2)) for n in (16, 32, 64)] + [("pack", n, ~pack(n), ~pack(BALLS_FINER * n)) for n in (32, 64)]
    for name, n, plain, finer in shapes:
        row = f"| {name} | {n} |"
        for matrix, edge in ((plain, 1), (finer, BALLS_FINER)):
            C, share = np.array(study(matrix, (4 * K, G), edge)["stiffness"]), 1 - matrix.mean()
            right = 1 / ((1 - share) / (K + 4 * G / 3) + share / (4 * K + 4 * G / 3)) - 4 * G / 3
            bulk = C[:3, :3].sum() / 9
            shears = [C[3, 3], C[4, 4], C[5, 5], *((C[i, i] + C[j, j]) / 4 - C[i, j] / 2 for i, j in ((0, 1), (1, 2), (0, 2)))]
            worst = max(abs(shear / G - 1) for shear in shears)
            row += f" {share:.4f} | {bulk / 1e9:.4f} | {right / 1e9:.4f} | {100 * (bulk / right - 1):+.3f} % | {100 * worst:.3f} % |"
        yield row


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
            cut = study(cylinders(FINER * n, fraction, 2 * FINER), stiff, FINER)["stiffness"][3][3] / G
            yield row + f" {cut:.5f} ({100 * (cut / right - 1):+.2f} %) |"


def sphere_table(study):
    yield ""
    yield "## Simple cubic arrays of spheres"
    yield ""
    yield ("In quartz, K = 37 GPa, G = 44 GPa: voids, and balls ten times as stiff. The series of `scripts/sphere_array_series.py` are those of a continuum, in solid harmonics up to degree 16; "
           "what the last two degrees change is beyond the digits shown. Nothing of a lattice is in them. They give back the matrix for balls of the matrix, Hill's bulk modulus for balls of its shear modulus, Eshelby's "
           "moduli for few spheres; and bulk moduli that are close to the bound of Hashin and Shtrikman that no array passes (`tests/house/test_sphere_array_series.py`). The tables of Nunan and Keller (1984), "
           "Iwakuma and Nemat-Nasser (1983) and Sangani and Lu (1987, *J. Mech. Phys. Solids* 35, 1) could not be read for this page.")
    yield ""
    yield "| spheres | volume | $C_{11}$ [GPa] | $C_{12}$ [GPa] | $C_{44}$ [GPa] | K over its bound |"
    yield "|---|---|---|---|---|---|"
    right = {}
    shapes = [(name, fraction, ratio) for name, ratio in (("voids", 0), ("stiff", 10)) for fraction in (0.05, 0.2)]
    for name, fraction, ratio in shapes:
        stiff = (ratio * K, ratio * G) if ratio else None
        values = right[name, fraction] = array_stiffness(fraction, (K, G), stiff)
        # The bound that holds for K is that with the matrix as the medium of comparison.
        shift = 4 * G / 3
        bound = 1 / ((1 - fraction) / (K + shift) + fraction / (ratio * K + shift)) - shift
        yield (f"| {name} | {fraction} |" + "".join(f" {1e-9 * v:.4f} |" for v in values)
               + f" {(values[0] + 2 * values[1]) / 3 / bound:.5f} |")
    yield ""
    yield "Deviations of the lattice from them, at n cells a period:"
    yield ""
    names = ("$C_{11}$", "$C_{12}$", "$C_{44}$")
    yield "| spheres | volume | n |" + "".join(f" {name} by centres |" for name in names) + "".join(f" {name} by volume |" for name in names)
    yield "|---" * 9 + "|"
    for name, fraction, ratio in shapes:
        stiff = (ratio * K, ratio * G) if ratio else None
        for n in (16, 32, 64):
            pair = study(balls(n, fraction), stiff), study(balls(BALLS_FINER * n, fraction), stiff, BALLS_FINER)
            row = f"| {name} | {fraction} | {n} |"
            for C in (result["stiffness"] for result in pair):
                row += "".join(f" {100 * (C[i][j] / v - 1):+.2f} % |" for (i, j), v in zip(((0, 0), (0, 1), (3, 3)), right[name, fraction]))
            yield row


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
        lines = [*cylinder_table(study), *hill_table(study), *sphere_table(study), *pack_table(study)]
    PAGE.write_text(HEAD.format(FINER, BALLS_FINER) + SUMMARY + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
