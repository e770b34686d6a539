#!/usr/bin/python3
"""Stress at curved surfaces, as stairs and as cut cells: writes docs/validation/curved_stress.csv and its table in curved.md.

    scripts/curved_stress_study.py [--koshi build/release/koshi] [--out docs/validation] [--cells 5 10 20]
    scripts/curved_stress_study.py --kinematics least-squares --surfaces cut --bodies bar askew     a table of its own

Bodies with the tractions of an exact solution on their outer faces (as profiles), nothing held but walls of plane strain:
  plate     hole of radius a = 1 along z in a plate pulled along x, plane strain (Kirsch)
  turned    the same, pulled at 30 degrees from x
  tilted    the same hole along (1, 2, 3) in a cube, pulled at 30 degrees from the lattice in the plane across it
  void      spherical cavity of radius a in a cube pulled along z (Goodier)
  oblique   the same pulled along (1, 2, 3)
  bar       round bar of radius 1 along z, twisted (Coulomb)
  askew     the same bar along (1, 2, 3)
n cells a radius, nu = 0.3. Errors in per cent: work of the tractions; peak at the curved surface, of the hoop stress (3; at a cavity that
along the meridian, 2.045) or the shear stress; that stress at all pieces of the curved surface, of its peak, mean by size and worst. The middles lie at no node.
"""
import argparse
import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

E, NU = 1e9, 0.3
S = 1e6  # the pull, or the shear stress at the bar's surface
CENTER = (0.0313, 0.0171, -0.0123)


def unit(v):
    size = math.sqrt(sum(c * c for c in v))
    return tuple(c / size for c in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def frame(axis, angle):
    """p, q, axis: right-handed; p is turned by an angle from the direction across the axis that lies in the x-y plane."""
    axis = unit(axis)
    first = (1.0, 0.0, 0.0) if abs(axis[2]) == 1 else unit(cross((0, 0, 1), axis))
    second = cross(axis, first)
    p = tuple(math.cos(angle) * a + math.sin(angle) * b for a, b in zip(first, second))
    return p, cross(axis, p), axis


def along(direction):
    """Formula of the coordinate along a direction, from the centre."""
    return "(" + "".join(f"{c:+.12g}*{v}" for c, v in zip(direction, "xyz")) + f"{-dot(direction, CENTER):+.12g})"


class Hole:
    """Kirsch's solution by terms: each a constant stress tensor in the frame times a function of place."""
    def __init__(self, axis, angle, half, thin):
        self.p, self.q, self.axis = self.frame = frame(axis, angle)
        self.half, self.thin, self.surface = half, thin, "hole"

    def terms(self):
        p, q = along(self.p), along(self.q)
        angle, square = f"atan2({q},{p})", f"({p}^2+{q}^2)"
        # Of pp, qq, pq; along the axis nu (pp + qq).
        return [((1, 0, 0), "1"),
                ((-1.5, -0.5, 0), f"cos(2*{angle})/{square}"), ((0, 0, -0.5), f"sin(2*{angle})/{square}"),
                ((-1, 1, 0), f"cos(4*{angle})/{square}"), ((0, 0, -1), f"sin(4*{angle})/{square}"),
                ((1.5, -1.5, 0), f"cos(4*{angle})/{square}^2"), ((0, 0, 1.5), f"sin(4*{angle})/{square}^2")]

    def faces(self, d):
        """Name, outward normal and a point of each loaded face; box of the body."""
        half = math.ceil(self.half / d) * d
        low, size = [-half] * 3, [2 * half] * 3
        if self.thin:
            low[2], size[2] = 0.0, 2 * d
        loaded = []
        for a in range(2 if self.thin else 3):
            for sign in (-1, 1):
                normal = tuple(sign if b == a else 0 for b in range(3))
                loaded.append((f"{'xyz'[a]}{'- +'[sign + 1]}", normal, tuple(0.5 * half * sign if b == a else 0 for b in range(3))))
        return loaded, low, size

    def regions(self, low, size):
        high = [l + s for l, s in zip(low, size)]
        reach = 4 * max(size)
        ends = [[c + s * reach * e for c, e in zip(CENTER, self.axis)] for s in (-1, 1)]
        return (f'[[region]]\nname = "hull"\nshape = "box"\nmin = {low}\nmax = {high}\nmaterial = "rock"\n'
                f'[[region]]\nname = "hole"\nshape = "cylinder"\nstart = {ends[0]}\nend = {ends[1]}\nradius = 1.0\nmaterial = "void"\n')

    def traction(self, term, normal):
        pp, qq, pq = term
        zz = NU * (pp + qq)
        np, nq, nz = (dot(normal, v) for v in self.frame)
        return [S * ((pp * np + pq * nq) * a + (pq * np + qq * nq) * b + zz * nz * c)
                for a, b, c in zip(*self.frame)]

    def stress(self, at):
        """Exact hoop stress at the surface, and its direction."""
        p, q = dot(at, self.p), dot(at, self.q)
        angle = math.atan2(q, p)
        direction = tuple(-math.sin(angle) * a + math.cos(angle) * b for a, b in zip(self.p, self.q))
        return S * (1 - 2 * math.cos(2 * angle)), direction, direction

    def distance(self, at):
        """From the axis."""
        height = dot(at, self.axis)
        return math.sqrt(max(0, dot(at, at) - height * height))

    peak = 3 * S
    work = None


class Void(Hole):
    """Spherical cavity of radius 1 in a cube pulled along an axis (Goodier 1933, J. Appl. Mech. 1, 39): the hydrostatic part
    of the pull and, with its deviator s, the displacements grad G : s and grad grad grad (1/r) : s, G Kelvin's solution."""
    def __init__(self, axis):
        super().__init__(axis, 0.0, 2.0, False)
        self.s = [[self.axis[a] * self.axis[b] - (1 / 3 if a == b else 0) for b in range(3)] for a in range(3)]
        # u = A r^-m s x + B r^-(m+2) (x s x) x, for both; 2 G is 1.
        kinds = [(3, -(2 - 4 * NU), -3.0), (5, 6.0, -15.0)]
        trace = [NU / (1 - 2 * NU) * ((3 - m) * b - m * a) for m, a, b in kinds]
        # No traction at r = 1: parts along s x and along x.
        (v1, v2), (w1, w2) = ([a + b - m * a / 2 for m, a, b in kinds], [t - m * a / 2 - m * b for (m, a, b), t in zip(kinds, trace)])
        share = [-w2 / (v1 * w2 - v2 * w1), w1 / (v1 * w2 - v2 * w1)]
        # Stress: factors of s, of x (s x) + (s x) x, of (x s x) 1 and of (x s x) x x, as pairs of factor and power of 1/r.
        self.powers = [[(c * a, m) for c, (m, a, _) in zip(share, kinds)],
                       [(c * (b - m * a / 2), m + 2) for c, (m, a, b) in zip(share, kinds)],
                       [(c * (b + t), m + 2) for c, (m, _, b), t in zip(share, kinds, trace)],
                       [(-c * (m + 2) * b, m + 4) for c, (m, _, b) in zip(share, kinds)]]

    def terms(self):
        # Formulas have at most 1000 characters, so a component is a sum of several.
        x = [f"({v}{-c:+.9g})" for v, c in zip("xyz", CENTER)]
        r = "((" + "+".join(f"{c}^2" for c in x) + ")^0.5)"
        v = ["(" + "+".join(f"({self.s[a][b]:.12g})*{x[b]}" for b in range(3)) + ")" for a in range(3)]
        q = "(" + "+".join(f"{x[a]}*{v[a]}" for a in range(3)) + ")"
        same, mixed, unit_part, square = ("(" + "+".join(f"({c:.12g})/{r}^{m}" for c, m in part) + ")" for part in self.powers)
        terms = []
        for a in range(3):
            for b in range(a, 3):
                terms += [((a, b), f"({self.s[a][b]:.12g})*(1+{same})"), ((a, b), f"{mixed}*({x[a]}*{v[b]}+{v[a]}*{x[b]})"),
                          ((a, b), f"({square}*{q}-0.5/{r}^5)*{x[a]}*{x[b]}")]
                if a == b:
                    terms.append(((a, b), f"{unit_part}*{q}+(1+0.5/{r}^3)/3"))
        return terms

    def traction(self, term, normal):
        a, b = term
        traction = [0.0, 0.0, 0.0]
        traction[a] = S * normal[b]
        traction[b] = S * normal[a]
        return traction

    def regions(self, low, size):
        high = [l + s for l, s in zip(low, size)]
        return (f'[[region]]\nname = "hull"\nshape = "box"\nmin = {low}\nmax = {high}\nmaterial = "rock"\n'
                f'[[region]]\nname = "hole"\nshape = "sphere"\ncenter = {list(CENTER)}\nradius = 1.0\nmaterial = "void"\n')

    def distance(self, at):
        return math.sqrt(dot(at, at))

    def stress(self, at):
        """Exact stress along the meridian at the surface, and its direction."""
        height, r = dot(at, self.axis), self.distance(at)
        radial = tuple(c / r for c in at)
        direction = unit(tuple(e - height / r * n for e, n in zip(self.axis, radial)))
        # What is left of the tensor at r = 1 along that direction: s x has no part along it but what the axis has.
        at_one = [sum(c for c, _ in part) for part in self.powers]
        cosine = height / r
        along_s, q = 1 - cosine * cosine - 1 / 3, cosine * cosine - 1 / 3
        return S * (along_s * (1 + at_one[0]) + at_one[2] * q + 0.5), direction, direction

    peak = S * (27 - 15 * NU) / (2 * (7 - 5 * NU))


class Bar:
    """Twisted round bar of length 3: shear stress S r across the radius."""
    def __init__(self, axis):
        self.p, self.q, self.axis = self.frame = frame(axis, 0)
        self.length, self.surface = 3.0, "bar"

    def terms(self):
        return [("p", along(self.p)), ("q", along(self.q))]

    def faces(self, d):
        ends = [tuple(c + s * 0.5 * self.length * e for c, e in zip(CENTER, self.axis)) for s in (-1, 1)]
        # An end holds the places within half a cell of its plane.
        loaded = [(name, tuple(s * e for e in self.axis), tuple(c - s * 0.25 * self.length * e for c, e in zip(end, self.axis)))
                  for name, s, end in zip(("foot", "head"), (-1, 1), ends)]
        half = [0.5 * self.length * abs(e) + math.sqrt(1 - e * e) for e in self.axis]
        reach = [math.ceil((h + 0.1) / d) * d for h in half]
        return loaded, [-r for r in reach], [2 * r for r in reach]

    def regions(self, low, size):
        ends = [[c + s * 0.5 * self.length * e for c, e in zip(CENTER, self.axis)] for s in (-1, 1)]
        return f'[[region]]\nname = "bar"\nshape = "cylinder"\nstart = {ends[0]}\nend = {ends[1]}\nradius = 1.0\nmaterial = "rock"\n'

    def traction(self, term, normal):
        # t = S (axis x r), on the lower end with the other sign.
        sign = 1 if dot(normal, self.axis) > 0 else -1
        direction = self.q if term == "p" else tuple(-c for c in self.p)
        return [sign * S * c for c in direction]

    def distance(self, at):
        return math.hypot(dot(at, self.p), dot(at, self.q))

    def stress(self, at):
        p, q = dot(at, self.p), dot(at, self.q)
        r = self.distance(at)
        direction = tuple(-q / r * a + p / r * b for a, b in zip(self.p, self.q))
        return S * r, direction, self.axis

    peak = S
    # T^2 L / (G J) with T = S pi/2, J = pi/2, L = 3.
    work = S * S * math.pi / 2 * 3 / (E / (2 * (1 + NU)))


def case(body, d, surface, kinematics):
    loaded, low, size = body.faces(d)
    text = f"""
[lattice]
spacing = {d!r}
kinematics = "{kinematics}"
[material.rock]
youngs_modulus = {E}
poissons_ratio = {NU}
density = 1000
[body]
origin = {low}
size = {size}
material = "void"
surface = "{surface}"
{body.regions(low, size)}
[analysis]
type = "static"
tolerance = 1e-8
[output]
fields = []
surface = true
"""
    hull = "hull" if isinstance(body, Hole) else "bar"
    text += f'[[selection]]\nname = "skin"\nsurface = "{hull}"\n'
    for name, normal, point in loaded:
        # The face is what of the skin lies beyond a plane close to it; of the bar's wall nothing may.
        inner = tuple(-c for c in normal)
        if isinstance(body, Hole):
            offset = max(abs(s) for s in low[:2]) - 1e-3 * d
            point = tuple(offset * c for c in normal)
        else:
            point = tuple(c + (0.5 * body.length - 1e-3 * d) * e for c, e in zip(CENTER, normal))
        text += (f'[[selection]]\nname = "beyond {name}"\nhalf_space = {{ point = {list(point)}, normal = {list(inner)} }}\n'
                 f'[[selection]]\nname = "{name}"\nintersection = ["skin", "beyond {name}"]\n')
        for term, profile in body.terms():
            traction = body.traction(term, normal)
            if max(abs(t) for t in traction) > 1e-9 * S:
                text += f'[[load]]\nselection = "{name}"\ntraction = {traction}\nprofile = "{profile}"\n'
    if isinstance(body, Hole) and body.thin:
        text += "".join(f'[[boundary]]\nface = "{f}"\nfix = ["z", "rx", "ry"]\n' for f in ("z-min", "z-max"))
    elif isinstance(body, Hole):
        # Where the hole leaves the cube pieces count whole or not at all: three corners take what is left of the balance.
        high = [l + s for l, s in zip(low, size)]
        for corner, fix in ((low, ["x", "y", "z"]), ([high[0], *low[1:]], ["y", "z"]), ([low[0], high[1], low[2]], ["z"])):
            text += f'[[boundary]]\npoint = {corner}\nfix = {json.dumps(fix)}\n'
    return text


def array(text, name):
    found = re.search(rf'Name="{name}"[^>]*>([^<]*)<', text).group(1)
    return [float(v) for v in found.split()]


def measure(koshi, body, n, surface, kinematics):
    d = 1 / n
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "case.toml").write_text(case(body, d, surface, kinematics))
        subprocess.run([koshi, "run", folder / "case.toml", "--out", folder / "out"], check=True, capture_output=True)
        energy = json.loads((folder / "out" / "summary.json").read_text())["energy"]["elastic"]
        text = (folder / "out" / "surface.vtp").read_text()
    points, corners, ends = array(text, "Points"), array(text, "connectivity"), array(text, "offsets")
    stress = array(text, "stress")
    errors, found_peak, begin = [], 0, 0
    for piece, end in enumerate(ends):
        own = [int(c) for c in corners[begin:int(end)]]
        begin = int(end)
        at = [sum(points[3 * c + a] for c in own) / len(own) - CENTER[a] for a in range(3)]
        if abs(body.distance(at) - 1) > 0.01 or (isinstance(body, Bar) and abs(dot(at, body.axis)) > 0.5 * body.length - 2 * d):
            continue  # outer faces, and the rims of the ends
        if isinstance(body, Hole) and not body.thin and max(abs(a + c) for a, c in zip(at, CENTER)) > body.half - 0.5:
            continue  # where the hole leaves the cube
        exact, first, second = body.stress(at)
        xx, yy, zz, yz, xz, xy = stress[6 * piece:6 * piece + 6]
        tensor = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
        value = sum(first[a] * tensor[a][b] * second[b] for a in range(3) for b in range(3))
        errors.append((value - exact) / body.peak)
        found_peak = max(found_peak, value)
    mean = sum(abs(e) for e in errors) / len(errors)
    return 2 * energy, [100 * v for v in (found_peak / body.peak - 1, mean, max(abs(e) for e in errors))]


def bodies():
    return [("plate", Hole((0, 0, 1), 0.0, 4.0, True)), ("turned", Hole((0, 0, 1), math.pi / 6, 4.0, True)),
            ("tilted", Hole((1, 2, 3), math.pi / 6, 2.0, False)), ("void", Void((0, 0, 1))), ("oblique", Void((1, 2, 3))),
            ("bar", Bar((0, 0, 1))), ("askew", Bar((1, 2, 3)))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koshi", default="build/release/koshi")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("docs/validation"))
    parser.add_argument("--bodies", nargs="+", default=[name for name, _ in bodies()])
    parser.add_argument("--cells", type=int, nargs="+", default=[5, 10, 20])
    parser.add_argument("--surfaces", nargs="+", default=["stairs", "cut"])
    parser.add_argument("--kinematics", default="rotational")
    options = parser.parse_args()
    table = []
    for name, body in (pair for pair in bodies() if pair[0] in options.bodies):
        for surface in options.surfaces:
            for n in options.cells:
                work, errors = measure(options.koshi, body, n, surface, options.kinematics)
                work = "" if body.work is None else 100 * (work / body.work - 1)
                table.append([name, surface, n, work] + errors)
                print(*table[-1], file=sys.stderr, flush=True)
    text = lambda v, digits: "" if v == "" else f"{v:.{digits}g}"
    # Each kinematics has its file and its table.
    name = "stress" if options.kinematics == "rotational" else f"stress {options.kinematics}"
    with open(options.out / f"curved_{name.replace(' ', '_').replace('-', '_')}.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["body", "surface", "n", "work error [%]", "peak error [%]", "mean error [%]", "worst error [%]"])
        writer.writerows([*row[:3], *(text(v, 4) for v in row[3:])] for row in table)
    lines = ["| body | surface | n | work | peak | mean | worst |", "|---|---|---|---|---|---|---|"]
    lines += [f"| {row[0]} | {row[1]} | {row[2]} | " + " | ".join(text(v, 2) for v in row[3:]) + " |" for row in table]
    page = options.out / "curved.md"
    start, end = f"<!-- {name} table -->\n", f"<!-- {name} end -->"
    before, after = page.read_text().split(start)[0], page.read_text().split(end)[1]
    page.write_text(before + start + "\n" + "\n".join(lines) + "\n\n" + end + after)


if __name__ == "__main__":
    main()
