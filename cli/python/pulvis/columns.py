"""Columns of a simulation as numpy arrays that share its memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from pulvis import _core
from pulvis.arguments import checked_class
from pulvis.errors import RunError


@dataclass(frozen=True)
class ColumnInfo:
    """Description of a column.

    ``numbers`` is the number of values per row, ``rows`` the current number of rows (including SIMD lanes without a
    particle), ``only_at_samples`` means that it is valid only in `on_sample` and `on_frame` callbacks.
    """

    name: str
    entity: str
    unit: str
    meaning: str
    numbers: int
    rows: int
    bytes: int
    of_particles: bool
    shares_memory: bool
    writable: bool
    only_at_samples: bool


@checked_class
class Column:
    """A column, accessed per particle (if it belongs to particles) or as one array.

    ``column[i]`` is the array [rows, numbers] of particle i, without a copy: its nodes, its elements, or a single
    row. ``column.blocks`` has all particles with the same mesh in one array, without a copy. ``numpy.asarray(column)``
    copies all rows, particle by particle, in the order of frame fields. For tools and contacts, ``column[i]`` is
    row i, and ``column.rows`` has all rows. Arrays keep the simulation alive; they always show the current step,
    whenever they are read. Those of `Simulation.writable` are copies, which the end of the ``with`` block checks and
    then writes.
    """

    def __init__(self, run: _core.Run, name: str, writable: bool = False) -> None:
        self.info = ColumnInfo(**run.column_info(name))
        self._run, self._writable = run, writable
        self._given: list[np.ndarray] = []
        # Within a `with` block: numbers, values, and the values as they were, of each block.
        self._drafts: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []
        self._places: dict[int, tuple[int, int, int]] = {}  # of each particle: block, chunk, lane
        self._began = 0  # number of steps

    name = property(lambda self: self.info.name)
    unit = property(lambda self: self.info.unit)
    meaning = property(lambda self: self.info.meaning)

    def __len__(self) -> int:
        return self._run.particles if self.info.of_particles else self.info.rows

    def __getitem__(self, number: int) -> np.ndarray:
        if not self.info.of_particles:
            return self.rows[number]
        if not -len(self) <= number < len(self):
            raise IndexError(f"particle {number}, allowed: 0 to {len(self) - 1}")
        number %= len(self)
        if not self._writable:
            return self._run.column_of_particle(self.name, number)
        block, chunk, lane = self._drafted()[1][number]
        return self._kept(self._drafts[block][1][chunk, lane])

    @property
    def rows(self) -> np.ndarray:
        """All rows [rows, numbers] of a column that does not belong to particles; a copy if ``info.shares_memory`` is
        False."""
        return self._run.column_rows(self.name)

    @property
    def blocks(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """Pairs of ``numbers`` [chunks, 8] and ``values`` [chunks, 8, rows, numbers]: particles that share a mesh.

        A number of -1 marks a lane without a particle. ``values`` shares the simulation's memory; of a writable column it
        is a copy.
        """
        if self._writable:
            return [(numbers, self._kept(values)) for numbers, values, _ in self._drafted()[0]]
        return self._run.column_blocks(self.name)

    def __array__(self, dtype: Any = None) -> np.ndarray:
        if not self.info.of_particles:
            return np.array(self.rows, dtype=dtype)
        parts = [np.empty(0)] * len(self)
        for numbers, values in self.blocks:
            for chunk, lane in zip(*np.nonzero(numbers >= 0)):
                parts[numbers[chunk, lane]] = values[chunk, lane]
        whole = np.concatenate(parts) if parts else np.empty((0, self.info.numbers))
        return whole if dtype is None else whole.astype(dtype)

    def _drafted(self):
        if not self._drafts:
            raise RunError(f"column '{self.name}' is written in a with block only, "
                           f"allowed: with sim.writable(\"{self.name}\") as column")
        return self._drafts, self._places

    def _kept(self, array: np.ndarray) -> np.ndarray:
        view = array.view()
        self._given.append(view)
        return view

    def __enter__(self) -> Column:
        if not self._writable:
            raise TypeError("allowed: with sim.writable(name) as column")
        blocks = self._run.column_blocks(self.name, True)  # raises at once if it is not writable
        self._drafts = [(numbers, values.copy(), values.copy()) for numbers, values in blocks]
        self._places = {int(numbers[chunk, lane]): (block, chunk, lane)
                        for block, (numbers, *_) in enumerate(self._drafts)
                        for chunk, lane in zip(*np.nonzero(numbers >= 0))}
        self._began = self._run.steps
        return self

    def __exit__(self, *error: object) -> None:
        """All of it is written, or nothing."""
        drafts, self._drafts, self._places = self._drafts, [], {}
        for array in self._given:
            array.flags.writeable = False
        self._given.clear()
        if self._run.steps != self._began:
            raise RunError(f"column '{self.name}': steps were taken within the with block; nothing of what was written is "
                           "kept, allowed: steps after it")
        for numbers, values, before in drafts:
            self._run.check_block(self.name, numbers, values, before)
        for (numbers, values, before), (_, memory) in zip(drafts, self._run.column_blocks(self.name, True)):
            changed = (values != before) & (numbers >= 0)[:, :, None, None]
            np.copyto(memory, values, where=changed)
        self._run.written(self.name)

    def __repr__(self) -> str:
        return f"<pulvis.Column {self.name} [{self.unit}]: {self.meaning}>"
