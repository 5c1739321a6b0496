"""What pulvis.open and pulvis.open_study hand back, held to the files themselves."""
import csv
import json
import os
import re
import subprocess
import sys
import time
import urllib.request

import h5py
import numpy as np
import pytest
from conftest import PROGRAM, SCENE, SOURCE

import pulvis


def test_the_history_is_a_table_over_time_with_units(compact):
    run = pulvis.open(compact)
    history = run.history
    with open(compact / "history.csv", encoding="utf-8") as file:
        head, *rows = list(csv.reader(file))
    assert {f"{name} [{run.units[name]}]" for name in run.names} == set(head)
    assert history.index.name == "time" and history.attrs["units"]["tool/top/force_y"] == "N"
    assert history.attrs["units"]["time"] == "s"
    column = head.index("tool/top/force_y [N]")
    np.testing.assert_allclose(history["tool/top/force_y"], [float(row[column]) for row in rows], rtol=1e-8)
    np.testing.assert_array_equal(run.series("tool/top/force_y"), history["tool/top/force_y"])
    assert len(history) == len(rows) and np.all(np.diff(history.index) >= 0)


def test_frames_have_fields_of_their_places(compact):
    run = pulvis.open(compact)
    assert len(run.frames) == 5 and run.frames[0].step == 0 and run.frames[-1].time == pytest.approx(20e-6)
    frame = run.frame(-1)
    with h5py.File(compact / "run.h5") as file:
        last = file["frames/000004"]
        np.testing.assert_array_equal(frame.field("effective_stress"), last["effective_stress"][()])
        np.testing.assert_array_equal(frame.nodes, last["position"][()])
        assert frame.field("velocity").shape == frame.nodes.shape
    assert frame.field("effective_stress").shape == (len(run.mesh.cells),) and frame.unit("effective_stress") == "Pa"
    assert run.mesh.cells.max() < len(run.mesh.reference) == len(run.mesh.node_particle)
    particles = frame.particles
    assert len(particles) == 25 and particles.index.name == "particle"
    assert particles.attrs["units"]["particle_stress:1"] == "Pa"
    assert particles["coordination"].max() == 4


def test_the_network_has_the_contacts_of_the_frame(compact):
    run = pulvis.open(compact)
    pairs, tools = run.network(), run.network(tools=True)
    assert 20 <= len(pairs) <= 40  # of a lattice of 5 x 5
    assert pairs.attrs["units"]["normal_force"] == "N"
    length = np.hypot(pairs["normal_x"], pairs["normal_y"])
    np.testing.assert_allclose(length, 1, atol=1e-12)
    along = pairs["force_x"] * pairs["normal_x"] + pairs["force_y"] * pairs["normal_y"]
    np.testing.assert_allclose(along, pairs["normal_force"], atol=1e-9 * pairs["normal_force"].max())
    touched = np.bincount(np.concatenate([pairs["first"], pairs["second"]]), minlength=25)
    np.testing.assert_array_equal(touched, run.frame(-1).particles["coordination"])
    assert tools["second"].between(0, 3).all()


def test_tags_of_particles_are_named(tagged):
    run = pulvis.open(tagged)
    particles = run.frame(0).particles
    assert list(particles["material"][:3]) == ["steel", "copper", "steel"]
    assert set(particles["class"]) == {"disc"} and list(particles["number"]) == list(range(25))
    np.testing.assert_array_equal(run.frame(-1).field("material"), np.arange(25) % 2)


def test_what_a_run_was_and_came_to(compact):
    run = pulvis.open(compact)
    summary = json.loads((compact / "summary.json").read_text(encoding="utf-8"))
    assert run.summary == summary and run.outcome == "done" and run.hash == summary["state_hash"]
    assert run.scene_hash == summary["scene_hash"] and run.title == summary["title"]
    assert run.scene["stage"][0]["duration"] == "20 us" and "20 us" in run.scene_text
    assert run.calibration is None and not run.loops and not run.images


def begun(folder):
    """The run, or None as long as it has no frame."""
    try:
        run = pulvis.open(folder) if (folder / "run.h5").exists() else None
    except pulvis.RunError as early:
        assert "run.h5" in str(early)
        return None
    return run if run and run.frames else None


def test_a_run_that_is_still_being_written_can_be_read(tmp_path):
    folder = tmp_path / "run"
    process = subprocess.Popen([PROGRAM, "run", SCENE, "-o", folder, "--threads", "1", "--quiet"])
    try:
        deadline = time.monotonic() + 120
        run = None
        while time.monotonic() < deadline:
            run = run.refresh() if run else begun(folder)
            if run and len(run.frames) >= 3:
                break
            time.sleep(0.05)
        assert process.poll() is None, "the run was over too soon to say anything"
        assert len(run.frames) >= 3 and run.outcome == "running" and run.hash is None
        assert len(run.history) >= 1 and np.isfinite(run.frame(-1).field("effective_stress")).all()
        assert run.frame(-1).time <= 2.8e-3
    finally:
        process.terminate()
        process.wait(timeout=60)
    assert pulvis.open(folder).outcome in ("interrupted", "running")


# What is looked at is not in the way of the run that goes on from there, whose file it is.
def test_an_interrupted_run_that_is_open_is_resumed(tmp_path):
    folder = tmp_path / "run"
    with pulvis.Scene(SCENE, {"output.frames": 40}).simulation(folder=folder) as sim:
        sim.step(2000)
    run = pulvis.open(folder)
    assert run.outcome == "interrupted" and len(run.frames) > 0
    before = [run.frame(k).field("effective_stress") for k in range(len(run.frames))]
    whole = pulvis.resume(folder).run()
    assert len(run.refresh().frames) > len(before) and run.outcome == "done" and run.hash == whole.hash
    for k, stress in enumerate(before):
        np.testing.assert_array_equal(run.frame(k).field("effective_stress"), stress)


# A reader that never waits: whatever it is between two frames or within one, what it sees is the run so far.
def test_what_is_read_while_it_is_written_is_the_beginning_of_the_end(tmp_path):
    folder = tmp_path / "run"
    words = ["--set", "output.frames=40", "--set", "output.samples=4000"]
    process = subprocess.Popen([PROGRAM, "run", SCENE, "-o", folder, "--threads", "1", "--quiet", *words])
    looks, run = [], None
    try:
        while process.poll() is None:
            run = run or begun(folder)
            if run is None:
                continue
            before = len(run.frames)
            run.refresh()
            assert len(run.frames) >= before
            looks.append((len(run.frames), {name: run.series(name) for name in run.names}))
    finally:
        process.kill()
        process.wait(timeout=60)
    end = pulvis.open(folder)
    assert end.outcome == "done" and len({frames for frames, _ in looks}) > 5
    for _, series in looks:
        for name, values in series.items():
            np.testing.assert_array_equal(values, end.series(name)[:len(values)], err_msg=name)


def test_each_look_at_a_run_that_goes_on_is_of_its_own(tmp_path):
    folder = tmp_path / "run"
    process = subprocess.Popen([PROGRAM, "run", SCENE, "-o", folder, "--threads", "1", "--quiet"])
    try:
        deadline, kept = time.monotonic() + 120, []
        while process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.1)
            if run := begun(folder):
                kept.append(run)
        assert process.wait(timeout=60) == 0
    finally:
        process.kill()
    counts = [len(run.frames) for run in kept]
    assert counts == sorted(counts) and len(set(counts)) > 3
    end = pulvis.open(folder)
    assert end.outcome == "done" and len(end.frames) == 51
    for run, count in zip(kept, counts):
        assert len(run.frames) == count and (run.hash is None or count == 51)
        np.testing.assert_array_equal(run.frame(-1).nodes, end.frame(count - 1).nodes)
    assert len(kept[0].refresh().frames) == 51 and kept[0].hash == end.hash


def test_what_is_no_run_is_refused_by_name(compact, study, tmp_path):
    for folder, says in ((tmp_path, "there is no run.h5"), (tmp_path / "none", "no such folder"),
                         (study, "pulvis.open_study")):
        with pytest.raises(pulvis.PulvisError, match=says) as refused:
            pulvis.open(folder)
        assert str(folder) in str(refused.value) and refused.value.file == folder
    (tmp_path / "run.h5").write_bytes(b"not HDF5")
    with pytest.raises(pulvis.RunError, match="run.h5"):
        pulvis.open(tmp_path)
    os.remove(tmp_path / "run.h5")
    os.mkfifo(tmp_path / "run.h5")
    with pytest.raises(pulvis.RunError, match="not a regular file"):
        pulvis.open(tmp_path)
    run = pulvis.open(compact)
    for wrong, says in ((lambda: run.frame(5), "there are 0 to 4"), (lambda: run.series("forces"), "tool/top/force_y"),
                        (lambda: run.frame(0).field("stres"), "effective_stress")):
        with pytest.raises(pulvis.RunError, match=says):
            wrong()


def test_arrays_need_no_pandas_and_tables_say_so(compact, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    run = pulvis.open(compact)
    assert run.series("dt").size and run.frame(-1).field("pressure").size and run.plot.forces()
    with pytest.raises(pulvis.RunError, match="apt install python3-pandas"):
        run.history  # pylint: disable=pointless-statement


def test_a_friction_loop_is_handed_back_way_by_way(loop):
    run = pulvis.open(loop)
    assert run.family == "afm" and run.calibration["k_n"] > 0
    (one,) = [found for found in run.loops][:1]
    for way, sign in ((one.trace, 1), (one.retrace, -1)):
        steps = np.diff(way.position)
        assert abs(np.sign(steps).sum()) == len(steps)
        np.testing.assert_array_equal(run.series(f"probe/force_{one.axis}")[way.rows], -way.force)
        assert sign * np.sign(steps[0]) == np.sign(np.diff(one.trace.position)[0])
    half = abs(np.median(one.trace.force) - np.median(one.retrace.force)) / 2
    assert half == pytest.approx(one.values["half_width"], rel=0.3)
    for way, name in ((one.trace, "trace"), (one.retrace, "retrace")):
        assert np.median(way.force) == pytest.approx(one.values[name], rel=0.3)


def test_a_force_curve_has_its_pull_off(pull_off):
    run = pulvis.open(pull_off)
    (curve,) = run.force_curves
    assert np.all(np.diff(curve.approach.position) > 0) and np.all(np.diff(curve.retract.position) < 0)
    # Between two samples, where the ball is released: as 3/2 pi w R says.
    assert -run.series("probe/lowest_force_z")[curve.retract.rows].min() == pytest.approx(curve.values["pull_off"])
    assert -curve.retract.force.min() <= curve.values["pull_off"] == pytest.approx(1.5 * np.pi * 0.01 * 5e-6, rel=1e-3)


def test_images_of_a_raster_have_their_size(raster):
    run = pulvis.open(raster)
    (action,) = run.images
    image = run.images[action]["topography_trace"]
    assert image.unit == "m" and image.values.ndim == 2 and image.pixel_width > 0
    assert set(run.images[action]) == {f"{channel}_{way}" for channel in ("topography", "deflection", "friction")
                                       for way in ("trace", "retrace")}


def test_a_study_is_a_table_of_its_runs(study):
    found = pulvis.open_study(study)
    runs = found.runs
    assert len(runs) == 4 and found.keys == ["contact.friction"]
    assert list(runs["contact.friction"]) == [0.1, 0.1, 0.3, 0.3] and list(runs["seed"]) == [1, 2, 1, 2]
    assert runs.attrs["units"]["peak/top_force"] == "N" and runs.attrs["units"]["wall_seconds"] == "s"
    means = runs.groupby("variation")["peak/top_force"].mean()
    np.testing.assert_allclose(found.values["peak/top_force"], means[found.values.index], rtol=1e-12)
    assert list(found.values["runs"]) == [2, 2] and (found.deviations["peak/top_force"] >= 0).all()
    assert found.run(1).title == found.run("friction=0.1,seed=2").title
    assert found.run(3).summary["relative_density"] == pytest.approx(runs["relative_density"].iloc[3], rel=1e-12)
    assert len(found.curves[0]["lines"]) == 2
    with pytest.raises(pulvis.RunError, match="there are 0 to 3"):
        found.run(4)


def test_what_is_no_study_is_refused(compact, tmp_path):
    with pytest.raises(pulvis.RunError, match="pulvis.open"):
        pulvis.open_study(compact)
    with pytest.raises(pulvis.RunError, match="no summary.json"):
        pulvis.open_study(tmp_path)


def test_varied_quantities_are_numbers_in_si():
    from pulvis.study import column_of

    values, unit = column_of(["0.5 ms", "20 us"])
    np.testing.assert_allclose(values, [5e-4, 2e-5])
    assert unit == "s"
    values, unit = column_of(["coarse", "fine"])
    assert list(values) == ["coarse", "fine"] and unit == ""


def test_the_examples_of_the_page_run(tagged, tmp_path, monkeypatch):
    (tmp_path / "runs").mkdir()
    (tmp_path / "runs/mine").symlink_to(tagged)
    monkeypatch.chdir(tmp_path)
    page = (SOURCE / "docs/python-results.md").read_text(encoding="utf-8")
    known = {}
    for example in re.findall(r"```python\n(.*?)```", page, re.S):
        exec(example, known)  # pylint: disable=exec-used
    assert set(known["mean"].index) == {"steel", "copper"} and len(known["strong"]) > 0 and known["work"] != 0
    assert (tmp_path / "compact.pdf").stat().st_size > 10_000
    for name in re.findall(r"`run\.plot\.(\w+)\(|`\.(\w+)\(", page.split("## Pictures")[1]):
        assert hasattr(known["run"].plot, name[0] or name[1]), name


def test_a_live_view_serves_the_page_of_a_run_until_it_is_closed(compact):
    view = pulvis.watch(compact)
    with urllib.request.urlopen(view.address) as page:
        assert b"Pulvis" in page.read()
    assert f'src="{view.address}"' in view._repr_html_()
    view.close()
    with pytest.raises(OSError):
        urllib.request.urlopen(view.address)
    with pytest.raises(pulvis.PulvisError, match="no such folder"):
        pulvis.watch(compact / "none")
