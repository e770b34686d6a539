#!/usr/bin/python3
"""Redoes the identities of chapters 3, 6, 7, 8 and 11 symbolically, from the bond law (2.1), (2.2) and nothing else.

The cell has side 1 and its corners at x = s / 2; a family's bonds count with the share the cell owns of them.
"""

from itertools import combinations, product

import sympy as sp

R = sp.Rational
kn1, kn2, kn3, kt1, kt2, kt3, kappa = springs = sp.symbols("kn1 kn2 kn3 kt1 kt2 kt3 kappa")
KN, KT = springs[:3], springs[3:6]
SHARE = [R(1, 4), R(1, 2), 1]
SIGNS = list(product((-1, 1), repeat=3))
CORNERS = [sp.Matrix(s) / 2 for s in SIGNS]
nu, a, b, gamma, f, t = sp.symbols("nu a b gamma f t")
checked = 0


def same(left, right):
    """Both sides are the same expression, or the same list of them."""
    global checked
    difference = sp.Matrix([left]) - sp.Matrix([right])
    assert sp.simplify(difference).is_zero_matrix, f"{left} is not {right}"
    checked += len(difference)


def bonds():
    """Pairs of corners, D, and the cell's share of kn and kt."""
    for p, q in combinations(range(8), 2):
        D = CORNERS[p] - CORNERS[q]
        family = int(D.dot(D)) - 1
        yield p, q, D, SHARE[family] * KN[family], SHARE[family] * KT[family]


def relative(u, w, p, q, D):
    """Normal and tangential part of (2.1)."""
    r = u[p] - u[q] - (w[p] + w[q]).cross(D) / 2
    r_n = D * r.dot(D) / D.dot(D)
    return r_n, r - r_n


def gradient(u):
    """Least-squares gradient (2.5)."""
    return sum((u[p] * sp.Matrix(SIGNS[p]).T for p in range(8)), sp.zeros(3)) / 4


def curl_half(G):
    return sp.Matrix([G[2, 1] - G[1, 2], G[0, 2] - G[2, 0], G[1, 0] - G[0, 1]]) / 2


def energy(u, w):
    """(2.2) over the bonds of the cell, and the volumetric spring (7.3)."""
    total = kappa * gradient(u).trace() ** 2 / 2
    for p, q, D, kn, kt in bonds():
        r_n, r_t = relative(u, w, p, q, D)
        total += (kn * r_n.dot(r_n) + kt * r_t.dot(r_t)) / 2
    return sp.expand(total)


# Strain, stress and the stiffness (7.1): twice the energy of a uniform strain differentiated twice.
e = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"e{min(i, j) + 1}{max(i, j) + 1}"))
ZERO = [sp.zeros(3, 1)] * 8
strained = [e * x for x in CORNERS]
uniform = energy(strained, ZERO)
C1111 = sp.diff(uniform, e[0, 0], 2)
C1122 = sp.diff(uniform, e[0, 0], e[1, 1])
C1212 = sp.diff(uniform, e[0, 1], 2) / 4
sigma = sp.Matrix(3, 3, lambda i, j: sp.diff(uniform, e[i, j]) / (1 if i == j else 2))


def rigid_motions():
    """Chapter 2: no energy in any of the six, for any springs."""
    shift, turn = sp.Matrix(sp.symbols("s1:4")), sp.Matrix(sp.symbols("w1:4"))
    same(energy([shift + turn.cross(x) for x in CORNERS], [turn] * 8), 0)


def paper_tensor():
    """(3.1) summed over the 13 bonds a cell owns inside the bulk is what the energy gives."""

    def entry(i, j, k, l):
        d = lambda m, n: int(m == n)
        total = 0
        for _, _, D, kn, kt in bonds():
            I = D / sp.sqrt(D.dot(D))
            mixed = I[j] * I[k] * d(i, l) + I[i] * I[k] * d(j, l) + I[j] * I[l] * d(i, k) + I[i] * I[l] * d(j, k)
            total += D.dot(D) * (kt / 4 * mixed + (kn - kt) * I[i] * I[j] * I[k] * I[l])
        return total

    same([entry(0, 0, 0, 0) + kappa, entry(0, 0, 1, 1) + kappa, entry(0, 1, 0, 1)], [C1111, C1122, C1212])


def least_squares_gradient():
    """(2.5) and (2.7): the fit is exact for linear fields; moment of the fitted rotation on the corners."""
    G = sp.Matrix(3, 3, sp.symbols("g1:10"))
    same(gradient([G * x for x in CORNERS]).reshape(9, 1), G.reshape(9, 1))
    u = [sp.Matrix(sp.symbols(f"u{p}_1:4")) for p in range(8)]
    T = sp.Matrix(sp.symbols("T1:4"))
    work = T.dot(curl_half(gradient(u)))
    for p in range(8):
        same(sp.Matrix([sp.diff(work, c) for c in u[p]]), T.cross(sp.Matrix(SIGNS[p])) / 8)


def surfaces():
    """(6.1), (6.2): forces and moments of one cell's springs on its corners in a uniform strain."""
    force, moment = [sp.zeros(3, 1)] * 8, [sp.zeros(3, 1)] * 8
    for p, q, D, kn, kt in bonds():
        r_n, r_t = relative(strained, ZERO, p, q, D)
        F = kn * r_n + kt * r_t
        force[p], force[q] = force[p] - F, force[q] + F
        moment[p], moment[q] = moment[p] + D.cross(F) / 2, moment[q] + D.cross(F) / 2
    pairwise = sigma.subs(kappa, 0)
    e11, e22, e33, e23, e13, e12 = e[0, 0], e[1, 1], e[2, 2], e[1, 2], e[0, 2], e[0, 1]
    for p, (s1, s2, s3) in enumerate(SIGNS):
        corner = R(2, 3) * (kn3 - kt3) * s1 * s2 * s3 * sp.Matrix([e23, e13, e12])
        same(force[p], -pairwise * sp.Matrix([s1, s2, s3]) / 4 - corner)
        same(moment[p], (kt2 + 2 * kt3) / 4 * (s1 * s2 * sp.Matrix([e13, -e23, e22 - e11])
                                             + s2 * s3 * sp.Matrix([e33 - e22, e12, -e13])
                                             + s1 * s3 * sp.Matrix([-e12, e11 - e33, e23])))


def stiffness():
    """(7.1), (7.2) and the force of the volumetric spring."""
    same(C1111, kn1 + 2 * kn2 + 2 * kt2 + R(4, 3) * kn3 + R(8, 3) * kt3 + kappa)
    same(C1122, kn2 - kt2 + R(4, 3) * kn3 - R(4, 3) * kt3 + kappa)
    same(C1212, kt1 / 2 + kn2 + kt2 + R(4, 3) * kn3 + R(2, 3) * kt3)
    same(C1111 - C1122 - 2 * C1212, (kn1 - kt1) - (kn2 - kt2) - R(8, 3) * (kn3 - kt3))
    u = [sp.Matrix(sp.symbols(f"u{p}_1:4")) for p in range(8)]
    theta = gradient(u).trace()
    for p in range(8):
        volumetric = -sp.Matrix([sp.diff(kappa * theta**2 / 2, c) for c in u[p]])
        same(volumetric, -kappa * theta * sp.Matrix(SIGNS[p]) / 4)


# Units of mu from here on: lambda / mu, and what uniform strain must give.
LAMBDA = 2 * nu / (1 - 2 * nu)
c = 2 * nu / (3 * (1 - nu))


def meets_uniform_strain(values):
    same([C.subs(values) for C in (C1111, C1122, C1212)], [LAMBDA + 2, LAMBDA, 1])


def isotropic():
    """Chapter 7: the closed forms are exact for any part lambda' the pairs carry."""
    lp = sp.Symbol("lp")
    kt_ii, kt_iii = R(2, 5) * (1 - lp), R(8, 15) * (1 - lp)
    kn_ii, kn_iii = kt_ii + lp, kt_iii + R(4, 3) * lp
    meets_uniform_strain(dict(zip(springs, (2, 0, 0, 2, 0, 0, LAMBDA))))
    meets_uniform_strain(dict(zip(springs, (kn_ii, kn_ii, 0, kt_ii, kt_ii, 0, LAMBDA - lp))))
    meets_uniform_strain(dict(zip(springs, (kn_iii, kn_iii / 2, kn_iii * R(3, 16),
                                            kt_iii, kt_iii / 2, kt_iii * R(3, 16), LAMBDA - lp))))


def bending_and_torsion():
    """(8.3) to (8.8)."""
    x, y, z = X = sp.symbols("x y z")
    bend = sp.Matrix([(a * y**2 + b * z**2) / 2, -a * x * y, -b * x * z])
    twist = gamma * sp.Matrix([0, -z * x, y * x])

    def corners(field):
        return [field.subs(dict(zip(X, corner))) for corner in CORNERS]

    def stored(field, kinematics):
        u = corners(field)
        w = corners(curl_half(field.jacobian(X))) if kinematics == "rotational" else [curl_half(gradient(u))] * 8
        return energy(u, w)

    same(stored(bend, "rotational"), ((kn1 + kn2 + kt2) * (a**2 + b**2) + 2 * (kn2 - kt2) * a * b) / 8)
    same(stored(twist, "rotational"), gamma**2 * (kt1 + 2 * kn2) / 8)
    same(stored(bend, "fit"), ((kn1 + kn2 + kt1 + 3 * kt2) * (a**2 + b**2) + 2 * (kn2 - kt2) * a * b) / 8)
    same(stored(twist, "fit"), gamma**2 * (kn2 + 2 * kt1 + 3 * kt2) / 4)

    bent = (a**2 + b**2 + 2 * nu * a * b) / (12 * (1 - nu))
    twisted = gamma**2 / 12

    def closed(normal1, shear1, t2, shear3):
        normal2 = t2 + c
        normal3 = R(3, 4) * (1 - shear1 / 2 - normal2 - t2 - R(2, 3) * shear3)
        return dict(zip(springs, (normal1, normal2, normal3, shear1, t2, shear3,
                                  LAMBDA - c - R(4, 3) * (normal3 - shear3))))

    # Rotational, any t: uniform strain, bending and torsion exact; the two choices (8.6) of t.
    shear3 = R(1, 2) - 1 / (6 * (1 - nu))
    free = closed(R(2, 3) - 2 * t, R(2, 3) - 2 * t - 2 * c, t, shear3 - t / 2)
    meets_uniform_strain(free)
    same(stored(bend, "rotational").subs(free), bent)
    same(stored(twist, "rotational").subs(free), twisted)
    same((free[kt1] - free[kt2]).subs(t, R(2, 9) * (1 - 3 * nu) / (1 - nu)), 0)
    same((free[kn1] - free[kn2]).subs(t, R(2, 9) * (1 - 2 * nu) / (1 - nu)), 0)
    # On the floor, t = kt1 = f: all but torsion.
    floor = closed(R(2, 3) - 2 * f, f, f, shear3 - f / 2)
    meets_uniform_strain(floor)
    same(stored(bend, "rotational").subs(floor), bent)
    # Least-squares.
    t2 = (1 - 3 * nu) / (18 * (1 - nu))
    fitted = closed(R(2, 3) - 5 * t2, t2, t2, shear3 + t2 / 4)
    meets_uniform_strain(fitted)
    same(stored(bend, "fit").subs(fitted), bent)
    same(stored(twist, "fit").subs(fitted), twisted)

    # Beam-exact, shear stiffnesses on the floor f: uniform strain, torsion, and bending about one axis with the
    # curvature about the other free.
    C = R(1, 3) - R(3, 2) * f
    B = (R(2, 3) * (1 + nu) + sp.sqrt(R(4, 9) * (1 + nu) ** 2 + 4 * C**2)) / 2
    normal2 = C + f
    difference = R(3, 8) * (B - normal2 - 2 * f - C)
    shear3 = (1 - R(3, 2) * f - normal2) / 2 - R(2, 3) * difference
    beam = dict(zip(springs, (B - normal2 - f, normal2, shear3 + difference, f, f, shear3,
                              LAMBDA - C - R(4, 3) * difference)))
    meets_uniform_strain(beam)
    same(stored(twist, "rotational").subs(beam), twisted)
    curled = stored(bend, "rotational").subs(beam).subs(b, -C / B * a)
    same(curled, (bent * (1 - nu**2)).subs(b, 0))
    same(sp.diff(stored(bend, "rotational").subs(beam), b).subs(b, -C / B * a), 0)


WAVES = {"P100": ((1, 0, 0), (1, 0, 0)), "P110": ((1, 1, 0), (1, 1, 0)), "P111": ((1, 1, 1), (1, 1, 1)),
         "S100": ((1, 0, 0), (0, 1, 0)), "S110z": ((1, 1, 0), (0, 0, 1)), "S110": ((1, 1, 0), (1, -1, 0)),
         "S111": ((1, 1, 1), (1, -1, 0))}  # direction and polarisation, in whole numbers


def wave_terms(direction, polarisation, kinematics):
    """(11.1): twice the energy per cell of the wave, over u^2, is M k^2 - G k^4 + ...; returns M and G."""
    n, p, h = sp.Matrix(direction), sp.Matrix(polarisation), sp.Symbol("h")
    angle = [h * n.dot(x) for x in CORNERS]
    cosine = [1 - z**2 / 2 + z**4 / 24 for z in angle]
    sine = [z - z**3 / 6 for z in angle]
    total = 0
    for u, turned in ((cosine, [-z for z in sine]), (sine, cosine)):  # exp(i angle): real and imaginary part
        u = [p * z for z in u]
        w = [h * n.cross(p) / 2 * z for z in turned]
        total += 2 * energy(u, w if kinematics == "rotational" else [curl_half(gradient(u))] * 8)
    total = sp.Poly(sp.expand(total), h)
    square, length = p.dot(p), n.dot(n)
    return total.coeff_monomial(h**2) / (square * length), -total.coeff_monomial(h**4) / (square * length**2)


def waves():
    """Chapter 11: the table (11.3), and the closed forms (11.4) to (11.6)."""
    normal = {"P100": (R(1, 12), R(1, 6), R(1, 9)), "P110": (R(1, 48), R(17, 48), R(4, 9)),
              "P111": (R(1, 108), R(8, 27), R(61, 81)), "S100": (0, R(1, 12), R(1, 9)),
              "S110z": (0, R(1, 24), R(2, 9)), "S110": (R(1, 48), R(1, 48), 0), "S111": (R(1, 108), R(2, 27), R(1, 81))}
    volumetric = {"P100": R(1, 12), "P110": R(1, 6), "P111": R(7, 36)}
    shear = {
        "rotational": {"P100": (0, R(1, 6), R(2, 9)), "P110": (R(1, 48), R(1, 16), R(2, 9)),
                       "P111": (R(1, 54), R(4, 27), R(2, 81)), "S100": (-R(1, 48), -R(1, 24), R(1, 18)),
                       "S110z": (-R(1, 96), -R(1, 48), -R(5, 36)), "S110": (0, -R(1, 16), -R(1, 6)),
                       "S111": (R(1, 216), -R(11, 108), -R(10, 81))},
        "fit": {"P100": (0, R(1, 6), R(2, 9)), "P110": (R(1, 48), R(1, 16), R(2, 9)),
                "P111": (R(1, 54), R(4, 27), R(2, 81)), "S100": (R(1, 24), R(1, 12), R(1, 18)),
                "S110z": (-R(1, 24), R(1, 24), R(1, 9)), "S110": (-R(1, 16), R(1, 16), R(1, 3)),
                "S111": (-R(17, 216), -R(1, 54), R(61, 162))}}
    shear3 = R(1, 2) - 1 / (6 * (1 - nu))

    def exact(normal1, shear1, t2, k):
        normal3 = R(3, 4) * (1 - shear1 / 2 - t2 - c - t2 - R(2, 3) * k)
        return dict(zip(springs, (normal1, t2 + c, normal3, shear1, t2, k, LAMBDA - c - R(4, 3) * (normal3 - k))))

    t2 = (1 - 3 * nu) / (18 * (1 - nu))
    lp, lam = sp.symbols("lp lambda")
    cube_ii = R(2, 5) * (1 - lp)
    cube_iii = R(8, 15) * (1 - lp)
    k3 = cube_iii + R(4, 3) * lp
    isotropic_ii = dict(zip(springs, (cube_ii + lp, cube_ii + lp, 0, cube_ii, cube_ii, 0, lam - lp)))
    isotropic_iii = dict(zip(springs, (k3, k3 / 2, k3 * R(3, 16), cube_iii, cube_iii / 2, cube_iii * R(3, 16),
                                       lam - lp)))
    bent = {"rotational": exact(R(2, 3) - 2 * t, R(2, 3) - 2 * t - 2 * c, t, shear3 - t / 2),  # t stays free
            "fit": exact(R(2, 3) - 5 * t2, t2, t2, shear3 + t2 / 4)}
    bent_error = {
        "rotational": {"P100": R(1, 24), "P110": (6 - 9 * nu + 2 * nu**2) / (96 * (1 - nu) ** 2),
                       "P111": (15 - 22 * nu + 5 * nu**2) / (216 * (1 - nu) ** 2), "S100": (1 + nu) / (48 * (1 - nu)),
                       "S110z": (1 + 3 * nu) / (96 * (1 - nu)), "S110": -(1 - 2 * nu) / (48 * (1 - nu)),
                       "S111": -(3 - 10 * nu) / (216 * (1 - nu))},
        "fit": {"P100": R(1, 24), "P110": (7 - 14 * nu + 8 * nu**2) / (96 * (1 - nu) ** 2),
                "P111": (39 - 89 * nu + 64 * nu**2) / (432 * (1 - nu) ** 2), "S100": R(1, 24),
                "S110z": (7 - 9 * nu) / (96 * (1 - nu)), "S110": (3 - 4 * nu) / (48 * (1 - nu)),
                "S111": (15 - 17 * nu) / (216 * (1 - nu))}}
    ii_error = {"P110": (22 + 20 * lam + 3 * lp) / (240 * (lam + 2)), "P111": (34 + 35 * lam - 14 * lp) / (360 * (lam + 2))}
    iii_error = {"P110": (24 + 20 * lam + lp) / (240 * (lam + 2)),
                 "P111": (114 + 105 * lam - 4 * lp) / (1080 * (lam + 2))}

    for kinematics in ("rotational", "fit"):
        for wave, (direction, polarisation) in WAVES.items():
            M, G = wave_terms(direction, polarisation, kinematics)
            table = (*normal[wave], *shear[kinematics][wave], volumetric.get(wave, 0))
            same(G, sum(weight * k for weight, k in zip(table, springs)))
            same(M.subs(isotropic_ii), lam + 2 if wave[0] == "P" else 1)
            modulus = LAMBDA + 2 if wave[0] == "P" else 1
            same(G.subs(bent[kinematics]) / (2 * modulus), bent_error[kinematics][wave])
            if wave in ii_error:
                same(G.subs(isotropic_ii) / (2 * (lam + 2)), ii_error[wave])
                same(G.subs(isotropic_iii) / (2 * (lam + 2)), iii_error[wave])


if __name__ == "__main__":
    for chapter in (rigid_motions, paper_tensor, least_squares_gradient, surfaces, stiffness, isotropic,
                    bending_and_torsion, waves):
        chapter()
    print(f"{checked} identities hold")
