#!/usr/bin/python3
"""Stiffness of simple cubic arrays of spheres in a continuum, by series: C11, C12 and C44 to five digits and more.

    scripts/sphere_array_series.py      prints a table that shows how the series converge

The body is a cube of side 1 with a sphere at its centre, repeated along the axes. Displacements are those of Papkovich and Neuber,

    u = B - grad(x . B + B0) / (4 (1 - nu)),    B, B0 harmonic:

in the matrix regular solid harmonics about the centre, and singular ones about the centre and, with the same coefficients, about the 26
neighbours of it; in the sphere regular ones. The mirrors of the cube leave an eighth of it. Coefficients are those of least squares for the
conditions on its faces, which the mirrors give, and on the sphere. Nothing of a lattice or of a mesh is in it.
"""
import itertools
import math

import numpy as np

# How a displacement changes its sign under the mirrors across x, y, z: parities of its components, and of B0.
STRETCH = ([(-1, 1, 1), (1, -1, 1), (1, 1, -1)], (1, 1, 1))
SHEAR = ([(1, -1, 1), (-1, 1, 1), (-1, -1, -1)], (-1, -1, 1))  # in the plane of x and y


def gauss(count, low, high):
    x, weight = np.polynomial.legendre.leggauss(count)
    return low + (high - low) * (x + 1) / 2, weight * (high - low) / 2


def regular(points, degree):
    """r^l P_lm(cos theta) e^(i m phi) / (l + m)!, for l up to `degree`, as an array [l][m][point]."""
    x, y, z = points.T
    r2 = x * x + y * y + z * z
    values = np.zeros((degree + 1, degree + 2, len(x)), complex)
    values[0, 0] = 1
    for l in range(1, degree + 1):
        values[l, l] = -(x + 1j * y) * values[l - 1, l - 1] / (2 * l)
        for m in range(l):
            below = values[l - 2, m] if l > m + 1 else 0
            values[l, m] = ((2 * l - 1) * z * values[l - 1, m] - r2 * below) / ((l + m) * (l - m))
    return values


def singular(points, degree):
    """(l - m)! P_lm(cos theta) e^(i m phi) / r^(l + 1), likewise."""
    x, y, z = points.T
    r2 = x * x + y * y + z * z
    values = np.zeros((degree + 1, degree + 2, len(x)), complex)
    values[0, 0] = 1 / np.sqrt(r2)
    for l in range(1, degree + 1):
        values[l, l] = -(2 * l - 1) * (x + 1j * y) * values[l - 1, l - 1] / r2
        for m in range(l):
            below = ((l - 1) ** 2 - m * m) * values[l - 2, m] if l > m + 1 else 0
            values[l, m] = ((2 * l - 1) * z * values[l - 1, m] - below) / r2
    return values


class Harmonics:
    """Solid harmonics and their derivatives at points; a derivative of one is another one of the degree below, or above if singular."""

    def __init__(self, points, degree, outer):
        self.step = 1 if outer else -1
        self.table = (singular if outer else regular)(points, degree + 2)
        self.count = len(points)

    def at(self, l, m):
        if l < abs(m):
            return np.zeros(self.count, complex)
        return self.table[l, m] if m >= 0 else (-1) ** m * np.conj(self.table[l, -m])

    def derivative(self, axes, l, m):
        """The derivative along the axes listed, complex: of the part cos m phi it is the real part, of sin m phi the imaginary one."""
        terms = [(1.0 + 0j, l, m)]
        for axis in axes:
            following = []
            for factor, p, q in terms:
                # d/dz lowers the degree; d/dx + i d/dy raises m besides, d/dx - i d/dy lowers it.
                p += self.step
                if axis == 2:
                    following.append((-self.step * factor, p, q))
                else:
                    up, down = (0.5, -0.5) if axis == 0 else (-0.5j, -0.5j)
                    following += [(up * factor, p, q + 1), (down * factor, p, q - 1)]
            terms = following
        return sum(factor * self.at(p, q) for factor, p, q in terms)


def kinds(degree, parity):
    """(l, m, part) of the real harmonics with this parity; part 0 is cos m phi, 1 is sin m phi."""
    for l in range(degree + 1):
        for m in range(l + 1):
            for part in (0, 1) if m else (0,):
                if parity == ((-1) ** (m + part), (-1) ** part, (-1) ** (l - m)):
                    yield l, m, part


def fields(points, degree, symmetry, nu, outer):
    """Displacements [point, component, column] and their gradients [point, component, axis, column] of all terms."""
    harmonics = Harmonics(points, degree, outer)
    share = 1 / (4 * (1 - nu))
    u, gradient = [], []
    for component in (0, 1, 2, None):
        for l, m, part in kinds(degree, symmetry[1] if component is None else symmetry[0][component]):
            # With a complex harmonic cos is its real and sin its imaginary part, and so are those of the derivatives along real axes.
            real = (lambda v: v.real) if part == 0 else (lambda v: v.imag)
            h = real(harmonics.at(l, m))
            first = [real(harmonics.derivative([a], l, m)) for a in range(3)]
            second = {pair: real(harmonics.derivative(list(pair), l, m)) for pair in itertools.combinations_with_replacement(range(3), 2)}
            displacement, slope = np.zeros((len(points), 3)), np.zeros((len(points), 3, 3))
            x = None if component is None else points[:, component]
            for a in range(3):
                displacement[:, a] = -share * (first[a] if x is None else x * first[a] + (h if a == component else 0))
                if a == component:
                    displacement[:, a] += h
                for b in range(3):
                    bend = second[min(a, b), max(a, b)]
                    if x is not None:
                        bend = x * bend + (first[a] if b == component else 0) + (first[b] if a == component else 0)
                    slope[:, a, b] = -share * bend + (first[b] if a == component else 0)
            u.append(displacement)
            gradient.append(slope)
    return np.stack(u, axis=-1), np.stack(gradient, axis=-1)


def stress(gradient, G, nu):
    both = G * (gradient + np.swapaxes(gradient, 1, 2))
    spread = 2 * G * nu / (1 - 2 * nu) * np.trace(gradient, axis1=1, axis2=2)
    for a in range(3):
        both[:, a, a] += spread
    return both


class Cube:
    """An eighth of the cube: points with weights on its three outer faces and on its part of the sphere."""

    def __init__(self, radius, count):
        t, w = gauss(count, 0, 0.5)
        pairs = np.array(list(itertools.product(t, t)))
        self.face_weight = np.prod(list(itertools.product(w, w)), axis=1)
        self.faces = [np.insert(pairs, a, 0.5, axis=1) for a in range(3)]
        c, wc = gauss(count, 0, 1)
        phi, wp = gauss(count, 0, math.pi / 2)
        cosine, phi = (v.ravel() for v in np.meshgrid(c, phi, indexing="ij"))
        sine = np.sqrt(1 - cosine**2)
        self.normal = np.stack([sine * np.cos(phi), sine * np.sin(phi), cosine], axis=1)
        self.sphere = radius * self.normal
        self.sphere_weight = np.outer(wc, wp).ravel()


def solve(cube, symmetry, matrix, ball, degree, multipoles, mean):
    """Mean stresses [face, component] under the mean strain `mean`; matrix and ball are (G, nu), or None for a void."""
    points = np.concatenate([*cube.faces, cube.sphere])
    inner = fields(points, degree, symmetry, matrix[1], False)
    outer = [0, 0]
    for shift in itertools.product((-1, 0, 1), repeat=3):
        for i, part in enumerate(fields(points - np.array(shift), multipoles, symmetry, matrix[1], True)):
            outer[i] = outer[i] + part
    u, gradient = (np.concatenate(pair, axis=-1) for pair in zip(inner, outer))
    sigma = stress(gradient, *matrix)
    n = len(cube.face_weight)

    # On a face: what changes its sign in the mirror is that of the mean strain, the stresses that do are zero.
    rows, right = [], []
    for a in range(3):
        on, root = slice(a * n, (a + 1) * n), np.sqrt(cube.face_weight)[:, None]
        for b in range(3):
            if symmetry[0][b][a] < 0:
                rows.append(root * u[on, b])
                right.append(root[:, 0] * (cube.faces[a] @ mean[b]))
            else:
                rows.append(root * sigma[on, a, b])
                right.append(np.zeros(n))

    # On the sphere: no traction, or the displacement and the traction of the ball.
    on, root = slice(3 * n, None), np.sqrt(cube.sphere_weight)[:, None, None]
    conditions = [np.einsum("pabc,pb->pac", sigma[on], cube.normal)]
    columns = u.shape[-1]
    if ball:
        within, slope = fields(cube.sphere, degree, symmetry, ball[1], False)
        tension = np.einsum("pabc,pb->pac", stress(slope, *ball), cube.normal)
        conditions = [np.concatenate([conditions[0], -tension], axis=-1), np.concatenate([u[on], -within], axis=-1)]
        rows = [np.concatenate([row, np.zeros((len(row), within.shape[-1]))], axis=1) for row in rows]
    for condition in conditions:
        rows.append((root * condition).reshape(-1, condition.shape[-1]))
        right.append(np.zeros(len(rows[-1])))
    rows, right = np.concatenate(rows), np.concatenate(right)
    scale = np.linalg.norm(rows, axis=0)
    kept = scale > 0
    solution = np.zeros(len(scale))
    solution[kept] = np.linalg.lstsq(rows[:, kept] / scale[kept], right, rcond=1e-13)[0] / scale[kept]
    weight = cube.face_weight / cube.face_weight.sum()
    return np.array([weight @ (sigma[a * n : (a + 1) * n, a] @ solution[:columns]) for a in range(3)])


def array_stiffness(fraction, matrix, ball=None, degree=16):
    """C11, C12, C44 of spheres with a part `fraction` of the volume; matrix and ball are (K, G), ball None: voids. Harmonics up to `degree`."""
    G0 = matrix[1]
    law = [(G / G0, (3 * K - 2 * G) / (2 * (3 * K + G))) for K, G in (matrix, ball or matrix)]
    cube = Cube(np.cbrt(3 * fraction / (4 * math.pi)), degree + 6)
    solid = law[1] if ball else None
    stretch = solve(cube, STRETCH, law[0], solid, degree, degree, np.diag([1.0, 0, 0]))
    shear = solve(cube, SHEAR, law[0], solid, degree, degree, np.array([[0, 0.5, 0], [0.5, 0, 0], [0, 0, 0]]))
    return G0 * stretch[0, 0], G0 * stretch[1, 1], G0 * shear[0, 1]


def main():
    K, G = 37e9, 44e9
    print("simple cubic arrays in quartz, K = 37 GPa, G = 44 GPa: C11, C12, C44 [GPa]")
    for name, ball in (("voids", None), ("ten times as stiff", (10 * K, 10 * G))):
        for fraction in (0.05, 0.2, 0.4):
            for degree in (6, 10, 14, 18):
                values = ", ".join(f"{v / 1e9:.6f}" for v in array_stiffness(fraction, (K, G), ball, degree))
                print(f"{name}, volume {fraction}, harmonics up to {degree}: {values}", flush=True)


if __name__ == "__main__":
    main()
