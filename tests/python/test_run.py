"""A run from Python is that of the command line: hash, history, files; in parts, resumed, in several threads."""
import threading

import numpy as np
import pytest

import pulvis
from conftest import SCENE

FAST = {"stage.press.duration": "0.1 ms", "output.samples": 20, "output.frames": 4}


def by_program(program, scene, folder, *words):
    sets = [word for key, value in FAST.items() for word in ("--set", f"{key}={value}")]
    done = program("run", scene, "-o", folder, "--quiet", *sets, *words)
    assert done.returncode in (0, 3), done.stderr
    return folder


def test_hash_and_history_are_those_of_the_command_line(scenes, cell, program, read_summary, tmp_path):
    folder = by_program(program, scenes / "compaction/unit-cell.toml", tmp_path / "program")
    sim = cell.simulation(threads=2, folder=tmp_path / "python")
    sim.run()
    assert sim.finished
    theirs, ours = read_summary(folder), read_summary(tmp_path / "python")
    assert sim.hash == theirs["state_hash"] == ours["state_hash"]
    assert ours["steps"] == theirs["steps"] == sim.steps
    assert ours["scene_hash"] == theirs["scene_hash"]
    assert (folder / "history.csv").read_text() == (tmp_path / "python/history.csv").read_text()
    for name in ("run.h5", "run.xdmf", "run.vtkhdf", "report.html", "scene.toml"):
        assert (tmp_path / "python" / name).is_file()
    assert not list((tmp_path / "python").glob("checkpoint-*"))


def test_parts_callbacks_and_views_change_no_bit(cell):
    whole = cell.simulation(threads=1).run()
    parts = cell.simulation(threads=2)
    parts.every(7, lambda sim: np.asarray(sim.column("velocity")).sum())
    parts.on_sample(lambda sim: sim.hash)
    assert parts.step(3).steps == 3
    parts.run_until("20 us")
    assert parts.time >= 20e-6 and parts.time - parts.dt < 20.1e-6
    parts.run_until(parts.time + 1e-5)
    for _ in range(5):
        parts.step(11)
    parts.run()
    assert parts.hash == whole.hash
    for name in whole.history:
        assert np.array_equal(whole.history[name], parts.history[name], equal_nan=True), name


def test_callbacks_come_when_they_should(cell, tmp_path):
    sim = cell.simulation(folder=tmp_path / "run")
    samples, frames, steps = [], [], []
    sim.on_sample(lambda sim: samples.append(sim.time))
    sim.on_frame(lambda sim: frames.append(sim.time))

    @sim.every(100)
    def _(sim):
        steps.append(sim.steps)

    sim.run()
    assert len(samples) == 21 and len(frames) == 5
    assert samples[0] == 0 and samples[-1] == sim.time == sim.end
    assert set(frames) <= set(samples)
    assert steps == list(range(100, sim.steps, 100)) or steps == list(range(100, sim.steps + 1, 100))
    assert np.array_equal(sim.history["time"], samples)


def test_a_run_can_be_stopped_from_a_callback_and_goes_on(cell):
    whole = cell.simulation().run().hash
    sim = cell.simulation()
    sim.every(50, lambda sim: sim.stop())
    sim.run()
    assert sim.steps == 50 and not sim.finished
    while not sim.finished:
        sim.run()
    assert sim.hash == whole


def test_an_error_in_a_callback_leaves_the_files_whole_and_the_run_goes_on(cell, read_summary, tmp_path):
    whole = cell.simulation().run().hash
    for kind in ("every", "on_sample"):
        folder = tmp_path / kind
        sim = cell.simulation(folder=folder)
        calls = []

        def fail(sim):
            calls.append(sim.time)
            if len(calls) == 3:
                raise ValueError("mine")

        sim.every(40, fail) if kind == "every" else sim.on_sample(fail)
        with pytest.raises(ValueError, match="mine"):
            sim.run()
        assert read_summary(folder)["outcome"] == "interrupted"
        assert list(folder.glob("checkpoint-*.h5"))
        sim.run()
        assert sim.hash == whole
        assert read_summary(folder)["outcome"] == "done"
        assert len((folder / "history.csv").read_text().splitlines()) == 22


def test_after_an_error_at_a_sample_columns_can_be_written(cell):
    """And it changes no bit that the run was left there."""
    broken, whole = cell.simulation(), cell.simulation()

    def fail(sim):
        if 0 < sim.time < sim.end:
            raise ValueError("at a sample")
    broken.on_sample(fail)
    with pytest.raises(ValueError, match="at a sample"):
        broken.run()
    for sim in (broken, whole):
        with sim.writable("velocity") as velocity:
            velocity[0][:, 0] += 1.0
        if sim is broken:
            whole.step(broken.steps)
    assert broken.step(1).steps == whole.step(1).steps
    assert broken.hash == whole.hash


def test_what_python_left_is_resumed_by_both(cell, program, read_summary, tmp_path):
    whole = cell.simulation().run().hash
    for name in ("python", "program"):
        with cell.simulation(folder=tmp_path / name) as sim:
            sim.run_until("50 us")
        assert read_summary(tmp_path / name)["outcome"] == "interrupted"
    resumed = pulvis.resume(tmp_path / "python", threads=2)
    assert resumed.steps == sim.steps
    assert resumed.run().hash == whole
    done = program("resume", tmp_path / "program", "--quiet")
    assert done.returncode in (0, 3), done.stderr
    assert read_summary(tmp_path / "program")["state_hash"] == whole


def test_what_the_program_left_is_resumed_from_python(scenes, cell, program, tmp_path):
    folder = by_program_stopped(program, scenes, tmp_path / "run")
    sim = pulvis.resume(folder)
    assert sim.steps == 200
    assert sim.run().hash == cell.simulation().run().hash


def by_program_stopped(program, scenes, folder):
    sets = [word for key, value in FAST.items() for word in ("--set", f"{key}={value}")]
    done = program("run", scenes / "compaction/unit-cell.toml", "-o", folder, "--quiet", "--stop-after", 200, *sets)
    assert done.returncode == 130, done.stderr
    return folder


def test_a_simulation_that_is_dropped_leaves_whole_files(cell, read_summary, tmp_path):
    sim = cell.simulation(folder=tmp_path / "run")
    sim.step(100)
    del sim
    assert read_summary(tmp_path / "run")["outcome"] == "interrupted"
    assert pulvis.resume(tmp_path / "run").steps == 100


def test_two_simulations_run_side_by_side(cell):
    whole = cell.simulation().run().hash
    sims = [cell.simulation(threads=1) for _ in range(2)]
    met = threading.Barrier(2, timeout=60)
    meetings = []

    def follow(sim):
        # Each waits once for the other in the middle of its run: neither could without Python's lock.
        to_meet = [met]
        sim.every(200, lambda sim: meetings.append(to_meet.pop().wait()) if to_meet else None)
        sim.run()

    threads = [threading.Thread(target=follow, args=(sim,)) for sim in sims]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(meetings) == 2
    assert [sim.hash for sim in sims] == [whole, whole]


def test_a_simulation_belongs_to_the_thread_that_runs_it(cell):
    sim = cell.simulation()
    going, refused = threading.Event(), threading.Event()

    def look(sim):
        going.set()
        assert refused.wait(60)

    sim.every(10, look)
    thread = threading.Thread(target=sim.run)
    thread.start()
    assert going.wait(60)
    with pytest.raises(pulvis.RunError, match="another thread"):
        sim.hash
    refused.set()
    thread.join()
    assert sim.finished


def test_progress_is_shown(cell, capsys):
    cell.simulation().run(progress=True)
    assert "100%" in capsys.readouterr().err


def test_running_a_finished_simulation_says_so():
    short = {"stage.press.duration": "2 us", "stage.press.move[0].displacement": ["0 mm", "-0.01 mm"]}
    sim = pulvis.Scene(SCENE, short).simulation(threads=1).run()
    for again in (sim.run, lambda: sim.run_until("1 ms"), sim.step):
        with pytest.warns(RuntimeWarning, match="has finished") as told:
            again()
        assert told[0].filename == __file__
