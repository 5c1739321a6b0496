"""Set-up of a particle scene: die, tools, particles, bonds, cell, and tool motion."""
import math

import numpy as np
from matplotlib.collections import LineCollection, PathCollection, PolyCollection
from matplotlib.path import Path

from pulvis.preview import tools as drawn_tools
from pulvis.preview import words
from pulvis.preview.motion import Motion
from pulvis.preview.sheet import (INK, MARGIN, MATERIAL_COLOURS, SIDE, WIDTH, Column, Labels, Programme,
                                  dimension)

BOND = "#c2185b"
REGION = "#6a3d9a"


def outline_path(loops):
    vertices, codes = [], []
    for loop in loops:
        points = np.reshape(loop, (-1, 2))
        vertices += [*points, points[0]]
        codes += [Path.MOVETO, *[Path.LINETO] * (len(points) - 1), Path.CLOSEPOLY]
    return Path(np.array(vertices), codes)


def size_text(one):
    outline = one["outline"]
    if outline == "disc":
        return f"disc, diameter {words.span(*one['diameter'], 'm')}"
    if outline == "ring":
        return f"ring, {words.span(*one['diameter'], 'm')}, hole {words.quantity(one['hole'], 'm')}"
    return (f"{outline}, {words.span(*one['width'], 'm')} × {words.span(*one['height'], 'm')},"
            f" area of a disc of {words.span(*one['diameter'], 'm')}")


class PowderDrawing:
    def __init__(self, setup):
        self.setup = setup
        self.colour = {material["name"]: MATERIAL_COLOURS[i % len(MATERIAL_COLOURS)]
                       for i, material in enumerate(setup["materials"])}
        self.points = self.outer_points()
        self.motion = Motion(self.bodies())
        self.column = self.written()
        self.programme = self.stages()
        self.layout()

    def outer_points(self):
        return np.vstack([np.reshape(one["loops"][0], (-1, 2)) for one in self.setup["particles"]])

    def bodies(self):
        """(points, entry) of every particle, of all of its grains."""
        grains = {}
        for one in self.setup["particles"]:
            grains.setdefault(one["particle"], []).append(one)
        for parts in grains.values():
            yield np.vstack([np.reshape(one["loops"][0], (-1, 2)) for one in parts]), parts[0]

    # ---- layout ------------------------------------------------------------------------------------
    def layout(self):
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        cell = self.setup["cell"]
        if cell:
            corner, vectors = np.array(cell["corner"]), np.array(cell["vectors"])
            corners = corner + np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) @ vectors
            low, high = np.minimum(low, corners.min(axis=0)), np.maximum(high, corners.max(axis=0))
            pad = 0.12 * (high - low).max()
            low, high = low - pad, high + pad
        self.tools = drawn_tools.Tools(self.setup, low, high)
        self.low, self.high = self.tools.low, self.tools.high
        self.span = (self.high - self.low).max()
        self.factor, self.unit = words.prefix_for(self.span, "m")
        width = WIDTH - 2 * MARGIN - SIDE - 0.35 - 0.55
        shape = (self.high - self.low)[1] / (self.high - self.low)[0]
        self.inches = width, min(max(shape * width, 2.6), 7.6)
        self.height = self.inches[1] + 0.55

    def draw(self, sheet, left, top):
        axes = sheet.axes(left + 0.55, top, *self.inches)
        axes.set(xlim=self.factor * np.array([self.low[0], self.high[0]]),
                 ylim=self.factor * np.array([self.low[1], self.high[1]]),
                 xlabel=f"x [{self.unit}]", ylabel=f"y [{self.unit}]")
        axes.set_aspect("equal", anchor="N", adjustable="box")
        axes.apply_aspect()
        labels = Labels(axes)
        self.particles(axes)
        self.bonds(axes)
        if self.setup["cell"]:
            self.cell(axes, labels)
        self.tools.draw(axes, labels, self.factor)
        self.motion.draw(axes, self.span, self.factor * np.eye(3)[:, :2])
        self.name_speed(labels)
        self.die(axes, labels)
        self.tools.name(labels, self.factor)

    # ---- particles ----------------------------------------------------------------------------------
    def particles(self, axes):
        for material, colour in self.colour.items():
            paths = [outline_path([self.factor * np.array(loop) for loop in one["loops"]])
                     for one in self.setup["particles"] if one["material"] == material]
            if not paths:
                continue
            thin = 0.5 if len(paths) < 500 else 0.25
            drawn = PathCollection(paths, facecolor=colour, edgecolor="#4a5561", linewidth=thin, zorder=2)
            drawn.set_gid(f"particles-{material}")
            drawn.set_rasterized(len(self.setup["particles"]) > 5000)  # a larger SVG is slow to open
            axes.add_collection(drawn)

    def images(self):
        """Outlines of the visible periodic images of the particles."""
        vectors = np.array(self.setup["cell"]["vectors"])
        for i, j in [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]:
            shift = i * vectors[0] + j * vectors[1]
            for one in self.setup["particles"]:
                points = np.reshape(one["loops"][0], (-1, 2)) + shift
                if (points.max(axis=0) > self.low).all() and (points.min(axis=0) < self.high).all():
                    yield self.factor * points

    def cell(self, axes, labels):
        axes.add_collection(PolyCollection(list(self.images()), facecolor="#eef1f4", edgecolor="#b7c0c9",
                                           linewidth=0.4, zorder=1))
        corner, vectors = np.array(self.setup["cell"]["corner"]), np.array(self.setup["cell"]["vectors"])
        corners = self.factor * (corner + np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]) @ vectors)
        axes.plot(*corners.T, color=INK, linewidth=1.3, linestyle=(0, (5, 2)), zorder=6)
        for (begin, end), vector in zip(((corners[0], corners[1]), (corners[0], corners[3])), vectors):
            across = np.array([-vector[1], vector[0]]) / math.hypot(*vector)
            if np.dot(across, corners[2] - corners[0]) > 0:
                across = -across
            shift = 0.045 * self.factor * self.span * across
            dimension(axes, begin + shift, end + shift, words.quantity(math.hypot(*vector), "m"), labels, [(0, 0)])
        labels.put("periodic cell", corners[2], steps=[(-1, 1), (1, 1), (-1, -1)], reach=4)

    def bonds(self, axes):
        edges = self.setup["bonds"]["edges"]
        if edges:
            drawn = LineCollection(self.factor * np.array(edges), color=BOND, zorder=3,
                                   linewidth=1.1 if len(edges) < 2000 else 0.4)
            drawn.set_gid("bonds")
            axes.add_collection(drawn)

    def name_speed(self, labels):
        for begin, end in self.motion.straight(self.span)[:1]:
            labels.put(words.quantity(self.motion.fastest["velocity"], "m/s"), self.factor * (begin + end)[:2] / 2, reach=6,
                       steps=labels.AROUND[1:])

    # ---- the die ------------------------------------------------------------------------------------
    def die(self, axes, labels):
        die = self.setup["die"]
        if not die:
            return
        (left, right), (bottom, top) = die["x"], die["y"]
        columns, rows = self.setup.get("density_cells", (0, 0))
        if columns:
            x, y = np.linspace(left, right, columns + 1), np.linspace(bottom, top, rows + 1)
            lines = [[(at, bottom), (at, top)] for at in x] + [[(left, at), (right, at)] for at in y]
            axes.add_collection(LineCollection(self.factor * np.array(lines), color=REGION, linewidth=0.8,
                                               linestyle=":", zorder=5))
        place = self.tools.dimension_places()
        dimension(axes, self.factor * np.array([left, place[1]]), self.factor * np.array([right, place[1]]),
                  words.quantity(right - left, "m"), labels, [(0, 0)])
        dimension(axes, self.factor * np.array([place[0], bottom]), self.factor * np.array([place[0], top]),
                  words.quantity(top - bottom, "m"), labels, [(0, 0)])

    # ---- text ---------------------------------------------------------------------------------------
    def written(self):
        setup, column = self.setup, Column()
        column.heading(f"{words.counted(setup['count'], 'particle')}"
                       + (f" of {words.counted(len(setup['particles']), 'grain')}"
                          if len(setup["particles"]) != setup["count"] else ""))
        several = len(setup["classes"]) > 1
        for one in setup["classes"]:
            beginning = f"{one['name']} ({one['material']}): {one['count']:,} × " if several else f"{one['name']}: "
            if one["name"] == self.shape_of(one) and not several:
                beginning = ""
            column.line(beginning + self.size_text(one), {"facecolor": self.colour[one["material"]],
                                                     "edgecolor": "#4a5561", "linewidth": 0.6})
        column.line(self.sizes())
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        if setup["count"] > 1:
            column.line(self.extent_text(low, high))
        self.motion.write(column)
        if "initial_state" in setup:
            column.line(f"As kept in {setup['initial_state']}")
        self.write_materials(column)
        self.write_tools(column)
        if "bonds" in setup:
            self.write_bonds(column)
        return column

    def sizes(self):
        elements = [one["elements"] for one in self.setup["particles"]]
        return (f"{words.counted(sum(elements), 'element')}, {min(elements)}"
                + (f" to {max(elements)}" if max(elements) > min(elements) else "")
                + f" in each; slice of {words.quantity(self.setup['thickness'], 'm')}")

    def extent_text(self, low, high):
        wide, tall = (words.quantity(float(f"{length:.3g}"), "m") for length in high - low)
        return f"All of them: {wide} wide, {tall} high"

    def size_text(self, one):
        return size_text(one)

    def shape_of(self, one):
        return one["outline"]

    def write_materials(self, column):
        column.heading("Materials")
        for material in self.setup["materials"]:
            text = (f"{material['name']}: E = {words.quantity(material['youngs_modulus'], 'Pa')}, ν ="
                    f" {words.number(material['poissons_ratio'])}, {words.number(material['density'])} kg/m³, ")
            text += (f"yields at {words.quantity(material['yield_stress'], 'Pa')}" if "yield_stress" in material
                     else "elastic")
            if "flow_law" in material:
                text += f", law {material['flow_law']}"
            elif "hardening_modulus" in material:
                text += f", hardening modulus {words.quantity(material['hardening_modulus'], 'Pa')}"
            column.line(text, {"facecolor": self.colour[material["name"]], "edgecolor": "#4a5561", "linewidth": 0.6})
        pairs = self.setup["friction"]
        if len({pair["coefficient"] for pair in pairs}) == 1:
            column.line(f"Friction between particles: {words.number(pairs[0]['coefficient'])}")
            return
        for pair in pairs:
            column.line(f"Friction {pair['first']} – {pair['second']}: {words.number(pair['coefficient'])}")

    def write_tools(self, column):
        if not self.setup["tools"]:
            return
        column.heading("Tools (rigid)")
        for tool in self.setup["tools"]:
            swatch = {"facecolor": drawn_tools.face_colour(tool), "edgecolor": drawn_tools.EDGE, "linewidth": 0.6}
            if tool["shape"] == "constraint":
                held = {"both": "x and y", "all": "x, y and z", "radial": "the radial direction"}.get(tool["holds"], tool["holds"])
                column.line(f"{tool['name']}: holds {words.counted(len(tool['nodes']), 'node')} in {held}", swatch)
                continue
            values = sorted(set(tool["friction"].values()))
            if len(values) == 1:
                friction = words.number(values[0])
            else:
                friction = ", ".join(f"{words.number(value)} ({name})" for name, value in tool["friction"].items())
            column.line(f"{tool['name']}: {tool['shape']}, friction {friction}", swatch)
        if self.tools_move():
            column.line("Arrows: directions of moves and forces, by number of the stage"
                        + ("" if self.setup.get("dimension") == 3 else "; dashed: final positions of faces"))
        if self.setup.get("density_cells") and self.setup["die"]:
            columns, rows = self.setup["density_cells"]
            column.line(f"Dotted: {columns} × {rows} cells of local density")

    def tools_move(self):
        return any(stage["moves"] or stage["servos"] for stage in self.setup["stages"])

    def write_bonds(self, column):
        bonds = self.setup["bonds"]
        if not bonds["laws"]:
            return
        column.heading("Bonds")
        for law in bonds["laws"]:
            kind = {"initial": "from the start", "pressed": "formed by pressure", "adhesion": "adhesion"}[law["origin"]]
            text = f"{law['first']} – {law['second']}: {kind}"
            if "strength" in law:
                text += f", strength {words.quantity(law['strength'], 'Pa')}"
            if "work" in law:
                text += f", {words.quantity(law['work'], 'J/m²')} within {words.quantity(law['range'], 'm')}"
            column.line(text + (", inside particles" if law["inside"] else ""))
        if bonds["edges"]:
            column.line(f"{len(bonds['edges']):,} edges bonded at the start", {"facecolor": BOND, "edgecolor": BOND})
        if bonds.get("faces"):
            column.line(f"{words.counted(bonds['faces'], 'face')} bonded at the start")

    def stages(self):
        stages = self.setup["stages"]
        rows = [(stage["name"], stage["kind"],
                 ("at most " if "until" in stage else "") + words.quantity(stage["duration"], "s"),
                 words.stage_text(stage, self.setup.get("dimension", 2))) for stage in stages]
        durations = [stage["duration"] for stage in stages]
        return Programme("Stages", rows, f"{words.quantity(sum(durations), 's')} in all", durations)
