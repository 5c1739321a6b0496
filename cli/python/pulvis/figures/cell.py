"""The periodic cell in figures: every particle inside, and pale periodic images of those that cross a boundary."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

PALE = 0.35  # colour fraction that a periodic image keeps


def paler(colours):
    """Blends with white instead of using alpha, so that adjacent elements show no seam."""
    return 1 - PALE * (1 - np.asarray(colours)[..., :3])


def cell_edges(corner, vectors):
    """Of a cell in three dimensions, [12, 2, 3] m."""
    ends = np.array([[np.insert(at, axis, along) for along in (0, 1)] for axis in range(3) for at in np.ndindex(2, 2)])
    return corner + ends @ vectors


class Cell:
    """Where the particles of a frame are drawn. Without a periodic cell: at their positions, without images."""

    def __init__(self, run, frame):
        self.here = "cell" in frame
        self.owner = run.file["mesh/node_particle"][()]
        self.position = frame["position"][()]
        self.images = []  # positions of all nodes, particles visible in this image of the powder
        self.shift = np.zeros((self.owner.max() + 1, self.position.shape[1]))  # m, moves each particle into the cell
        if self.here:
            self.corner, self.vectors = frame["cell"][0], frame["cell"][1:]
            self._wrap()
            if self.position.shape[1] == 2:
                self.quads, self.quad_owner = run.file["mesh/quads"][()], run.file["mesh/cell_particle"][()]
                self._find_images()

    def _wrap(self):
        inside = self._in_vectors(self.position)
        count = np.bincount(self.owner)
        centre = np.stack([np.bincount(self.owner, along) / count for along in inside.T], axis=1)
        self.shift = -np.floor(centre) @ self.vectors
        self.position = self.position + self.shift[self.owner]

    def _find_images(self):
        inside = self._in_vectors(self.position)
        low, high = np.full(self.shift.shape, np.inf), np.full(self.shift.shape, -np.inf)
        np.minimum.at(low, self.owner, inside)
        np.maximum.at(high, self.owner, inside)
        first, last = np.ceil(-high.max(axis=0)).astype(int), np.floor(1 - low.min(axis=0)).astype(int)
        for i in range(first[0], last[0] + 1):
            for j in range(first[1], last[1] + 1):
                shown = np.all((low + (i, j) < 1) & (high + (i, j) > 0), axis=1)
                if (i or j) and shown.any():
                    self.images.append((self.position + (i, j) @ self.vectors, shown))

    def _in_vectors(self, points):
        return np.linalg.solve(self.vectors.T, (points - self.corner).T).T

    def other_end(self, ids, centre, point):
        """For each contact: the centre of the periodic image of the second particle that touches the first one there.
        Assumes that both particles have about the same size."""
        end = centre[ids[:, 1]]
        if not self.here or not len(ids):
            return end
        there = 2 * point - centre[ids[:, 0]]
        return end + np.round(self._in_vectors(there) - self._in_vectors(end)) @ self.vectors

    def limits(self):
        """Bounds of everything drawn, m: lower left, upper right."""
        drawn = [self.position, *(position[shown[self.owner]] for position, shown in self.images)]
        if self.here:
            drawn.append(self.outline())
        low, high = (end(np.concatenate(drawn), axis=0) for end in (np.min, np.max))
        margin = 0.03 * (high - low).max()
        return np.array([low - margin, high + margin])

    def edges(self):
        """The edges of a cell in three dimensions, [12, 2, 3] m; none without a cell."""
        return cell_edges(self.corner, self.vectors) if self.here else np.zeros((0, 2, 3))

    def outline(self):
        (a, b), corner = self.vectors, self.corner
        return np.array([corner, corner + a, corner + a + b, corner + b, corner])

    def draw(self, axes, colours=None, edges=None, seam=0.35):
        """The cell boundary and the images. colours: of the quads [n, 3 or 4]; edges: node pairs of the outlines."""
        if not self.here:
            return
        for position, shown in self.images:
            if colours is not None:
                quads = shown[self.quad_owner]
                axes.add_collection(PolyCollection(1e3 * position[self.quads[quads]], facecolors=paler(colours[quads]),
                                                   edgecolors="face", linewidths=seam, zorder=0.5))
            if edges is not None:
                lines = edges[shown[self.owner[edges[:, 0]]]]
                axes.add_collection(LineCollection(1e3 * position[lines], colors="#aab3bd",
                                                   linewidths=0.4, zorder=0.6))
        line = 1e3 * self.outline()
        axes.plot(line[:, 0], line[:, 1], color="#d55e00", linewidth=0.9, linestyle="-", zorder=3)
