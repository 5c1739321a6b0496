"""Particle simulations: the same time steps as the command line, driven from Python."""

from __future__ import annotations

import os
import warnings
import weakref
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pulvis import _core
from pulvis.arguments import Quantity, checked, checked_class, in_si, shown
from pulvis.columns import Column, ColumnInfo
from pulvis.errors import Named
from pulvis.progress import progress_bar

if TYPE_CHECKING:
    from pandas import DataFrame

    from pulvis.results import Run
    from pulvis.scene import Scene


@checked_class
class Simulation:
    """A run of a scene, created by `Scene.simulation` or `pulvis.resume`.

    However a run is split into parts, and whatever is read in between, its steps are those of ``pulvis run`` and
    its final state is bitwise identical. Between two steps, positions are at t_n and velocities at t_(n-1/2); at a
    sample, forces, stresses and energies are at t_n, too.

    The GIL is released during steps, so simulations can run in parallel threads. Ctrl-C raises KeyboardInterrupt
    after the current step; if the simulation has a folder, a checkpoint is written first.
    """

    def __init__(self, run: _core.Run, scene: Scene, folder: str | os.PathLike[str] | None) -> None:
        self._run = run
        self.scene = scene
        self.folder = None if folder is None else Path(folder)

    # ---- running ------------------------------------------------------------------------------------------------
    def run(self, progress: bool | None = None) -> Simulation:
        """Runs to the end, or until `stop()` is called. Returns the simulation.

        Parameters
        ----------
        progress : bool, optional
            Show a progress bar (tqdm). None: only in a notebook.

        Raises
        ------
        RunError
            If the run fails its checks (docs/stability.md). Its files are complete even then.

        Warns
        -----
        RuntimeWarning
            If the simulation has finished: it does nothing.
        """
        self._warn_if_finished()
        with progress_bar(self, progress):
            self._run.run()
        return self

    def run_until(self, time: Quantity, progress: bool | None = None) -> Simulation:
        """Runs to the first step at or after `time` (seconds, ``"1 ms"``, or a pint quantity). Returns the simulation."""
        self._warn_if_finished()
        with progress_bar(self, progress):
            self._run.run_until(in_si("time", time, "s"))
        return self

    def step(self, count: int = 1) -> Simulation:
        """Takes `count` steps, or fewer if the run ends first. Returns the simulation."""
        self._warn_if_finished()
        self._run.step(count)
        return self

    def _warn_if_finished(self) -> None:
        if self.finished:
            warnings.warn(f"the simulation has finished ({self.outcome}), and nothing is run: make another one with "
                          "scene.simulation()", RuntimeWarning, stacklevel=4)  # checked_class adds a call

    def stop(self) -> None:
        """Makes `run` return after the current step. Call it from a callback or another thread."""
        self._run.stop()

    def checkpoint(self) -> None:
        """Writes a checkpoint into the folder, from which `pulvis.resume` can continue."""
        self._run.checkpoint()

    def close(self) -> None:
        """Writes a checkpoint and closes the files of an unfinished run; this releases the folder.

        In a fork of the process that made the simulation it does nothing: the files belong to the other process.
        """
        self._run.close()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    # ---- callbacks ----------------------------------------------------------------------------------------------
    def on_sample(self, call: Callable[[Simulation], Any]) -> Callable[[Simulation], Any]:
        """Calls ``call(simulation)`` at every sample (``output.samples``). Returns `call`: usable as a decorator."""
        self._run.on_sample(self._bound(call))
        return call

    def on_frame(self, call: Callable[[Simulation], Any]) -> Callable[[Simulation], Any]:
        """Calls ``call(simulation)`` after each frame is written (``output.frames``)."""
        self._run.on_frame(self._bound(call))
        return call

    def every(self, steps: int, call: Callable[[Simulation], Any] | None = None) -> Callable[..., Any]:
        """Calls ``call(simulation)`` between two steps, whenever the step number is a multiple of `steps`.

        Here, and when no `run` call is active, columns may be modified and tools driven.
        """
        if call is None:
            return lambda call: self.every(steps, call)
        self._run.every(steps, self._bound(call))
        return call

    def _bound(self, call):
        this = weakref.ref(self)  # avoids a reference cycle with the run
        return lambda: call(this())

    # ---- state --------------------------------------------------------------------------------------------------
    @property
    def time(self) -> float:
        """t_n in seconds."""
        return self._run.time

    @property
    def end(self) -> float:
        """Time in seconds at which the last stage ends."""
        return self._run.end

    @property
    def dt(self) -> float:
        """The next time step in seconds."""
        return self._run.dt

    @property
    def steps(self) -> int:
        """Steps taken so far, including those before a restart."""
        return self._run.steps

    @property
    def finished(self) -> bool:
        """Whether the run has ended; `outcome` tells how."""
        return self._run.outcome != ""

    @property
    def outcome(self) -> str:
        """"done", "stopped as expected: ...", "failed: ..."; empty while the run is in progress."""
        return self._run.outcome

    @property
    def hash(self) -> str:
        """Hash of the state, 16 hexadecimal digits; at the end, ``state_hash`` in summary.json."""
        return self._run.hash

    @property
    def threads(self) -> int:
        """Number of worker threads."""
        return self._run.threads

    @property
    def elements(self) -> int:
        """Number of finite elements."""
        return self._run.elements

    @property
    def particles(self) -> int:
        """Number of particles."""
        return self._run.particles

    @property
    def warnings(self) -> list[str]:
        """Warnings about the results of the run: list of str."""
        return self._run.warnings

    @property
    def verdicts(self) -> list[dict[str, Any]]:
        """Results of the scene's ``[[expect]]`` checks: dicts with ``what``, ``measured``, ``allowed``, ``met``."""
        return self._run.verdicts

    @property
    def driven(self) -> set[str]:
        """What was changed from Python: set of str. `pulvis resume` refuses to continue such a run."""
        return self._run.driven

    @property
    def history(self) -> History:
        """The samples taken by this object: a mapping from series names to arrays [samples], in SI units."""
        return History(self._run)

    @property
    def results(self) -> Run:
        """The run's folder, opened by `pulvis.open`."""
        if self.folder is None:
            raise _error("the simulation has no folder; allowed: scene.simulation(folder=...)")
        import pulvis

        return pulvis.open(self.folder)

    # ---- columns and tools --------------------------------------------------------------------------------------
    @property
    def columns(self) -> list[ColumnInfo]:
        """All columns of this scene: list of `ColumnInfo` (name, unit, meaning, ...)."""
        return [ColumnInfo(**one) for one in self._run.columns]

    def column(self, name: str) -> Column:
        """A column, sharing the simulation's memory, read-only: `Column`.

        `name` as in `columns`; ``"position"`` is short for ``"node.position"``; for tools it is ``"tool.position"``.
        """
        return Column(self._run, name)

    def writable(self, name: str) -> Column:
        """A column whose arrays may be modified, within a ``with`` statement:

        ``with sim.writable("velocity") as velocity: velocity[3][:, 1] -= 2.0``

        Only between two steps: in `every` callbacks and when no `run` call is active. Velocities may be modified,
        and of particles ``yield_stress``, ``hardening_modulus`` and ``mass_damping``. The end of the block writes them,
        all or none: values that the scene language refuses raise a RangeError. The energy balance of the run does not
        include these changes.
        """
        return Column(self._run, name, writable=True)

    @property
    def tools(self) -> dict[str, Tool]:
        """The tools by name: mapping to `Tool`."""
        return Named("tool", {name: Tool(self._run, name, i) for i, name in enumerate(self._run.tools)})

    @property
    def servos(self) -> dict[str, Servo]:
        """The servos, by the names of the tools whose force they control: mapping to `Servo`."""
        return Named("servo", {name: Servo(self._run, name) for name in self._run.servos})

    @property
    def mesh(self) -> dict[str, np.ndarray]:
        """``quads`` [elements, 4] of node numbers, ``cell_particle`` [elements], ``node_particle`` [nodes]: dict of
        arrays. Nodes are numbered as in ``numpy.asarray(sim.column("position"))``."""
        return self._run.mesh

    def __repr__(self) -> str:
        state = self.outcome or f"t = {self.time:.4g} s of {self.end:.4g} s"
        return f"<pulvis.Simulation {self.scene.title!r}, step {self.steps}, {state}>"


@checked_class
class Tool:
    """A tool of a simulation. Vectors have two components in 2D and three in 3D."""

    def __init__(self, run: _core.Run, name: str, row: int) -> None:
        self._run, self.name, self._row = run, name, row

    @property
    def position(self) -> np.ndarray:
        """A point on its surface, m [dimension]."""
        return self._run.column_rows("tool.position")[self._row][:self._run.dimension]

    @property
    def velocity(self) -> np.ndarray:
        """Mean over the last step, m/s [dimension]."""
        return self._run.column_rows("tool.velocity")[self._row][:self._run.dimension]

    @property
    def force(self) -> np.ndarray:
        """Force exerted by the particles on the tool, N [dimension]."""
        return self._run.column_rows("tool.force")[self._row][:self._run.dimension]

    def drive(self, velocity: Any) -> None:
        """Moves the tool at `velocity` from now on: (x, y), or (x, y, z) in three dimensions, in m/s,
        strings with units, or pint quantities.

        This overrides the motion of this tool in the scene's stages until the run ends or it is driven again; other
        tools are not affected. Checkpoints save the velocity, and `pulvis.resume` keeps it; the command ``resume``
        refuses such a run, since no script drives it there. Allowed only between two steps. For a tool with a servo,
        drive the force instead: `Simulation.servos`.
        """
        if isinstance(velocity, (str, bytes)) or not hasattr(velocity, "__iter__"):
            raise TypeError(f"Tool.drive: velocity = {shown(velocity)}, allowed: {self._run.dimension} components")
        parts = [in_si("Tool.drive: velocity", one, "m/s") for one in velocity]
        if len(parts) != self._run.dimension:
            raise ValueError(f"velocity: {len(parts)} components are given, allowed: {self._run.dimension}")
        self._run.drive_tool(self.name, parts + [0.0] * (3 - len(parts)))

    def __repr__(self) -> str:
        return f"<pulvis.Tool {self.name!r} at {tuple(self.position)} m>"


@checked_class
class Servo:
    """A servo of a simulation: it moves its tool to apply a prescribed force (``[[stage.servo]]``)."""

    def __init__(self, run: _core.Run, tool: str) -> None:
        self._run, self.tool = run, tool

    @property
    def target(self) -> float:
        """Target force in N at this time: from its ramp or from `drive`; 0 in stages without this servo."""
        return self._run.servo(self.tool)[0]

    @property
    def direction(self) -> np.ndarray:
        """Unit vector along which it pushes, - [dimension]."""
        return np.asarray(self._run.servo(self.tool)[1])[:self._run.dimension]

    @property
    def holds(self) -> bool:
        """Whether it is active in the current stage."""
        return self._run.servo(self.tool)[2]

    @property
    def measured(self) -> float:
        """Force in N that the powder exerts on the tool, opposite to the servo's direction."""
        row = self._run.tools.index(self.tool)
        return -float(self._run.column_rows("tool.force")[row][:self._run.dimension] @ self.direction)

    def drive(self, force: Quantity) -> None:
        """Sets the target to `force`, in N, a string with a unit, or a pint quantity, at once and without a ramp.

        This overrides the force in every stage that has this servo, until it is driven again, and the stage-end
        criterion ``tolerance``; ``response`` and ``max_speed`` stay. Allowed only between two steps. Checkpoints
        save the target, as they do for driven tools.
        """
        self._run.drive_servo(self.tool, in_si("Servo.drive: force", force, "N"))

    def __repr__(self) -> str:
        return f"<pulvis.Servo of {self.tool!r}, target {self.target:.6g} N>"


class History(Mapping[str, np.ndarray]):
    """Sampled series by name, including ``"time"``. `units`, `labels` (for axes) and `meanings` have the same names."""

    def __init__(self, run: _core.Run) -> None:
        self.units = {"time": "s"}
        self.labels = {"time": "time $t$"}
        self.meanings = {"time": "simulated time"}
        self._arrays = Named("series", {"time": run.sample_times})
        rows = run.samples
        for i, (name, unit, label, meaning) in enumerate(run.series):
            self._arrays[name] = rows[:, i]
            self.units[name] = unit
            self.labels[name] = label
            self.meanings[name] = meaning

    def __getitem__(self, name: str) -> np.ndarray:
        return self._arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    def frame(self) -> DataFrame:
        """The same as a pandas DataFrame; ``attrs["units"]`` holds the units."""
        import pandas

        frame = pandas.DataFrame({name: np.asarray(values) for name, values in self._arrays.items()})
        frame.attrs["units"] = dict(self.units)
        return frame


@checked
def resume(folder: str | os.PathLike[str], threads: int = 0, checkpoint_every: float = 60.0) -> Any:
    """A stopped run at its latest checkpoint: a `Simulation`, or a `Lever`. Its `run` continues it."""
    from pulvis.scene import Scene

    folder = Path(folder)
    if (folder / "scene.toml").is_file() and _core.is_lever_folder(os.fspath(folder)):
        from pulvis.afm import Lever

        return Lever.resumed(folder, threads, checkpoint_every)
    run = _core.Run.resume(os.fspath(folder), threads, checkpoint_every)
    return Simulation(run, Scene(folder / "scene.toml"), folder)


def _error(message):
    from pulvis.errors import RunError

    return RunError(message)
