"""Pulvis from Python: the combined discrete/finite element method for powders.

Scenes and simulations are the same as on the command line: same compiled systems, same scene language, bitwise
identical results. Reading results (`pulvis.open`, `pulvis.open_study`) and plotting need no compiled module.
"""

import importlib
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # resolves the lazy names for type checkers and editors
    from pulvis.afm import Lever as Lever
    from pulvis.columns import Column as Column
    from pulvis.errors import (PulvisError as PulvisError, RangeError as RangeError, RunError as RunError,
                               SceneError as SceneError)
    from pulvis.live import LiveView as LiveView, watch as watch
    from pulvis.meshes import Mesh as Mesh, SolidMesh as SolidMesh, mesh as mesh
    from pulvis.packing import Packing as Packing, SolidPacking as SolidPacking, pack as pack
    from pulvis.results import Run as Run, open as open
    from pulvis.scene import Scene as Scene
    from pulvis.simulation import Simulation as Simulation, resume as resume
    from pulvis.study import Study as Study, open_study as open_study

__version__: str  # read on first use

# The module of each public name. A name is imported on first use: reading and plotting results need no compiled
# module, and no pandas unless a table is requested.
_HOMES = {
    "open": "pulvis.results",
    "Run": "pulvis.results",
    "open_study": "pulvis.study",
    "Study": "pulvis.study",
    "Scene": "pulvis.scene",
    "Simulation": "pulvis.simulation",
    "Column": "pulvis.columns",
    "resume": "pulvis.simulation",
    "Lever": "pulvis.afm",
    "pack": "pulvis.packing",
    "Packing": "pulvis.packing",
    "SolidPacking": "pulvis.packing",
    "Mesh": "pulvis.meshes",
    "SolidMesh": "pulvis.meshes",
    "mesh": "pulvis.meshes",
    "watch": "pulvis.live",
    "LiveView": "pulvis.live",
    "PulvisError": "pulvis.errors",
    "SceneError": "pulvis.errors",
    "RunError": "pulvis.errors",
    "RangeError": "pulvis.errors",
}

__all__ = sorted(_HOMES)


def _compiled():
    try:
        return importlib.import_module("pulvis._core")
    except ModuleNotFoundError as missing:
        if missing.name != "pulvis._core":
            raise
        version = "{}.{}".format(*sys.version_info)
        raise ImportError(
            f"the compiled module of pulvis is not built for this Python ({version}). In the source folder, "
            "./pulvis --version builds it into build/release/python, for /usr/bin/python3 (with the Debian packages "
            "python3-dev, pybind11-dev and python3-numpy, which it installs); pip install . builds it for the Python of "
            "this pip. Results are read and plotted without it.", name="pulvis._core") from None


def _version():
    """Of the compiled module; without it, of the installed package."""
    try:
        return _compiled().version
    except ImportError:
        from importlib import metadata
        try:
            return metadata.version("pulvis")
        except metadata.PackageNotFoundError:
            raise AttributeError("pulvis.__version__ is that of the compiled module, which is not built") from None


def __getattr__(name):
    if name == "_core":  # `from pulvis import _core`, before it is imported
        return _compiled()
    if name == "__version__":
        return _version()
    if name not in _HOMES:
        raise AttributeError(f"module 'pulvis' has no attribute '{name}'")
    value = getattr(importlib.import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted({*globals(), *__all__, "__version__"})
