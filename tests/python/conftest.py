"""Paths, small scenes, and small runs that the tests read, made once by the program itself."""
import json
import os
import shutil
import subprocess
from pathlib import Path

import h5py
import matplotlib
import numpy as np
import pytest

import pulvis

matplotlib.use("Agg")

SOURCE = Path(os.environ.get("PULVIS_SOURCE", Path(__file__).resolve().parents[2]))
PROGRAM = os.environ.get("PULVIS_PROGRAM", SOURCE / "build/release/cli/pulvis")
SCENE = SOURCE / "scenes/compaction/regular-25.toml"
SHORT = ["stage.press.duration=20 us", "output.frames=4", 'stage.press.move[0].displacement=["0 mm", "-0.4 mm"]',
         "output.contacts=true", "output.density_cells=[3, 2]"]


def call(*words, code=0, cwd=None):
    """What the program says; `code` is what it must end with."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, cwd=cwd, check=False)
    assert done.returncode == code, f"{words}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


@pytest.fixture(scope="session")
def compact(tmp_path_factory):
    """A short compaction of 25 discs with contacts and local densities."""
    folder = tmp_path_factory.mktemp("runs") / "compact"
    call("run", SCENE, "-o", folder, "--threads", "1", *(word for one in SHORT for word in ("--set", one)))
    return folder


@pytest.fixture(scope="session")
def tagged(compact, tmp_path_factory):
    """The same with materials, classes and numbers of the particles, and with the tools' bodies."""
    folder = tmp_path_factory.mktemp("tagged") / "run"
    shutil.copytree(compact, folder)
    with h5py.File(folder / "run.h5", "r+") as run:
        count = int(run["mesh/node_particle"][()].max()) + 1
        for name, values, names in (("material", np.arange(count) % 2, "steel\ncopper"),
                                    ("class", np.zeros(count), "disc"), ("number", np.arange(count), "")):
            named = {"names": names} if names else {}
            put(run, f"particles/{name}", values.astype("i4"), unit="-", place="particle", components=1, **named)
        put(run, "tools/line_tool", np.repeat([0, 1], 4).astype("i4"))
        for frame in run["frames"].values():
            top = float(frame["position"][:, 1].max())
            corners = [[0, top], [0.05, top], [0.05, top + 5e-3], [0, top + 5e-3], [0, 0], [0.05, 0], [0.05, -5e-3], [0, -5e-3]]
            put(frame, "tools/outline", np.array(corners), unit="m", place="list", components=2)
    return folder


def put(group, name, values, **attrs):
    """A dataset, in the place of one that is there."""
    if name in group:
        del group[name]
    group.create_dataset(name, data=values).attrs.update(attrs)


def lever(name, tmp_path_factory):
    folder = tmp_path_factory.mktemp("levers") / name
    call("run", SOURCE / f"tests/keys/scenes/{name}.toml", "-o", folder, "--threads", "1")
    return folder


@pytest.fixture(scope="session")
def loop(tmp_path_factory):
    return lever("plane", tmp_path_factory)


@pytest.fixture(scope="session")
def pull_off(tmp_path_factory):
    return lever("jkr", tmp_path_factory)


@pytest.fixture(scope="session")
def raster(tmp_path_factory):
    return lever("raster", tmp_path_factory)


@pytest.fixture(scope="session")
def study(tmp_path_factory):
    """Two frictions, two seeds."""
    folder = tmp_path_factory.mktemp("studies")
    text = f'scene = "{SCENE}"\nseeds = [1, 2]\n[set]\n"stage.press.duration" = "20 us"\n' \
           '"stage.press.move[0].displacement" = ["0 mm", "-0.4 mm"]\noutput.frames = 2\noutput.samples = 40\n' \
           '[grid]\ncontact.friction = [0.1, 0.3]\n'
    (folder / "study.toml").write_text(text, encoding="utf-8")
    call("study", folder / "study.toml", "-o", folder / "out")
    return folder / "out"


def run_program(*words, **options):
    """The command line beside the package that is tested."""
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, **options)


def summary(folder):
    return json.loads((Path(folder) / "summary.json").read_text())


@pytest.fixture
def scenes():
    return SOURCE / "scenes"


@pytest.fixture
def make_cell(scenes):
    """One plastic disc in a die: a second or less."""
    return lambda **changes: pulvis.Scene(scenes / "compaction/unit-cell.toml", stage__press__duration="0.1 ms",
                                          output__samples=20, output__frames=4, **changes)


@pytest.fixture
def cell(make_cell):
    return make_cell()


@pytest.fixture
def program():
    return run_program


@pytest.fixture
def read_summary():
    return summary
