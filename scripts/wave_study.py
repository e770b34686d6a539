#!/usr/bin/python3
"""Wave speeds of every calibration: writes docs/validation/waves.md.

    scripts/wave_study.py [--koshi build/release/koshi] [--out docs/validation]

Speeds are those `koshi calibrate` finds from the lattice's dynamic matrix. Time steps change them: the central
difference scheme turns omega into 2/dt asin(omega dt / 2) (docs/theory/11_waves.md).
"""
import argparse
import json
import math
import pathlib
import subprocess

from convergence_study import CHOICES, DENSITY, E

RATIOS = [-0.5, -0.3, 0.0, 0.18, 0.25, 0.3, 0.4, 0.45, 0.49]
SPACING, SAFETY = 0.002, 0.9
WAVES = ("p", "s_slow", "s_fast")


def deviations(koshi, choice, nu):
    """{cells: {direction: [(in space, in steps) of P, S slow, S fast]}}, percent of the solid's speeds."""
    _, cell, calibration, kinematics = choice
    ended = subprocess.run(
        [koshi, "calibrate", "--json", "--cell", cell, "--calibration", calibration, "--kinematics", kinematics,
         "--youngs-modulus", f"{E} Pa", f"--poissons-ratio={nu}", "--spacing", f"{SPACING} m", "--density",
         f"{DENSITY} kg/m^3"], capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        return None
    found = json.loads(ended.stdout)
    dt = SAFETY * min(found["time_step"]["d_over_p"], found["time_step"]["bulk_limit"])
    solid = found["wave_speeds"]
    table = {}
    for row in found["dispersion"]:
        k = 2 * math.pi / (row["cells_per_wavelength"] * SPACING)
        errors = []
        for wave in WAVES:
            c, exact = row[wave], solid[wave[0]]
            stepped = 2 / dt * math.asin(c * k * dt / 2) / k
            errors.append((100 * (c / exact - 1), 100 * (stepped / exact - 1)))
        table.setdefault(row["cells_per_wavelength"], {})[row["direction"]] = errors
    return table


def worst(table, cells, kind):
    return max((abs(error[kind]), error[kind]) for errors in table[cells].values() for error in errors)[1]


def page(values):
    text = """# Wave speeds

Made by `scripts/wave_study.py` from the lattice's own dispersion (`koshi calibrate`). Entries are deviations from the
solid's speeds in percent, at 20 / 40 cells per wavelength: of P and both S waves along [100], [110] and [111] the worst.
The errors are of second order; [chapter 11](../theory/11_waves.md) has their coefficients in closed form. A dash: springs
that are refused.

**For waves take `calibration = "isotropic"` with Cube-II or Cube-III.** At the step Koshi chooses by itself, without
damping, every wave is within 0.5 / 0.13 % for Poisson's ratios from -0.5 to 0.4, with either kinematics. Bending-exact springs
are within 0.62 / 0.16 %: P along [111] is the worst with node rotations, and no choice among springs that bend and
twist exactly changes it. Along [100] P is off by 0.41 / 0.10 % in space whatever the springs: the lumped mass sets it.

The step helps because a central difference raises frequencies while the lattice lowers them: in space alone the errors
are larger (second table). The step is that of a periodic box, 0.9 of the lesser of d/c_p and 2/omega_max. Bodies with
free corners step less far with node rotations, about half of d/c_p, and lie between the two tables; with the fit they
step as far.
"""
    for kind, heading in ((1, "At the automatic step"), (0, "In space alone (steps much smaller than the limit)")):
        text += f"\n## {heading}\n\n| springs | " + " | ".join(f"nu = {nu:g}" for nu in RATIOS) + " |\n"
        text += "|---" * (len(RATIOS) + 1) + "|\n"
        for choice in CHOICES:
            entries = []
            for nu in RATIOS:
                table = values[choice[0], nu]
                entries.append("–" if table is None else
                               f"{worst(table, 20, kind):+.2f} / {worst(table, 40, kind):+.3f}")
            text += f"| {choice[0]} | " + " | ".join(entries) + " |\n"
    text += "\n## Direction by direction, nu = 0.18, 20 cells per wavelength\n\nIn space / at the automatic step.\n"
    for wave, name in enumerate(("P", "S slow", "S fast")):
        text += f"\n| {name} | [100] | [110] | [111] |\n|---|---|---|---|\n"
        for choice in CHOICES:
            rows = values[choice[0], 0.18][20]
            entries = ["%+.3f / %+.3f" % rows[direction][wave] for direction in ("[100]", "[110]", "[111]")]
            text += f"| {choice[0]} | " + " | ".join(entries) + " |\n"
    return text


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--koshi", default=root / "build/release/koshi", type=pathlib.Path)
    arguments.add_argument("--out", default=root / "docs/validation", type=pathlib.Path)
    options = arguments.parse_args()
    values = {(choice[0], nu): deviations(options.koshi.resolve(), choice, nu)
              for choice in CHOICES for nu in RATIOS}
    (options.out / "waves.md").write_text(page(values))


if __name__ == "__main__":
    main()
