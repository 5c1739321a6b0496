"""Initial velocities and spins of the particles: straight and curved arrows, and their largest values in words."""
import numpy as np

from pulvis.preview import words
from pulvis.preview.sheet import INK

MOST = 200  # arrows of each kind
LONGEST = 0.16  # arrow of the fastest particle, as a fraction of the set-up's size
TURN = np.linspace(0, 1.6 * np.pi, 97)  # rad, of a curved arrow
RADIUS = 0.6  # of a curved arrow, as a fraction of the particle's


def vector(value):
    """In three dimensions; a spin in the plane is about the axis towards the viewer."""
    return np.array([0, 0, value] if np.ndim(value) == 0 else [*value, 0][:3], float)


class Motion:
    """bodies: (outline or surface points [n, 2 or 3], entry of the set-up) of every particle, of all of its grains."""

    def __init__(self, bodies):
        self.bodies = [(np.pad(points, ((0, 0), (0, 3 - points.shape[1]))), one) for points, one in bodies
                       if "velocity" in one or "angular_velocity" in one]
        self.fastest = {name: max((np.linalg.norm(vector(one[name])) for _, one in self.bodies if name in one), default=0)
                        for name in ("velocity", "angular_velocity")}

    def write(self, column):
        if self.fastest["velocity"]:
            column.line(f"Black arrows: initial velocity, up to {words.quantity(self.fastest['velocity'], 'm/s')}")
        if self.fastest["angular_velocity"]:
            column.line(f"Curved arrows: initial spin, up to {words.number(self.fastest['angular_velocity'])} rad/s")

    def straight(self, size):
        """(begin, end) [arrows, 3], the fastest first."""
        moving = [(points.mean(axis=0), vector(one["velocity"])) for points, one in self.bodies if "velocity" in one]
        moving.sort(key=lambda one: -np.linalg.norm(one[1]))
        return [(middle, middle + LONGEST * size * velocity / self.fastest["velocity"]) for middle, velocity in moving[:MOST]]

    def curved(self):
        """Arcs [arrows, points, 3] in the sense of each spin, normal to it."""
        arcs = []
        for points, one in [body for body in self.bodies if "angular_velocity" in body[1]][:MOST]:
            axis = vector(one["angular_velocity"]) / np.linalg.norm(vector(one["angular_velocity"]))
            first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
            first /= np.linalg.norm(first)
            middle = points.mean(axis=0)
            radius = RADIUS * np.linalg.norm(np.cross(points - middle, axis), axis=1).max()
            arcs.append(middle + radius * (np.cos(TURN)[:, None] * first + np.sin(TURN)[:, None] * np.cross(axis, first)))
        return arcs

    def draw(self, axes, size, scale):
        """scale: [3, 2], from the scene to the drawing."""
        for begin, end in self.straight(size):
            self.arrow(axes, begin @ scale, end @ scale, "velocity")
        for arc in self.curved():
            path = arc @ scale
            axes.plot(*path[:-4].T, color=INK, linewidth=1.4, zorder=7, gid="spin-arc")
            self.arrow(axes, path[-5], path[-1], "spin")

    def arrow(self, axes, begin, end, gid):
        if np.hypot(*(end - begin)) > 1e-9 * np.abs(end).max():  # else it points at the viewer
            axes.annotate("", end, begin, zorder=7, annotation_clip=False, gid=gid,
                          arrowprops={"arrowstyle": "-|>", "color": INK, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0})
