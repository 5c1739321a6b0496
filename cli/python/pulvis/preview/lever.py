"""Set-up of an AFM lever: top view, side view, and the path of the tip on the surface."""
import math

import numpy as np
from matplotlib.patches import Circle, PathPatch, Polygon, Rectangle

from pulvis.preview import words
from pulvis.preview.powder import outline_path
from pulvis.preview.sheet import (FAINT, INK, MARGIN, MATERIAL_COLOURS, SIDE, WIDTH, Column, Labels, Programme,
                                  dimension, number_mark, stage_colour)

PARTS = ("glue", "tip", "coating", "lever")
CLAMP, SAMPLE, LASER = "#8d97a2", "#d9d2c3", "#d7263d"
LEAST_THICKNESS = 0.022  # minimum drawn thickness in the side view, as a fraction of the lever's length
BELOW = 0.75  # inches below a view: its axis, and the heading of the next view
DRAWING = WIDTH - 2 * MARGIN - SIDE - 0.35 - 0.55  # inches


def round_factor(wanted):
    """The next of 1, 2, 5, 10, ..."""
    if wanted <= 1:
        return 1
    power = 10 ** math.floor(math.log10(wanted))
    return next(int(power * step) for step in (1, 2, 5, 10) if power * step >= wanted * (1 - 1e-9))


class LeverDrawing:
    def __init__(self, setup):
        self.setup, self.lever, self.tip = setup, setup["lever"], setup["tip"]
        self.parts = setup["parts"]
        self.length = self.lever["length"]
        self.factor, self.unit = words.prefix_for(self.length, "m")
        names = [material["name"] for material in setup["materials"]]
        self.colour = {name: MATERIAL_COLOURS[i % len(MATERIAL_COLOURS)] for i, name in enumerate(names)}
        self.material = {"lever": self.lever["material"], "coating": self.lever.get("coating"),
                         "tip": self.tip.get("material"), "glue": self.tip.get("material")}
        if self.tip["shape"] == "sphere":
            self.round_ball()
        self.column, self.programme = self.written(), self.actions()
        self.measure()

    # ---- layout ------------------------------------------------------------------------------------
    def turned(self, points):
        """Transforms from the lever frame to the sample frame: x along the sample, z up."""
        c, s = math.cos(self.lever["tilt"]), math.sin(self.lever["tilt"])
        x, z = np.reshape(points, (-1, 2)).T
        return np.column_stack([c * x + s * z, c * z - s * x])

    def thickened(self, points):
        points = np.array(points, float)
        lower = min(z for _, z in self.parts["lever"]["side"])
        points[:, 1] = lower + self.thicker * (points[:, 1] - lower)
        return points

    def round_ball(self):
        """Draws the ball as a true sphere: its mesh is coarse."""
        angle, radius, end = np.linspace(0, 2 * np.pi, 91), self.tip["radius"], np.array(self.tip["end"])
        circle = radius * np.column_stack([np.cos(angle), np.sin(angle)])
        self.parts["tip"] = {"plan": [circle + end[:2]], "side": circle + [end[0], end[2] + radius],
                             "front": circle + [end[1], end[2] + radius]}

    def measure(self):
        length, plan = self.length, np.vstack([np.array(loop) for loop in self.parts["lever"]["plan"]])
        self.thicker = round_factor(LEAST_THICKNESS * length / self.lever["thickness"])
        self.x = np.array([-0.2 * length, max(plan[:, 0].max(), length) + 0.17 * length])
        self.y = np.array([plan[:, 1].min() - 0.13 * length, plan[:, 1].max() + 0.12 * length])
        self.sides = {name: self.turned(self.thickened(part["side"]) if name in ("lever", "coating") else part["side"])
                      for name, part in self.parts.items()}
        self.end = self.turned([self.tip["end"][0], self.tip["end"][2]])[0]
        if self.tip["shape"] == "sphere":  # a tilted ball has its lowest point elsewhere
            self.end = self.sides["tip"][np.argmin(self.sides["tip"][:, 1])]
        z = np.vstack(list(self.sides.values()))[:, 1]
        self.z = np.array([min(z.min(), self.end[1]) - (0.19 if self.pressed() is not None else 0.09) * length, z.max() + 0.08 * length])
        scale = DRAWING / np.ptp(self.x)
        self.plan_height, self.side_height = scale * np.ptp(self.y), scale * np.ptp(self.z)
        if self.plan_height > 4.2:
            self.plan_height = 4.2
        surface = self.setup["surface"]
        self.detail_height = 0 if not surface else 3.6 if surface["shape"] == "map" else 2.6
        self.height = self.plan_height + self.side_height + self.detail_height + 2 * BELOW + 0.15

    def pressed(self):
        """The index of the first action that presses to a given force."""
        return next((i for i, action in enumerate(self.setup["actions"]) if "force" in action), None)

    def draw(self, sheet, left, top):
        top += 0.15
        self.draw_plan(sheet.axes(left + 0.55, top, DRAWING, self.plan_height))
        top += self.plan_height + BELOW
        self.draw_side(sheet.axes(left + 0.55, top, DRAWING, self.side_height))
        top += self.side_height + BELOW
        if self.setup["surface"]:
            self.draw_surface(sheet, left + 0.55, top)

    def prepare(self, axes, x, y, names, title):
        axes.set(xlim=self.factor * x, ylim=self.factor * y, xlabel=f"{names[0]} [{self.unit}]",
                 ylabel=f"{names[1]} [{self.unit}]")
        axes.set_aspect("equal", anchor="NW", adjustable="box")
        axes.apply_aspect()
        axes.set_title(title, loc="left", fontsize=9, fontweight="bold", color=INK, pad=4)
        return Labels(axes)

    def face(self, part):
        return {"facecolor": self.colour.get(self.material[part], "#cccccc"), "edgecolor": "#4a5561", "linewidth": 0.8}

    # ---- top view -----------------------------------------------------------------------------------
    def draw_plan(self, axes):
        labels = self.prepare(axes, self.x, self.y, ("along x", "across y"), "From above")
        plan = self.parts["lever"]["plan"]
        path = outline_path([self.factor * np.array(loop) for loop in plan])
        axes.add_patch(PathPatch(path, **self.face("coating" if "coating" in self.parts else "lever"), zorder=2,
                                 gid="lever"))
        for name in ("tip", "glue"):
            if name in self.parts:
                axes.add_patch(Polygon(self.factor * np.array(self.parts[name]["plan"][0]), closed=True, fill=False,
                                       edgecolor=INK, linewidth=0.9, linestyle=(0, (3, 1.5)), zorder=4, gid=name))
        points = np.vstack([np.array(loop) for loop in plan])
        low, high = points[:, 1].min(), points[:, 1].max()
        self.clamp(axes, labels, low, high, self.factor * 0.07 * self.length)
        axis = self.factor * np.array(self.tip["axis"])
        axes.plot(*axis, marker="+", color=INK, markersize=6, zorder=6)
        if not self.setup["actions"]:
            self.loads(axes, labels, axis, [("F_x", (1, 0)), ("F_y", (0, 1))])
        if self.tip["shape"] != "none":
            labels.put("tip", axis, reach=16, leader=True, steps=[(1, -1), (0, -1), (-1, -1), (-1, 0)])
        self.laser(axes, labels)
        at = low - 0.07 * self.length
        dimension(axes, self.factor * np.array([0, at]), self.factor * np.array([self.length, at]),
                  words.quantity(self.length, "m"), labels, [(0, 0)])
        self.widths(axes, labels, low, high)

    def widths(self, axes, labels, low, high):
        at = 0.12 * self.length if self.lever["shape"] == "beam" else -0.12 * self.length
        width = self.lever.get("width", self.lever.get("base_width", high - low))
        dimension(axes, self.factor * np.array([at, low]), self.factor * np.array([at, high]),
                  words.quantity(width, "m"), labels, [(0, 0)])
        if "arm_width" not in self.lever:
            return
        angle, arm = self.lever["half_angle"], self.lever["arm_width"]
        outer = np.array([0.35 * self.length, high - 0.35 * self.length * math.tan(angle)])
        inner = outer - arm * np.array([math.sin(angle), math.cos(angle)])
        dimension(axes, self.factor * outer, self.factor * inner, words.quantity(arm, "m"), labels, [(0, 0)])
        labels.put(f"half angle {words.degrees(angle)}", (self.factor * 0.2 * self.length, 0), steps=[(0, 0)])

    def clamp(self, axes, labels, low, high, wide):
        low, high = self.factor * low, self.factor * high
        axes.add_patch(Rectangle((-wide, low), wide, high - low, facecolor=CLAMP, edgecolor=INK, linewidth=0.6,
                                 hatch="////", zorder=1))
        labels.put("clamp", (-wide / 2, (low + high) / 2), steps=[(0, 0)], rotation=90)

    def laser(self, axes, labels):
        laser = self.setup["laser"]
        place = self.factor * np.array([laser["position"], laser["offset"]])
        radius = self.factor * laser["radius"]
        if radius > 0:
            axes.add_patch(Circle(place, radius, facecolor=LASER, edgecolor="none", alpha=0.35, zorder=3))
        axes.plot(*place, marker="x", color=LASER, markersize=5, zorder=6)
        labels.put("laser" + (f", radius {words.quantity(laser['radius'], 'm')}" if radius > 0 else ""), place,
                   reach=16, color=LASER, leader=True, steps=[(-1, 1), (1, 1), (-1, -1), (0, 1)])

    def loads(self, axes, labels, place, directions):
        size = 0.13 * self.factor * self.length
        for name, direction in directions:
            head = place + size * np.array(direction)
            axes.annotate("", head, place, zorder=8, annotation_clip=False,
                          arrowprops={"arrowstyle": "-|>", "color": stage_colour(1), "linewidth": 1.8, "shrinkA": 0,
                                      "shrinkB": 0})
            shaft = (place + head) / 2
            labels.keep_free(labels.extent(labels.axes.annotate(" ", shaft, fontsize=9)))
            labels.put(name, head, reach=5, color=stage_colour(1), fontweight="bold",
                       steps=[direction, (direction[1], direction[0])])

    # ---- side view ----------------------------------------------------------------------------------
    def draw_side(self, axes):
        note = f", thickness drawn × {self.thicker}" if self.thicker > 1 else ", to scale"
        labels = self.prepare(axes, self.x, self.z, ("along x", "up z"), f"From the side{note}")
        for name in PARTS:
            if name in self.sides:
                axes.add_patch(Polygon(self.factor * self.sides[name], closed=True, zorder=3, gid=f"side-{name}",
                                       **self.face(name)))
        root = self.sides["lever"]
        near = root[root[:, 0] < 0.1 * self.length]
        self.clamp(axes, labels, near[:, 1].min() - 0.03 * self.length, near[:, 1].max() + 0.03 * self.length,
                   self.factor * 0.07 * self.length)
        end = self.factor * self.end
        if self.tip["shape"] != "none":
            labels.put(f"{self.tip['shape']}, {words.quantity(self.tip['height'], 'm')}", end,
                       steps=[(-1, 0), (-1, -1), (1, 0)], reach=12)
        if self.setup["surface"]:
            self.sample(axes, labels)
        middle = self.factor * self.turned([0.45 * self.length, 0])[0]
        text = f"thickness {words.quantity(self.lever['thickness'], 'm')}"
        if "coating" in self.lever:
            text += f" and {words.quantity(self.lever['coating_thickness'], 'm')} of {self.lever['coating']}"
        labels.put(text, middle, steps=[(0, 1)], reach=9)
        if self.lever["tilt"]:
            labels.put(f"tilt {words.degrees(self.lever['tilt'])}",
                       self.factor * self.turned([0.2 * self.length, 0])[0], steps=[(0, -1)], reach=11)
        if not self.setup["actions"]:
            self.loads(axes, labels, end, [("F_x", (1, 0)), ("F_z", (0, 1))])
        if self.pressed() is not None:
            force = self.setup["actions"][self.pressed()]["force"]
            self.press(axes, labels, end, self.pressed(), words.quantity(force, "N"))

    def sample(self, axes, labels):
        top, deep = self.factor * self.end[1], self.factor * 0.06 * self.length
        left, right = self.factor * self.x
        axes.add_patch(Rectangle((left, top - deep), right - left, deep, facecolor=SAMPLE, edgecolor="none", zorder=1,
                                 gid="sample"))
        axes.plot([left, right], [top, top], color=FAINT, linewidth=0.9, zorder=2)
        labels.put("sample", (left + 0.22 * (right - left), top - deep / 2), steps=[(0, 0)])

    def press(self, axes, labels, end, index, text):
        size = 0.12 * self.factor * self.length
        tail = end - np.array([0, size])
        axes.annotate("", end, tail, zorder=8, arrowprops={"arrowstyle": "-|>", "color": stage_colour(index),
                                                           "linewidth": 1.8, "shrinkA": 0, "shrinkB": 0})
        labels.keep_free(labels.extent(number_mark(axes, tail, index)))
        labels.put(text, (end + tail) / 2, steps=[(1, 0), (-1, 0)], reach=6, color=stage_colour(index))

    # ---- the surface --------------------------------------------------------------------------------
    def path(self):
        """Path of the tip: [(action index, begin, end)], (x, y) relative to its start; rasters are kept separately."""
        place, scans, rasters = np.zeros(2), [], []
        for i, action in enumerate(self.setup["actions"]):
            if action["kind"] not in ("scan", "raster"):
                continue
            way = action["distance"] * np.array([0, 1] if action["direction"] == "lateral" else [1, 0])
            if action["kind"] == "raster":
                aside = action["width"] * np.array([1, 0] if action["direction"] == "lateral" else [0, 1])
                rasters.append((i, place.copy(), way, aside, action["lines"]))
                place = place + aside
                continue
            scans.append((i, place.copy(), place + way))
            if not action["retrace"]:
                place = place + way
        return scans, rasters

    def draw_surface(self, sheet, left, top):
        if self.setup["surface"]["shape"] == "map":
            self.draw_map(sheet, left, top)
        else:
            self.draw_profile(sheet, left, top)

    def draw_map(self, sheet, left, top):
        surface, size = self.setup["surface"], self.detail_height - 0.45
        heights = np.array(surface["heights"])
        rows, columns = heights.shape
        factor, unit = words.prefix_for(surface["spacing"] * (columns - 1), "m")
        up, high_unit = words.prefix_for(np.ptp(heights), "m")
        half = 0.5 * factor * surface["spacing"] * np.array([columns - 1, rows - 1])
        axes = sheet.axes(left, top, min(size * columns / rows, 4.6), size)
        picture = axes.imshow(up * (heights - heights.min()), origin="lower", cmap="Greys_r", gid="map",
                              extent=(-half[0], half[0], -half[1], half[1]), interpolation="nearest")
        axes.set(xlabel=f"along x [{unit}]", ylabel=f"across y [{unit}]")
        axes.set_title("Surface from above; + is under the tip", loc="left", fontsize=9, fontweight="bold", color=INK,
                       pad=4)
        bar = sheet.figure.colorbar(picture, ax=axes, label=f"height [{high_unit}]", fraction=0.05, pad=0.04)
        bar.outline.set_visible(False)
        scans, rasters = self.path()
        for i, begin, way, aside, lines in rasters:
            corners = factor * np.array([begin, begin + way, begin + way + aside, begin + aside])
            axes.add_patch(Polygon(corners, closed=True, fill=False, edgecolor=stage_colour(i), linewidth=1.2))
            for share in np.linspace(0, 1, min(lines, 9)):
                self.arrow(axes, factor * (begin + share * aside), factor * (begin + share * aside + way), i, 0.8)
            number_mark(axes, factor * begin, i)
        for i, begin, end in scans:
            self.arrow(axes, factor * begin, factor * end, i, 1.6)
            number_mark(axes, factor * (begin + end) / 2, i)
        axes.plot(0, 0, marker="+", color=LASER, markersize=8, markeredgewidth=1.6)

    def arrow(self, axes, begin, end, index, wide):
        axes.annotate("", end, begin, zorder=8, annotation_clip=False,
                      arrowprops={"arrowstyle": "-|>", "color": stage_colour(index), "linewidth": wide, "shrinkA": 0,
                                  "shrinkB": 0})

    def profile_direction(self, scans):
        surface = self.setup["surface"]
        if surface["shape"] != "plane" or "incline" in surface or not scans:
            return surface["direction"]
        _, begin, end = scans[0]
        return "lateral" if abs((end - begin)[1]) > 0 else "along"

    def draw_profile(self, sheet, left, top):
        scans, _ = self.path()
        direction = self.profile_direction(scans)
        axis = 1 if direction == "lateral" else 0
        profile = np.array(self.setup["surface"]["profile"])
        tip = self.tip_outline(direction)
        reach = 1.25 * self.profile_reach(scans, axis, profile, tip)
        inside = profile[np.abs(profile[:, 0]) <= reach]
        rise = np.ptp(np.append(inside[:, 1], np.interp([-reach, reach], *profile.T)))
        factor, unit = words.prefix_for(reach, "m")
        width, height = DRAWING, self.detail_height - 0.45
        axes = sheet.axes(left, top, width, height)
        flat = 2 * reach * height / width  # m, height of the drawing if to scale
        higher = round_factor(0.12 * flat / rise) if rise > 1e-6 * reach else 1
        tip = tip - [0, self.clearance(tip, profile)]
        ground = np.vstack([profile, [profile[-1, 0], -9 * flat], [profile[0, 0], -9 * flat]])
        ground[:len(profile), 1] *= higher
        axes.add_patch(Polygon(factor * ground, closed=True, facecolor=SAMPLE, edgecolor=FAINT, linewidth=0.9,
                               zorder=2, gid="profile"))
        axes.set(xlim=(-factor * reach, factor * reach), ylim=(-factor * 0.35 * flat, factor * 0.65 * flat),
                 xlabel=f"{'across y' if axis else 'along x'} [{unit}]")
        axes.set_yticks([])
        axes.spines["left"].set_visible(False)
        axes.set_title("Tip and surface" + (f", heights × {higher}" if higher > 1 else ", to scale"), loc="left",
                       fontsize=9, fontweight="bold", color=INK, pad=4)
        labels = Labels(axes)
        self.draw_tip(axes, labels, (factor, higher), tip, np.interp(0, *profile.T))
        texts = []
        for k, (i, begin, end) in enumerate([one for one in scans if abs(one[2] - one[1])[axis] > 0][:4]):
            at = -factor * flat * (0.1 + 0.06 * k)
            self.arrow(axes, (factor * begin[axis], at), (factor * end[axis], at), i, 1.6)
            labels.keep_free(labels.extent(number_mark(axes, (factor * begin[axis], at), i)))
            texts.append((i, words.quantity(abs((end - begin)[axis]), "m")
                          + (" and back" if self.setup["actions"][i]["retrace"] else ""), (factor * (begin + end)[axis] / 2, at)))
        for i, text, place in texts:  # after all numbers have been placed
            labels.put(text, place, steps=[(0, -1), (1, 0), (-1, 0)], reach=6, color=stage_colour(i))
        labels.put(self.surface_text(), (-0.97 * factor * reach, -0.31 * factor * flat), steps=[(0, 0)], ha="left")

    def profile_reach(self, scans, axis, profile, tip):
        """Range of the scans and of the surface features; on a plane, the width of the tip."""
        reach = max((abs(place[axis]) for _, *ends in scans for place in ends), default=0)
        surface = self.setup["surface"]
        if "wavelength" in surface:
            return max(reach, surface["wavelength"])
        if surface["shape"] != "plane":
            return max(reach, np.abs(profile[1:-1, 0]).max())
        return max(reach, 0.6 * np.ptp(tip[:, 0]))

    def draw_tip(self, axes, labels, scale, tip, ground):
        """A sharp tip touches with its apex or the rounding around it, whatever the surrounding profile."""
        ball, (factor, higher) = self.tip["shape"] == "sphere", scale
        stretch = factor * np.array([1, higher])
        axes.add_patch(Polygon(stretch * tip, closed=True, zorder=4, gid="tip-on-surface", alpha=1 if ball else 0.4,
                               **self.face("tip")))
        if ball:
            return
        radius, angle = self.tip.get("end_radius", 0), np.linspace(0, 2 * np.pi, 73)
        if radius > 0:
            rounding = radius * np.column_stack([np.sin(angle), 1 - np.cos(angle)]) + [0, ground]
            axes.add_patch(Polygon(stretch * rounding, closed=True, zorder=5, **self.face("tip")))
        place = 0, factor * higher * ground
        axes.plot(*place, marker="o", markersize=4, color=INK, zorder=6)
        labels.put("touches here", place, leader=True, reach=18, steps=[(-1, 1), (1, 1)])

    def tip_outline(self, direction):
        """Outline of tip and glue relative to the apex: (sideways, up)."""
        parts = [self.parts[name] for name in ("tip",) if name in self.parts]
        if not parts:
            return 1e-2 * self.length * np.array([[0, 0], [0.2, 1], [-0.2, 1]])
        if direction == "along":
            return self.turned(parts[0]["side"]) - self.end
        return np.array(parts[0]["front"]) - [self.tip["end"][1], self.tip["end"][2]]

    def clearance(self, tip, profile):
        """Distance to lower the tip until it touches the profile: a sharp tip with its apex, a ball anywhere."""
        if self.tip["shape"] != "sphere":
            return -np.interp(0, *profile.T)
        close = np.vstack([tip + share * (np.roll(tip, -1, axis=0) - tip) for share in (0, 0.25, 0.5, 0.75)])
        return np.min(close[:, 1] - np.interp(close[:, 0], *profile.T))

    # ---- text ---------------------------------------------------------------------------------------
    def surface_text(self):
        surface = self.setup["surface"]
        parts = [surface["shape"]]
        if "incline" in surface:
            parts.append(f"inclined by {words.degrees(surface['incline'])}")
        for name, words_for in (("height", "high"), ("wavelength", "wavelength"), ("plateau", "plateau"),
                                ("spacing", "from point to point")):
            if name in surface:
                parts.append(f"{words.quantity(surface[name], 'm')} {words_for}"
                             if name != "wavelength" else f"wavelength {words.quantity(surface[name], 'm')}")
        if "slope" in surface:
            parts.append(f"flanks of {words.number(surface['slope'])}")
        return ", ".join(parts)

    def written(self):
        column, lever, tip = Column(), self.lever, self.tip
        swatch = {name: {"facecolor": colour, "edgecolor": "#4a5561", "linewidth": 0.6}
                  for name, colour in self.colour.items()}
        column.heading("Lever")
        shape = {"beam": "beam", "v": "V", "mesh": f"mesh of {lever.get('file')}"}[lever["shape"]]
        column.line(f"{shape}, {words.quantity(self.length, 'm')} long, {words.quantity(lever['thickness'], 'm')} thick"
                    + (f", {words.quantity(lever['width'], 'm')} wide" if "width" in lever else "")
                    + (f", arms {words.quantity(lever['arm_width'], 'm')} wide" if "arm_width" in lever else ""),
                    swatch[lever["material"]])
        if "coating" in lever:
            column.line(f"coating of {lever['coating']}, {words.quantity(lever['coating_thickness'], 'm')}",
                        swatch[lever["coating"]])
        stiffness = lever.get("rough_stiffness")
        if stiffness:
            column.line(f"As a simple beam about {words.number(float(f'{stiffness:.2g}'))} N/m")
        column.heading("Tip")
        if tip["shape"] == "none":
            column.line("none: loads act on the lever's lower face")
        else:
            text = f"{tip['shape']}, {words.quantity(tip['height'], 'm')} high"
            for name, told in (("radius", "radius"), ("foot", "foot"), ("end_radius", "end rounded by")):
                if name in tip:
                    text += f", {told} {words.quantity(tip[name], 'm')}"
            column.line(text + f", {words.quantity(tip['set_back'], 'm')} from the end", swatch[tip["material"]])
        self.write_surface(column)
        column.heading("Materials")
        for material in self.setup["materials"]:
            column.line(f"{material['name']}: E = {words.quantity(material['youngs_modulus'], 'Pa')}, ν ="
                        f" {words.number(material['poissons_ratio'])}"
                        + (f", yields at {words.quantity(material['yield_stress'], 'Pa')}"
                           if "yield_stress" in material else ""), swatch[material["name"]])
        return column

    def write_surface(self, column):
        surface = self.setup["surface"]
        if not surface:
            return
        column.heading("Surface (rigid)")
        text = self.surface_text() + f"; friction {words.number(surface['friction'])}"
        if "pull_off" in surface:
            text += f"; pull-off force {words.quantity(surface['pull_off'], 'N')}"
        if "work" in surface:
            text += f"; work of adhesion {words.quantity(surface['work'], 'J/m²')}"
        column.line(text, {"facecolor": SAMPLE, "edgecolor": FAINT, "linewidth": 0.6})
        if surface["shape"] == "map":
            rows, columns = np.shape(surface["heights"])
            column.line(f"{surface['file']}: {columns} × {rows} points")

    def actions(self):
        actions = self.setup["actions"]
        if not actions:
            return Programme("Actions", [("calibration", "", "", "stiffness of the lever: loads F_x, F_y and F_z on the "
                                          "tip's end, one after the other")])
        rows = [(action["name"] or action["kind"], action["kind"] if action["name"] else "",
                 words.counted(action["increments"], "increment"),
                 words.action_text(action)) for action in actions]
        return Programme("Actions", rows)
