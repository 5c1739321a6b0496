"""Particle meshes on their own, without a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pulvis import _core
from pulvis.arguments import checked

if TYPE_CHECKING:
    from pulvis.scene import Scene


@dataclass(frozen=True)
class Mesh:
    """The undeformed mesh of a particle class, relative to the centroid of its outline.

    ``nodes`` [nodes, 2] m, of which the first ``boundary_nodes`` form the outline, counter-clockwise; ``quads``
    [elements, 4]; ``area`` m^2 of the true outline; ``min_corner_sine`` of the worst element, 1 for a rectangle;
    ``shortest_edge`` m.
    """

    name: str
    nodes: np.ndarray
    quads: np.ndarray
    boundary_nodes: int
    area: float
    min_corner_sine: float
    shortest_edge: float

    @property
    def outline(self) -> np.ndarray:
        """The boundary nodes, counter-clockwise, m [nodes, 2]."""
        return self.nodes[: self.boundary_nodes]


@dataclass(frozen=True)
class SolidMesh:
    """The undeformed mesh of a particle class in three dimensions, relative to its centre of volume.

    ``nodes`` [nodes, 3] m, of which the first ``surface_nodes`` are on the surface; ``hexahedra`` [elements, 8] in the order of
    VTK; ``faces`` [faces, 4] nodes of the element faces on the surface, counter-clockwise from outside; ``volume`` m^3 of the
    true shape; ``area`` m^2 of the surface.
    """

    name: str
    nodes: np.ndarray
    hexahedra: np.ndarray
    faces: np.ndarray
    surface_nodes: int
    volume: float
    area: float


def refuse_grains(found: dict[str, Any], wanted: str) -> None:
    """A run meshes the grains of a particle, and not the particle."""
    grains = found.get("grains")
    if grains:
        raise ValueError(f"particles of class '{found['name']}' consist of grains and have no {wanted} of their own, allowed: "
                         f"classes without grains, or those of its grains, '{grains[0]}' to '{grains[-1]}'")


def made(found: dict[str, Any]) -> Mesh | SolidMesh:
    if "hexahedra" in found:
        return SolidMesh(**found)
    refuse_grains(found, "mesh")
    return Mesh(**{key: value for key, value in found.items() if key != "grains"})


@checked
def mesh(scene: Scene, particle: str | int = 0) -> Mesh | SolidMesh:
    """The mesh of a particle class of a scene, by name or index: `Mesh`, or `SolidMesh` in three dimensions.

    A class with [particle.grains] has none. Each of its grains is a class with a mesh: "disc#2.7" is the seventh grain of the
    second variant of "disc". Its centroid is the origin.
    """
    if isinstance(particle, str):
        number = 0
        names: list[str] = []
        while True:
            try:
                found = _core.mesh_of_class(scene._core, number)
            except IndexError:
                raise KeyError(f"there is no class '{particle}', allowed: {', '.join(names)}") from None
            if found["name"] == particle:
                return made(found)
            names.append(found["name"])
            number += 1
    return made(_core.mesh_of_class(scene._core, particle))
