#!/usr/bin/python3
"""Node rotations against the cell's least-squares fit: writes the tables of docs/validation/kinematics.md to stdout.

    scripts/kinematics_study.py [--koshi build/release/koshi] [--parts accuracy cost rotation]

Accuracy and unknowns by direct equilibrium, cost by explicit runs of one block, the least of three runs each; the figures
of rigid rotations are closed forms that tests/verification/test_rigid_rotation.cpp checks.
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile

from convergence_study import CLAMP, CONVERGED, E, TIP_LOAD, TIP_PROBE, case

KINEMATICS = ["rotational", "least-squares"]


def run(koshi, directory, text, *options):
    file = directory / "case.toml"
    file.write_text(text)
    subprocess.run([koshi, "run", file, "--out", directory / "out", "--quiet", *options], check=True)
    return json.loads((directory / "out" / "summary.json").read_text())


def plain(text, axes):
    return text.replace("[body]", f'springs = "plain"\naxes = "{axes}"\n[body]')


def uniaxial(koshi, directory, cell, kinematics):
    """E/E0 and nu/nu0 of the paper's compression with its full springs."""
    platens = ('[[boundary]]\nname = "bottom"\nface = "z-min"\nfix = ["z", "rx", "ry", "rz"]\n'
               '[[boundary]]\nname = "top"\nface = "z-max"\ndisplacement = { z = -0.00032 }\n')
    # The least-squares body may slide and turn on its platens: three points hold it.
    hold = ('[[boundary]]\nname = "centre"\npoint = [0.004, 0.004, 0.0]\nfix = ["x", "y"]\n'
            '[[boundary]]\nname = "edge"\npoint = [0.008, 0.004, 0.0]\nfix = ["y"]\n')
    probes = '[[probe]]\nname = "force"\nface = "z-max"\nquantity = "reaction"\n'
    for name, x in (("left", 0.0), ("right", 0.008)):
        probes += f'[[probe]]\nname = "{name}"\npoint = [{x}, 0.004, 0.008]\nquantity = "displacement"\n'
    text = case(("", cell, "paper", kinematics), 0.18, 0.002, (0.008, 0.008, 0.016), platens + hold, probes)
    values = run(koshi, directory, plain(text, "xyz"))["probes"]
    modulus = -values["force"]["reaction"][2] / 0.008**2 / 0.02
    lateral = (values["right"]["displacement"][0] - values["left"]["displacement"][0]) / 0.008 / 0.02
    return modulus / E, round(lateral / 0.18, 4) + 0.0  # no "-0.0000"


def cantilever(koshi, directory, cell, calibration, kinematics, nu):
    text = case(("", cell, calibration, kinematics), nu, 0.002, (0.018, 0.078, 0.018), CLAMP + TIP_LOAD, TIP_PROBE)
    return run(koshi, directory, plain(text, "yxz") if calibration == "paper" else text)


def automatic_step(koshi, directory, cell, calibration, kinematics):
    """Step of the undamped cantilever [s]."""
    text = case(("", cell, calibration, kinematics), 0.18, 0.002, (0.018, 0.078, 0.018), CLAMP + TIP_LOAD, TIP_PROBE)
    text = text.replace('type = "static"', 'type = "dynamic"\nduration = 1e-3\ndamping = { kind = "none" }')
    return run(koshi, directory, text.replace("tolerance = 1e-9", ""))["analysis"]["time_step"]


def cost(koshi, directory, cell, calibration):
    """Seconds per node and step of both kinematics, the least of three turns."""
    least = {}
    for _ in range(3):
        for kinematics in KINEMATICS:
            text = case(("", cell, calibration, kinematics), 0.18, 0.001, (0.064, 0.064, 0.064), "", "")
            text = text.replace('type = "static"', 'type = "dynamic"\nduration = 3e-5\ntime_step = 5e-7')
            text = text.replace("tolerance = 1e-9", 'damping = { kind = "local", factor = 0.8 }\nallow_unstable_step = true')
            speed = run(koshi, directory, text)["performance"]["node_steps_per_second"]
            least[kinematics] = min(least.get(kinematics, math.inf), 1 / speed)
    return least


def accuracy(koshi, directory):
    print("| paper's analyses, full springs | rotational | least-squares |\n|---|---|---|")
    for cell in ("cube-I", "cube-II", "cube-III"):
        texts = ["%.4f / %.4f" % uniaxial(koshi, directory, cell, k) for k in KINEMATICS]
        print(f"| {cell}: E/E0 / nu/nu0 | " + " | ".join(texts) + " |")
    for cell in ("cube-I", "cube-II", "cube-III"):
        both = [cantilever(koshi, directory, cell, "paper", k, 0.18) for k in KINEMATICS]
        print(f"| {cell}: cantilever [cm] | " +
              " | ".join("%.5f" % (100 * b["probes"]["tip"]["displacement"][0]) for b in both) + " |")

    print("\n| exact springs, d = 0.2 cm | rotational [cm] | error | least-squares [cm] | error |\n|---|---|---|---|---|")
    unknowns = []
    for calibration, ratios in (("bending-exact", list(CONVERGED)), ("beam-exact", [0.45])):
        for nu in ratios:
            both = [cantilever(koshi, directory, "cube-III", calibration, k, nu) for k in KINEMATICS]
            unknowns = [b["analysis"]["unknowns"] for b in both]
            texts = ["%.6f | %+.2f %%" % (u, 100 * (u / CONVERGED[nu] - 1))
                     for u in (100 * b["probes"]["tip"]["displacement"][0] for b in both)]
            print(f"| {calibration}, nu = {nu:g} | " + " | ".join(texts) + " |")

    print("\n| cantilever, d = 0.2 cm, nu = 0.18 | rotational | least-squares |\n|---|---|---|")
    print(f"| unknowns | {unknowns[0]} | {unknowns[1]} |")
    springs = (("cube-II", "isotropic"), ("cube-III", "bending-exact"))
    for cell, calibration in springs:
        both = [cantilever(koshi, directory, cell, calibration, k, 0.18) for k in KINEMATICS]
        print(f"| {cell}, {calibration}: iterations to 1e-9 | " +
              " | ".join(str(b["analysis"]["iterations"]) for b in both) + " |")
    for cell, calibration in springs:
        both = [automatic_step(koshi, directory, cell, calibration, k) for k in KINEMATICS]
        print(f"| {cell}, {calibration}: automatic step, undamped | " +
              " | ".join("%.3f us" % (1e6 * step) for step in both) + " |")


def costs(koshi, directory):
    print("| cost per node and step [ns], 274 625 nodes | rotational | least-squares | ratio |\n|---|---|---|---|")
    for cell, calibration in (("cube-I", "isotropic"), ("cube-II", "isotropic"), ("cube-III", "isotropic"),
                              ("cube-III", "bending-exact")):
        least = cost(koshi, directory, cell, calibration)
        a, b = (1e9 * least[k] for k in KINEMATICS)
        print(f"| {cell}, {calibration} | {a:.1f} | {b:.1f} | {a / b:.2f} |")


def rotation(*_):
    print("| rigid rotation | strain left, both | misfit of node rotations |\n|---|---|---|")
    for degrees in (0.1, 1, 10):
        angle = math.radians(degrees)
        print(f"| {degrees:g} degrees | {math.cos(angle) - 1:.3e} | {angle - math.sin(angle):.1e} |")


PARTS = {"accuracy": accuracy, "cost": costs, "rotation": rotation}


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--koshi", default=root / "build/release/koshi", type=pathlib.Path)
    arguments.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS))
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory() as name:
        for part in options.parts:
            PARTS[part](options.koshi.resolve(), pathlib.Path(name))
            print()


if __name__ == "__main__":
    main()
