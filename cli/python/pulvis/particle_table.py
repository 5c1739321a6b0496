"""Particles as OVITO reads them: extended XYZ, with place, shape, orientation and stress of every particle in every frame.

A particle is the ellipsoid (in two dimensions the ellipse) with the area or volume and the second moments of its elements.
In SI units.
"""

from __future__ import annotations

import itertools
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pulvis.errors import RunError
from pulvis.frames import names_in

if TYPE_CHECKING:
    from pulvis.frames import Frame
    from pulvis.results import Run

ROUND = 0.01  # semi-axes that differ by less are equal: their directions are then those of the material
GAUSS = np.array([-1, 1]) / np.sqrt(3)
CORNERS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
TO_OVITO = [0, 1, 2, 3, 5, 4]  # xx yy zz xy yz zx; OVITO: xx yy zz xy xz yz


class Points:
    """Integration points of all elements: `owner` is the particle of each."""

    def __init__(self, run: Run) -> None:
        self.cells, owner = run.mesh.cells, run.mesh.cell_particle
        dimension = run.mesh.reference.shape[1]
        corners = CORNERS[:2**dimension, :dimension]
        at = np.array(list(itertools.product(GAUSS, repeat=dimension)))
        factors = 0.5 * (1 + at[:, None, :] * corners)  # [points, corners, axes]
        self.shapes = factors.prod(axis=2)
        self.slopes = np.stack([0.5 * corners[:, k] * np.delete(factors, k, axis=2).prod(axis=2) for k in range(dimension)], axis=2)
        self.count, self.owner_of_cell, self.points_per_cell = int(owner.max()) + 1, owner, len(at)
        self.owner = np.repeat(owner, len(at))

    def places(self, nodes: np.ndarray) -> np.ndarray:
        """Of the points, [points, axes], for these nodes."""
        return (self.shapes @ nodes[self.cells]).reshape(-1, nodes.shape[1])

    def volumes(self, nodes: np.ndarray) -> np.ndarray:
        """Area or volume that each point stands for."""
        corners = nodes[self.cells]
        along = [self.slopes[:, :, k] @ corners for k in range(nodes.shape[1])]
        if len(along) == 2:
            (a, b), (c, d) = (np.moveaxis(one, -1, 0) for one in along)
            return (a * d - b * c).ravel()
        return (np.cross(along[0], along[1]) * along[2]).sum(axis=-1).ravel()

    def sums(self, values: np.ndarray) -> np.ndarray:
        """Of the points of every particle."""
        of_cells = values.reshape(len(self.cells), self.points_per_cell, -1).sum(axis=1)
        sums = [np.bincount(self.owner_of_cell, column, minlength=self.count) for column in of_cells.T]
        return np.stack(sums, axis=1).reshape(self.count, *values.shape[1:])


def in_space(matrices: np.ndarray) -> np.ndarray:
    """Plane rotations [n, 2, 2] as rotations about z."""
    if matrices.shape[1] == 3:
        return matrices
    whole = np.tile(np.eye(3), (len(matrices), 1, 1))
    whole[:, :2, :2] = matrices
    return whole


def nearest_rotations(matrices: np.ndarray) -> np.ndarray:
    """The rotations of the polar decompositions of deformation gradients."""
    left, _, right = np.linalg.svd(matrices)
    left[..., -1] *= np.sign(np.linalg.det(left @ right))[:, None]
    return left @ right


def principal_axes(moments: np.ndarray, factor: float) -> tuple[np.ndarray, np.ndarray]:
    """Semi-axes and their directions (columns) of one ellipse or ellipsoid, the directions as close to the axes as possible.
    factor: of the square of a semi-axis and the moment along it."""
    values, vectors = np.linalg.eigh(moments)
    lengths = np.sqrt(factor * np.maximum(values, 0))
    places = range(len(lengths))
    order = max(itertools.permutations(places), key=lambda p: sum(vectors[k, p[k]]**2 for k in places))
    lengths, vectors = lengths[list(order)], vectors[:, list(order)]
    left = set(places)
    while left:  # directions of equal semi-axes may be turned among each other
        first = min(left)
        group = [k for k in left if abs(lengths[k] - lengths[first]) <= ROUND * lengths[first]]
        basis = vectors[:, group]
        one, _, other = np.linalg.svd(basis.T[:, group])
        vectors[:, group] = basis @ one @ other
        left -= set(group)
    if np.linalg.det(vectors) < 0:
        vectors[:, -1] *= -1
    return lengths, vectors


def quaternions(rotations: np.ndarray) -> np.ndarray:
    """x y z w of rotations [n, 3, 3], with w >= 0."""
    r = rotations
    trace = np.trace(r, axis1=1, axis2=2)
    # The largest of the four squares is the one to divide by.
    squares = np.stack([1 + 2 * r[:, k, k] - trace for k in range(3)] + [1 + trace], axis=1)
    rows = np.empty((len(r), 4, 4))
    for i, j in itertools.product(range(3), repeat=2):
        rows[:, i, j] = r[:, i, j] + r[:, j, i]
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        rows[:, k, 3] = rows[:, 3, k] = r[:, j, i] - r[:, i, j]
    for k in range(4):
        rows[:, k, k] = squares[:, k]
    found = rows[np.arange(len(r)), squares.argmax(axis=1)]
    found /= np.linalg.norm(found, axis=1, keepdims=True)
    return np.where(found[:, 3:] < 0, -found, found)


class Shapes:
    """The particles of a run before the first step, with which frames are compared."""

    def __init__(self, run: Run) -> None:
        self.points = Points(run)
        reference = run.mesh.reference
        self.volumes = self.points.volumes(reference)
        self.arms = self._about_centres(self.points.places(reference), self.volumes)[1]
        self.dimension = reference.shape[1]
        self.inverse = np.linalg.inv(self.products(self.arms, self.volumes[:, None] * self.arms))

    def _about_centres(self, places, volumes):
        total = self.points.sums(volumes)
        centres = self.points.sums(volumes[:, None] * places) / total[:, None]
        return centres, places - centres[self.points.owner]

    def rotations(self, nodes: np.ndarray) -> np.ndarray:
        """Of the material, from the deformation gradients that fit the particles best."""
        _, arms = self._about_centres(self.points.places(nodes), self.volumes)
        return nearest_rotations(self.products(arms, self.volumes[:, None] * self.arms) @ self.inverse)

    def products(self, one: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Sums of a b^T over the points of every particle."""
        shape = len(self.points.cells), self.points.points_per_cell, self.dimension
        of_cells = one.reshape(shape).transpose(0, 2, 1) @ other.reshape(shape)
        sums = [np.bincount(self.points.owner_of_cell, column, minlength=self.points.count)
                for column in of_cells.reshape(len(of_cells), -1).T]
        return np.stack(sums, axis=1).reshape(-1, self.dimension, self.dimension)

    def of(self, nodes: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Centres, semi-axes, their directions and rotations of the material, all in space."""
        volumes = self.points.volumes(nodes)
        centres, arms = self._about_centres(self.points.places(nodes), volumes)
        moments = self.products(arms, volumes[:, None] * arms)
        moments /= self.points.sums(volumes)[:, None, None]
        rotations = self.rotations(nodes)
        turned = rotations.transpose(0, 2, 1) @ moments @ rotations  # as seen by the material
        found = [principal_axes(one, self.dimension + 2) for one in turned]
        lengths = np.array([one for one, _ in found])
        axes = rotations @ np.array([one for _, one in found])
        if self.dimension == 2:
            centres = np.column_stack([centres, np.zeros(len(centres))])
            lengths = np.column_stack([lengths, np.sqrt(lengths.prod(axis=1))])
        return centres, lengths, in_space(axes), in_space(rotations)

    def stress(self, frame: Frame) -> np.ndarray | None:
        """Mean Cauchy stresses in OVITO's order, [particles, 6]: those of the run, else of the elements; None without any."""
        if "particle_stress" in frame:
            values = frame["particle_stress"][()]
        elif "stress" in frame:
            volumes = self.points.volumes(frame.nodes)
            of_points = np.repeat(frame["stress"][()], self.points.points_per_cell, axis=0)
            values = self.points.sums(volumes[:, None] * of_points) / self.points.sums(volumes)[:, None]
        else:
            return None
        return np.column_stack([values, np.zeros((len(values), 6 - values.shape[1]))])[:, TO_OVITO]


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Of stresses in OVITO's order."""
    normal, shear = stress[:, :3], stress[:, 3:]
    return np.sqrt(0.5 * ((normal - np.roll(normal, 1, axis=1))**2).sum(axis=1) + 3 * (shear**2).sum(axis=1))


def tags_of(run: Run, count: int) -> dict[str, np.ndarray]:
    """Number, material (as one word) and class of every particle; runs of older versions have only numbers."""
    of = run.file.get("particles", {})
    tags = {"id:I:1": of["number"][()] if "number" in of else np.arange(count), "species:S:1": np.full(count, "particle")}
    if "material" in of:
        words = [re.sub(r"\s+", "_", name) for name in names_in(of["material"])]
        tags["species:S:1"] = np.array(words)[of["material"][()]]
    if "class" in of:
        tags["class:I:1"] = of["class"][()]
    return tags


def box(frame: Frame) -> str:
    """The periodic cell; else the box around the nodes."""
    nodes = np.column_stack([frame.nodes, np.zeros((len(frame.nodes), 3 - frame.nodes.shape[1]))])
    origin, sides, periodic = nodes.min(axis=0), np.diag(np.ptp(nodes, axis=0)), "F F F"
    if "cell" in frame:
        corner, *vectors = frame["cell"][()]
        axes = len(corner)
        origin[:axes], sides[:axes, :axes] = corner, vectors
        periodic = " ".join("T" if k < axes else "F" for k in range(3))
    if sides[2, 2] == 0:  # a plane
        sides[2, 2] = 0.1 * np.linalg.norm(sides[0])
        origin[2] = -0.5 * sides[2, 2]
    words = " ".join(f"{side:.9g}" for side in sides.ravel()), " ".join(f"{one:.9g}" for one in origin)
    return f'Lattice="{words[0]}" Origin="{words[1]}" pbc="{periodic}"'


def text_of(frame: Frame, shapes: Shapes, words: dict[str, np.ndarray]) -> str:
    """One frame of the file."""
    centres, lengths, axes, rotations = shapes.of(frame.nodes)
    numbers = {"pos:R:3": centres, "aspherical_shape:R:3": lengths, "orientation:R:4": quaternions(axes),
               "rotation:R:4": quaternions(rotations)}
    stress = shapes.stress(frame)
    if stress is not None:
        numbers |= {"stress:R:6": stress, "von_mises:R:1": von_mises(stress)[:, None],
                    "pressure:R:1": -stress[:, :3].mean(axis=1)[:, None]}
    properties = ":".join([*words, *numbers])
    head = f'{len(centres)}\nProperties={properties} Time={frame.time:.9g} Step={frame.step} {box(frame)}\n'
    rows = np.column_stack([*numbers.values()])
    return head + "".join(" ".join([*map(str, before), *(f"{value:.9g}" for value in row)]) + "\n"
                          for *before, row in zip(*words.values(), rows))


def write_xyz(run: Run, path: str | os.PathLike[str], frame: int | None = None) -> None:
    """The particles of all frames, or of one, as extended XYZ."""
    if run.is_solid:
        raise RunError(f"{run.folder}: a lever has no particles to write as XYZ", run.folder)
    frames = run.frames if frame is None else [run.frame(frame)]
    if not frames:
        raise RunError(f"{run.folder}: there is no frame", run.folder)
    shapes = Shapes(run)
    words = tags_of(run, shapes.points.count)
    with Path(path).open("w", encoding="utf-8") as file:
        for one in frames:
            file.write(text_of(one, shapes, words))
