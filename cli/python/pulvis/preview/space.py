"""Set-up of a 3D particle scene: view from a corner and from two sides, with tools and their motion."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from pulvis.figures.cell import cell_edges
from pulvis.preview import tools as drawn_tools
from pulvis.preview import words
from pulvis.preview.powder import PowderDrawing
from pulvis.preview.sheet import INK, MARGIN, SIDE, WIDTH, number_mark, stage_colour

TURN, TILT = -np.pi / 4, np.arctan(np.sqrt(0.5))
LIGHT = np.array([-0.35, 0.5, -0.8]) / np.linalg.norm([-0.35, 0.5, -0.8])
CELL = "#d55e00"
GAP = 0.35  # inches between the views
BELOW = 0.7  # inches below a view from a side: its axis, and the heading of the next view


def view_from(turn, tilt):
    """Rotation matrix, rows: right, up, away from the viewer."""
    ct, st, cu, su = np.cos(turn), np.sin(turn), np.cos(tilt), np.sin(tilt)
    return np.array([[ct, -st, 0], [su * st, su * ct, cu], [cu * st, cu * ct, -su]])


VIEWS = [("", view_from(TURN, TILT)), ("along y", view_from(0, 0)), ("along x", view_from(-np.pi / 2, 0))]


def normals(corners):
    cross = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    return cross / np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), 1e-300)


class SpaceDrawing(PowderDrawing):
    def __init__(self, setup):
        faces, colours = [], []
        for one in setup["particles"]:
            nodes = np.reshape(one["nodes"], (-1, 3))
            faces.append(nodes[np.array(one["faces"])])
            colours += [one["material"]] * len(faces[-1])
        self.faces, self.owner = np.concatenate(faces), np.array(colours)
        self.pieces = [np.reshape(tool["pieces"], (-1, 4, 3)) for tool in setup["tools"]]
        self.held = {tool["name"]: np.array(tool["nodes"]) for tool in setup["tools"] if tool["shape"] == "constraint"}
        cell = setup["cell"]
        self.edges = cell_edges(np.array(cell["corner"]), np.array(cell["vectors"])) if cell else np.zeros((0, 2, 3))
        super().__init__(setup)

    def outer_points(self):
        return np.concatenate([self.faces.reshape(-1, 3), self.edges.reshape(-1, 3)])

    def bodies(self):
        for one in self.setup["particles"]:
            yield np.reshape(one["nodes"], (-1, 3)), one

    def layout(self):
        every = np.concatenate([self.outer_points(), *(piece.reshape(-1, 3) for piece in self.pieces)])
        self.span = np.ptp(every, axis=0).max()
        self.factor, self.unit = words.prefix_for(self.span, "m")
        self.middle, self.ends = (every.min(axis=0) + every.max(axis=0)) / 2, np.vstack([every, *(end for arrow in self.motion.straight(self.span) for end in arrow)])
        room = WIDTH - 2 * MARGIN - SIDE - 0.35
        self.large = 0.6 * room - GAP / 2
        self.small = 0.4 * room - GAP / 2 - 0.45
        self.height = max(self.large * self.shape(VIEWS[0][1]), 2 * (self.small * max(self.shape(rows) for _, rows in VIEWS[1:]) + BELOW + 0.1))
        self.height = min(self.height, 7.6)

    def limits(self, rows):
        seen = self.ends @ rows[:2].T
        pad = self.span * np.array([0.06, 0.17])  # room for arrows up and down
        return seen.min(axis=0) - pad, seen.max(axis=0) + pad

    def shape(self, rows):
        low, high = self.limits(rows)
        return (high - low)[1] / (high - low)[0]

    def draw(self, sheet, left, top):
        self.view(sheet.axes(left, top, self.large, self.height), VIEWS[0], False)
        each = self.height / 2 - BELOW
        for k, view in enumerate(VIEWS[1:]):
            self.view(sheet.axes(left + self.large + GAP + 0.45, top + k * (each + BELOW), self.small, each), view, True)

    def view(self, axes, view, with_axes):
        name, rows = view
        low, high = self.limits(rows)
        axes.set(xlim=self.factor * np.array([low[0], high[0]]), ylim=self.factor * np.array([low[1], high[1]]))
        axes.set_aspect("equal", anchor="N", adjustable="box")
        self.draw_tools(axes, rows)
        axes.add_collection(LineCollection(self.factor * self.edges @ rows[:2].T, colors=CELL, linewidths=0.9, zorder=3))
        self.draw_particles(axes, rows)
        self.draw_held(axes, rows)
        self.draw_moves(axes, rows)
        self.motion.draw(axes, self.span, self.factor * rows[:2].T)
        if not with_axes:
            axes.axis("off")
            return
        axes.set(xlabel=f"{'x' if rows[0][0] > 0.5 else 'y'} [{self.unit}]", ylabel=f"z [{self.unit}]")
        axes.set_title(f"seen {name}", fontsize=8, loc="left", color=INK)

    def draw_particles(self, axes, rows):
        normal = normals(self.faces) @ rows.T
        front = normal[:, 2] < 0
        seen = self.faces[front] @ rows.T
        order = np.argsort(-seen[..., 2].mean(axis=1), kind="stable")
        light = 0.6 + 0.4 * np.maximum(0, normal[front][order] @ LIGHT)
        rgb = np.array([[int(self.colour[name][k:k + 2], 16) / 255 for k in (1, 3, 5)] for name in self.owner[front][order]])
        drawn = PolyCollection(self.factor * seen[order][..., :2], facecolors=rgb * light[:, None], edgecolors="face", linewidths=0.3, zorder=2)
        drawn.set_gid("particles")
        drawn.set_rasterized(len(order) > 20000)  # a larger SVG is slow to open
        axes.add_collection(drawn)

    def draw_tools(self, axes, rows):
        for tool, pieces in zip(self.setup["tools"], self.pieces):
            inside = normals(pieces) @ rows[2] < -1e-9
            flat = self.factor * pieces @ rows[:2].T
            axes.add_collection(PolyCollection(flat[inside], facecolors=drawn_tools.face_colour(tool), edgecolors="none", alpha=0.55, zorder=1))
            axes.add_collection(LineCollection(self.factor * rims(pieces) @ rows[:2].T, colors=drawn_tools.EDGE, linewidths=0.7, zorder=1.1))

    def draw_held(self, axes, rows):
        for name, nodes in self.held.items():
            axes.plot(*(self.factor * nodes @ rows[:2].T).T, linestyle="", marker="o", markersize=2.6,
                      color=drawn_tools.HELD, markeredgecolor=INK, markeredgewidth=0.3, zorder=6, gid=f"tool-{name}")

    def draw_moves(self, axes, rows):
        """Arrows from the middle of a tool's surface, or of the nodes that it holds, numbered by stage."""
        middles = {tool["name"]: pieces.reshape(-1, 3).mean(axis=0) for tool, pieces in zip(self.setup["tools"], self.pieces) if len(pieces)}
        middles |= {name: nodes.mean(axis=0) for name, nodes in self.held.items()}
        shown = {}
        for index, stage in enumerate(self.setup["stages"]):
            drives = [(move["tool"], move["displacement"]) for move in stage["moves"]] + \
                     [(servo["tool"], servo["direction"]) for servo in stage["servos"]]
            for name, way in drives:
                way = np.array(way) @ rows[:2].T
                if name not in middles or np.hypot(*way) < 1e-9 * np.linalg.norm(way + 1):
                    continue
                beside = shown[name] = shown.get(name, -1) + 1
                across = np.array([1.0, 0.0]) if abs(way[1]) > abs(way[0]) else np.array([0.0, 1.0])
                begin = middles[name] @ rows[:2].T + 0.09 * self.span * beside * across
                end = begin + 0.14 * self.span * way / np.hypot(*way)
                axes.annotate("", self.factor * end, self.factor * begin, zorder=7,
                              arrowprops={"arrowstyle": "-|>", "color": stage_colour(index), "linewidth": 1.6, "shrinkA": 0, "shrinkB": 0})
                number_mark(axes, self.factor * begin, index)

    # ---- text ---------------------------------------------------------------------------------------
    def sizes(self):
        elements = [one["elements"] for one in self.setup["particles"]]
        return (f"{words.counted(sum(elements), 'element')}, {min(elements)}"
                + (f" to {max(elements)}" if max(elements) > min(elements) else "") + " in each")

    def extent_text(self, low, high):
        return "All of them: " + " × ".join(words.quantity(float(f"{length:.3g}"), "m") for length in high - low)

    def size_text(self, one):
        if "height" in one:
            return f"{one['shape']}, diameter {words.span(*one['width'], 'm')}, height {words.span(*one['height'], 'm')}"
        size = words.span(*one["diameter"], "m")
        return f"sphere, diameter {size}" if one["shape"] == "sphere" else f"{one['shape']}, volume of a ball of {size}"

    def shape_of(self, one):
        return one["shape"]


def rims(pieces):
    """Edges that belong to only one quad: [n, 2, 3]."""
    edges = np.stack([pieces, np.roll(pieces, -1, axis=1)], axis=2).reshape(-1, 2, 3)
    edges = edges[np.abs(edges[:, 0] - edges[:, 1]).sum(axis=1) > 0]
    scale = np.ptp(edges.reshape(-1, 3), axis=0).max() if len(edges) else 1
    whole = np.round(edges / (1e-7 * scale)).astype(np.int64)
    flipped = np.array([tuple(a) > tuple(b) for a, b in whole], bool)
    whole[flipped] = whole[flipped][:, ::-1]
    _, first, count = np.unique(whole.reshape(-1, 6), axis=0, return_index=True, return_counts=True)
    return edges[first[count == 1]]
