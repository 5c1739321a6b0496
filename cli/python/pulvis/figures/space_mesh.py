"""Geometry of hexahedral meshes: outer faces, plane sections, and density along z."""
import numpy as np

# Corners of a hexahedron's faces, counter-clockwise from outside, and its edges; corners in VTK order.
SIDES = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
EDGES = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]])
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


def tetrahedra(hexahedra, position):
    """(volumes [n], heights of their corners [n, 4], ascending): the solid as tetrahedra between a common point and its
    outer faces, which are four triangles each. A volume has the sign of the side of its face that it is on: the sum over
    all, also of what is below a height, is that of the solid."""
    corners = position[outer_sides(hexahedra)[0]]
    apex, middle = position.mean(axis=0), corners.mean(axis=1)
    edges = np.stack([corners, np.roll(corners, -1, axis=1), np.repeat(middle[:, None], 4, axis=1)], axis=2).reshape(-1, 3, 3)
    heights = np.column_stack([edges[..., 2], np.full(len(edges), apex[2])])
    return np.linalg.det(edges - apex) / 6, np.sort(heights, axis=1)


def share_below(heights, z):
    """Of the volume of tetrahedra: the integral of the area of their sections, which is a quadratic B-spline."""
    a, b, c, d = heights.T
    up, down = z - a, d - z
    with np.errstate(divide="ignore", invalid="ignore"):
        low = up**3 / ((b - a) * (c - a) * (d - a))
        high = 1 - down**3 / ((d - a) * (d - b) * (d - c))
        between = ((z - b)**2 / ((c - b) * (d - b)) + up * (c - z) * (z - b) / ((c - a) * (c - b) * (d - b))
                   + up**2 * down / ((c - a) * (d - a) * (d - b)))
    return np.select([z <= a, z >= d, z <= b, z >= c], [0, 1, low, high], between)


def density_along_z(hexahedra, position, section, slices=SLICES):
    """(density [slices], z [slices + 1], m): solid volume over available volume in slices of equal thickness between the
    level tools, or to the end of the powder where there is none. section: space_tools.CrossSection; None if nothing is
    between its ends."""
    bottom = max(position[:, 2].min() if section.bottom is None else section.bottom, section.low)
    top = min(position[:, 2].max() if section.top is None else section.top, section.high)
    if not bottom < top:
        return None
    volume, heights = tetrahedra(hexahedra, position)
    z = np.linspace(bottom, top, slices + 1)
    below = np.array([share_below(heights, place) @ volume for place in z])
    return np.diff(below) / (section.area * np.diff(z)), z
