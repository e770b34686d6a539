#!/usr/bin/python3
"""The series for arrays of spheres in a continuum (scripts/sphere_array_series.py) against what is known exactly."""
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
from sphere_array_series import Harmonics, array_stiffness  # noqa: E402

K, G = 37.0, 44.0


def bulk(moduli):
    return (moduli[0] + 2 * moduli[1]) / 3


class Series(unittest.TestCase):
    def near(self, values, expected, tolerance):
        for value, right in zip(values, expected, strict=True):
            self.assertLess(abs(value / right - 1), tolerance, (values, expected))

    def test_derivatives_are_those_of_differences(self):
        places, step, checked = np.random.RandomState(1).rand(5, 3) + 0.3, 1e-5, 0
        for outer in (False, True):
            harmonics = Harmonics(places, 6, outer)
            for l in range(5):
                for m in range(l + 1):
                    for a in range(3):
                        h = step * np.eye(3)[a]
                        slope = (Harmonics(places + h, 6, outer).at(l, m) - Harmonics(places - h, 6, outer).at(l, m)) / (2 * step)
                        found = harmonics.derivative([a], l, m)
                        self.assertLess(np.abs(found - slope).max(), 1e-7 * (1 + np.abs(slope).max()))
                        checked += 1
        self.assertEqual(checked, 2 * 15 * 3)

    def test_a_ball_of_the_matrix_is_not_there(self):
        self.near(array_stiffness(0.2, (K, G), (K, G), 6), (K + 4 * G / 3, K - 2 * G / 3, G), 1e-10)

    def test_equal_shear_moduli_give_hills_bulk_modulus(self):
        moduli = array_stiffness(0.2, (K, G), (4 * K, G), 12)
        right = 1 / (0.8 / (K + 4 * G / 3) + 0.2 / (4 * K + 4 * G / 3)) - 4 * G / 3
        self.near((bulk(moduli), moduli[2]), (right, G), 1e-6)

    def test_few_spheres_are_eshelbys(self):
        # Dilute: K' = K + f (K_i - K) (K + 4 G / 3) / (K_i + 4 G / 3), G' with zeta likewise; between spheres f^2 counts, with a
        # number of order 1. C44 and (C11 - C12) / 2 differ in that order alone.
        f, zeta = 1e-4, G / 6 * (9 * K + 8 * G) / (K + 2 * G)
        for ball in (None, (10 * K, 10 * G)):
            inner = ball or (0, 0)
            moduli = array_stiffness(f, (K, G), ball, 8)
            slope = [(inner[0] - K) * (K + 4 * G / 3) / (inner[0] + 4 * G / 3), (inner[1] - G) * (G + zeta) / (inner[1] + zeta)]
            found = [(bulk(moduli) - K) / f, (moduli[2] - G) / f, ((moduli[0] - moduli[1]) / 2 - G) / f]
            self.near(found, [slope[0], slope[1], slope[1]], 1e-3)

    def test_bulk_moduli_keep_to_their_bound_and_are_near_it(self):
        for ball, side in ((None, -1), ((10 * K, 10 * G), 1)):
            moduli = array_stiffness(0.2, (K, G), ball, 10)
            bound = 1 / (0.8 / (K + 4 * G / 3) + 0.2 / ((ball or (0, 0))[0] + 4 * G / 3)) - 4 * G / 3
            self.assertGreater(side * (bulk(moduli) / bound - 1), 0)
            self.assertLess(side * (bulk(moduli) / bound - 1), 0.01)

    def test_more_harmonics_change_nothing(self):
        # Two degrees more let the residual fall by a factor of ten or so at this volume.
        self.near(array_stiffness(0.2, (K, G), None, 10), array_stiffness(0.2, (K, G), None, 14), 1e-5)


if __name__ == "__main__":
    unittest.main()
