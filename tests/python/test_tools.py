"""Tools driven from Python: where they go, and that nobody takes such a run for the scene's own."""
import numpy as np
import pytest

import pulvis


def test_a_driven_tool_moves_as_it_is_told(cell):
    sim = cell.simulation().step(50)
    with pytest.raises(KeyError, match="no tool 'punch', allowed: .*top"):
        sim.tools["punch"]
    with pytest.raises(KeyError, match="no series 'force', allowed: time, "):
        sim.history["force"]
    top = sim.tools["top"]
    heights = []
    top.drive((0, "-4 m/s"))
    for _ in range(100):  # what a column of tools shows is of the step before
        begin = sim.time
        sim.step(1)
        heights.append((begin, top.position[1]))
    times, at = np.array(heights).T
    assert np.diff(at) / np.diff(times) == pytest.approx(-4, rel=1e-9)
    top.drive((0, 0))
    sim.step(2)
    height = top.position[1]
    sim.step(50)
    assert top.position[1] == height and top.velocity[1] == 0
    assert sim.driven == {"tool top"}
    assert any("driven from Python (tool top)" in line for line in sim.warnings)


@pytest.mark.parametrize("velocity", [(0, float("nan")), (float("nan"), 0), (0, float("inf"))])
def test_a_velocity_that_is_no_number_is_refused(cell, velocity):
    with pytest.raises(pulvis.PulvisError, match="not finite"):
        cell.simulation().step(1).tools["top"].drive(velocity)


def test_driven_as_the_scene_drives_it_the_forces_are_the_scene_s(cell):
    """The programme in small parts: of what the scene's own tool does, step by step, the mean of ten."""
    own, heights = cell.simulation(), {}
    own.every(1, lambda sim: heights.update({sim.steps: sim.tools["top"].position[1]}))
    own.run()
    times = {}
    sim = cell.simulation()

    @sim.every(10)
    def _(sim):
        # The tool's position is of the step before.
        if sim.steps + 11 in heights:
            times[sim.steps] = sim.time
            sim.tools["top"].drive((0, (heights[sim.steps + 11] - heights[sim.steps + 1]) / (10 * sim.dt)))

    sim.run()
    half = len(own.history["time"]) // 2
    ours, theirs = sim.history["tool/top/force_y"], own.history["tool/top/force_y"]
    assert ours[half] == pytest.approx(theirs[half], rel=0.05)


def test_a_force_is_held_by_a_loop_in_python(make_cell):
    """What the module is for: a controller of three lines, whose gain suits soft contact springs."""
    wanted = 500.0
    sim = make_cell(overrides={"contact.stiffness": 0.5}).simulation()

    @sim.every(5)
    def _(sim):
        top = sim.tools["top"]
        top.drive((0, float(np.clip(0.02 * (top.force[1] - wanted), -10, 10))))

    sim.run()
    late = sim.history["tool/top/force_y"][-5:]
    assert late == pytest.approx(wanted, rel=0.25)


def test_a_driven_run_is_resumed_by_python_alone(cell, program, tmp_path):
    folder = tmp_path / "run"
    with cell.simulation(folder=folder) as sim:
        sim.step(100)
        sim.tools["top"].drive((0, "-3 m/s"))
        sim.step(100)
    done = program("resume", folder)
    assert done.returncode == 2
    assert "was driven from Python" in done.stderr and "tool top" in done.stderr
    resumed = pulvis.resume(folder)
    assert resumed.driven == {"tool top"} and resumed.steps == 200
    resumed.step(2)
    assert resumed.tools["top"].velocity[1] == pytest.approx(-3, rel=1e-9)
    whole = cell.simulation()
    whole.step(100)
    whole.tools["top"].drive((0, "-3 m/s"))
    assert whole.step(102).hash == resumed.hash


def test_what_cannot_be_driven_is_refused(cell):
    sim = cell.simulation().step(10)
    with pytest.raises(pulvis.RunError, match="could be missed"):
        sim.tools["top"].drive((0, "-1e9 m/s"))
    with pytest.raises(pulvis.SceneError):
        sim.tools["top"].drive((0, "-1 kg"))
    with pytest.raises(KeyError):
        sim.tools["head"]
    errors = []

    def drive(sim):
        if sim.time == sim.end:
            return
        with pytest.raises(pulvis.RunError, match="between two calls"):
            sim.tools["top"].drive((0, 0))
        errors.append(sim.time)

    sim.on_sample(drive)
    sim.run()
    assert errors and sim.driven == set()
