"""Columns share the simulation's memory: read by particle, written where and when it is safe."""
import gc

import h5py
import numpy as np
import pytest

import pulvis


@pytest.fixture
def mixture(scenes):
    """25 discs of two classes, so that chunks have lanes without a particle and two meshes."""
    return pulvis.Scene(scenes / "compaction/regular-25.toml")


def test_views_show_the_present_step_without_a_copy(cell):
    sim = cell.simulation()
    column = sim.column("position")
    first = column[0]
    before = first.copy()
    sim.step(200)
    assert not np.array_equal(first, before)
    assert np.shares_memory(first, sim.column("position")[0])
    assert np.shares_memory(first, column.blocks[0][1])
    assert not first.flags.owndata and not first.flags.writeable
    with pytest.raises(ValueError):
        first[0, 0] = 1


def test_rows_are_by_particle_whatever_the_lanes(mixture, tmp_path):
    sim = mixture.simulation(folder=tmp_path / "run")
    seen = []
    sim.on_frame(lambda sim: seen.append(np.asarray(sim.column("position"))))
    sim.run_until(0.02 * sim.end)
    sim.close()
    with h5py.File(tmp_path / "run/run.h5") as file:
        assert np.array_equal(seen[0], file["frames/000000/position"][:, :2])
        owner = file["mesh/node_particle"][:]
    column = sim.column("position")
    assert len(column) == 25 == sim.particles
    assert np.array_equal(np.repeat(np.arange(25), [len(column[i]) for i in range(25)]), owner)
    assert np.array_equal(owner, sim.mesh["node_particle"])
    for i in range(25):
        for numbers, values in column.blocks:
            for chunk, lane in zip(*np.nonzero(numbers == i)):
                assert np.array_equal(values[chunk, lane], column[i])
    assert sorted(np.concatenate([n[n >= 0] for n, _ in column.blocks])) == list(range(25))


def test_columns_say_what_they_are(cell):
    sim = cell.simulation()
    infos = {info.name: info for info in sim.columns}
    assert infos["node.position"].unit == "m" and infos["node.position"].numbers == 2
    assert infos["node.velocity"].writable and not infos["node.position"].writable
    assert sim.column("velocity").name == "node.velocity"
    assert sim.column("tool.velocity").rows.shape == (4, 3)  # tools live in space
    with pytest.raises(KeyError, match="did you mean 'node.velocity'"):
        sim.column("node.velocty")


def test_what_is_not_kept_is_readable_at_samples_alone(mixture):
    sim = mixture.simulation(threads=1)
    transient = [info.name for info in sim.columns if info.only_at_samples]
    assert transient
    with pytest.raises(pulvis.RunError, match="on_sample"):
        sim.column(transient[0])[0]
    shapes = []
    sim.on_sample(lambda sim: shapes.append(sim.column(transient[0])[0].shape))
    sim.step(2)
    assert len(shapes) == 1 and shapes[0][0] > 0


def test_forces_on_tools_are_those_of_the_history(cell):
    sim = cell.simulation()
    forces = []
    sim.on_sample(lambda sim: forces.append(sim.tools["top"].force[1]))
    sim.run()
    assert np.array_equal(forces, sim.history["tool/top/force_y"])
    assert max(np.abs(forces)) > 0


def test_views_keep_the_simulation_alive(cell):
    sim = cell.simulation()
    view = sim.column("position")[0]
    values = view.copy()
    del sim
    gc.collect()
    filler = [np.zeros(view.size * 8) for _ in range(100)]
    assert np.array_equal(view, values) and len(filler) == 100


def test_velocities_are_writable_between_steps(cell):
    calm = cell.simulation().step(100)
    sim = cell.simulation().step(100)
    with sim.writable("velocity") as velocity:
        velocity[0][:, 0] += 3.0
        kept = velocity[0]
    with pytest.raises(ValueError):
        kept[0, 0] = 0.0
    assert np.allclose(sim.column("velocity")[0][:, 0], calm.column("velocity")[0][:, 0] + 3.0)
    x, y = (one.column("position")[0][:, 0].mean() for one in (sim, calm))
    assert x == y
    before = calm.time
    sim.step(1), calm.step(1)
    assert sim.time == calm.time
    x, y = (one.column("position")[0][:, 0].mean() for one in (sim, calm))
    assert x - y == pytest.approx(3.0 * (calm.time - before), rel=1e-9)
    assert sim.driven == {"column node.velocity"}


def test_a_softer_yield_stress_bears_less(make_cell):
    """Written before anything flows it is the material's own, to the bit."""
    # With soft springs the punch is no faster than the disc can follow.
    of = lambda stress: make_cell(overrides={"material.316L.yield_stress": stress, "contact.stiffness": 0.5})
    hard, written, soft = of("240 MPa").simulation(), of("240 MPa").simulation().step(1), of("120 MPa").simulation()
    with written.writable("yield_stress") as stress:
        stress[0][:] = 120e6
    for sim in (hard, soft, written):
        sim.run()
    of_hard, of_soft, of_written = (sim.history["tool/top/force_y"] for sim in (hard, soft, written))
    assert np.array_equal(of_written, of_soft)
    assert of_soft[-1] == pytest.approx(0.5 * of_hard[-1], rel=0.05)  # all of it flows, without hardening


def test_what_is_not_finite_is_not_kept(cell):
    sim = cell.simulation().step(3)
    before = np.array(sim.column("velocity"))
    with pytest.raises(pulvis.RunError, match="not finite"):
        with sim.writable("velocity") as velocity:
            velocity[0][0, 0] = np.nan
    assert np.array_equal(np.array(sim.column("velocity")), before)
    assert sim.step(1).steps == 4


def test_what_is_not_safe_is_refused(cell):
    sim = cell.simulation()
    with pytest.raises(pulvis.RunError, match="allowed: node.velocity"):
        with sim.writable("position"):
            pass
    errors = []

    def write(sim):
        try:
            with sim.writable("velocity"):
                pass
        except pulvis.RunError as error:
            errors.append(str(error))

    sim.on_sample(write)
    sim.run()
    assert len(errors) == 21 and "between two calls" in errors[0]
    with pytest.raises(pulvis.RunError, match="has ended"):
        with sim.writable("velocity"):
            pass
