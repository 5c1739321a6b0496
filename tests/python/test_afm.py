"""Levers from Python: the figures, hash and files of the command line."""
import numpy as np
import pytest

import pulvis

COARSE = {"lever.elements_along": 8, "lever.elements_across": 4, "tip.elements": 2}


@pytest.fixture
def coarse(scenes):
    """A friction loop on a lever of few elements: as many increments as the shipped one has, in a tenth of the time."""
    return lambda: pulvis.Scene(scenes / "afm/loop-beam-0.toml",
                                **{key.replace(".", "__"): value for key, value in COARSE.items()})


def test_a_calibration_is_that_of_the_program(scenes, program, read_summary, tmp_path):
    file = scenes / "afm/calibration-beam.toml"
    done = program("run", file, "-o", tmp_path / "program", "--quiet")
    assert done.returncode == 0, done.stderr
    theirs = read_summary(tmp_path / "program")
    lever = pulvis.Scene(file).simulation(folder=tmp_path / "python").run()
    assert lever.hash == theirs["state_hash"] == read_summary(tmp_path / "python")["state_hash"]
    ours = pulvis.Scene(file).calibration()
    assert ours == lever.calibration
    assert ours["normal_stiffness"] == theirs["calibration"]["k_n"]
    assert ours["normal_stiffness"] > 0 and ours["lateral_stiffness"] > ours["normal_stiffness"]


def test_a_friction_loop_is_that_of_the_program(coarse, scenes, program, read_summary, tmp_path):
    sets = [word for key, value in COARSE.items() for word in ("--set", f"{key}={value}")]
    done = program("run", scenes / "afm/loop-beam-0.toml", *sets, "-o", tmp_path / "program", "--quiet")
    assert done.returncode == 0, done.stderr
    lever = coarse().simulation(folder=tmp_path / "python")
    told = []
    lever.on_sample(lambda one: told.append((one.actions, one.history["probe/force_z"][-1])))
    lever.run()
    assert lever.finished and lever.hash == read_summary(tmp_path / "program")["state_hash"]
    assert (tmp_path / "program/history.csv").read_text() == (tmp_path / "python/history.csv").read_text()
    assert len(told) == len(lever.history["actions"])
    assert np.array_equal([actions for actions, _ in told], lever.history["actions"])
    assert np.array_equal([force for _, force in told], lever.history["probe/force_z"])
    loop = lever.loops[-1]
    assert loop["half_width"] > 0 and loop["load"] > 0
    assert lever.figures["loop/half_width"] == loop["half_width"]
    with pytest.raises(pulvis.RunError, match="has already run"):
        lever.run()


def test_an_error_in_a_callback_ends_the_run_with_whole_files_and_it_is_resumed(coarse, read_summary, tmp_path):
    whole = coarse().simulation().run()
    lever = coarse().simulation(folder=tmp_path / "run")

    @lever.on_sample
    def _(lever):
        if len(lever.history["actions"]) == 5:
            raise ValueError("mine")

    with pytest.raises(ValueError, match="mine"):
        lever.run()
    assert read_summary(tmp_path / "run")["outcome"] == "interrupted"
    resumed = pulvis.resume(tmp_path / "run")
    assert not resumed.finished and resumed.run().finished and resumed.hash == whole.hash
    assert read_summary(tmp_path / "run")["outcome"] == "done"


def test_a_force_curve_has_its_pull_off(scenes):
    lever = pulvis.Scene(scenes.parent / "tests/keys/scenes/jkr.toml").simulation().run()
    curve = lever.force_curves[-1]
    assert curve["pull_off"] > 0 and curve["work"] > 0


def test_what_belongs_to_powders_is_refused(scenes):
    lever = pulvis.Scene(scenes / "afm/calibration-beam.toml")
    assert lever.is_afm
    with pytest.raises(pulvis.SceneError, match="no particles"):
        pulvis.pack(lever)
    with pytest.raises(pulvis.RunError, match="no lever to calibrate; allowed: a scene with family"):
        pulvis.Scene(scenes / "compaction/unit-cell.toml").calibration()


def files_of(folder):
    return (folder / "history.csv").read_text()


def test_a_programme_in_parts_keeps_its_bits_and_files(coarse, tmp_path):
    """Press, hold, scan: by increments, up to the end of an action, and to the end."""
    whole = coarse().simulation(folder=tmp_path / "whole").run()
    lever = coarse().simulation(folder=tmp_path / "parts")
    seen, frames = [], []
    lever.every(4, lambda one: seen.append(one.increments))
    lever.on_frame(lambda one: frames.append(one.actions))
    assert lever.step(3).increments == 3
    assert lever.actions == whole.history["actions"][3]
    lever.run_until(1)
    assert lever.actions == pytest.approx(1, abs=1e-9) and not lever.finished
    assert lever.step(0).run_until(0.5).actions == pytest.approx(1, abs=1e-9)
    lever.run()
    assert lever.finished and lever.hash == whole.hash
    assert files_of(tmp_path / "parts") == files_of(tmp_path / "whole")
    assert [frame.time for frame in lever.results.frames] == [frame.time for frame in whole.results.frames]
    assert seen == list(range(4, lever.increments + 1, 4))
    assert frames[0] == 0 and sorted(frames) == frames


def test_steps_beyond_the_end_finish_the_programme(coarse):
    lever = coarse().simulation()
    assert lever.step(10_000).finished
    with pytest.raises(pulvis.RunError, match="has already run"):
        lever.step()


def test_a_lever_is_stopped_and_goes_on(coarse):
    lever = coarse().simulation()
    lever.every(5, lambda one: one.stop() if one.increments == 5 else None)
    assert lever.run().increments == 5
    assert lever.run().hash == coarse().simulation().run().hash


def test_a_lever_that_is_closed_is_resumed(coarse, read_summary, tmp_path):
    with coarse().simulation(folder=tmp_path / "run") as lever:
        lever.step(6)
    assert read_summary(tmp_path / "run")["outcome"] == "interrupted"
    resumed = pulvis.resume(tmp_path / "run")
    assert not resumed.finished and resumed.run().finished and resumed.hash == coarse().simulation().run().hash


def test_a_resumed_lever_goes_on_in_parts(coarse, tmp_path):
    with coarse().simulation(folder=tmp_path / "run") as lever:
        lever.step(6)
    resumed = pulvis.resume(tmp_path / "run", checkpoint_every=1e9)
    assert resumed.increments == 6
    assert resumed.step(2).increments == 8 and not resumed.finished
    assert resumed.run().hash == coarse().simulation().run().hash


def test_a_lever_writes_its_checkpoints_when_it_is_told_to(coarse, tmp_path):
    lever = coarse().simulation(folder=tmp_path / "run", checkpoint_every=1e9, checkpoint_steps=4)
    kept = []
    lever.every(1, lambda one: kept.append(sorted(file.name for file in (tmp_path / "run").glob("checkpoint-*.h5"))))
    lever.step(6)
    assert [files[-1] for files in kept[3:]] == [f"checkpoint-{step:012}.h5" for step in (0, 4, 4)]
    with pytest.raises(ValueError, match="checkpoint_every: 0, allowed: > 0 s"):
        coarse().simulation(folder=tmp_path / "other", checkpoint_every=0).run()


def test_an_unknown_series_is_told_with_those_that_there_are(coarse):
    with pytest.raises(KeyError, match="no series 'force', allowed: actions, .*probe/force_z"):
        coarse().simulation().history["force"]


def test_a_callback_takes_no_increments_of_its_own_lever(coarse):
    lever = coarse().simulation()
    lever.on_sample(lambda lever: lever.step())
    with pytest.raises(pulvis.RunError, match="the lever is running"):
        lever.run()
