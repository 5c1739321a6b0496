"""Types: the stub of the compiled module is that of the module, and the package agrees with itself and its stub."""
import ast
import re
import subprocess
import sys

import pytest
from conftest import SOURCE

import pulvis
from pulvis import _core

PACKAGE = SOURCE / "cli/python/pulvis"
STUB = ast.parse((PACKAGE / "_core.pyi").read_text())


def functions(body):
    return {one.name: one for one in body if isinstance(one, ast.FunctionDef)}


def classes():
    return {one.name: one for one in STUB.body if isinstance(one, ast.ClassDef)}


def own_names(thing):
    """What pybind11 put into a class, or the module has beside what every module has."""
    return {name for name in vars(thing) if not name.startswith("__") and not name.startswith("_pybind11")}


def is_property(function):
    return any(isinstance(one, ast.Name) and one.id == "property" for one in function.decorator_list)


def arguments_of_stub(function):
    """Names, and defaults as text, without self."""
    args = [*function.args.posonlyargs, *function.args.args]
    defaults = [None] * (len(args) - len(function.args.defaults)) + [ast.literal_eval(d) for d in function.args.defaults]
    return [(a.arg, d) for a, d in zip(args, defaults) if a.arg != "self"]


def arguments_of_module(function):
    """The same from the first line of pybind11's docstring: f(self: pulvis._core.Run, name: str, writable: bool = False)."""
    inside = re.match(r"\w+\((.*)\)(?: -> .*)?$", function.__doc__.splitlines()[0])[1]
    call = ast.parse(f"def f({re.sub(r'<[^>]*>', 'None', inside)}): pass").body[0]
    return arguments_of_stub(call)


@pytest.mark.parametrize("name", sorted(classes()))
def test_the_stub_has_the_members_of_a_class(name):
    stub, compiled = functions(classes()[name].body), getattr(_core, name)
    assert own_names(compiled) == set(stub) - {"__init__"}
    for member, function in stub.items():
        real = getattr(compiled, member)
        assert is_property(function) == isinstance(real, property), member
        if not is_property(function):
            assert arguments_of_stub(function) == arguments_of_module(real), f"{name}.{member}"


def test_the_stub_has_the_names_of_the_module():
    stub = functions(STUB.body)
    values = {one.target.id for one in STUB.body if isinstance(one, ast.AnnAssign)}
    assert own_names(_core) == {*stub, *classes(), *values}
    for name, function in stub.items():
        assert arguments_of_stub(function) == arguments_of_module(getattr(_core, name)), name
    for name in values:
        assert isinstance(getattr(_core, name), str), name


def test_every_public_name_is_there_documented_and_known_to_checkers():
    for name in pulvis.__all__:
        assert (getattr(pulvis, name).__doc__ or "").strip(), name
    tree = ast.parse((PACKAGE / "__init__.py").read_text())
    for_checkers = next(one for one in tree.body if isinstance(one, ast.If))
    assert {alias.asname: one.module for one in for_checkers.body for alias in one.names} == pulvis._HOMES


def public_functions(body):
    for one in body:
        if isinstance(one, ast.FunctionDef) and not one.name.startswith("_"):
            yield one
        elif isinstance(one, ast.ClassDef) and not one.name.startswith("_"):
            yield from public_functions(one.body)


@pytest.mark.parametrize("name", ["scene", "simulation", "columns", "afm", "packing", "meshes", "frames", "results", "study", "plot"])
def test_public_functions_have_types(name):
    functions = list(public_functions(ast.parse((PACKAGE / f"{name}.py").read_text()).body))
    assert functions
    for one in functions:
        args = [a for a in [*one.args.args, *one.args.kwonlyargs] if a.arg not in ("self", "cls")]
        assert one.returns is not None and all(a.annotation for a in args), f"{name}.{one.name}"


def test_mypy_finds_nothing(tmp_path):
    words = ["--ignore-missing-imports", "--no-error-summary", "--cache-dir", tmp_path, "--exclude", "figures|preview",
             "--follow-imports", "silent", "--check-untyped-defs", PACKAGE]
    done = subprocess.run([sys.executable, "-m", "mypy", *map(str, words)], capture_output=True, text=True, cwd=SOURCE)
    assert done.returncode == 0, done.stdout + done.stderr
