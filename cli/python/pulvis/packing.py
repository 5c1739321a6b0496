"""Packings on their own, without a run."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pulvis import _core
from pulvis.arguments import checked, checked_class
from pulvis.meshes import refuse_grains

if TYPE_CHECKING:
    from pulvis.scene import Scene


@checked_class
@dataclass(frozen=True)
class Packing:
    """The placed particles, in order of their numbers.

    ``centres`` [particles, 2] m, ``angles`` [particles] rad, ``classes`` [particles] indices into ``names``,
    ``areas`` [particles] m^2, ``radii`` [particles] m of discs of equal area, ``table`` the CSV text that
    ``kind = "csv"`` reads back bit for bit.
    """

    centres: np.ndarray
    angles: np.ndarray
    classes: np.ndarray
    names: list[str]
    areas: np.ndarray
    table: str
    _meshes: dict[int, dict[str, Any]]

    @property
    def radii(self) -> np.ndarray:
        """Radii of discs of equal area, m [particles]."""
        return np.sqrt(self.areas / np.pi)

    def __len__(self) -> int:
        return len(self.centres)

    def outline(self, number: int) -> np.ndarray:
        """Boundary nodes of a particle, counter-clockwise, m [nodes, 2]. Not of a particle of grains."""
        mesh = self._meshes[self.classes[number]]
        refuse_grains(mesh, "outline")
        points = mesh["nodes"][: mesh["boundary_nodes"]]
        c, s = np.cos(self.angles[number]), np.sin(self.angles[number])
        return points @ np.array([[c, s], [-s, c]]) + self.centres[number]

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the table."""
        with open(file, "w", encoding="utf-8") as out:
            out.write(self.table)


@checked_class
@dataclass(frozen=True)
class SolidPacking:
    """The placed particles in three dimensions, in order of their numbers.

    ``centres`` [particles, 3] m, ``rotations`` [particles, 4] quaternions w, x, y, z from a particle's body frame to the scene,
    ``classes`` [particles] indices into ``names``, ``volumes`` [particles] m^3, ``radii`` [particles] m of equal-volume spheres,
    ``table`` the CSV text that ``kind = "csv"`` reads back bit for bit.
    """

    centres: np.ndarray
    rotations: np.ndarray
    classes: np.ndarray
    names: list[str]
    volumes: np.ndarray
    table: str
    _meshes: dict[int, dict[str, Any]]

    @property
    def radii(self) -> np.ndarray:
        """Radii of spheres of equal volume, m [particles]."""
        return np.cbrt(self.volumes * 3 / (4 * np.pi))

    def __len__(self) -> int:
        return len(self.centres)

    def surface(self, number: int) -> np.ndarray:
        """Surface nodes of a particle, m [nodes, 3]; for their faces see `pulvis.mesh`."""
        mesh = self._meshes[self.classes[number]]
        w, axis = self.rotations[number][0], self.rotations[number][1:]
        points = mesh["nodes"][: mesh["surface_nodes"]]
        turned = points + 2 * np.cross(axis, np.cross(axis, points) + w * points)
        return turned + self.centres[number]

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the table."""
        with open(file, "w", encoding="utf-8") as out:
            out.write(self.table)


@checked
def pack(scene: Scene) -> Packing | SolidPacking:
    """The packing of a scene: `Packing`, or `SolidPacking` in three dimensions."""
    made = _core.packing(scene._core)
    meshes = {c: _core.mesh_of_class(scene._core, int(c)) for c in np.unique(made["classes"])}
    if "rotations" in made:
        volumes = np.array([meshes[c]["volume"] for c in made["classes"]])
        return SolidPacking(volumes=volumes, _meshes=meshes, **made)
    areas = np.array([meshes[c]["area"] for c in made["classes"]])
    return Packing(areas=areas, _meshes=meshes, **made)
