"""Frames of runs: the state at one time, its fields, contacts, bonds and densities. In SI units."""

from __future__ import annotations

from collections import namedtuple
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from pulvis.errors import RunError

if TYPE_CHECKING:
    from pandas import DataFrame

Densities = namedtuple("Densities", "values lines")
Densities.__doc__ = """Relative densities of the cells of a grid: `values` [along x, y (, z)] and `lines`, the places between the
cells along each axis, m."""


def table(columns: dict[str, tuple[Any, str]], index: Any = None, name: str | None = None) -> DataFrame:
    """DataFrame from columns {name: (values, unit)}; `attrs["units"]` holds the units."""
    try:
        import pandas
    except ImportError as error:
        raise RunError("tables need pandas (Debian: apt install python3-pandas); series and fields do not") from error

    frame = pandas.DataFrame({key: values for key, (values, _) in columns.items()}, index=index)
    frame.index.name = name
    frame.attrs["units"] = {key: unit for key, (_, unit) in columns.items()}
    return frame


def names_in(dataset: h5py.Dataset) -> list[str]:
    """The names that the integers of a dataset index, or an empty list."""
    text = dataset.attrs.get("names", "")
    text = text.decode() if isinstance(text, bytes) else text
    return text.split("\n") if text else []


class Frame:
    """The state at one time: `time` in s (for a lever: completed actions), `step`, and fields."""

    def __init__(self, run, name, number):
        self._run, self._group, self.name, self.number = run, run.file["frames"][name], name, number
        self.attrs = self.group.attrs
        self.time, self.step = float(self.attrs["time"]), int(self.attrs["step"])

    def __repr__(self):
        return f"<Frame {self.number}: time {self.time:.6g}, step {self.step}>"

    @property
    def group(self) -> h5py.Group:
        """Its group in `run.h5`."""
        self._run._require_own_process()
        return self._group

    def __contains__(self, name):
        return name in self.group

    def __getitem__(self, name):
        """The dataset of a field."""
        return self.group[name]

    def __iter__(self):
        return iter(self.group)

    @property
    def fields(self) -> list[str]:
        """Names of the node, cell and particle fields."""
        return [name for name, item in self.group.items() if item.attrs.get("place") in ("node", "cell", "particle")]

    def dataset(self, name: str) -> h5py.Dataset:
        """The dataset of a field: from this frame, or from the run for constant fields."""
        for place in (self.group, self._run.file.get("particles", {})):
            if name in place and isinstance(place[name], h5py.Dataset):
                return place[name]
        known = [*self.fields, *self._run.file.get("particles", [])]
        raise RunError(f"no field {name}; there are: {', '.join(known) or 'none'}", self._run.folder)

    def field(self, name: str) -> np.ndarray:
        """Values of a field in SI units: [count], or [count, components]. `fields` lists the names."""
        data = self.dataset(name)
        count = int(data.attrs.get("components", 1))
        values = data[()]
        return values[:, :count] if values.ndim > 1 and data.attrs.get("place") == "node" else values

    def unit(self, name: str) -> str:
        """Unit of a field."""
        return self.dataset(name).attrs["unit"]

    @property
    def nodes(self) -> np.ndarray:
        """Node positions, m: [nodes, 2 or 3]."""
        return self.group["position"][()]

    @property
    def particles(self) -> DataFrame:
        """DataFrame of all particle fields; components become separate columns, name:1, name:2 ..."""
        columns, kept = {}, self._run.file.get("particles", {})
        for name in [*kept, *(n for n in self.fields if self.group[n].attrs["place"] == "particle")]:
            data, unit = self.dataset(name)[()], self.unit(name)
            if data.ndim == 1:
                names = names_in(self.dataset(name))
                columns[name] = (np.array(names, object)[data] if names else data, unit)
            else:
                columns.update({f"{name}:{k + 1}": (data[:, k], unit) for k in range(data.shape[1])})
        count = int(self._run.mesh.node_particle.max()) + 1
        return table(columns, np.arange(count), "particle")

    def density(self) -> Densities:
        """Relative densities of the grid cells: `values` [along x, y (, z)], NaN where a cell has no free space, and `lines`,
        the coordinates of the grid lines along each axis, m."""
        if "local_density" not in self.group:
            raise RunError(f"frame {self.number} has no local densities: the scene needs output.density_cells",
                           self._run.folder, key="output.density_cells")
        lines = tuple(self.group[f"density_grid/{axis}"][()] for axis in "xyz" if f"density_grid/{axis}" in self.group)
        cells = self.group["local_density"][()].reshape([len(one) - 1 for one in reversed(lines)])
        return Densities(cells.T, lines)

    def network(self, tools: bool = False) -> DataFrame:
        """DataFrame of the contacts between particles, or between particles and tools: `first`, `second` (particle
        numbers, or the tool's index in the scene), `x`, `y`, `normal_x`, `normal_y`, `normal_force` ...; in three
        dimensions `z`, `normal_z`, and `area` instead of `length`."""
        group = "tool_contacts" if tools else "contacts"
        if group not in self.group:
            raise RunError(f"frame {self.number} has no contacts: the scene needs output.contacts = true",
                           self._run.folder, key="output.contacts")
        ids = self.group[f"{group}/ids"][()]
        columns = {"first": (ids[:, 0], "-"), "second": (ids[:, 1], "-")}
        for name, data in self.group[group].items():
            if name == "ids":
                continue
            values, unit = data[()], data.attrs["unit"]
            parts = {name: values} if values.ndim == 1 else {
                (axis if name == "point" else f"{name}_{axis}"): values[:, k] for k, axis in zip(range(values.shape[1]), "xyz")}
            columns.update({key: (part, unit) for key, part in parts.items()})
        return table(columns, name="contact")

    def _listed(self, group: str) -> dict[str, tuple[Any, str]]:
        """Columns of a group of lists, as recorded by scenes with bonds that break."""
        if group not in self.group:
            raise RunError(f"frame {self.number} has no {group}: the scene needs [[bond]] of origin initial or pressed",
                           self._run.folder, key="bond")
        columns = {}
        for name, data in self.group[group].items():
            values, unit = data[()], data.attrs["unit"]
            if name == "ids":
                columns.update({"particle": (values[:, 0], unit), "other": (values[:, 1], unit)})
            elif values.ndim == 1:
                columns[name] = (values, unit)
            else:
                columns.update({axis if name == "position" else f"{name}_{axis}": (values[:, k], unit)
                                for k, axis in zip(range(values.shape[1]), "xyz")})
        return columns

    def bonds(self) -> DataFrame:
        """DataFrame of the bonds: `particle`, `other` (for a tool: -1 - its position in the scene), `damage`; in two
        dimensions lines along edges, `length` and `start_x` to `end_y`; in three faces, `area` and `x`, `y`, `z`."""
        return table(self._listed("bonds"), name="bond")

    def fragments(self) -> DataFrame:
        """DataFrame of the fragments: `number` (their lowest particle number), `particles`, and undeformed `area`, in
        three dimensions `volume`."""
        return table(self._listed("fragments"), name="fragment")
