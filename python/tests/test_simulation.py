"""Runs, steps, fields as views, loads that change."""

import os
import signal
import threading

import numpy as np
import pytest

import koshi
from conftest import beam

# The bar: k = E A / L = 1e9 Pa * 4e-6 m^2 / 4e-3 m = 1e6 N/m, so 4 N pull it by 4e-6 m; nu = 0: exactly.
PULLED = 4e-6


def test_run_reaches_the_bars_extension(case):
    result = koshi.run(case)
    assert result.measurement.probes["top"] == pytest.approx([0, 0, PULLED], rel=1e-6, abs=1e-12)
    assert result.measurement.probes["support"] == pytest.approx([0, 0, -4], rel=1e-6, abs=1e-6)
    # Energy F u / 2, and the same unbalanced ratio that ended the run.
    assert result.measurement.elastic_energy == pytest.approx(0.5 * 4 * PULLED, rel=1e-6)
    assert 0 <= result.measurement.unbalanced_ratio < 1e-9
    assert result.steps > 0 and result.time_step > 0 and not result.stopped


def test_fields_are_views(case):
    simulation = koshi.Simulation(case)
    u = simulation.displacement
    assert u.shape == (3, 5, 3, 3) and u.dtype == np.float64
    assert np.shares_memory(u, simulation.displacement)
    x, y, z = simulation.coordinates
    assert x == pytest.approx([0, 1e-3, 2e-3]) and z == pytest.approx(np.arange(5) * 1e-3)
    # Uniform strain written through the view: energy E eps^2 V / 2 with eps = 1e-3, V = 16e-9 m^3.
    u[2] = 1e-3 * z[:, None, None]
    assert simulation.measure().elastic_energy == pytest.approx(0.5 * 1e9 * 1e-6 * 16e-9, rel=1e-12)
    assert simulation.field("strain").shape == (6, 4, 2, 2)
    assert simulation.field("strain")[2] == pytest.approx(np.full((4, 2, 2), 1e-3), rel=1e-12)
    assert simulation.field("stress")[2] == pytest.approx(np.full((4, 2, 2), 1e6), rel=1e-12)
    # Mass: 16e-9 m^3 * 2000 kg/m^3, read only, like the cells.
    assert simulation.mass.sum() == pytest.approx(32e-6, rel=1e-12)
    assert simulation.cells.shape == (4, 2, 2) and (simulation.cells == 1).all()
    for frozen in (simulation.mass, simulation.cells):
        with pytest.raises(ValueError):
            frozen[...] = 0
    # The view keeps what it looks at alive.
    del simulation
    assert u[2].max() == pytest.approx(4e-6)


def test_velocity_written_by_the_user_moves_the_body():
    case = beam(boundary=[], load=[], analysis=koshi.Analysis("dynamic", duration="1 ms"), probe=[])
    simulation = koshi.Simulation(case)
    simulation.velocity[0] = 2.0
    simulation.step(10)
    # Free flight: u = v t.
    assert simulation.steps == 10
    assert simulation.time == pytest.approx(10 * simulation.time_step, rel=1e-12)
    assert simulation.displacement[0] == pytest.approx(np.full((5, 3, 3), 2 * simulation.time), rel=1e-9)
    # 1/2 m v^2 with 32e-6 kg.
    assert simulation.measure().kinetic_energy == pytest.approx(0.5 * 32e-6 * 4, rel=1e-9)


def test_loads_and_motions_change_between_runs(case):
    simulation = koshi.Simulation(case)
    assert simulation.run().measurement.probes["top"][2] == pytest.approx(PULLED, rel=1e-6)
    simulation.set_load_factor("pull", -0.5)
    assert simulation.run().measurement.probes["top"][2] == pytest.approx(-0.5 * PULLED, rel=1e-6)
    with pytest.raises(koshi.InputError, match='there is no load "pul"; did you mean "pull"'):
        simulation.set_load_factor("pul", 1)

    pushed = beam(load=[], boundary=[*case.boundary, koshi.Boundary("top", face="z-max", displacement={"z": 1e-6})])
    simulation = koshi.Simulation(pushed)
    assert simulation.run().measurement.probes["support"][2] == pytest.approx(-1, rel=1e-6)
    simulation.set_boundary_factor("top", 3)
    assert simulation.run().measurement.probes["support"][2] == pytest.approx(-3, rel=1e-6)


def test_callback_sees_and_stops_the_run(case):
    seen = []

    def stop_at_40(simulation):
        seen.append(simulation.steps)
        return simulation.steps >= 40

    result = koshi.run(case, callback=stop_at_40)
    assert seen == [10, 20, 30, 40] and result.steps == 40 and result.stopped


@pytest.mark.parametrize("type", ["quasi-static", "static"])
def test_exceptions_of_a_callback_come_through(case, type):
    def fail(*_):
        raise KeyError("mine")

    case.analysis = koshi.Analysis(type, tolerance=1e-9)
    with pytest.raises(KeyError, match="mine"):
        koshi.run(case, callback=fail)
    with pytest.raises(KeyError, match="mine"):
        koshi.run(case, progress=fail)


def test_static_analysis_tells_its_iterations_and_shows_its_solution(case):
    case.analysis = koshi.Analysis("static", tolerance=1e-10)
    seen, steps = [], []
    result = koshi.run(case, callback=lambda s: seen.append(s.displacement[2].max()), progress=lambda *p: steps.append(p))
    # After each iteration, 0 among them, and with the solution.
    assert len(seen) == result.iterations + 2 and seen[-1] == pytest.approx(PULLED, rel=1e-9)
    assert result.measurement.probes["top"][2] == pytest.approx(PULLED, rel=1e-9)
    assert len(result.residuals) == result.iterations + 1 == len(steps)
    assert result.residuals[0] == 1 and result.residuals[-1] <= 1e-10 < result.residuals[-2]
    assert "iteration 0" in steps[0][1] and not result.stopped
    # Between solutions the load changes.
    simulation = koshi.Simulation(case)
    simulation.run()
    simulation.set_load_factor("pull", 3)
    assert simulation.run().measurement.probes["top"][2] == pytest.approx(3 * PULLED, rel=1e-9)


# Iterations without end: steps so small that the residual does not fall.
ENDLESS = ["-ksp_type", "richardson", "-ksp_richardson_scale", "1e-15", "-ksp_max_it", "1000000000"]


def test_static_analysis_stops_when_the_callback_asks(case, tmp_path):
    case.analysis = koshi.Analysis("static")
    calls = []
    simulation = koshi.Simulation(case)
    result = simulation.run(
        lambda s: calls.append(s) or len(calls) == 5, petsc_options=ENDLESS, out=tmp_path / "out"
    )
    # Called after iterations 0 ... 4; steps of 1e-15 of the way leave the bar where it was.
    assert result.stopped and len(calls) == 5 == len(result.residuals) and result.iterations == 4
    assert result.residuals == pytest.approx(np.ones(5), abs=1e-6)
    assert 0 < simulation.displacement[2].max() < 1e-6 * PULLED
    assert not (tmp_path / "out/checkpoint.h5").exists()
    # The same simulation goes on to the end.
    assert simulation.run().measurement.probes["top"][2] == pytest.approx(PULLED, rel=1e-6)


def interrupted_once(begun):
    """A thread that presses Ctrl-C once the run has begun; it only gets there if the run lets other threads go on."""

    def press():
        begun()
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    return thread


@pytest.mark.parametrize("type", ["dynamic", "static"])
def test_an_interrupt_ends_a_run(case, type):
    case.analysis = koshi.Analysis(type, **({"duration": "1000 s"} if type == "dynamic" else {}))
    begun = threading.Event()
    thread = interrupted_once(begun.wait)
    with pytest.raises(KeyboardInterrupt):
        koshi.run(case, progress=lambda *_: begun.set(), petsc_options=ENDLESS if type == "static" else [])
    thread.join()


def test_an_interrupt_ends_stepping(case):
    simulation = koshi.Simulation(case)

    def stepping():
        while simulation.steps == 0:
            pass

    thread = interrupted_once(stepping)
    with pytest.raises(KeyboardInterrupt):
        simulation.step(10**15)
    thread.join()
    assert simulation.steps > 0


def test_a_hinge_is_solved_or_refused():
    # Held along an edge parallel to x: nothing resists a rotation about it, and a pull along x does not turn it.
    parts = {
        "boundary": [koshi.Boundary("hinge", box={"min": (0, 0, 0), "max": ("2 mm", 0, 0)}, fix=["x", "y", "z"])],
        "analysis": koshi.Analysis("static"),
    }
    pulled = koshi.Load("pull", face="z-max", force=("1 N", 0, 0))
    result = koshi.run(beam(**parts, load=[pulled]))
    assert result.measurement.probes["support"] == pytest.approx([-1, 0, 0], abs=1e-7)
    pulled.force = (0, 0, "1 N")
    with pytest.raises(koshi.InputError, match="is free to rotate about x, and its loads do not balance"):
        koshi.run(beam(**parts, load=[pulled]))


def test_failures_raise(case):
    case.analysis = koshi.Analysis("quasi-static", tolerance=1e-12, duration="1 us")
    with pytest.raises(koshi.RunError, match="not at rest after"):
        koshi.run(case)
    case.analysis = koshi.Analysis("dynamic", duration="1 ms", time_step="1 s")
    with pytest.raises(koshi.InputError, match="analysis.time_step: error: time step 1 s is above the stable limit"):
        koshi.run(case)


def voxels(case):
    image = np.full((4, 2, 2), 5)
    image[:, 1, 1] = 0
    image[3, 0, 0] = 9
    case.material["soft"] = koshi.Material("0.5 GPa", 0.0, 1000)
    case.body = koshi.Body(image=image, materials={0: "void", 5: "rock", 9: "soft"})
    return image


def test_voxel_image_from_an_array(case):
    image = voxels(case)
    simulation = koshi.Simulation(case)
    assert (simulation.cells == np.select([image == 0, image == 5], [0, 1], 2)).all()
    # Cells of 1e-9 m^3: 11 of 2000 kg/m^3, one of 1000 kg/m^3.
    assert simulation.mass.sum() == pytest.approx(23e-6, rel=1e-12)
    # Any layout and integer type means the same.
    case.body.image = np.asfortranarray(image.astype(np.uint8))
    assert (koshi.Simulation(case).cells == simulation.cells).all()


def test_factors_from_an_array(case, tmp_path):
    # A bar of half the stiffness gives twice.
    case.analysis = koshi.Analysis("static")
    whole = koshi.Simulation(case)
    whole.run()
    nz, ny, nx = whole.cells.shape
    case.body.factor = np.full((nz, ny, nx), 0.5)
    half = koshi.Simulation(case)
    half.run()
    assert half.displacement == pytest.approx(2 * whole.displacement, rel=1e-6, abs=1e-15)
    assert (half.mass == whole.mass).all()
    # A run writes them beside its resolved input, which can be run again.
    koshi.run(case, out=tmp_path / "out")
    again = koshi.Simulation(tmp_path / "out" / "resolved.toml")
    again.run()
    assert (again.displacement == half.displacement).all()
    case.body.factor = np.full((nz, ny, nx), 1.5)
    with pytest.raises(koshi.InputError, match="body.factor: error: the factor of cell .0, 0, 0. is 1.5"):
        koshi.Simulation(case)
    case.body.factor = np.ones((nz, ny))
    with pytest.raises(koshi.InputError, match="body.factor: error: the array has the type float64 and the shape"):
        koshi.Simulation(case)


def test_wrong_arrays_raise(case):
    voxels(case)
    case.body.materials = {0: "void", 5: "rock"}
    with pytest.raises(koshi.InputError, match="body.materials: error: the image also has the value 9"):
        koshi.Simulation(case)
    case.body.image = np.ones((2, 2))
    with pytest.raises(koshi.InputError, match=r"body.image: error: .*float64 and the shape \(2, 2\)"):
        koshi.Simulation(case)


def test_output_directory_holds_the_whole_input(case, tmp_path):
    voxels(case)
    result = koshi.run(case, out=tmp_path / "out")
    assert (tmp_path / "out/summary.json").exists() and (tmp_path / "out/fields.pvd").exists()
    again = koshi.run(tmp_path / "out/resolved.toml")
    assert (again.measurement.probes["top"] == result.measurement.probes["top"]).all()
