#!/usr/bin/python3
"""Curved surfaces as stairs and as cut cells: writes docs/validation/curved.{md,csv}.

    scripts/curved_study.py [--koshi build/release/koshi] [--out docs/validation] [--cells 5 10 20]

Bodies under inner pressure p, inner radius a, outer radius b = 2 a, n cells across the wall, nu = 0.3:
  tube     along z between smooth walls, plane strain (Timoshenko & Goodier, Theory of Elasticity, section 28)
  tilted   the same tube about an axis along (1, 2, 3), its ends free: sigma_z = 0
  sphere   hollow (section 136)
The middle of each body lies at no node. Errors: the work of the pressure (twice the elastic energy); the radial
displacement and the hoop stress, relative to the peak at the inner wall, of nodes at least two cells of the coarsest row
inside.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

E, NU, A, B = 1e9, 0.3, 1.0, 2.0
P = 1e6
CENTER = (0.0313, 0.0171, -0.0123)
MARGIN = 0.399  # probed nodes are farther from the surfaces: two cells of 1/5, so that all rows see the same places


def tube_exact(r, plane_strain):
    """Radial displacement and hoop stress of a tube."""
    k = P * A * A / (B * B - A * A)
    if plane_strain:
        u = (1 + NU) / E * k * ((1 - 2 * NU) * r + B * B / r)
    else:
        u = k / E * ((1 - NU) * r + (1 + NU) * B * B / r)
    return u, k * (1 + B * B / r**2)


def sphere_exact(r):
    k = P * A**3 / (B**3 - A**3)
    return k / E * ((1 - 2 * NU) * r + (1 + NU) * B**3 / (2 * r * r)), k * (1 + B**3 / (2 * r**3))


class Body:
    """One of the three bodies with n cells across the wall."""

    def __init__(self, kind, n):
        self.kind, self.n, self.d = kind, n, (B - A) / n
        tilted = (1 / math.sqrt(14), 2 / math.sqrt(14), 3 / math.sqrt(14))
        self.axis = (0.0, 0.0, 1.0) if kind == "tube" else tilted
        reach = math.ceil((B + 0.05) / self.d) * self.d
        self.thick = 2 * self.d if kind == "tube" else 1.0
        if kind == "tilted":
            # Half the length along each axis, and what the radius adds.
            longest = max(0.5 * self.thick * abs(c) + B * math.sqrt(1 - c * c) for c in self.axis)
            reach = math.ceil((longest + 0.05) / self.d) * self.d
        self.low = [-reach] * 3
        self.size = [2 * reach] * 3
        if kind == "tube":
            self.low[2], self.size[2] = 0.0, self.thick

    def regions(self):
        def shape(name, radius, material):
            if self.kind == "sphere":
                form = f'shape = "sphere"\ncenter = {list(CENTER)}'
            elif self.kind == "tube":
                form = f'shape = "cylinder"\nstart = {[CENTER[0], CENTER[1], 0.0]}\nend = {[CENTER[0], CENTER[1], self.thick]}'
            else:
                half = 0.5 * self.thick
                start = [c - half * e for c, e in zip(CENTER, self.axis)]
                end = [c + half * e for c, e in zip(CENTER, self.axis)]
                form = f'shape = "cylinder"\nstart = {start}\nend = {end}'
            return f'[[region]]\nname = "{name}"\n{form}\nradius = {radius!r}\nmaterial = "{material}"\n'
        return shape("hull", B, "rock") + shape("bore", A, "void")

    def polar(self, x):
        """Radius and its direction at a place."""
        r = [v - c for v, c in zip(x, CENTER)]
        if self.kind != "sphere":
            along = sum(a * b for a, b in zip(r, self.axis))
            r = [a - along * b for a, b in zip(r, self.axis)]
        length = math.sqrt(sum(a * a for a in r))
        return length, [a / length for a in r]

    def exact(self, r):
        return sphere_exact(r) if self.kind == "sphere" else tube_exact(r, self.kind == "tube")

    def shortening(self, x):
        """Displacement along the axis: a free tube has sigma_r + sigma_t = 2 k there."""
        if self.kind != "tilted":
            return 0
        return -2 * NU / E * P * A * A / (B * B - A * A) * sum((v - c) * e for v, c, e in zip(x, CENTER, self.axis))

    def work(self):
        area = 4 * math.pi * A * A if self.kind == "sphere" else 2 * math.pi * A * self.thick
        return P * area * self.exact(A)[0]

    def nodes(self):
        """About 200 nodes inside the wall, spread over all directions."""
        found = []
        counts = [round(s / self.d) + 1 for s in self.size]
        for k in range(counts[2]):
            for j in range(counts[1]):
                for i in range(counts[0]):
                    x = [l + self.d * c for l, c in zip(self.low, (i, j, k))]
                    r = self.polar(x)[0]
                    if not A + MARGIN < r < B - MARGIN:
                        continue
                    if self.kind == "tilted":
                        along = sum((v - c) * e for v, c, e in zip(x, CENTER, self.axis))
                        if abs(along) > 0.5 * self.thick - MARGIN:
                            continue
                    found.append(x)
        step = max(1, len(found) // 200)
        return found[::step]

    def case(self, surface, probed):
        probes = "".join(
            f'[[probe]]\nname = "{q[0]}{i}"\npoint = {x}\nquantity = "{q}"\n'
            for i, x in enumerate(probed) for q in ("displacement", "stress"))
        walls = ""
        if self.kind == "tube":
            walls = "".join(f'[[boundary]]\nface = "{f}"\nfix = ["z", "rx", "ry"]\n' for f in ("z-min", "z-max"))
        return f"""
[lattice]
spacing = {self.d!r}
[material.rock]
youngs_modulus = {E}
poissons_ratio = {NU}
density = 1000
[body]
origin = {self.low}
size = {self.size}
material = "void"
surface = "{surface}"
{self.regions()}
{walls}
[[load]]
surface = "bore"
pressure = {P}
[analysis]
type = "static"
tolerance = 1e-8
[output]
fields = []
{probes}"""


def rigid_free(body, probed, moved):
    """Radial displacements without the mean shift and turn of the body, which a free body may have."""
    rows = [body.polar(x)[1] for x in probed]
    exact = [body.exact(body.polar(x)[0])[0] for x in probed]
    left = [[u - e * c - body.shortening(x) * a for u, c, a in zip(m, row, body.axis)]
            for x, m, e, row in zip(probed, moved, exact, rows)]
    middle = [sum(x[a] for x in probed) / len(probed) for a in range(3)]
    arms = [[v - m for v, m in zip(x, middle)] for x in probed]
    shift = [sum(v[a] for v in left) / len(left) for a in range(3)]
    cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    # By least squares: the turn w with sum r x (w x r) = sum r x u.
    inertia = [[sum((sum(c * c for c in r) if a == b else 0) - r[a] * r[b] for r in arms) for b in range(3)] for a in range(3)]
    moment = [sum(m[a] for m in map(cross, arms, left)) for a in range(3)]
    columns = list(zip(*inertia))
    det = sum(a * b for a, b in zip(columns[0], cross(columns[1], columns[2])))
    turn = [sum(a * b for a, b in zip(moment, cross(columns[(c + 1) % 3], columns[(c + 2) % 3]))) / det for c in range(3)]
    turned = [cross(turn, r) for r in arms]
    return [sum((u - s - t) * c for u, s, t, c in zip(m, shift, w, row)) for m, w, row in zip(moved, turned, rows)], exact


def measure(koshi, body, surface):
    probed = body.nodes()
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder) / "case.toml"
        case.write_text(body.case(surface, probed))
        subprocess.run([koshi, "run", case, "--out", pathlib.Path(folder) / "out"], check=True, capture_output=True)
        summary = json.loads((pathlib.Path(folder) / "out" / "summary.json").read_text())
    values = summary["probes"]
    moved = [values[f"d{i}"]["displacement"] for i in range(len(probed))]
    radial, exact = rigid_free(body, probed, moved)
    u_errors = [r / e - 1 for r, e in zip(radial, exact)]
    peak = body.exact(A)[1]
    s_errors = []
    for i, x in enumerate(probed):
        r, e = body.polar(x)
        xx, yy, zz, yz, xz, xy = values[f"s{i}"]["stress"]
        # The stress across a direction of the circumference: of the sphere the mean of all, by the trace.
        along = xx * e[0]**2 + yy * e[1]**2 + zz * e[2]**2 + 2 * (yz * e[1] * e[2] + xz * e[0] * e[2] + xy * e[0] * e[1])
        if body.kind == "sphere":
            hoop = 0.5 * (xx + yy + zz - along)
        else:
            a = body.axis
            h = [a[1] * e[2] - a[2] * e[1], a[2] * e[0] - a[0] * e[2], a[0] * e[1] - a[1] * e[0]]
            hoop = xx * h[0]**2 + yy * h[1]**2 + zz * h[2]**2 + 2 * (yz * h[1] * h[2] + xz * h[0] * h[2] + xy * h[0] * h[1])
        s_errors.append((hoop - body.exact(r)[1]) / peak)
    mean = lambda v: sum(abs(x) for x in v) / len(v)
    worst = lambda v: max(abs(x) for x in v)
    work = 2 * summary["energy"]["elastic"] / body.work() - 1
    return [100 * v for v in (work, mean(u_errors), worst(u_errors), mean(s_errors), worst(s_errors))]


def order(rows):
    """Of convergence between the coarsest and the finest."""
    (n0, e0), (n1, e1) = rows[0], rows[-1]
    return math.log(abs(e0) / abs(e1)) / math.log(n1 / n0) if n1 > n0 and e1 != 0 else float("nan")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koshi", default="build/release/koshi")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("docs/validation"))
    parser.add_argument("--cells", type=int, nargs="+", default=[5, 10, 20])
    options = parser.parse_args()
    names = ["work", "displacement mean", "displacement worst", "stress mean", "stress worst"]
    table = []
    for kind in ("tube", "tilted", "sphere"):
        for surface in ("stairs", "cut"):
            for n in options.cells:
                table.append([kind, surface, n] + measure(options.koshi, Body(kind, n), surface))
                print(*table[-1], file=sys.stderr, flush=True)
    with open(options.out / "curved.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["body", "surface", "n"] + [f"{name} error [%]" for name in names])
        writer.writerows([*row[:3], *(f"{v:.4g}" for v in row[3:])] for row in table)
    lines = ["| body | surface | n | " + " | ".join(names) + " |", "|---" * 8 + "|"]
    for row in table:
        lines.append(f"| {row[0]} | {row[1]} | {row[2]} | " + " | ".join(f"{v:.2g}" for v in row[3:]) + " |")
        if row[2] == options.cells[-1]:
            same = [r for r in table if r[:2] == row[:2]]
            orders = [order([(r[2], r[c]) for r in same]) for c in range(3, 8)]
            lines.append(f"| {row[0]} | {row[1]} | order | " + " | ".join(f"{v:.1f}" for v in orders) + " |")
    page = options.out / "curved.md"
    text = page.read_text() if page.exists() else "# Curved surfaces\n\n<!-- table -->\n<!-- end -->\n"
    start, end = "<!-- table -->\n", "<!-- end -->"
    page.write_text(text[:text.index(start) + len(start)] + "\n" + "\n".join(lines) + "\n\n" + text[text.index(end):])


if __name__ == "__main__":
    main()
