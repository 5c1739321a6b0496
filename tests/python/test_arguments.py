"""Every public callable with wrong arguments: refused in the package's own words, whatever the argument."""
import inspect
import math

import numpy as np
import pytest
from matplotlib import pyplot as plt

import pulvis
from pulvis import arguments

# Nothing of these may reach a user.
OF_THE_BINDING = ("incompatible function arguments", "Invoked with", "pybind", "std::", "arg0", "_core.", "object at 0x7")
REFUSALS = (TypeError, ValueError, LookupError, pulvis.PulvisError)


class Odd:
    def __repr__(self):
        return "<odd>"


WRONG = [Odd(), None, "x", b"x", 1.5, True, -1, 0, 10**30, -(10**30), math.nan, math.inf, 1e300, [], [Odd()], {}, (1, 2, 3, 4), "\ud800",
         "1 kg", len, np.float64(2.5), np.array([1.0, 2.0]), 3 + 4j]


def public(of):
    return [name for name in dir(of) if not name.startswith("_")]


@pytest.fixture(scope="session")
def things(compact, study, scenes_folder, tmp_path_factory):
    """Instances of all public classes, and those that they lead to."""
    folder = tmp_path_factory.mktemp("arguments")
    scene = pulvis.Scene(scenes_folder / "compaction/unit-cell.toml", stage__press__duration="0.02 ms", output__samples=5)
    held = pulvis.Scene({"extends": str(scenes_folder / "compaction/unit-cell.toml"), "remove": ["stage"],
                         "stage": [{"name": "press", "kind": "compact", "duration": "0.02 ms",
                                    "servo": [{"tool": "top", "force": "500 N"}]}]})
    beam = pulvis.Scene(scenes_folder / "afm/loop-beam-0.toml", lever__elements_along=8, lever__elements_across=4,
                        tip__elements=2)
    ball = pulvis.Scene(scenes_folder / "compaction-3d/one-sphere.toml", accuracy="draft")
    sim, servo = scene.simulation(folder=folder / "run").step(2), held.simulation().step(2)
    run = pulvis.open(compact)
    return {
        "pulvis": pulvis, "Scene": scene, "Simulation": sim, "Column": sim.column("position"), "Tool": sim.tools["top"],
        "Servo": servo.servos["top"], "History": sim.history, "Lever": beam.simulation(), "Packing": pulvis.pack(scene),
        "SolidPacking": pulvis.pack(ball), "Mesh": pulvis.mesh(scene), "SolidMesh": pulvis.mesh(ball), "Run": run,
        "Frame": run.frame(0), "Plot": run.plot, "Study": pulvis.open_study(study),
    }


@pytest.fixture(scope="session")
def scenes_folder():
    from conftest import SOURCE

    return SOURCE / "scenes"


def good_value(name, scene, folder):
    """For the other arguments of a call."""
    return {
        "scene": scene, "source": scene.file, "folder": str(folder / "other"), "file": str(folder / "table.csv"),
        "path": str(folder / "film.gif"), "call": len, "time": 0.0, "count": 0, "steps": 1, "increments": 1, "name": "position",
        "number": 0, "actions": 0.0, "velocity": (0.0, 0.0), "force": 1.0, "particle": 0, "which": 0, "x": "time", "y": "dt",
        "run": None, "tool": "top", "row": 0,
    }.get(name)


def calls_of(thing, of):
    """(name, callable, names of its arguments): constructors of classes, too."""
    for name in public(of):
        if isinstance(inspect.getattr_static(type(of), name, None), property):
            continue
        call = getattr(of, name)
        if not callable(call) or inspect.ismodule(call) or (inspect.isclass(call) and issubclass(call, Exception)):
            continue
        parameters = [one for one in inspect.signature(call).parameters.values() if one.kind is not one.VAR_KEYWORD]
        yield f"{thing}.{name}", call, parameters


def refusal_of(call, args, keys, refusals):
    """What a call says, if it refuses; anything else that it raises fails the test."""
    try:
        call(*args, **keys)
    except refusals as error:
        return error
    finally:
        plt.close("all")
    return None


# Takes long.
SLOW = {"Plot.animate"}
# Their messages are their own: a RunError, which names the folder, or of the library that draws.
OF_RESULTS = {"Run", "Frame", "Plot", "Study", "History"}
KINDS = ["pulvis", "Scene", "Simulation", "Column", "Tool", "Servo", "History", "Lever", "Packing", "SolidPacking", "Mesh", "SolidMesh",
         "Run", "Frame", "Plot", "Study"]


@pytest.mark.parametrize("kind", KINDS)
def test_wrong_arguments_are_refused_in_our_own_words(kind, things, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    checked = 0
    refusals = Exception if kind in OF_RESULTS else REFUSALS
    values = [WRONG[0], 10**30] if kind == "Plot" else WRONG  # figures take their time
    for name, call, parameters in calls_of(kind, things[kind]):
        if name in SLOW:
            continue
        if parameters and "call" not in [one.name for one in parameters] and name.split(".")[1] in ("run", "simulation", "calibration"):
            parameters = [one for one in parameters if one.name in ("threads", "folder", "progress", "overwrite", "checkpoint_every")]
        for wrong in parameters:
            others = [one for one in parameters if one is not wrong and one.default is one.empty and one.kind is not one.VAR_POSITIONAL]
            keys = {one.name: good_value(one.name, things["Scene"], tmp_path) for one in others}
            for value in values:
                if wrong.kind is wrong.VAR_POSITIONAL:
                    error = refusal_of(call, [value], keys, refusals)
                else:
                    error = refusal_of(call, [], {**keys, wrong.name: value}, refusals)
                said = "" if error is None else str(error)
                assert not any(word in said for word in OF_THE_BINDING), f"{name}({wrong.name}={value!r}): {said}"
                if isinstance(value, Odd) and kind not in OF_RESULTS and not inspect.isclass(call) and wrong.annotation not in ("Any", wrong.empty):
                    assert isinstance(error, TypeError), f"{name}({wrong.name}={value!r}): {error!r}"
                    assert f"{wrong.name} = <odd>" in said and "allowed: " in said, said
                checked += 1
    assert checked > 0 or kind in ("History", "Mesh", "SolidMesh", "Column")


@pytest.mark.parametrize("wrong, said", [
    (lambda sim: sim.every(5, "x"), "Simulation.every: call = 'x' of type str, allowed: a function or None"),
    (lambda sim: sim.every("x"), "Simulation.every: steps = 'x' of type str, allowed: a whole number"),
    (lambda sim: sim.on_sample(None), "Simulation.on_sample: call = None of type NoneType, allowed: a function"),
    (lambda sim: sim.on_frame(3), "Simulation.on_frame: call = 3 of type int, allowed: a function"),
    (lambda sim: sim.step(1.5), "Simulation.step: count = 1.5"),
    (lambda sim: sim.run_until([1]), "Simulation.run_until: time = "),
    (lambda sim: sim.column(3), "Simulation.column: name = 3"),
    (lambda sim: sim.column("position")[0.5], r"Column\[\]: number = 0.5"),
    (lambda sim: sim.column("position")["0"], r"Column\[\]: number = '0'"),
    (lambda sim: sim.tools["top"].drive(None), "Tool.drive: velocity = None"),
    (lambda sim: sim.tools["top"].drive((0, None)), "Tool.drive: velocity = None"),
    (lambda sim: sim.tools["top"].drive((True, 0)), "Tool.drive: velocity = True"),
    (lambda sim: pulvis.pack("x"), "pack: scene = 'x' of type str, allowed: a Scene"),
    (lambda sim: pulvis.mesh(sim.scene, 1.5), "mesh: particle = 1.5 of type float, allowed: a string or a whole number"),
    (lambda sim: sim.scene.simulation(threads="2"), "Scene.simulation: threads = '2'"),
    (lambda sim: sim.scene.simulation(folder=3), "Scene.simulation: folder = 3 of type int, allowed: a path or None"),
    (lambda sim: sim.scene.simulation(overwrite="no"), "Scene.simulation: overwrite = 'no' of type str, allowed: True or False"),
    (lambda sim: sim.scene.simulation(checkpoint_every="1 s"), "Scene.simulation: checkpoint_every = '1 s'"),
    (lambda sim: pulvis.open(3), "open: folder = 3"),
    (lambda sim: pulvis.resume(None), "resume: folder = None"),
])
def test_wrong_types_are_named(cell, wrong, said):
    with pytest.raises(TypeError, match=said):
        wrong(cell.simulation())


@pytest.mark.parametrize("wrong, said", [
    (lambda sim: sim.step(10**30), "count = 1000000000000000000000000000000: allowed: -9223372036854775807 to"),
    (lambda sim: sim.step(-1), "step: -1 steps, allowed: >= 0"),
    (lambda sim: sim.every(0, print), "every: 0 steps, allowed: >= 1"),
    (lambda sim: sim.run_until(float("nan")), "time: nan, allowed: >= 0 s"),
    (lambda sim: sim.scene.simulation(threads=2000), "threads: 2000, allowed: 1 to 1024"),
    (lambda sim: sim.scene.simulation(threads=10**12), "threads: 1000000000000, allowed: 1 to 1024"),
    (lambda sim: sim.scene.simulation(checkpoint_every=0), "checkpoint_every: 0, allowed: > 0 s"),
    (lambda sim: sim.scene.simulation(checkpoint_steps=-1), "checkpoint_steps: -1, allowed: >= 0"),
    (lambda sim: sim.scene.simulation(folder="a\0b"), "folder = .*allowed: a path without null characters"),
    (lambda sim: pulvis.Scene({"title": "\ud800"}), "scene: .*allowed: text that UTF-8 can express"),
    (lambda sim: pulvis.Scene(sim.scene.file, title="\ud800"), "overrides: .*allowed: text that UTF-8 can express"),
    (lambda sim: sim.tools["top"].drive((0, 1e300)), r"tool top: 1e\+300 m/s, allowed: <= .* otherwise contacts could be missed"),
    (lambda sim: sim.tools["top"].drive((0, 0, 0)), "velocity: 3 components are given, allowed: 2"),
])
def test_values_out_of_range_are_told_with_the_range(cell, wrong, said):
    with pytest.raises(ValueError, match=said):
        wrong(cell.simulation())


def test_classes_beyond_the_last_are_told(cell):
    with pytest.raises(IndexError, match="class 1000000000000, allowed: 0 to 0"):
        pulvis.mesh(cell, 10**12)


def test_numbers_of_numpy_are_numbers(cell):
    sim = cell.simulation(threads=np.int32(1), overwrite=np.bool_(False), checkpoint_every=np.float32(30))
    assert sim.step(np.int64(3)).steps == 3 and sim.run_until(np.float64(1e-6)).time >= 1e-6
    assert np.array_equal(sim.column("position")[np.uint8(0)], sim.column("position")[-1])


def test_a_servo_takes_forces_that_a_scene_may_ask_for(scenes):
    held = pulvis.Scene({"extends": str(scenes / "compaction/unit-cell.toml"), "remove": ["stage"],
                         "stage": [{"name": "press", "kind": "compact", "duration": "0.2 ms",
                                    "servo": [{"tool": "top", "force": "500 N"}]}]})
    sim = held.simulation().step(2)
    servo = sim.servos["top"]
    for force in (1e300, 1.1e12, -1, math.nan, "1e300 N"):
        with pytest.raises(pulvis.RangeError, match="tool top: force: .*allowed: a quantity in N, >= 0 and <= 1e[+]12"):
            servo.drive(force)
    assert servo.target < 500 and sim.driven == set()
    for wrong in (None, [1.0], True):
        with pytest.raises(TypeError, match="Servo.drive: force = "):
            servo.drive(wrong)


def test_a_closed_simulation_is_neither_driven_nor_written(scenes, cell, tmp_path):
    held = pulvis.Scene({"extends": str(scenes / "compaction/unit-cell.toml"), "remove": ["stage"],
                         "stage": [{"name": "press", "kind": "compact", "duration": "0.2 ms",
                                    "servo": [{"tool": "top", "force": "500 N"}]}]})
    sim, servos = cell.simulation(folder=tmp_path / "run").step(3), held.simulation().step(3)
    sim.close(), servos.close()
    before = {one.name: one.read_bytes() for one in (tmp_path / "run").iterdir() if one.is_file()}
    for call in (lambda: sim.tools["top"].drive((0, 0)), lambda: servos.servos["top"].drive(1.0), sim.checkpoint, sim.run,
                 lambda: sim.on_sample(print), lambda: sim.on_frame(print), lambda: sim.every(1, print),
                 lambda: sim.writable("velocity").__enter__()):
        with pytest.raises(pulvis.RunError, match="the simulation is closed"):
            call()
    assert {one.name: one.read_bytes() for one in (tmp_path / "run").iterdir() if one.is_file()} == before
    sim.close()
    assert len(sim.history["time"]) > 0 and sim.column("position")[0].shape[1] == 2


def test_a_finished_lever_takes_no_callbacks(scenes):
    lever = pulvis.Scene(scenes / "afm/calibration-beam.toml").simulation().run()
    for call in (lambda: lever.on_sample(print), lambda: lever.on_frame(print), lambda: lever.every(1, print)):
        with pytest.raises(pulvis.RunError, match="has already run"):
            call()


def test_unions_of_annotations_are_taken_apart():
    assert arguments._words_of("Callable[[A | B], C] | None") == ["Callable", "None"]
    assert arguments._words_of("str | os.PathLike[str] | None") == ["os.PathLike", "None"]
