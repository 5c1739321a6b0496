"""A fork of a process shares its open files: there its simulations, levers and results are refused, and leave the files alone."""
import os
import signal
import subprocess
import sys
import traceback

import numpy as np
import pytest

import pulvis


def in_a_fork(work):
    """Runs `work` in a forked child; its output and exit code."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(60)
        code = 0
        try:
            os.write(write, str(work()).encode())
        except BaseException:
            os.write(write, traceback.format_exc().encode())
            code = 1
        os._exit(code)
    os.close(write)
    with os.fdopen(read) as said:
        text = said.read()
    return text, os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def told(call):
    try:
        call()
    except pulvis.RunError as error:
        return str(error)
    return "nothing was refused"


def state_of(folder):
    """Contents of all files."""
    return {one.name: one.read_bytes() for one in folder.iterdir() if one.is_file()}


def test_a_simulation_is_refused_in_a_fork(cell, tmp_path):
    sim = cell.simulation(folder=tmp_path / "run", threads=1).step(10)
    top = sim.tools["top"]
    calls = {
        "run": sim.run, "step": sim.step, "run_until": lambda: sim.run_until(1e-5), "checkpoint": sim.checkpoint,
        "history": lambda: sim.history, "time": lambda: sim.time, "hash": lambda: sim.hash, "tools": lambda: sim.tools,
        "column": lambda: sim.column("position")[0], "writable": lambda: sim.writable("velocity").__enter__(),
        "on_sample": lambda: sim.on_sample(print), "every": lambda: sim.every(1, print), "force": lambda: top.force,
        "drive": lambda: top.drive((0, 0)), "mesh": lambda: sim.mesh, "verdicts": lambda: sim.verdicts,
    }
    said, code = in_a_fork(lambda: "\n".join(f"{name}: {told(call)}" for name, call in calls.items()))
    assert code == 0, said
    for line in said.splitlines():
        assert f"this simulation belongs to process {os.getpid()}" in line and "allowed: " in line, line
    assert len(said.splitlines()) == len(calls)


def test_a_fork_leaves_the_files_alone(make_cell, tmp_path):
    whole = make_cell().simulation(folder=tmp_path / "whole", threads=1).run()
    sim = make_cell().simulation(folder=tmp_path / "run", threads=1)
    sim.every(40, lambda sim: None)
    sim.run_until(4e-5)
    before = state_of(tmp_path / "run")

    def child():
        sim.close()
        told(sim.run)
        held = [os.readlink(f"/proc/self/fd/{fd}") for fd in os.listdir("/proc/self/fd") if fd.isdigit() and
                os.path.islink(f"/proc/self/fd/{fd}")]
        return [one for one in held if str(tmp_path / "run") in one]

    said, code = in_a_fork(child)
    assert (said, code) == ("[]", 0)  # it holds neither the files nor the lock
    assert state_of(tmp_path / "run") == before
    sim.run()
    assert sim.hash == whole.hash
    assert (tmp_path / "run/history.csv").read_text() == (tmp_path / "whole/history.csv").read_text()
    assert np.array_equal(sim.results.series("tool/top/force_y"), whole.results.series("tool/top/force_y"))
    for ours, theirs in zip(sim.results.frames, whole.results.frames):
        assert np.array_equal(ours.nodes, theirs.nodes)


FORKS = """
import gc, os, sys, pulvis
kind, scene, folder = sys.argv[1:]
if kind == "lever":
    made = pulvis.Scene(scene, lever__elements_along=8, lever__elements_across=4, tip__elements=2)
else:
    made = pulvis.Scene(scene, stage__press__duration="0.05 ms", output__frames=50, output__samples=400)
sim = made.simulation(folder=folder, threads=1)
sim.step(10 if kind == "lever" else 1000)
child = os.fork()
if child == 0:  # ends like any program: everything is collected, and the buffers of all files are flushed
    del sim
    gc.collect()
    sys.exit(0)
os.waitpid(child, 0)
print(sim.run().hash, flush=True)
"""


@pytest.mark.parametrize("kind, scene", [("simulation", "compaction/unit-cell.toml"), ("lever", "afm/loop-beam-0.toml")])
def test_a_fork_that_ends_writes_nothing(kind, scene, scenes, tmp_path):
    done = subprocess.run([sys.executable, "-c", FORKS, kind, scenes / scene, tmp_path / "run"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    run = pulvis.open(tmp_path / "run")
    assert run.outcome == "done" and run.hash == done.stdout.strip()
    lines = (tmp_path / "run/history.csv").read_text().splitlines()
    assert len(lines) == 1 + len(run.series("time")) and len(set(lines)) == len(lines)
    for frame in run.frames:
        assert all(np.isfinite(frame.dataset(name)[()]).all() for name in frame.fields)


def test_a_fork_within_a_callback_does_not_go_on(cell, tmp_path):
    sim = cell.simulation(folder=tmp_path / "run", threads=1)
    read, write = os.pipe()
    parent = os.getpid()

    @sim.every(50)
    def _(sim):
        if sim.steps == 50 and os.fork() == 0:
            signal.alarm(60)

    try:
        sim.run()
    except pulvis.RunError as error:
        if os.getpid() != parent:
            os.write(write, str(error).encode())
    finally:
        if os.getpid() != parent:
            os._exit(0)
    os.wait()
    os.close(write)
    with os.fdopen(read) as said:
        assert f"this simulation belongs to process {parent}" in said.read()
    assert sim.outcome == "done" and sim.hash == cell.simulation().run().hash


def test_a_fork_can_make_its_own(cell):
    sim = cell.simulation(threads=2).run()
    said, code = in_a_fork(lambda: cell.simulation(threads=2).run().hash)
    assert (said, code) == (sim.hash, 0)


def test_a_lever_is_refused_in_a_fork(scenes):
    scene = pulvis.Scene(scenes / "afm/loop-beam-0.toml", lever__elements_along=8, lever__elements_across=4, tip__elements=2)
    lever = scene.simulation().step(2)
    calls = [lever.run, lever.step, lambda: lever.run_until(1), lambda: lever.on_sample(print), lambda: lever.every(1, print),
             lambda: lever.history, lambda: lever.calibration, lambda: lever.loops, lambda: lever.outcome]
    said, code = in_a_fork(lambda: "\n".join(map(told, calls)))
    assert code == 0 and said.count(f"this lever belongs to process {os.getpid()}") == len(calls), said
    assert lever.step(1).increments == 3


def test_results_are_refused_in_a_fork_until_they_are_opened_again(compact):
    run = pulvis.open(compact)
    frame = run.frame(0)
    calls = [lambda: run.series("time"), lambda: run.mesh, lambda: frame.field("effective_stress"), lambda: frame.nodes,
             lambda: run.history]
    said, code = in_a_fork(lambda: "\n".join(map(told, calls)))
    assert code == 0 and said.count("opened by process") == len(calls) and "pulvis.open in this process" in said, said
    own, code = in_a_fork(lambda: len(pulvis.open(compact).series("time")))
    again, _ = in_a_fork(lambda: len(run.refresh().series("time")))
    assert own == again == str(len(run.series("time"))) and code == 0
