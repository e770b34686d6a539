#!/usr/bin/python3
"""Pictures of the examples, from their own results: examples/*/picture.png, 1200 x 750.

    scripts/gallery_pictures.py [EXAMPLE...] [--build build/release] [--out DIRECTORY]

Bodies are the view of the report page in headless Chromium; curves are drawn with matplotlib from fields and histories, the
theory beside them. --out writes NN.png into another directory instead.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

from matplotlib.collections import PolyCollection
import matplotlib.colors
import numpy as np

import gallery_crack_pictures as cracks
from gallery import EXAMPLES, ROOT, Results
from gallery_drawing import BLUE, GREEN, LIMIT, RED, THEORY, WIDTH, Maker, drawn, figure, side_by_side


def uniaxial_paper(maker):
    faster = ("boundary.top platen.velocity.z='-1 cm/s'", "analysis.duration='32 ms'", "analysis.time_step='auto'",
              "output.every='32 ms'")
    views = ([f"field=displacement:{c}", "lines=cells", "scale-number=8"] for c in "zx")
    return side_by_side(*maker.bodies("01_uniaxial_paper", *views, overrides=faster))


def cantilever_paper(maker):
    """Fig. 7: the deflection along the beam, with exact springs and Euler-Bernoulli's curve beside the paper's springs."""
    fig, ax = figure()
    for example, label, colour in (("03_cantilever_exact", "exact springs (example 03)", GREEN),
                                   ("02_cantilever_paper", "paper's springs, Cube-II", BLUE)):
        simulation = maker.simulation(example)
        simulation.run()
        y = simulation.coordinates[1]
        # Along the line x = 0.8 cm, z = 1.0 cm, as in the paper.
        ax.plot(100 * y, 100 * simulation.displacement[0, 5, :, 4], "o-", color=colour, markersize=5, label=label)
    length, force, modulus, inertia = 0.078, 9.8, 1112e6, 0.018**4 / 12
    y = np.linspace(0, length, 100)
    ax.plot(100 * y, 100 * force * y**2 * (3 * length - y) / (6 * modulus * inertia), label="Euler–Bernoulli", **THEORY)
    ax.plot(7.8, 0.016439, "k*", markersize=16, label="three-dimensional elasticity")  # docs/theory/09_numbers.md
    ax.set(xlabel="y along the beam [cm]", ylabel="deflection $u_x$ [cm]", title="Cantilever of the paper",
           xlim=(0, 8), ylim=(0, None))
    handles, labels = ax.get_legend_handles_labels()
    ax.legend(handles[::-1], labels[::-1], loc="upper left")
    return drawn(fig)


def cantilever_exact(maker):
    return maker.body("03_cantilever_exact", ["field=displacement:x", "lines=cells", "scale-number=80"])


def two_phase_block(maker):
    cut = ["cut=y", "cut-position=112", "outline=false"]
    return side_by_side(*maker.bodies("04_two_phase_block", ["field=material", *cut], ["field=stress:zz", *cut]))


def torsion_bar(maker):
    views = ([f"field={field}", "lines=cells", "scale-number=40"] for field in ("stress:yz", "displacement:z"))
    return side_by_side(*maker.bodies("05_torsion_bar", *views))


def wave_in_bar(maker):
    """The stress over place and time, and what the gauges see."""
    simulation = maker.simulation("06_wave_in_bar")
    samples = []
    simulation.run(lambda s: samples.append((s.time, s.field("stress")[0].mean(axis=(0, 1)))) and False)
    times, stress = np.array([t for t, _ in samples]), np.array([s for _, s in samples])
    x = simulation.coordinates[0]
    speed, length = np.sqrt(200e9 / 7850), 0.6
    fig, (left, right) = figure(2)
    left.grid(False)
    edges = np.append(times, 2 * times[-1] - times[-2])
    mesh = left.pcolormesh(1e3 * x, 1e6 * edges, 1e-6 * stress, cmap="RdBu_r", vmin=-1, vmax=1)
    fig.colorbar(mesh, ax=left, location="top", label="stress $σ_{xx}$ in the bar [MPa]")
    # The middle of the pulse leaves at 30 us and runs at c_0.
    reflected = 30 + 1e6 * length / speed
    left.plot([0, 600, 600 - 1e-3 * speed * (220 - reflected)], [30, reflected, 220], **THEORY)
    left.text(330, 62, "$c_0=\\sqrt{E/ρ}$")
    left.set(xlabel="x along the bar [mm]", ylabel="time [µs]", xlim=(0, 600), ylim=(0, 220))

    results = Results(maker.run("06_wave_in_bar"))
    t = np.array(results.time)

    def pulse(s):
        return np.where((s > 0) & (s < 60e-6), 0.5 * (1 - np.cos(2 * np.pi * s / 60e-6)), 0)

    for gauge, place, colour in (("gauge 1", 0.15, BLUE), ("gauge 2", 0.45, RED)):
        stress = 1e-6 * np.array(results.history(f"{gauge}.stress.xx"))
        right.plot(1e6 * t, stress, color=colour, label=f"{gauge}, x = {1e3 * place:g} mm")
        theory = -pulse(t - place / speed) + pulse(t - (2 * length - place) / speed)
        right.plot(1e6 * t, theory, label="one-dimensional theory" if place > 0.3 else None, **THEORY)
    right.set(xlabel="time [µs]", ylabel="stress $σ_{xx}$ [MPa]", xlim=(0, 220), ylim=(-1.15, 1.6))
    right.legend(loc="upper left")
    return drawn(fig)


def porous_cube(maker):
    plain = ["field=stress:zz", "outline=false", "lines=none", "scale-number=0", "range-min=-80", "range-max=80"]
    return side_by_side(*maker.bodies("07_porous_cube", plain, [*plain, "cut=y"]))


def gravity_column(maker):
    """Beside the settled body, stresses over depth."""
    body, = maker.bodies("08_gravity_column", ["field=displacement:z", "lines=cells", "scale-number=60"])
    simulation = maker.simulation("08_gravity_column")
    simulation.run()
    stress, z = simulation.field("stress")[:, :, 4, 4], simulation.coordinates[2]
    fig, right = figure(width=WIDTH // 2 - 8)
    depth = 10 - 0.5 * (z[1:] + z[:-1])
    right.plot(-1e-3 * stress[2], depth, "o", color=BLUE, label="vertical, $-σ_{zz}$")
    right.plot(-1e-3 * stress[0], depth, "s", color=RED, label="lateral, $-σ_{xx}$")
    vertical = np.array([0, 78.48, 78.48, 78.48 + 1.8 * 9.81 * 6])
    right.plot(vertical, [0, 4, 4, 10], label="theory", **THEORY)
    right.plot(vertical * [1 / 3, 1 / 3, 2 / 3, 2 / 3], [0, 4, 4, 10], **THEORY)
    right.axhspan(0, 4, color="#f3ead2", zorder=0)
    right.axhspan(4, 10, color="#e6e2dd", zorder=0)
    right.text(150, 0.6, "sand")
    right.text(8, 9.6, "clay")
    right.set(xlabel="stress [kPa]", ylabel="depth [m]", xlim=(0, 200), ylim=(10, 0), title="Stress at rest")
    right.legend(loc="center right", bbox_to_anchor=(1, 0.75))
    return side_by_side(body, drawn(fig))


def beam_vibration(maker):
    results = Results(maker.run("09_beam_vibration"))
    t, tip = np.array(results.time), 1e6 * np.array(results.history("tip.displacement.y"))
    fig, ax = figure()
    ax.axvspan(0, 9, color="#eef1f5", zorder=0)
    ax.text(0.4, -88, "force rises", color="#5a6675")
    ax.text(9.3, -88, "free", color="#5a6675")
    ax.plot(1e3 * t, tip, color=BLUE, label="Koshi")
    deflection, frequency = 100.75, 222.30  # expected.py
    free = t[t >= 9e-3]
    ax.plot([0, 9], [0, deflection], **THEORY)
    ax.plot(1e3 * free, deflection * np.cos(2 * np.pi * frequency * (free - 9e-3)), label="Timoshenko's beam, first mode",
            **THEORY)
    ax.set(xlabel="time [ms]", ylabel="deflection of the tip [µm]", title="Cantilever, pushed and let go",
           xlim=(0, 27), ylim=(-130, 150))
    ax.legend(loc="upper right", ncols=2)
    return drawn(fig)


def tunnel(maker):
    """Beside the stress around the tunnel, Kirsch's along its horizontal axis."""
    plain = ["field=stress:zz", "outline=false", "lines=none", "scale-number=100"]
    body, = maker.bodies("10_tunnel", plain, look="y", keys=["+"] * 7)
    simulation = maker.simulation("10_tunnel")
    simulation.run()
    x = simulation.coordinates[0]
    distance, stress = 0.5 * (x[1:] + x[:-1]) - 30, simulation.field("stress")[:, 120, 0, :]
    rock = (distance > 3) & (distance < 15)
    fig, ax = figure(width=WIDTH // 2 - 8)
    ax.plot(distance[rock], -1e-6 * stress[2][rock], "o", color=BLUE, markersize=5, label="vertical, $-σ_{zz}$")
    ax.plot(distance[rock], -1e-6 * stress[0][rock], "s", color=RED, markersize=5, label="lateral, $-σ_{xx}$")
    r = np.linspace(3, 15, 200)
    q, p, k = (3 / r) ** 2, 5, 1 / 3
    ax.plot(r, p / 2 * ((1 + k) * (1 + q) + (1 - k) * (1 + 3 * q**2)), label="Kirsch", **THEORY)
    ax.plot(r, p / 2 * ((1 + k) * (1 - q) - (1 - k) * (1 - 4 * q + 3 * q**2)), **THEORY)
    ax.set(xlabel="distance from the axis [m]", ylabel="stress beside the tunnel [MPa]", xlim=(0, 15), ylim=(0, 15))
    ax.axvspan(0, 3, color="#eef1f5", zorder=0)
    ax.text(0.4, 0.4, "tunnel", color="#5a6675")
    ax.legend(loc="upper right")
    return side_by_side(body, drawn(fig))


def pressurised_tube(maker):
    """Hoop stress in the middle of the tube's length: a map, and of every cell against its distance from the axis."""
    simulation = maker.simulation("40_pressurised_tube")
    simulation.run()
    x, y = (1e3 * c for c in simulation.coordinates[:2])
    X, Y = np.meshgrid(0.5 * (x[1:] + x[:-1]) - 1, 0.5 * (y[1:] + y[:-1]) - 2, indexing="ij")
    xx, yy, _, _, _, xy = (1e-6 * component.T for component in simulation.field("stress")[:, 12])
    r = np.hypot(X, Y)
    hoop = (xx * Y**2 + yy * X**2 - 2 * xy * X * Y) / r**2
    solid = (xx != 0) | (yy != 0)
    fig, (left, right) = figure(2)
    left.grid(visible=False)
    shown = left.pcolormesh(x, y, np.where(solid, hoop, np.nan).T, cmap="viridis", vmin=30, vmax=90)
    fig.colorbar(shown, ax=left, label="hoop stress [MPa]", shrink=0.8)
    left.set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
    right.plot(r[solid], hoop[solid], "o", color=BLUE, markersize=3, label="cells, cut ones too")
    along = np.linspace(25, 50, 100)
    right.plot(along, 50 / 3 * (1 + (50 / along) ** 2), label="Lamé", **THEORY)
    right.set(xlabel="distance from the axis [mm]", ylabel="hoop stress [MPa]", ylim=(0, 100))
    right.legend(loc="lower left")
    return drawn(fig)


def gear(maker):
    """Von Mises stress on the true surface, seen along the axis, and near the tooth that is pushed."""
    root = xml.etree.ElementTree.parse(maker.run("41_gear") / "surface.vtp").getroot()
    arrays = {array.get("Name"): np.array(array.text.split(), dtype=float) for array in root.iter("DataArray")}
    points = 1e3 * arrays["Points"].reshape(-1, 3)
    xx, yy, zz, yz, xz, xy = 1e-6 * arrays["stress"].reshape(-1, 6).T
    mises = np.sqrt(0.5 * ((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) + 3 * (yz**2 + xz**2 + xy**2))
    ends = arrays["offsets"].astype(int)
    pieces = [points[begin:end] for begin, end in zip([0, *ends[:-1]], ends)]
    top = [p for p, piece in enumerate(pieces) if piece[:, 2].min() > 10 - 1e-6 and np.hypot(*piece[:, :2].mean(axis=0)) > 10]
    fig, axes = figure(2)
    for ax, view in zip(axes, ((-31, 31, -31, 31), (19, 31, -7, 5))):
        shown = PolyCollection([pieces[p][:, :2] for p in top], array=mises[top], cmap="viridis", edgecolors="face", linewidth=0.4)
        shown.set_clim(0, 500)
        ax.add_collection(shown)
        ax.grid(visible=False)
        ax.set(xlim=view[:2], ylim=view[2:], aspect="equal", xlabel="x [mm]")
    axes[1].annotate("", (26.34, -2.78), (25.7, -6.7), arrowprops={"arrowstyle": "simple", "color": RED})
    axes[0].set_ylabel("y [mm]")
    fig.colorbar(shown, ax=axes[1], label="von Mises stress on the upper face [MPa]", shrink=0.8)
    return drawn(fig)


def tuning_fork(maker):
    return side_by_side(*maker.bodies("50_tuning_fork", ["sample=0"], ["sample=2"], look="y"))


def sandstone(maker):
    """A section in colours, and the end points of E(n) n in three planes."""
    folder = EXAMPLES / "30_sandstone"
    image = maker.directory / "sandstone.npy"
    subprocess.run([sys.executable, folder / "sandstone.py", image, "96"], check=True)
    out = maker.directory / "out"
    subprocess.run([maker.build / "koshi", "homogenize", folder / "case.toml", "--out", out, "--quiet", "--set", f"body.image={image}",
                    "--set", "lattice.spacing='5 um'", "--set", "output.report=false"], check=True)
    fig, (left, right) = figure(2)
    colours = matplotlib.colors.ListedColormap(["#20262e", "#e8dcc0", "#b3703a"])
    left.imshow(np.load(image)[48], cmap=colours, vmin=0, vmax=2, origin="lower", extent=(0, 0.48, 0, 0.48), interpolation="nearest")
    left.grid(False)
    left.set(title="section: quartz, clay, pores", xlabel="x [mm]", ylabel="y [mm]")
    rows = np.genfromtxt(out / "directions.csv", delimiter=",", skip_header=1)
    for plane, colour in zip(range(3), (BLUE, RED, GREEN)):
        n, modulus = rows[36 * plane:36 * (plane + 1), :3], 1e-9 * rows[36 * plane:36 * (plane + 1), 3]
        ends = np.concatenate([modulus[:, None] * n, -modulus[:, None] * n, modulus[:1, None] * n[:1]])
        right.plot(ends[:, plane], ends[:, (plane + 1) % 3], color=colour, label=f"plane {'xyz'[plane]}{'xyz'[(plane + 1) % 3]}")
    right.set(title="Young's modulus by direction [GPa]", aspect="equal")
    right.legend(loc="center")
    return drawn(fig)


PICTURES = {"01_uniaxial_paper": uniaxial_paper, "02_cantilever_paper": cantilever_paper,
            "03_cantilever_exact": cantilever_exact, "04_two_phase_block": two_phase_block, "05_torsion_bar": torsion_bar,
            "06_wave_in_bar": wave_in_bar, "07_porous_cube": porous_cube, "08_gravity_column": gravity_column,
            "09_beam_vibration": beam_vibration, "10_tunnel": tunnel, "11_notched_beam": cracks.notched_beam, "12_l_panel": cracks.l_panel,
            "13_brazilian_disc": cracks.brazilian_disc, "20_kalthoff_winkler": cracks.kalthoff_winkler,
            "21_rock_compression": cracks.rock_compression, "30_sandstone": sandstone, "40_pressurised_tube": pressurised_tube,
            "50_tuning_fork": tuning_fork}
PICTURES = {"01_uniaxial_paper": uniaxial_paper, "02_cantilever_paper": cantilever_paper, "03_cantilever_exact": cantilever_exact,
            "04_two_phase_block": two_phase_block, "05_torsion_bar": torsion_bar, "06_wave_in_bar": wave_in_bar,
            "07_porous_cube": porous_cube, "08_gravity_column": gravity_column, "09_beam_vibration": beam_vibration,
            "10_tunnel": tunnel, "12_l_panel": cracks.l_panel, "20_kalthoff_winkler": cracks.kalthoff_winkler, "30_sandstone": sandstone,
            "40_pressurised_tube": pressurised_tube, "41_gear": gear, "50_tuning_fork": tuning_fork}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("examples", nargs="*", default=sorted(PICTURES), metavar="EXAMPLE")
    parser.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    arguments = parser.parse_args()
    for example in arguments.examples:
        with tempfile.TemporaryDirectory() as directory:
            image = PICTURES[example](Maker(arguments.build.resolve(), pathlib.Path(directory)))
        file = arguments.out / f"{example}.png" if arguments.out else EXAMPLES / example / "picture.png"
        image.save(file, optimize=True)
        for kept in (0xFE, 0xFC, 0xF8):  # fewer shades, until the file is small
            if file.stat().st_size > LIMIT:
                image.point(lambda v: v if v == 255 else v & kept).save(file, optimize=True)
        print(f"{file}: {image.width} x {image.height}, {file.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
