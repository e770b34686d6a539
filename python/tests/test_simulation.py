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


def test_a_macroscopic_strain_has_its_stress():
    # Uniaxial stress of 2 MPa along z, no shear: strains 2e6 / 1e9 and -0.25 times that.
    zero = {c: 0 for c in ("xx", "yy", "yz", "xz", "xy")}
    case = koshi.Case(
        koshi.Lattice(spacing=1e-3),
        koshi.Body(size=(3e-3, 2e-3, 4e-3), material="rock", periodic=["x", "y", "z"]),
        {"rock": koshi.Material(1e9, 0.25, 2000)},
        macroscopic=koshi.Macroscopic(stress={"zz": "2 MPa", **zero}),
    )
    simulation = koshi.Simulation(case)
    result = simulation.run()
    assert result.macroscopic.strain == pytest.approx([-5e-4, -5e-4, 2e-3, 0, 0, 0], rel=1e-9, abs=1e-12)
    assert result.macroscopic.stress == pytest.approx([0, 0, 2e6, 0, 0, 0], rel=1e-9, abs=1e-3)
    # Displacements E x from the lower corner.
    x, y, z = simulation.coordinates
    assert simulation.displacement[2] - 2e-3 * z[:, None, None] == pytest.approx(np.zeros((4, 2, 3)), abs=1e-15)
    assert koshi.run(beam(analysis=koshi.Analysis())).macroscopic is None
    with pytest.raises(koshi.InputError, match="macroscopic strain without periodic directions"):
        case.body.periodic = None
        koshi.Simulation(case)


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


@pytest.mark.parametrize("reduce", [None, "area-mean"])
def test_probe_of_a_relative_displacement(case, reduce):
    case.selection = [koshi.Selection("half way", box={"min": (0, 0, 1e-3), "max": (1, 1, 2e-3)})]
    case.probe = [
        koshi.Probe("top", face="z-max", reduce=reduce),
        koshi.Probe("below", selection="half way", reduce=reduce),
        koshi.Probe("apart", face="z-max", reduce=reduce, minus="half way"),
    ]
    probes = koshi.run(case).measurement.probes
    assert probes["top"][2] > probes["below"][2] > 0
    assert probes["apart"] == pytest.approx([t - b for t, b in zip(probes["top"], probes["below"], strict=True)], rel=1e-12)


@pytest.fixture
def brittle():
    """A bar of 6 x 2 x 2 cells of 10 mm, held at x = 0 and pulled at its other end by 1 um, far below its strength."""
    return koshi.Case(
        koshi.Lattice("10 mm", kinematics="least-squares"),
        koshi.Body(size=(0.06, 0.02, 0.02), material="rock"),
        {"rock": koshi.Material(30e9, 0, 2400, fracture={"tensile_strength": 3e6, "fracture_energy": 100})},
        boundary=[koshi.Boundary(face="x-min", fix=["x"]), koshi.Boundary(face="x-max", displacement={"x": 1e-6}, ramp=1e-3),
                  koshi.Boundary(point=(0, 0, 0), fix=["y", "z"]), koshi.Boundary(point=(0, 0.02, 0), fix=["z"])],
        analysis=koshi.Analysis("quasi-static", tolerance=1e-6),
        probe=[koshi.Probe("pull", face="x-max", quantity="reaction")],
    )  # fmt: skip


def test_damage_is_seen_and_set(brittle):
    whole = koshi.run(brittle).measurement.probes["pull"][0]
    simulation = koshi.Simulation(brittle)
    assert simulation.damage.shape == (2, 2, 6) and not simulation.damage.any()
    damage = np.zeros((2, 2, 6))
    damage[:, :, 2] = 0.5
    simulation.set_damage(damage)
    assert (simulation.damage == damage).all()
    # One layer of six of half the stiffness: 1/(5 + 2) for 1/6. It is far from its strength and does not crack on.
    pull = simulation.run().measurement.probes["pull"][0]
    assert pull / whole == pytest.approx(6 / 7, rel=1e-4)
    assert (simulation.damage == damage).all()
    # Damage never falls; more of it leaves a tenth of the layer, 1/(5 + 10).
    simulation.set_damage(0 * damage)
    assert (simulation.damage == damage).all()
    simulation.set_damage(1.8 * damage)
    assert (simulation.damage == 1.8 * damage).all()
    assert simulation.run().measurement.probes["pull"][0] / whole == pytest.approx(6 / 15, rel=1e-4)


def test_damage_goes_on_from_what_was_set(brittle):
    # Exponential softening leaves s = exp(-(x - 1)/b) of the strength at x times the strain of the onset, 1e-4; 2 b = 2 E
    # G_f/(h f_t^2) - 1 = 65.67. Damage 0.9 is that of x = 8.1. The bar of five whole layers is pulled to 24 um = (x + 5 s)
    # um, hence x = 21.31, s = 0.5388, whatever part of the way the layer came by set_damage.
    simulation = koshi.Simulation(brittle, overrides=["boundary.1.displacement.x=24e-6"])
    damage = np.zeros((2, 2, 6))
    damage[:, :, 3] = 0.9
    simulation.set_damage(damage)
    force = simulation.run().measurement.probes["pull"][0] / 4e-4
    assert simulation.damage[:, :, 3].min() > 0.9
    assert force == pytest.approx(0.5388 * 3e6, rel=0.01)


def test_damage_that_is_wrong_raises(brittle, case):
    simulation = koshi.Simulation(brittle)
    with pytest.raises(koshi.InputError, match=r"the damage of cell \(0, 0, 0\) is to be 1.5; it lies between 0 and 1"):
        simulation.set_damage(np.full((2, 2, 6), 1.5))
    with pytest.raises(koshi.InputError, match="must have a value for each cell of this rank"):
        simulation.set_damage(np.zeros((6, 2, 2)))
    with pytest.raises(koshi.InputError, match="the normal is zero"):
        simulation.set_damage(np.zeros((2, 2, 6)), (0, 0, 0))
    assert not simulation.damage.any()
    with pytest.raises(koshi.InputError, match="no material of the case can crack"):
        koshi.Simulation(case).set_damage(np.zeros((1, 1, 1)))
    brittle.region = [koshi.Region("box", "void", min=(0.05, 0, 0), max=(0.06, 0.02, 0.02))]
    brittle.boundary[1] = koshi.Boundary(box={"min": (0.05, 0, 0), "max": (0.05, 0.02, 0.02)}, displacement={"x": 1e-6}, ramp=1e-3)
    brittle.probe = []
    with pytest.raises(koshi.InputError, match=r"cell \(5, 0, 0\) is to be 0.1; the cell is empty or of a material"):
        koshi.Simulation(brittle).set_damage(np.where(np.arange(6) == 5, 0.1, np.zeros((2, 2, 6))))


def test_bonds_have_no_damage_to_set(brittle):
    brittle.lattice = koshi.Lattice("10 mm", calibration="isotropic")
    brittle.material["rock"] = koshi.Material(30e9, 0, 2400, fracture={"law": "bonds", "critical_stretch": 1e-4})
    simulation = koshi.Simulation(brittle)
    assert simulation.damage.shape == (2, 2, 6) and not simulation.damage.any()
    with pytest.raises(koshi.InputError, match="a cell has no damage of its own, only bonds that break"):
        simulation.set_damage(np.zeros((2, 2, 6)))


def test_strength_from_an_array(brittle):
    # Pulled to 1.5 MPa: a layer of a third of the strength cracks, the others do not.
    brittle.body.strength = np.ones((2, 2, 6))
    brittle.body.strength[:, :, 4] = 1 / 3
    simulation = koshi.Simulation(brittle, overrides=["boundary.1.displacement.x=3e-6"])
    simulation.run()
    assert (simulation.damage[:, :, 4] > 0).all()
    assert not np.delete(simulation.damage, 4, axis=2).any()
    brittle.body.strength[0, 0, 0] = 0
    with pytest.raises(koshi.InputError, match="body.strength: error: the strength of cell .0, 0, 0. is 0 times"):
        koshi.Simulation(brittle)


def test_grains_from_an_array(brittle, tmp_path):
    labels = np.broadcast_to(np.arange(6) // 3, (2, 2, 6))
    brittle.body.grain_boundary = {"labels": labels, "strength": 1 / 3}
    overrides = ["boundary.1.displacement.x=3e-6"]
    simulation = koshi.Simulation(brittle, overrides=overrides)
    simulation.run(out=tmp_path / "out")
    assert (simulation.damage[:, :, 2:4] > 0).any()
    assert not np.delete(simulation.damage, [2, 3], axis=2).any()
    again = koshi.Simulation(tmp_path / "out" / "resolved.toml")
    again.run()
    assert (again.damage == simulation.damage).all()
