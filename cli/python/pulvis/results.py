"""Runs read from their folders: finished, aborted, or still being written. Everything is in SI units.

    run = pulvis.open("runs/mine")
    run.history["tool/top/force_y"]            # a column of a pandas DataFrame over time
    run.frame(-1).field("effective_stress")    # a numpy array, one value per element
    run.plot.field("effective_stress")

Reading needs numpy and h5py; pandas is needed only for DataFrames, matplotlib only for plots.
"""

from __future__ import annotations

import json
import os
import time
from collections import namedtuple
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from pulvis.arguments import checked
from pulvis.errors import RunError
from pulvis.frames import Densities, Frame, table

if TYPE_CHECKING:
    from pandas import DataFrame

    from pulvis.lever_results import ForceCurve, Image, Loop
    from pulvis.plot import Plot

Mesh = namedtuple("Mesh", "cells reference cell_particle node_particle")
Mesh.__doc__ = """The mesh of a run: `cells` [cells, 4 or 8] node numbers, `reference` [nodes, 2 or 3] m, the nodes
before the first step, and the particle that each cell and each node belongs to."""

_TICK = 0.01  # s; resolution of a file's modification time
_PATIENCE = 10.0  # s; timeout for a file that changes while it is read


@checked
def open(folder: str | os.PathLike[str]) -> Run:  # noqa: A001  (pulvis.open)
    """The run in this folder."""
    return Run(folder)


class Run:
    """A run folder. Data is as written at the time of opening; `refresh()` reads it again.

    A forked process shares the position in the open files with its parent: it opens the folder itself, or calls
    `refresh()`.
    """

    @checked
    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        self.refresh()

    def __repr__(self):
        return f"<Run {self.title!r} in {self.folder}: {self.outcome}, {len(self.frames)} frames>"

    def refresh(self) -> Run:
        """Reopens the files, to see new data of a run that is still being written."""
        # HDF5 follows file addresses that the writer may reuse in the meantime: data is valid only if the file did not
        # change until all of it had been read.
        deadline = time.monotonic() + _PATIENCE
        while True:
            before, error = self._last_change(), None
            is_settled = before is None or not 0 <= time.time() - before[0] / 1e9 < _TICK
            try:
                self._read()
            except (RunError, OSError, RuntimeError, KeyError, ValueError) as one:
                error = one
            if is_settled and self._last_change() == before:
                break
            if time.monotonic() > deadline:
                error = error or RunError(f"{self.folder}: it is being written faster than it can be read", self.folder)
                break
            time.sleep(_TICK / 5)
        if error:
            self._close()
            raise error
        return self

    def _last_change(self):
        try:
            status = (self.folder / "run.h5").stat()
        except OSError:
            return None
        return status.st_mtime_ns, status.st_size, status.st_ino

    def _read(self):
        self._close()
        self._process = os.getpid()
        self.summary = self._summary()
        self._file = self._opened()
        self.in_space = "mesh/hexahedra" in self.file and "particles" in self.file  # particles in three dimensions
        self.is_solid = "mesh/hexahedra" in self.file and not self.in_space  # a lever
        self.title = self.summary.get("title") or self.file.attrs.get("title") or self.folder.name
        whole = [name for name in sorted(self.file.get("frames", []))
                 if self.file["frames"][name].attrs.get("complete", 0) == 1]
        self.frames = [Frame(self, name, number) for number, name in enumerate(whole)]
        self._series: dict[str, h5py.Dataset] = {}
        self._units: dict[str, str] = {}
        self._labels: dict[str, str] = {}
        self._values: dict[str, np.ndarray] = {}  # for a run in progress: its history moves within the file
        self._mesh: Mesh | None = None
        if "history" in self.file:
            self.file["history"].visititems(self._keep_series)

    def _close(self):
        for one in (getattr(self, "_file", None), getattr(self, "_stream", None)):
            if one:
                one.close()
        self._file = self._stream = None

    def _require_own_process(self):
        if self._process != os.getpid():
            raise RunError(f"{self.folder}: opened by process {self._process}; process {os.getpid()} is a fork of it and shares "
                           "its files; allowed: pulvis.open in this process", self.folder)

    @property
    def file(self) -> h5py.File:
        """`run.h5`."""
        self._require_own_process()
        return self._file

    def _opened(self):
        path = self.folder / "run.h5"
        if not self.folder.is_dir():
            raise RunError(f"{self.folder}: no such folder", self.folder)
        if not path.exists():
            study = (self.folder / "study.csv").exists()
            raise RunError(f"{self.folder}: not a run: there is no run.h5 in it"
                           + (" (it is a study: pulvis.open_study)" if study else ""), self.folder)
        if not path.is_file():
            raise RunError(f"{path}: not a regular file", path)  # opening a named pipe would block until a writer appears
        try:
            if self.summary.get("outcome") != "done":
                # HDF5 shares cached metadata between all handles of a process that open the same file name. For a run
                # in progress or resumable, each reader needs an independent view.
                self._stream = path.open("rb", buffering=0)
            file = h5py.File(self._stream or path, "r")
        except OSError as error:
            raise RunError(f"{path}: {error}", path) from error
        if "mesh" not in file:
            file.close()
            raise RunError(f"{path}: not written by pulvis: it has no /mesh", path)
        return file

    def _summary(self):
        path = self.folder / "summary.json"
        if not path.is_file():
            return {}
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise RunError(f"{path}: {error}", path) from error

    def _keep_series(self, name, item):
        if isinstance(item, h5py.Dataset):
            self._series[name] = item
            self._units[name] = item.attrs["unit"]
            if "label" in item.attrs:  # not in runs of older versions
                self._labels[name] = item.attrs["label"]
            if self.outcome == "running":
                self._values[name] = item[()]

    @property
    def family(self) -> str:
        """"afm" for a lever; "compaction" for powders, also if they are sheared."""
        return self.summary.get("family") or ("afm" if self.is_solid else "compaction")

    @property
    def outcome(self) -> str:
        """"done", "interrupted" or an error description; "running" until one of these is written."""
        return self.summary.get("outcome") or self.file.attrs.get("outcome") or "running"

    @property
    def hash(self) -> str | None:
        """Hash of the final state: bitwise identical states have equal hashes. None before the end."""
        return self.summary.get("state_hash")

    @property
    def scene_hash(self) -> str:
        """Hash of the scene as it was run: equivalent scenes have equal hashes."""
        return str(self.file.attrs["scene_hash"])

    @property
    def scene_text(self) -> str:
        """The scene as it was run, including overrides (TOML)."""
        path = self.folder / "scene.toml"
        if not path.is_file():
            raise RunError(f"{self.folder}: there is no scene.toml", path)
        return path.read_text(encoding="utf-8")

    @property
    def scene(self) -> dict[str, Any]:
        """The same as a dict."""
        import tomllib

        return tomllib.loads(self.scene_text)

    @property
    def mesh(self) -> Mesh:
        """The mesh on whose nodes and cells the fields are defined."""
        if self._mesh is None:
            of = self.file["mesh"]
            cells = of["hexahedra" if "hexahedra" in of else "quads"][()]
            self._mesh = Mesh(cells, *(of[name][()] for name in ("reference", "cell_particle", "node_particle")))
        return self._mesh

    @property
    def names(self) -> list[str]:
        """Names of the history series."""
        return list(self._series)

    @property
    def units(self) -> dict[str, str]:
        """Unit of each series."""
        return dict(self._units)

    @property
    def labels(self) -> dict[str, str]:
        r"""Words and symbol of each series and field for axes, as "relative density $\rho$"; empty for runs of older versions."""
        fields = [*self.file.get("particles", {}).items(), *(self.frames[-1].group.items() if self.frames else ())]
        return {name: item.attrs["label"] for name, item in fields if "label" in item.attrs} | self._labels

    def has(self, name: str) -> bool:
        """Whether a series of this name exists."""
        return name in self._series

    def dataset(self, name: str) -> h5py.Dataset:
        """The dataset of a series."""
        self._require_own_process()
        if name not in self._series:
            raise RunError(f"no series {name}; there are: {', '.join(sorted(self._series)) or 'none'}", self.folder)
        return self._series[name]

    def series(self, name: str) -> np.ndarray:
        """Values of a history series in SI units: [samples]."""
        values = self._values[name] if name in self._values else self.dataset(name)[()]
        times = self._values.get("time", self._series.get("time", []))
        return values[:len(times)]

    def unit(self, name: str) -> str:
        """Unit of a series."""
        self.dataset(name)  # raises if there is no such series
        return self._units[name]

    @property
    def history(self) -> DataFrame:
        """DataFrame of all series over time (s; for a lever: completed actions); `attrs["units"]` holds the units."""
        columns = {name: (self.series(name), self.unit(name)) for name in self._series if name != "time"}
        frame = table(columns, self.series("time") if self.has("time") else None, "time")
        frame.attrs["units"]["time"] = self.unit("time") if self.has("time") else "s"
        return frame

    def frame(self, number: int | None = None) -> Frame:
        """A frame by number, counted from 0; negative numbers count from the end. Default: the last."""
        count = len(self.frames)
        number = -1 if number is None else number
        if not isinstance(number, (int, np.integer)) or not -count <= number < count:
            there = f"there are 0 to {count - 1}" if count else "there is none"
            raise RunError(f"frame {number!r}: {there}", self.folder)
        return self.frames[number]

    def density(self, frame: int = -1) -> Densities:
        """Local densities of a frame: see Frame.density."""
        return self.frame(frame).density()

    def network(self, frame: int = -1, tools: bool = False) -> DataFrame:
        """The contacts of a frame: see Frame.network."""
        return self.frame(frame).network(tools)

    def bonds(self, frame: int = -1) -> DataFrame:
        """The bonds of a frame: see Frame.bonds."""
        return self.frame(frame).bonds()

    def fragments(self, frame: int = -1) -> DataFrame:
        """The fragments of a frame: see Frame.fragments."""
        return self.frame(frame).fragments()

    def cracks(self) -> DataFrame:
        """DataFrame of all bonded points that broke, in order: `time`, `x`, `particle`, `shear`, `length` or `area` ..."""
        if "cracks" not in self.file:
            raise RunError(f"{self.folder} has no cracks: the scene needs [[bond]] of origin initial or pressed",
                           self.folder, key="bond")
        columns = {name: (data[()], data.attrs["unit"]) for name, data in self.file["cracks"].items()}
        return table(columns, name="crack")

    @checked
    def write_xyz(self, path: str | os.PathLike[str], frame: int | None = None) -> None:
        """Writes the particles of all frames, or of one, as extended XYZ for OVITO: places, semi-axes, orientations, stresses."""
        from pulvis.particle_table import write_xyz

        write_xyz(self, path, frame)

    @property
    def calibration(self) -> dict[str, Any] | None:
        """Lever only: stiffnesses, sensitivities, closed-form values. None for other runs."""
        return self.summary.get("calibration")

    @property
    def loops(self) -> list[Loop]:
        """Lever only: friction loops (lever_results.Loop)."""
        from pulvis.lever_results import loops_of

        return loops_of(self)

    @property
    def force_curves(self) -> list[ForceCurve]:
        """Lever only: force curves (lever_results.ForceCurve)."""
        from pulvis.lever_results import force_curves_of

        return force_curves_of(self)

    @property
    def images(self) -> dict[str, dict[str, Image]]:
        """Raster scans: {action: {"topography_trace": lever_results.Image, ...}}."""
        from pulvis.lever_results import images_of

        return images_of(self)

    @property
    def plot(self) -> Plot:
        """Plots: run.plot.forces(), .field("effective_stress") ... (pulvis.plot.Plot)."""
        from pulvis.plot import Plot

        return Plot(self)

    def _repr_html_(self):
        from pulvis.plot import html_of

        return html_of(self)

    def _repr_png_(self):
        from pulvis.plot import png_of

        return png_of(self)
