"""Moduli at half the spacing as the reference; the porosity counted in the voxels."""
import pathlib
import runpy

import numpy as np

sandstone = runpy.run_path(str(pathlib.Path(__file__).parent / "sandstone.py"))["sandstone"]
COARSE, FINE = 48, 96  # cells along the edge of the same box


def homogenized(run, n):
    image = run.directory / f"sandstone_{n}.npy"
    np.save(image, sandstone(n))
    return run.homogenize(f"body.image={image}", f"lattice.spacing={480e-6 / n}")


def values(run):
    coarse, fine = homogenized(run, COARSE), homogenized(run, FINE)
    for name, modulus in (("K", "bulk"), ("G", "shear")):
        yield f"{name} [GPa]", fine["closest_isotropic"][modulus] / 1e9, coarse["closest_isotropic"][modulus] / 1e9, 0.06
    for name, axis in (("v_p along x [m/s]", "x"), ("v_p along z [m/s]", "z")):
        yield name, fine["wave_speeds"][axis][0], coarse["wave_speeds"][axis][0], 0.03
    yield "porosity", float(np.mean(sandstone(COARSE) == 0)), coarse["porosity"], 1e-4
