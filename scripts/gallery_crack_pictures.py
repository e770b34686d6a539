"""Pictures of the examples with cracks."""
import runpy

import matplotlib.patches
import numpy as np

from gallery import EXAMPLES, Results
from gallery_drawing import BLUE, RED, THEORY, WIDTH, drawn, figure, side_by_side


def notched_beam(maker):
    """The force over the opening of the notch's mouth, event by event, and the damage around the notch."""
    results = Results(maker.run("11_notched_beam"))
    mouth, force = 1e3 * np.array(results.history("mouth.displacement.x")), -5 * np.array(results.history("load.reaction.y"))
    simulation = maker.simulation("11_notched_beam")
    simulation.run()
    x, y = (1e3 * c for c in simulation.coordinates[:2])
    damage = np.ma.masked_array(simulation.damage[0], simulation.cells[0] == 0)
    fig, (left, right) = figure(2)
    left.plot(mouth, force, color=BLUE, linewidth=1, label="Koshi, all events")
    left.plot(mouth[1:3], force[1:3], "o", color=BLUE, markersize=3)
    left.set(xlabel="opening of the mouth [mm]", ylabel="force on the beam [N]", xlim=(0, None), ylim=(0, 900))
    right.grid(visible=False)
    shown = right.pcolormesh(x, y, damage, cmap="Reds", vmin=0, vmax=1)
    fig.colorbar(shown, ax=right, label="damage", shrink=0.8)
    right.set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal", xlim=(905, 1105), ylim=(0, 200))
    return drawn(fig)


def l_panel(maker):
    """The force on the jack over its lift, event by event, beside the largest one measured."""
    results = Results(maker.run("12_l_panel"))
    lift, force = np.array(results.history("load factor")), 1e-2 * np.array(results.history("jack.reaction.y"))
    fig, ax = figure()
    ax.plot(lift, force, color=BLUE, linewidth=1, label="Koshi, all events")
    ax.plot(0.2078, 7.2191, "k*", markersize=16, label="the largest force measured")  # expected.py
    ax.set(xlabel="lift of the jack [mm]", ylabel="force on the jack [kN]", title="L-shaped panel", xlim=(0, None), ylim=(0, 8))
    ax.legend(loc="lower right")
    return drawn(fig)


def brazilian_disc(maker):
    """Where the disc has cracked through and when, beside the load event by event."""
    results = Results(maker.run("13_brazilian_disc"))
    fig, (body, curve) = figure(2)
    body.grid(visible=False)
    event, x, y, _ = 1e3 * np.array(results.crack()).T
    points = body.scatter(x, y, c=1e-3 * event, s=26, marker="s", cmap="viridis")
    body.add_patch(matplotlib.patches.Circle((0, 0), 50, fill=False, color="#5a6675"))
    for side in (-1, 1):
        body.annotate("", (0, side * 51), (0, side * 66), arrowprops={"width": 5, "color": "#5a6675"})
    body.set(aspect="equal", xlim=(-55, 55), ylim=(-68, 68), title="cells cracked through")
    body.axis("off")
    fig.colorbar(points, ax=body, shrink=0.6, label="event")
    nominal = 2e-3 / (np.pi * 0.1 * 0.002)
    curve.plot(nominal * np.array(results.history("load factor")), color=BLUE, label="Koshi, all events")
    curve.axhline(5, label="$f_t$", **THEORY)
    curve.set(xlabel="event", ylabel="load as 2P/(πDt) [MPa]", xlim=(0, None), ylim=(0, 6), title="Brazilian disc")
    curve.legend(loc="upper right")
    return drawn(fig)


def kalthoff_winkler(maker):
    """Both halves of the plate with their cracks by time, on the largest tension; and the way of the tip."""
    example = "20_kalthoff_winkler"
    expected = runpy.run_path(str(EXAMPLES / example / "expected.py"))
    results = Results(maker.run(example))
    cells = np.array(results.crack())
    simulation = maker.simulation(example)
    simulation.run()
    stress = simulation.field("stress")[:, 0]
    middle, radius = 0.5 * (stress[0] + stress[1]), np.hypot(0.5 * (stress[0] - stress[1]), stress[5])
    tension = np.ma.masked_array(1e-6 * (middle + radius), simulation.cells[0] == 0)
    x, y = 1e3 * simulation.coordinates[0], 1e3 * simulation.coordinates[1]

    fig, (left, right) = figure(2)
    left.grid(False)
    for side in (1, -1):
        left.pcolormesh(x, side * y, tension, cmap="Greys", vmin=0, vmax=1200)
        dots = left.scatter(1e3 * cells[:, 1], side * 1e3 * cells[:, 2], c=1e6 * cells[:, 0], s=7, cmap="plasma", vmin=10, vmax=70)
    fig.colorbar(dots, ax=left, location="top", label="cells crack through at [µs]; grey: tension")
    left.annotate("", (0, 0), (-22, 0), arrowprops={"arrowstyle": "simple", "color": BLUE})
    left.set(xlim=(-25, 101), ylim=(-101, 101), aspect="equal", xlabel="x [mm]", ylabel="y [mm]")

    crack = expected["main_crack"](results)
    tip = expected["NOTCH"]
    times = 1e6 * np.array([time for time, _, _ in crack])
    way = 1e3 * np.maximum.accumulate([np.hypot(x - tip[0], y - tip[1]) for _, x, y in crack])
    right.plot(times, way, color=BLUE, label="tip of the crack")
    start = times[0]
    limit = expected["rayleigh_speed"]() * 1e-3
    right.plot([start, start + 30], [way[0], way[0] + 30 * limit], label="Rayleigh's waves", **THEORY)
    right.set(xlabel="time [µs]", ylabel="way of the tip [mm]", xlim=(15, 70), ylim=(0, 80))
    right.legend(loc="upper left")
    return drawn(fig)


def rock_compression(maker):
    """The column's surface and a section with its damage, and the stress over the strain."""
    example = "21_rock_compression"
    body, = maker.bodies(example, ["field=damage", "lines=none", "outline=false", "cut=y"])
    results = Results(maker.directory / example)
    time = 1e3 * np.array(results.time)
    strain = np.interp(time, [0, 0.1, 0.6], [0, 0.04, 0.4]) / 80
    stress = -1e-6 * np.array(results.history("press.reaction.z")) / 0.040**2
    fig, ax = figure(width=WIDTH // 2 - 8)
    ax.plot(1e3 * strain, stress, color=BLUE, label="Koshi")
    ax.plot([0, 1.6], [0, 96], label="$E$ times strain", **THEORY)
    cracks = ax.twinx()
    cracks.plot(1e3 * strain, results.history("cracks"), color=RED, linewidth=1.4)
    cracks.set_ylabel("taken by cracks [J]", color=RED)
    ax.set(xlabel="strain of the platen [‰]", ylabel="stress on the platen [MPa]", xlim=(0, None), ylim=(0, None))
    ax.legend(loc="upper left")
    return side_by_side(body, drawn(fig))
