"""Paths, a small scene, and the program that the package is compared with."""
import json
import os
import subprocess
from pathlib import Path

import pytest

import pulvis

SOURCE = Path(__file__).parents[2]


def run_program(*words, **options):
    """The command line beside the package that is tested."""
    return subprocess.run([os.environ["PULVIS_PROGRAM"], *map(str, words)], capture_output=True, text=True, **options)


def summary(folder):
    return json.loads((Path(folder) / "summary.json").read_text())


@pytest.fixture
def scenes():
    return SOURCE / "scenes"


@pytest.fixture
def cell(scenes):
    """One plastic disc in a die: a second or less."""
    return pulvis.Scene(scenes / "compaction/unit-cell.toml", stage__press__duration="0.1 ms", output__samples=20,
                        output__frames=4)


@pytest.fixture
def program():
    return run_program


@pytest.fixture
def read_summary():
    return summary
