"""The tools of a run in three dimensions: surface quads, counter-clockwise seen from the powder."""
from typing import NamedTuple

import numpy as np

UPRIGHT = 1e-3
COPLANAR = 1e-3  # difference of unit normals


def pieces(run, frame):
    """(corners [n, 4, 3] m, kinds [n]) of all surface quads in a frame."""
    if "tools/quads" not in run.file or "tools/outline" not in frame:
        return np.empty((0, 4, 3)), np.empty(0, str)
    of_tool = run.file["tools/quad_tool"]
    text = of_tool.attrs["kinds"]
    kinds = (text.decode() if isinstance(text, bytes) else text).split("\n")
    return frame["tools/outline"][()][run.file["tools/quads"][()]], np.array(kinds)[of_tool[()]]


def normals(corners):
    cross = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    return cross / np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), 1e-300)


def rims(run, frame):
    """Edges that belong to only one quad, and those between faces of an STL tool that are not coplanar: [n, 2, 3] m."""
    corners, kinds = pieces(run, frame)
    if not len(corners):
        return np.empty((0, 2, 3))
    quads, stl = run.file["tools/quads"][()], kinds == "stl"
    if stl.any():  # each of its triangles has corners of its own
        tools = np.repeat(run.file["tools/quad_tool"][()][stl], 4)
        alike = np.unique(np.column_stack([tools, corners[stl].reshape(-1, 3)]), axis=0, return_inverse=True)[1]
        quads[stl] = quads.max() + 1 + alike.reshape(-1, 4)
    edges = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    real = np.flatnonzero(edges[:, 0] != edges[:, 1])
    _, first, which, count = np.unique(edges[real], axis=0, return_index=True, return_inverse=True, return_counts=True)
    normal = normals(corners)[real // 4]
    bend = np.zeros(len(first))
    np.maximum.at(bend, which.reshape(-1), np.linalg.norm(normal - normal[first[which.reshape(-1)]], axis=1))
    drawn = first[(count == 1) | stl[real[first] // 4] & (bend > COPLANAR)]
    return np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2, 3)[real[drawn]]


def cut(corners, axis, at):
    """Where the plane normal to `axis` cuts the quads: lines [n, 2, 2] in the other axes."""
    lines = []
    for piece in corners:
        away = piece[:, axis] - at
        points = []
        for i in range(4):
            j = (i + 1) % 4
            if (away[i] > 0) != (away[j] > 0):
                points.append(np.delete(piece[i] + away[i] / (away[i] - away[j]) * (piece[j] - piece[i]), axis))
        if len(points) == 2:
            lines.append(points)
    return np.array(lines).reshape(-1, 2, 2)


class CrossSection(NamedTuple):
    """Of the space of the powder, normal to z."""

    area: float  # m^2
    inside: str = ""  # of what, in words
    low: float = -np.inf  # m, the part of z in which the space has this cross-section: a die ends at its mouth
    high: float = np.inf
    bottom: float | None = None  # m, z of level planes below and above the powder, in a die also of punches
    top: float | None = None


def stands(corners):
    """Whether a round surface is about z: its area is then turned equally far towards all directions normal to z."""
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    size = np.linalg.norm(across, axis=1)
    spread = across.T @ (across / np.maximum(size, 1e-300)[:, None])
    return np.abs(spread - np.diag([*2 * [np.trace(spread[:2, :2]) / 2], spread[2, 2]])).max() <= UPRIGHT * size.sum()


def cross_section(run, frame, position):
    """Of a round die, or of the box between the vertical walls; the width of the powder where there is no wall. None in
    a die that does not stand along z."""
    corners, kinds = pieces(run, frame)
    if not stands(corners[kinds == "die"]):
        return None
    normal = normals(corners)
    # Up to the deepest point of a punch, the cavity is the whole bore.
    faces = (np.abs(normal[:, :2]).max(axis=1, initial=0) < UPRIGHT) & (kinds == "plane")
    if (kinds == "die").any():
        faces |= (np.abs(normal[:, 2]) > UPRIGHT) & (kinds == "punch")
    floors, lids = (corners[faces & (sign * normal[:, 2] > 0)][..., 2] for sign in (1, -1))
    ends = {"bottom": floors.max() if len(floors) else None, "top": lids.min() if len(lids) else None}
    return area_between(corners, kinds, normal, position)._replace(**ends)


def area_between(corners, kinds, normal, position):
    upright = np.abs(normal[:, 2]) < UPRIGHT
    die = corners[upright & (kinds == "die")].reshape(-1, 3)
    if len(die):
        area, mouth = np.pi / 4 * np.prod(np.ptp(die[:, :2], axis=0)), corners[~upright & (kinds == "die")].reshape(-1, 3)
        if not len(mouth):  # longer than it is drawn
            return CrossSection(area, "in the die")
        ends = {"high": die[:, 2].max()} if mouth[:, 2].mean() > die[:, 2].mean() else {"low": die[:, 2].min()}
        return CrossSection(area, "in the die, below its mouth", **ends)
    low, high = position[:, :2].min(axis=0), position[:, :2].max(axis=0)
    walls = set()
    for piece, across in zip(corners[upright & (kinds == "plane")], normal[upright & (kinds == "plane")]):
        k = int(np.abs(across[:2]).argmax())
        if abs(across[1 - k]) < UPRIGHT:
            (low if across[k] > 0 else high)[k] = piece[0, k]
            walls.add((k, across[k] > 0))
    return CrossSection(np.prod(high - low), "between the walls" if len(walls) == 4 else "in the box around the powder")
