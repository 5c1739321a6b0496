"""Every notebook of docs/notebooks runs without an error; new ones are found by themselves."""
import ast
import re
import shutil

import nbformat
import pytest
from conftest import SOURCE
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

FOLDER = SOURCE / "docs/notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def execute(notebook, folder):
    """In a folder where scenes are at ../../scenes and ../../runs is nobody's."""
    resources = {"metadata": {"path": str(folder)}}
    NotebookClient(notebook, timeout=540, kernel_name="python3", resources=resources).execute()


def code_of(notebook):
    return "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "code")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path / "ipython"))
    monkeypatch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    (tmp_path / "scenes").symlink_to(SOURCE / "scenes")
    return shutil.copytree(FOLDER, tmp_path / "docs/notebooks")


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_a_notebook_runs(path, folder):
    execute(nbformat.read(path, 4), folder)


def test_a_notebook_that_fails_is_seen(folder):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("assert 1 + 1 == 3")])
    with pytest.raises(CellExecutionError, match="AssertionError"):
        execute(notebook, folder)


def test_there_are_notebooks_and_a_page_lists_them_all():
    listed = re.findall(r"\(([\w-]+\.ipynb)\)", (FOLDER / "README.md").read_text())
    assert listed == [path.name for path in NOTEBOOKS] and len(listed) >= 6


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_a_notebook_checks_what_it_shows(path):
    notebook = nbformat.read(path, 4)
    nbformat.validate(notebook)
    statements = ast.walk(ast.parse(code_of(notebook)))
    assert sum(isinstance(one, ast.Assert) for one in statements) >= 3
    assert sum(cell.cell_type == "markdown" for cell in notebook.cells) >= 4


def test_stored_outputs_are_small_whole_and_of_no_place():
    assert sum(path.stat().st_size for path in NOTEBOOKS) < 1_000_000
    for path in NOTEBOOKS:
        for cell in nbformat.read(path, 4).cells:
            for output in cell.get("outputs", []):
                assert output.output_type != "error", path.name
                text = output.get("text", "") + str(output.get("data", {}).get("text/plain", ""))
                assert not re.search(r"(^|[\s'\"])/\w+/", text), f"{path.name}: {text}"
