"""Levers of an atomic force microscope: calibration, friction loops, force curves."""

from __future__ import annotations

import os
import weakref
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
    ``actions`` counts the actions done. However the programme is cut into parts, its increments are those of
    ``pulvis run``, and its final state has the same bits.

    An error in a callback or Ctrl-C ends a lever with a folder, whose files are whole then; `pulvis.resume` goes on.
    Without a folder it goes on itself.
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

    # ---- course -------------------------------------------------------------------------------------------------
    def run(self, progress: bool | None = None) -> Lever:
        """Runs the programme to its end, or only writes what the calibration found. Returns the lever."""
        del progress  # increments take too different times for a bar
        return self._go(self._core.run)

    def run_until(self, actions: float) -> Lever:
        """Goes on until so many actions of the programme are over: 2 for the first two, 2.5 for half of the third, too.

        A scan with its retrace is one action; the trace is over at its half. Returns the lever.
        """
        return self._go(lambda: self._core.run_until(float(actions)))

    def step(self, count: int = 1) -> Lever:
        """Makes `count` increments, fewer where the programme ends. Returns the lever."""
        return self._go(lambda: self._core.step(count))

    def _go(self, part):
        self._core.write_to("" if self.folder is None else os.fspath(self.folder), self._overwrite)
        part()
        return self

    def stop(self) -> None:
        """From a callback or another thread: `run` comes back when the present increment is made."""
        self._core.stop()

    def close(self) -> None:
        """Completes the files of a programme that has not ended, with a checkpoint; `pulvis.resume` goes on then."""
        self._core.close()

    def __enter__(self) -> Lever:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    # ---- callbacks ----------------------------------------------------------------------------------------------
    def on_sample(self, call: Callable[[float, dict[str, float]], Any]) -> Callable[[float, dict[str, float]], Any]:
        """Calls ``call(actions, row)`` after every increment: row is a dict of the series. Returns `call`."""
        names = [name for name, _, _ in _core.afm_series()]
        self._core.on_sample(lambda time, row: call(time, dict(zip(names, row))))
        return call

    def on_frame(self, call: Callable[[Lever], Any]) -> Callable[[Lever], Any]:
        """Calls ``call(lever)`` when a frame has been written."""
        self._core.on_frame(self._bound(call))
        return call

    def every(self, increments: int, call: Callable[[Lever], Any] | None = None) -> Callable[..., Any]:
        """Calls ``call(lever)`` after every increment whose number is a multiple of `increments`."""
        if call is None:
            return lambda call: self.every(increments, call)
        self._core.every(increments, self._bound(call))
        return call

    def _bound(self, call):
        this = weakref.ref(self)  # the compiled lever must not keep what keeps it
        return lambda: call(this())

    # ---- results ------------------------------------------------------------------------------------------------
    increments = property(lambda self: self._core.increments, doc="Increments made so far: int.")
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
    def actions(self) -> float:
        """Actions done so far, the part of the present one included."""
        times = self._core.sample_times
        return times[-1] if times else 0.0

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
