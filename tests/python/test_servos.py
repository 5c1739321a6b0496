"""Servos driven from Python: what they ask for, and that nobody takes such a run for the scene's own."""
import pytest

import pulvis


def scene_with(scenes, *after):
    """One plastic disc in a die under a servo: 500 N, asked for in full after a fifth of the stage, 80 us."""
    return pulvis.Scene({
        "extends": str(scenes / "compaction/unit-cell.toml"), "remove": ["stage"], "output": {"samples": 60, "frames": 4},
        "stage": [{"name": "press", "kind": "compact", "duration": "0.4 ms",
                   "servo": [{"tool": "top", "force": "500 N", "tolerance": 0.5}]}, *after]})


@pytest.fixture
def held(scenes):
    return scene_with(scenes)


def test_a_servo_tells_what_it_asks_for(held):
    sim = held.simulation()
    assert list(sim.servos) == ["top"]
    servo, seen = sim.servos["top"], []
    assert servo.holds and tuple(servo.direction) == (0, -1)
    sim.on_sample(lambda sim: seen.append((servo.target, servo.measured)))
    sim.run()
    target, measured = zip(*seen)
    assert list(target) == list(sim.history["tool/top/force_asked"])
    assert list(measured) == list(sim.history["tool/top/force_y"])
    assert target[-1] == 500 and sim.driven == set()


def test_it_asks_for_nothing_once_its_stage_is_over(scenes):
    sim = scene_with(scenes, {"name": "rest", "kind": "hold", "duration": "0.1 ms"}).simulation().run()
    time, target = sim.history["time"], sim.history["tool/top/force_asked"]
    assert set(target[time > 0.401e-3]) == {0} and target[time < 0.399e-3][-1] == 500
    assert sim.servos["top"].target == 0 and not sim.servos["top"].holds


def test_the_force_is_what_it_is_driven_to(held):
    """Without a ramp, and held as the scene's own force is, which swings by 3% at the end of this stage."""
    sim = held.simulation().run_until("0.2 ms")
    sim.servos["top"].drive("800 N")
    sim.step(1)
    assert sim.servos["top"].target == 800
    sim.run()
    assert sim.history["tool/top/force_asked"][-1] == 800
    assert sim.history["tool/top/force_y"][-1] == pytest.approx(800, rel=0.05)
    assert sim.driven == {"servo of tool top"}
    assert any("driven from Python (servo of tool top)" in line for line in sim.warnings)


def test_driven_to_what_it_asks_for_the_run_keeps_its_bits(held):
    """The scene's force, driven when its ramp is over, changes nothing."""
    whole = held.simulation().run()
    sim = held.simulation().run_until("0.2 ms")
    assert sim.servos["top"].target == 500
    sim.servos["top"].drive(500)
    assert sim.run().hash == whole.hash


def test_a_driven_servo_is_resumed_by_python_alone(held, program, tmp_path):
    with held.simulation(folder=tmp_path / "run") as sim:
        sim.step(100)
        sim.servos["top"].drive("200 N")
        sim.step(100)
    done = program("resume", tmp_path / "run")
    assert done.returncode == 2 and "servo of tool top" in done.stderr
    whole = held.simulation().step(100)
    whole.servos["top"].drive("200 N")
    resumed = pulvis.resume(tmp_path / "run").step(100)
    assert resumed.servos["top"].target == 200
    assert whole.step(200).hash == resumed.hash


def test_what_cannot_be_driven_is_refused(held, cell):
    sim = held.simulation().step(10)
    with pytest.raises(pulvis.RunError, match="allowed: a quantity in N, >= 0 and"):
        sim.servos["top"].drive(-1)
    with pytest.raises(pulvis.SceneError):
        sim.servos["top"].drive("1 kg")
    with pytest.raises(KeyError):
        sim.servos["bottom"]
    with pytest.raises(pulvis.RunError, match="sim.servos"):
        sim.tools["top"].drive((0, 1))
    assert cell.simulation().servos == {} and sim.driven == set()
