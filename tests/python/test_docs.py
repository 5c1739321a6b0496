"""The examples of the guides, docs/python*.md, and those in docstrings of the package."""
import doctest
import importlib
import inspect
import pkgutil
import re

import pytest
from conftest import SOURCE

import pulvis

GUIDES = {path.name: path for path in sorted((SOURCE / "docs").glob("python*.md"))}


@pytest.fixture
def beside_scenes(tmp_path, monkeypatch):
    """A folder where scenes are at scenes/ and what an example leaves harms nobody."""
    (tmp_path / "scenes").symlink_to(SOURCE / "scenes")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def code_of(guide):
    return "\n".join(re.findall(r"^```python\n(.*?)^```$", GUIDES[guide].read_text(), re.M | re.S))


def run_doctest(test):
    lines = []
    if doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test, out=lines.append).failed:
        pytest.fail("".join(lines))


def test_examples_of_the_guide(beside_scenes):
    test = doctest.DocTestParser().get_doctest(code_of("python.md"), {}, "python.md", str(GUIDES["python.md"]), 0)
    assert len(test.examples) > 30
    run_doctest(test)


def test_examples_of_results(beside_scenes, tagged):
    """Plain Python, for the run "runs/mine"."""
    (beside_scenes / "runs").mkdir()
    (beside_scenes / "runs/mine").symlink_to(tagged)
    names = {}
    exec(compile(code_of("python-results.md"), str(GUIDES["python-results.md"]), "exec"), names)
    assert (beside_scenes / "compact.pdf").stat().st_size > 10_000
    assert names["work"] != 0 and len(names["strong"]) > 0


def test_no_guide_is_left_out():
    assert set(GUIDES) == {"python.md", "python-results.md"}, "a new guide wants a test of its examples here"


def modules():
    return [one.name for one in pkgutil.walk_packages(pulvis.__path__, "pulvis.") if not one.name.endswith(("__main__", "_core"))]


@pytest.mark.parametrize("name", modules())
def test_examples_of_docstrings(name, beside_scenes):
    module = importlib.import_module(name)
    for test in doctest.DocTestFinder(exclude_empty=True).find(module):
        run_doctest(test)


def test_the_way_from_an_idea_to_a_figure(beside_scenes):
    """The section of the overview."""
    section = (SOURCE / "docs/overview.md").read_text().split("\n## From Python\n")[1].split("\n## ")[0]
    code = re.search(r"^```python\n(.*?)^```$", section, re.M | re.S)[1]
    assert inspect.cleandoc(code).startswith("import pulvis")
    exec(compile(code, "docs/overview.md", "exec"), {})
    assert (beside_scenes / "runs/mine/run.h5").is_file()
