"""The package in a source folder that is not built yet."""
import os
import subprocess
import sys

PROGRAM = """
import pulvis
pulvis.open, pulvis.open_study, pulvis.PulvisError
for name in ("Scene", "Simulation", "Lever", "Column", "mesh", "pack", "resume"):
    try:
        getattr(pulvis, name)
    except ImportError as error:
        print(error)
    else:
        raise AssertionError(name)
"""


def test_the_error_without_the_compiled_module_says_how_to_build_it():
    package = os.path.join(os.environ["PULVIS_SOURCE"], "cli/python")
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, cwd="/",
                          env={**os.environ, "PYTHONPATH": package, "PYTHONDONTWRITEBYTECODE": "1"})
    assert done.returncode == 0, done.stderr
    told = set(done.stdout.splitlines())
    assert len(told) == 1, told
    for word in ("not built for this Python", "./pulvis --version", "build/release/python", "pybind11-dev", "pip install ."):
        assert word in done.stdout


def test_its_module_is_found_where_it_is_built():
    from pulvis import _core
    assert _core.__name__ == "pulvis._core"


def test_it_tells_its_version(program):
    import pulvis
    assert pulvis.__version__ in program("--version").stdout and "__version__" in dir(pulvis)
