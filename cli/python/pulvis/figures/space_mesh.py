"""Geometry of hexahedral meshes: outer faces, plane sections, and density along z."""
import numpy as np

# Corners of a hexahedron's faces, counter-clockwise from outside, and its edges; corners in VTK order.
SIDES = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
EDGES = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]])
NATURAL = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
SLICES = 20


def outer_sides(hexahedra):
    """(faces [n, 4] of nodes, cells [n]): faces that belong to only one hexahedron."""
    faces = hexahedra[:, SIDES].reshape(-1, 4)
    key = np.sort(faces, axis=1)
    order = np.lexsort(key.T)
    same = np.all(key[order][1:] == key[order][:-1], axis=1)
    alone = np.sort(order[~(np.append(same, False) | np.insert(same, 0, False))])
    return faces[alone], alone // 6


def section(hexahedra, position, axis, at):
    """(polygons, cells): section by the plane normal to `axis` at `at`; polygons [corners, 2] in the other axes."""
    away = position[:, axis] - at
    above = away[hexahedra] > 0
    cells = np.flatnonzero(above.any(axis=1) & ~above.all(axis=1))
    start, end = hexahedra[cells][:, EDGES[:, 0]], hexahedra[cells][:, EDGES[:, 1]]
    crossed = (away[start] > 0) != (away[end] > 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(crossed, away[start] / (away[start] - away[end]), 0)[..., None]
    flat = np.delete(position, axis, axis=1)
    points = flat[start] + share * (flat[end] - flat[start])
    count = crossed.sum(axis=1)
    middle = (points * crossed[..., None]).sum(axis=1) / count[:, None]
    towards = points - middle[:, None]
    angle = np.where(crossed, np.arctan2(towards[..., 1], towards[..., 0]), np.inf)
    order = np.argsort(angle, axis=1, kind="stable")
    ordered = np.take_along_axis(points, order[..., None], axis=1)
    return [ordered[i, :count[i]] for i in range(len(cells))], cells


def parts(hexahedra, position):
    """(volumes, low z, high z) of the eight parts of each hexahedron, halved along its natural coordinates:
    [cells, 8]; by the Jacobian at their centres."""
    corners = position[hexahedra]
    volume, low, high = (np.empty((len(hexahedra), 8)) for _ in range(3))
    for part, place in enumerate(NATURAL / 2):
        shape = np.prod(1 + NATURAL * place, axis=1) / 8
        slope = np.stack([NATURAL[:, k] * np.prod(np.delete(1 + NATURAL * place, k, axis=1), axis=1) / 8 for k in range(3)])
        sides = np.einsum("kn,cnx->ckx", slope, corners)  # each part has length one in natural coordinates
        middle, half = corners[..., 2] @ shape, np.abs(sides[..., 2]).sum(axis=1) / 2
        volume[:, part] = np.linalg.det(sides)
        low[:, part], high[:, part] = middle - half, middle + half
    return volume, low, high


def density_along_z(hexahedra, position, section, slices=SLICES):
    """(density [slices], z [slices + 1], m): solid volume over available volume in slices of equal thickness. section:
    space_tools.CrossSection; None if nothing is between its ends."""
    bottom, top = max(position[:, 2].min(), section.low), min(position[:, 2].max(), section.high)
    if not bottom < top:
        return None
    volume, low, high = (values.ravel() for values in parts(hexahedra, position))
    z = np.linspace(bottom, top, slices + 1)
    below = np.clip((z[:, None] - low) / np.maximum(high - low, 1e-30), 0, 1) @ volume
    return np.diff(below) / (section.area * np.diff(z)), z
