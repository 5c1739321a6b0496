"""run.vtkhdf and tools.vtkhdf: the frames of run.h5 in the format of VTK, wherever the folder is and however the run ended."""
import importlib.util
import shutil
import signal
import subprocess
import sys
import time

import h5py
import pytest
from conftest import PROGRAM, SCENE, SHORT, SOURCE, call

sys.path.insert(0, str(SOURCE / "tests"))
from vtk_hdf import check_run  # noqa: E402

HAS_VTK = importlib.util.find_spec("vtk") is not None


def short(folder, *more):
    return [PROGRAM, "run", SCENE, "-o", folder, "--threads", "1", *(word for one in SHORT for word in ("--set", one)), *more]


def test_the_plane_the_tools_and_a_moved_folder(compact, tmp_path, monkeypatch):
    assert len(check_run(compact, HAS_VTK)) == (4 if HAS_VTK else 2)
    shutil.copytree(compact, tmp_path / "moved")
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    check_run(tmp_path / "moved", HAS_VTK)
    with h5py.File(tmp_path / "moved/run.vtkhdf") as file:
        assert {source.file_name for source in file["VTKHDF/Points"].virtual_sources()} == {"run.h5"}


def test_nothing_is_stored_twice(compact):
    with h5py.File(compact / "run.vtkhdf") as file:
        root = file["VTKHDF"]
        for name in ("Points", "Connectivity", *(f"{group}/{field}" for group in ("PointData", "CellData") for field in root[group])):
            assert root[name].is_virtual and root[name].id.get_storage_size() == 0, name
        assert root["Types"].id.get_storage_size() == 0
    assert (compact / "run.vtkhdf").stat().st_size < 0.1 * (compact / "run.h5").stat().st_size


def test_a_lever(loop):
    assert len(check_run(loop, HAS_VTK)) >= 1


def test_space(tmp_path):
    call("run", SOURCE / "scenes/compaction-3d/one-sphere.toml", "-o", tmp_path / "run", "--threads", "1", "--set", "output.frames=3")
    check_run(tmp_path / "run", HAS_VTK)


def test_a_killed_run_and_a_resumed_one(tmp_path):
    folder = tmp_path / "run"
    more = ["--set", "output.frames=40", "--set", "stage.press.duration=60 us"]
    with subprocess.Popen(short(folder, *more), stdout=subprocess.DEVNULL) as run:
        deadline = time.monotonic() + 60
        while not (folder / "tools.vtkhdf").exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        time.sleep(0.3)
        run.send_signal(signal.SIGKILL)
    with h5py.File(folder / "run.vtkhdf") as file, h5py.File(folder / "run.h5") as results:
        named = {source.dset_name.split("/")[2] for source in file["VTKHDF/Points"].virtual_sources()}
        assert named <= set(results["frames"])
        assert file["VTKHDF/Steps"].attrs["NSteps"] == len(named)
    if list(folder.glob("checkpoint-*.h5")):
        call("resume", folder, "--threads", "1")
    else:
        subprocess.run([*short(folder, *more), "--overwrite"], check=True, stdout=subprocess.DEVNULL)
    check_run(folder)
