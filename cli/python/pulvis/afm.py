"""Levers of an atomic force microscope: calibration, friction loops, force curves."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pulvis import _core

if TYPE_CHECKING:
    from pulvis.results import Run
    from pulvis.scene import Scene


class Lever:
    """A lever of a scene of the family "afm", calibrated when it is made; `Scene.simulation` makes it.

    `run` goes through its programme, an equilibrium after the other. A lever has no time: what `history` calls
    ``actions`` counts the actions done.
    """

    def __init__(self, scene: Scene, threads: int = 0, folder: str | os.PathLike[str] | None = None,
                 overwrite: bool = False, core: _core.Lever | None = None) -> None:
        self.scene = scene
        self.folder = None if folder is None else Path(folder)
        self._overwrite = overwrite
        self._core = core or _core.Lever(scene._core, threads)

    @classmethod
    def resumed(cls, folder: str | os.PathLike[str], threads: int = 0) -> Lever:
        from pulvis.scene import Scene

        core = _core.resume_lever(os.fspath(folder), threads)
        return cls(Scene(Path(folder) / "scene.toml"), folder=folder, core=core)

    def on_sample(self, call: Callable[[float, dict[str, float]], Any]) -> Callable[[float, dict[str, float]], Any]:
        """Calls ``call(actions, row)`` after every increment: row is a dict of the series. Returns `call`."""
        names = [name for name, _, _ in _core.afm_series()]
        self._core.on_sample(lambda time, row: call(time, dict(zip(names, row))))
        return call

    def run(self, progress: bool | None = None) -> Lever:
        """Runs the programme, or only writes what the calibration found. Returns the lever."""
        del progress  # increments take too different times for a bar
        self._core.run("" if self.folder is None else os.fspath(self.folder), self._overwrite)
        return self

    calibration = property(lambda self: self._core.calibration,
                           doc="Stiffnesses (N/m, N m/rad), sensitivities (m/V) and shares: dict.")
    loops = property(lambda self: self._core.loops,
                     doc="Friction loops of the run: list of dicts, forces in N (docs/afm.md).")
    force_curves = property(lambda self: self._core.curves,
                            doc="Force curves of the run: list of dicts, pull-off in N, work in J.")
    figures = property(lambda self: self._core.figures, doc="All figures of the run by name: dict of float.")
    hash = property(lambda self: self._core.hash, doc="``state_hash`` of summary.json.")
    outcome = property(lambda self: self._core.outcome, doc='"done", "interrupted" or "failed: ..."; else empty.')
    verdicts = property(lambda self: self._core.verdicts, doc="As of `Simulation.verdicts`.")
    elements = property(lambda self: self._core.elements, doc="Number of finite elements.")

    @property
    def finished(self) -> bool:
        """Whether the whole programme was run."""
        return self.outcome == "done"

    @property
    def history(self) -> dict[str, np.ndarray]:
        """Arrays [increments] by series, SI units: dict; ``actions`` counts the actions done."""
        rows = self._core.samples
        series = {"actions": np.asarray(self._core.sample_times)}
        series.update({name: rows[:, i] for i, (name, _, _) in enumerate(_core.afm_series())})
        return series

    @property
    def results(self) -> Run:
        """The run's folder, opened by `pulvis.open`."""
        import pulvis
        from pulvis.errors import RunError

        if self.folder is None:
            raise RunError("the lever has no folder; allowed: scene.simulation(folder=...)")
        return pulvis.open(self.folder)
