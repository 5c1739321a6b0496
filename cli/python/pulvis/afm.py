"""Cantilevers (levers) of an atomic force microscope: calibration, friction loops, force curves."""

from __future__ import annotations

import os
import weakref
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pulvis import _core
from pulvis.arguments import checked_class
from pulvis.errors import Named

if TYPE_CHECKING:
    from pulvis.results import Run
    from pulvis.scene import Scene


@checked_class
class Lever:
    """The lever of a scene of the family "afm". `Scene.simulation` creates and calibrates it.

    `run` steps through the programme, one equilibrium after another. A lever has no time: ``actions`` in `history`
    counts the completed actions instead. However the programme is split into parts, its increments are those of
    ``pulvis run``, and its final state is bitwise identical.

    An error in a callback or Ctrl-C ends a lever with a folder. Its files are complete, and `pulvis.resume` continues
    it. A lever without a folder can simply be run on.
    """

    def __init__(self, scene: Scene, threads: int = 0, folder: str | os.PathLike[str] | None = None,
                 overwrite: bool = False, checkpoint_every: float = 60.0, checkpoint_steps: int = 0,
                 core: _core.Lever | None = None) -> None:
        self.scene = scene
        self.folder = None if folder is None else Path(folder)
        self._files = (overwrite, checkpoint_every, checkpoint_steps)
        self._core = core or _core.Lever(scene._core, threads)

    @classmethod
    def resumed(cls, folder: str | os.PathLike[str], threads: int = 0, checkpoint_every: float = 60.0) -> Lever:
        """A stopped lever at its latest checkpoint; `run` continues it."""
        from pulvis.scene import Scene

        core = _core.resume_lever(os.fspath(folder), threads, checkpoint_every)
        return cls(Scene(Path(folder) / "scene.toml"), folder=folder, core=core)

    # ---- running ------------------------------------------------------------------------------------------------
    def run(self, progress: bool | None = None) -> Lever:
        """Runs the programme to its end; without a programme, only writes the calibration. Returns the lever."""
        del progress  # increments differ too much in duration for a progress bar
        return self._go(self._core.run)

    def run_until(self, actions: float) -> Lever:
        """Runs until this many actions of the programme are complete: 2, or 2.5 for half of the third as well.

        A scan with trace and retrace is one action; the trace ends halfway. Returns the lever.
        """
        return self._go(lambda: self._core.run_until(actions))

    def step(self, count: int = 1) -> Lever:
        """Takes `count` increments, or fewer if the programme ends first. Returns the lever."""
        return self._go(lambda: self._core.step(count))

    def _go(self, part):
        self._core.write_to("" if self.folder is None else os.fspath(self.folder), *self._files)
        part()
        return self

    def stop(self) -> None:
        """Makes `run` return after the current increment. Call it from a callback or another thread."""
        self._core.stop()

    def close(self) -> None:
        """Writes a checkpoint and closes the files of an unfinished programme; `pulvis.resume` can continue it."""
        self._core.close()

    def __enter__(self) -> Lever:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    # ---- callbacks ----------------------------------------------------------------------------------------------
    def on_sample(self, call: Callable[[Lever], Any]) -> Callable[[Lever], Any]:
        """Calls ``call(lever)`` after every increment: its values are the last of `history`. Returns `call`."""
        self._core.on_sample(self._bound(call))
        return call

    def on_frame(self, call: Callable[[Lever], Any]) -> Callable[[Lever], Any]:
        """Calls ``call(lever)`` after each frame is written."""
        self._core.on_frame(self._bound(call))
        return call

    def every(self, increments: int, call: Callable[[Lever], Any] | None = None) -> Callable[..., Any]:
        """Calls ``call(lever)`` after every increment whose number is a multiple of `increments`."""
        if call is None:
            return lambda call: self.every(increments, call)
        self._core.every(increments, self._bound(call))
        return call

    def _bound(self, call):
        this = weakref.ref(self)  # avoids a reference cycle with the compiled lever
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
        """Actions completed so far, including the fraction of the current one."""
        times = self._core.sample_times
        return times[-1] if times else 0.0

    @property
    def finished(self) -> bool:
        """Whether the whole programme has been run."""
        return self.outcome == "done"

    @property
    def history(self) -> Mapping[str, np.ndarray]:
        """Arrays [increments] by series name, SI units: dict; ``actions`` counts the completed actions."""
        rows = self._core.samples
        series = {"actions": np.asarray(self._core.sample_times)}
        series.update({name: rows[:, i] for i, (name, *_) in enumerate(_core.afm_series())})
        return Named("series", series)

    @property
    def results(self) -> Run:
        """The run's folder, opened by `pulvis.open`."""
        import pulvis
        from pulvis.errors import RunError

        if self.folder is None:
            raise RunError("the lever has no folder; allowed: scene.simulation(folder=...)")
        return pulvis.open(self.folder)
