"""Columns of a simulation as numpy arrays that share its memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from pulvis import _core


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


class Column:
    """A column, accessed per particle (if it belongs to particles) or as one array.

    ``column[i]`` is the array [rows, numbers] of particle i, without a copy: its nodes, its elements, or a single
    row. ``column.blocks`` has all particles with the same mesh in one array, without a copy. ``numpy.asarray(column)``
    copies all rows, particle by particle, in the order of frame fields. For tools and contacts, ``column[i]`` is
    row i, and ``column.rows`` has all rows. Arrays keep the simulation alive; they always show the current step,
    whenever they are read.
    """

    def __init__(self, run: _core.Run, name: str, writable: bool = False) -> None:
        self.info = ColumnInfo(**run.column_info(name))
        self._run, self._writable = run, writable
        self._given: list[tuple[np.ndarray, np.ndarray]] = []

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
        return self._kept(self._run.column_of_particle(self.name, number % len(self), self._writable))

    @property
    def rows(self) -> np.ndarray:
        """All rows [rows, numbers] of a column that does not belong to particles; a copy if ``info.shares_memory`` is
        False."""
        return self._run.column_rows(self.name)

    @property
    def blocks(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """Pairs of ``numbers`` [chunks, 8] and ``values`` [chunks, 8, rows, numbers]: particles that share a mesh.

        A number of -1 marks a lane without a particle. ``values`` shares the simulation's memory.
        """
        return [(numbers, self._kept(values))
                for numbers, values in self._run.column_blocks(self.name, self._writable)]

    def __array__(self, dtype: Any = None) -> np.ndarray:
        if not self.info.of_particles:
            return np.array(self.rows, dtype=dtype)
        parts = [np.empty(0)] * len(self)
        for numbers, values in self._run.column_blocks(self.name, False):
            for chunk, lane in zip(*np.nonzero(numbers >= 0)):
                parts[numbers[chunk, lane]] = values[chunk, lane]
        whole = np.concatenate(parts) if parts else np.empty((0, self.info.numbers))
        return whole if dtype is None else whole.astype(dtype)

    def _kept(self, array: np.ndarray) -> np.ndarray:
        if self._writable:
            self._given.append((array, array.copy()))
        return array

    def __enter__(self) -> Column:
        if not self._writable:
            raise TypeError("allowed: with sim.writable(name) as column")
        self._run.column_blocks(self.name, True)  # raises at once if it is not writable
        return self

    def __exit__(self, *_: object) -> None:
        bad = self.info.entity == "node" and any(not np.isfinite(array).all() for array, _ in self._given)
        for array, before in self._given:
            if bad:
                array[...] = before
            array.flags.writeable = False
        self._given.clear()
        self._run.written(self.name)
        if bad:
            from pulvis.errors import RunError

            raise RunError(f"column '{self.name}': what was written is not finite")

    def __repr__(self) -> str:
        return f"<pulvis.Column {self.name} [{self.unit}]: {self.meaning}>"
