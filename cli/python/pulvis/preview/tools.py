"""Tools as finite bodies, their moves and forces as arrows, and the extent of the drawing."""
import math

import numpy as np
from matplotlib.patches import Circle, Polygon, Rectangle
from matplotlib.transforms import Bbox

from pulvis.preview import words
from pulvis.preview.sheet import INK, number_mark, stage_colour

FACE, EDGE, HELD = "#c3c9d0", "#5b6672", "#e69f00"
THICK, ARROW, MOST_ARROWS = 0.075, 0.13, 4  # fractions of the set-up's size; maximum arrows per tool


def face_colour(tool):
    return HELD if tool["shape"] == "constraint" else FACE


def turned(vector):
    return np.array([-vector[1], vector[0]])


class Body:
    """A tool as drawn: position and extent of its face, and its actions."""

    def __init__(self, tool, stages):
        self.tool, self.name = tool, tool["name"]
        self.normal = np.array(tool["normal"], float)
        self.along = turned(self.normal)
        self.point = np.array(tool["point"], float)
        self.moves = [(i, np.array(move["displacement"], float), move) for i, stage in enumerate(stages)
                      for move in stage["moves"] if move["tool"] == self.name]
        self.servos = [servo for stage in stages for servo in stage["servos"] if servo["tool"] == self.name]
        self.slides = any(abs(d @ self.along) > abs(d @ self.normal) for _, d, _ in self.moves)
        self.upright = abs(self.normal[0]) > abs(self.normal[1])
        if tool["shape"] == "polyline":
            self.points = np.array(tool["points"], float)
        self.reach, self.depth = (0.0, 0.0), math.inf

    @property
    def polyline(self):
        return self.tool["shape"] == "polyline"

    @property
    def acts(self):
        return bool(self.moves or self.servos)

    def level(self):
        """Position of its face along its normal, at the point deepest in the powder."""
        return max(self.points @ self.normal) if self.polyline else self.point @ self.normal

    def lowest(self):
        """The same at the shallowest point, limited to the drawn depth."""
        return max(min(self.points @ self.normal), self.level() - self.depth) if self.polyline else self.level()

    def at(self, along, behind=0.0):
        """A point on its face, or at a distance behind it."""
        return along * self.along + (self.lowest() - behind if behind else self.level()) * self.normal

    def furthest(self):
        """The displacement at the end of the stage at which its face is deepest in the powder."""
        sums = np.cumsum([d for _, d, _ in self.moves], axis=0) if self.moves else np.zeros((1, 2))
        best = sums[np.argmax(sums @ self.normal)]
        return best if best @ self.normal > 0 else None


class Tools:
    def __init__(self, setup, low, high):
        self.stages = setup["stages"]
        self.powder = np.array([low, high])
        self.middle = (low + high) / 2
        self.bodies = [Body(tool, self.stages) for tool in setup["tools"] if tool["shape"] != "constraint"]
        self.held = [tool for tool in setup["tools"] if tool["shape"] == "constraint"]
        self.texts = []  # beside arrows
        self.near = [body for body in self.bodies if self.distance(body) < 4 * (high - low).max()]
        self.content()
        self.size = (self.high - self.low).max()
        self.thick, self.arrow = THICK * self.size, ARROW * self.size
        for body in self.bodies:
            body.reach, body.depth = self.reach_of(body), 1.6 * self.thick
        self.make_room(bool(setup["die"]))

    def distance(self, body):
        return abs(self.middle @ body.normal - body.level())

    # ---- layout ------------------------------------------------------------------------------------
    def content(self):
        """The bounding box of powder, tool faces and constrained nodes."""
        places = [*self.powder]
        for body in self.near:
            places.append(self.middle - (self.middle @ body.normal - body.level()) * body.normal)
            if body.polyline:
                pad = 0.4 * (self.powder[1] - self.powder[0]).max()
                inside = ((body.points > self.powder[0] - pad) & (body.points < self.powder[1] + pad)).all(axis=1)
                places += [*body.points[inside]]
        for tool in self.held:
            places += [np.array(node) for node in tool["nodes"]]
        self.low, self.high = np.min(places, axis=0), np.max(places, axis=0)

    def reach_of(self, body):
        """Extent along its face: punches between the walls, walls past the punches, targets past everything."""
        corners = np.array([[x, y] for x in (self.low[0], self.high[0]) for y in (self.low[1], self.high[1])])
        places = corners @ body.along
        low, high = places.min(), places.max()
        if body.slides or body.polyline:
            return low - 2 * self.thick, high + 2 * self.thick
        for other in self.bodies:
            if other is body or other.upright == body.upright or abs(other.normal @ body.normal) > 1e-6:
                continue
            side = np.sign(other.normal @ body.along)
            level = other.level() * side  # position of the other face along this one
            if body.upright:  # a wall
                level -= 0 if other.slides or other.polyline else side * self.thick
            low, high = (level, high) if side > 0 else (low, level)
        if high <= low:
            return places.min(), places.max()
        alone = not any(abs(other.normal @ body.normal) < 0.5 for other in self.bodies)
        return (low - self.thick, high + self.thick) if alone else (low, high)

    def make_room(self, dimensions):
        low, high = self.low.copy(), self.high.copy()
        for body in self.near:
            behind = self.thick + (1.25 * self.arrow if body.acts else 0)
            for along in body.reach:
                place = body.at(along, behind)
                low, high = np.minimum(low, place), np.maximum(high, place)
        if dimensions:
            low[1] -= 0.75 * self.thick
            high[0] += 0.75 * self.thick
        self.dimension_at = np.array([high[0] - 0.2 * self.thick, low[1] + 0.2 * self.thick])
        for tool in self.held:
            nodes = np.array(tool["nodes"])
            if self.acts(tool):
                low = np.minimum(low, nodes.min(axis=0) - 1.3 * self.arrow)
                high = np.maximum(high, nodes.max(axis=0) + 1.3 * self.arrow)
        pad = 0.03 * self.size
        self.low, self.high = low - pad, high + pad
        if self.held:  # room for their names beside a tall row of particles
            wide, tall = self.high - self.low
            self.low[0] -= max(0, tall / 2 - wide) / 2
            self.high[0] += max(0, tall / 2 - wide) / 2

    def dimension_places(self):
        """x of the height dimension line, y of the width dimension line."""
        return self.dimension_at

    def acts(self, tool):
        return any(one["tool"] == tool["name"] for stage in self.stages for one in stage["moves"] + stage["servos"])

    # ---- drawing ------------------------------------------------------------------------------------
    def draw(self, axes, labels, factor):
        for body in self.bodies:
            self.draw_body(axes, body, factor)
        for body in self.near:
            self.draw_arrows(axes, labels, body, factor)
        for tool in self.held:
            self.draw_held(axes, labels, tool, factor)
        for text, place, style in self.texts:  # after all arrows have been placed
            labels.put(text, place, **style)

    def draw_body(self, axes, body, factor):
        low, high = body.reach
        back = [body.at(high, self.thick), body.at(low, self.thick)]
        if body.polyline:
            far = 4 * self.size
            begin, end = body.points[0] - body.points[1], body.points[-1] - body.points[-2]
            chain = np.vstack([body.points[0] + far * begin / np.hypot(*begin), body.points,
                               body.points[-1] + far * end / np.hypot(*end)])
            right = -turned(chain[-1] - chain[0]) / np.hypot(*(chain[-1] - chain[0]))
            outline = np.vstack([chain, chain[-1] + 2 * far * right, chain[0] + 2 * far * right])
            clip = np.array([body.at(low, self.thick), body.at(high, self.thick), self.low, self.high])
            inner = np.vstack([np.clip(clip[:2], self.low, self.high), self.powder[0] - self.thick,
                               self.powder[1] + self.thick])
            box = np.maximum(inner.min(axis=0), self.low), np.minimum(inner.max(axis=0), self.high)
        else:
            outline, box = np.array([body.at(low), body.at(high), *back]), None
        patch = Polygon(factor * outline, closed=True, facecolor=FACE, edgecolor=EDGE, linewidth=1.0, zorder=4,
                        hatch="////" if body.acts else None)
        patch.set_gid(f"tool-{body.name}")
        axes.add_patch(patch)
        if box is not None:
            size = factor * (box[1] - box[0])
            patch.set_clip_path(Rectangle(factor * box[0], *size, transform=axes.transData))
        furthest = body.furthest()
        if furthest is not None and not body.polyline:
            line = factor * (np.array([body.at(low), body.at(high)]) + furthest)
            axes.plot(*line.T, color=stage_colour(body.moves[0][0]), linewidth=1.1, linestyle=(0, (4, 2.5)), zorder=5)

    def draw_arrows(self, axes, labels, body, factor):
        acts = self.acts_of(body.tool)
        shown = acts[:MOST_ARROWS]
        low, high = body.reach
        apart = min((high - low) / (len(shown) + 1), 0.3 * self.size) if shown else 0
        for k, (stage, direction, text) in enumerate(shown):
            along = (low + high) / 2 + (k - (len(shown) - 1) / 2) * apart
            towards = direction / np.hypot(*direction)
            near = body.at(along, self.thick) - 0.02 * self.size * body.normal
            if abs(towards @ body.normal) > 0.5:
                far = near - np.sign(towards @ body.normal) * self.arrow * towards
                tail, head = (far, near) if towards @ body.normal > 0 else (near, far)
            else:
                middle = near - 0.35 * self.arrow * body.normal
                tail, head = middle - 0.6 * self.arrow * towards, middle + 0.6 * self.arrow * towards
            self.arrow_between(axes, labels, stage, tail, head, text, factor)
        if len(acts) > len(shown):
            labels.put(f"and in {len(acts) - len(shown)} more stages", factor * body.at(high - apart / 2, self.thick),
                       reach=10, fontsize=7.5)

    def arrow_between(self, axes, labels, stage, tail, head, text, factor):
        tail, head = factor * tail, factor * head
        axes.annotate("", head, tail, zorder=10, annotation_clip=False,
                      arrowprops={"arrowstyle": "-|>,head_width=0.28,head_length=0.5", "color": stage_colour(stage),
                                  "linewidth": 2, "shrinkA": 0, "shrinkB": 0})
        mark = number_mark(axes, tail, stage)
        labels.keep_free(labels.extent(mark))
        labels.keep_free(Bbox.from_extents(*axes.transData.transform([np.minimum(tail, head), np.maximum(tail, head)])
                                           .ravel()).padded(4))
        sideways = abs((head - tail)[0]) > abs((head - tail)[1])
        self.texts.append((text, (tail + head) / 2, {"steps": [(0, -1), (0, 1)] if sideways else [(1, 0), (-1, 0)],
                                                     "reach": 5, "fontsize": 8, "color": stage_colour(stage),
                                                     "linespacing": 1.05}))

    def draw_held(self, axes, labels, tool, factor):
        nodes = factor * np.array(tool["nodes"])
        axes.plot(*nodes.T, linestyle="", marker="o", markersize=3.2, color=HELD, markeredgecolor=INK,
                  markeredgewidth=0.4, zorder=7, gid=f"tool-{tool['name']}")
        if "radius" in tool:
            axes.add_patch(Circle(factor * np.array(tool["point"]), factor * tool["radius"], fill=False,
                                  edgecolor=HELD, linewidth=1.1, linestyle="--", zorder=7))
        else:
            low, high = (factor * np.array(tool[key]) for key in ("low", "high"))
            axes.add_patch(Rectangle(low, *(high - low), fill=False, edgecolor=HELD, linewidth=1.1, linestyle="--",
                                     zorder=7))
        middle = nodes.mean(axis=0)
        if tool["holds"] == "radial":  # one symbol stands for all
            middle = nodes[np.argmax(nodes[:, 0])]
        self.draw_held_moves(axes, labels, tool, middle / factor, factor)

    def acts_of(self, tool):
        """[(stage, direction, text)] of the moves and forces of a tool."""
        acts = []
        for i, stage in enumerate(self.stages):
            acts += [(i, np.array(move["displacement"], float), words.quantity(math.hypot(*move["displacement"]), "m")
                      + "\n" + words.quantity(move["speed"], "m/s")) for move in stage["moves"]
                     if move["tool"] == tool["name"]]
            acts += [(i, np.array(servo["direction"], float), words.quantity(servo["force"], "N"))
                     for servo in stage["servos"] if servo["tool"] == tool["name"]]
        return [act for act in acts if np.hypot(*act[1]) > 0]

    def draw_held_moves(self, axes, labels, tool, middle, factor):
        acts = self.acts_of(tool)
        shown = acts[:MOST_ARROWS]
        for k, (stage, direction, text) in enumerate(shown):
            towards = direction / np.hypot(*direction)
            sideways = abs(towards[0]) > abs(towards[1])
            shift = (k - (len(shown) - 1) / 2) * self.arrow * (np.array([0, -0.75]) if sideways else np.array([1, 0]))
            self.arrow_between(axes, labels, stage, middle + shift, middle + shift + self.arrow * towards, text, factor)
        if len(acts) > len(shown):
            labels.put(f"and in {len(acts) - len(shown)} more stages", factor * middle, reach=20, fontsize=7.5,
                       steps=labels.AROUND[1:])

    def place_of_name(self, body):
        if not body.polyline:
            return body.at(sum(body.reach) / 2, self.thick / 2)
        # Behind the middle of the visible part of its face.
        shares = np.linspace(0, 1, 9)[:, None]
        begin, end = body.points[:-1], body.points[1:]
        faces = np.vstack([a + shares * (b - a) for a, b in zip(begin, end)])
        inward = np.repeat([-turned(b - a) / max(np.hypot(*(b - a)), 1e-300) for a, b in zip(begin, end)], 9, axis=0)
        seen = ((faces > self.low) & (faces < self.high)).all(axis=1)
        if not seen.any():
            return np.clip(body.at(sum(body.reach) / 2), self.low, self.high)
        middle = np.flatnonzero(seen)[seen.sum() // 2]
        return faces[middle] + 0.5 * self.thick * inward[middle]

    def name(self, labels, factor):
        for body in self.near:
            labels.put(body.name, factor * self.place_of_name(body), steps=[(0, 0), (0, 1), (0, -1)], reach=6,
                       fontweight="bold", rotation=90 if body.upright else 0)
        for tool in self.held:
            middle = np.mean(tool["nodes"], axis=0)
            out = 1 if middle[0] > self.middle[0] else -1  # away from the particles
            labels.put(tool["name"], factor * middle, reach=10, fontweight="bold", leader=True,
                       steps=[(out, 0), (out, 1), (out, -1), *labels.AROUND[1:]])
