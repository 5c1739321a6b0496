"""The sheet on which a set-up is drawn: coordinates in inches from the upper left corner, wrapped text, and labels
that avoid each other."""
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.patches import Rectangle
from matplotlib.text import Text

STYLE = {"figure.dpi": 150, "savefig.dpi": 200, "font.size": 9, "svg.fonttype": "none", "pdf.fonttype": 42,
         "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.6, "xtick.labelsize": 8,
         "ytick.labelsize": 8, "axes.labelsize": 9, "hatch.linewidth": 0.5, "axes.edgecolor": "#5b6672",
         "xtick.color": "#5b6672", "ytick.color": "#5b6672", "axes.labelcolor": "#38424d"}
INK, FAINT, WARNING = "#1d2733", "#5b6672", "#a63603"
MATERIAL_COLOURS = ["#a6c8e4", "#f6c391", "#b5dba9", "#cfc0e4", "#f2e08c", "#e8b3c2", "#9fd8d2", "#d2c3b0"]
STAGE_COLOURS = ["#0072b2", "#d55e00", "#007f5f", "#b0418f", "#8c6d1f", "#5a4fcf", "#555555", "#882255"]
WIDTH, MARGIN, SIDE = 11.4, 0.3, 3.55  # inches: sheet width, margin, and text column
LINE = 0.165  # inches, line spacing


def stage_colour(index):
    return STAGE_COLOURS[index % len(STAGE_COLOURS)]


def wrapped(text, inches, size=8.5):
    """Text wrapped to this width; letters of the sheet's font are a little over half as wide as high."""
    return textwrap.wrap(text, max(12, int(inches * 72 / (0.56 * size)))) or [""]


class Sheet:
    def __init__(self, height):
        self.height = height
        self.figure = plt.figure(figsize=(WIDTH, height))

    def axes(self, left, top, width, height):
        return self.figure.add_axes((left / WIDTH, 1 - (top + height) / self.height, width / WIDTH,
                                     height / self.height))

    def text(self, left, top, text, **style):
        # A dollar sign in a scene is not mathtext.
        self.figure.text(left / WIDTH, 1 - top / self.height, text.replace("$", r"\$"),
                         **{"va": "top", "color": INK, "fontsize": 8.5, **style})

    def box(self, left, top, width, height, **style):
        self.figure.add_artist(Rectangle((left / WIDTH, 1 - (top + height) / self.height), width / WIDTH,
                                         height / self.height, transform=self.figure.transFigure, **style))


class Column:
    """Text beside a drawing: headings, lines, lines with a colour swatch. Measured before drawing."""

    def __init__(self, width=SIDE):
        self.width, self.rows = width, []

    def heading(self, text):
        self.rows.append(("heading", text, None))

    def line(self, text, swatch=None):
        indent = 0.24 if swatch else 0.0
        for i, part in enumerate(wrapped(text, self.width - indent)):
            self.rows.append(("line", part, swatch if i == 0 else "space" if swatch else None))

    @property
    def height(self):
        return sum(LINE * (1.7 if kind == "heading" else 1) for kind, _, _ in self.rows)

    def write(self, sheet, left, top):
        for kind, text, swatch in self.rows:
            if kind == "heading":
                top += 0.55 * LINE
                sheet.text(left, top, text, fontweight="bold")
                top += 1.15 * LINE
                continue
            if isinstance(swatch, dict):
                sheet.box(left + 0.02, top + 0.02, 0.15, 0.1, **swatch)
            sheet.text(left + (0.24 if swatch else 0), top, text)
            top += LINE


def clash(box, others):
    return sum(max(0, min(box.x1, o.x1) - max(box.x0, o.x0)) * max(0, min(box.y1, o.y1) - max(box.y0, o.y0))
               for o in others)


class Labels:
    """Labels in a drawing, each next to its point, placed so that it covers no earlier label."""
    AROUND = [(0, 0), (0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (-1, 1), (1, -1), (-1, -1)]

    def __init__(self, axes):
        self.axes, self.taken = axes, []
        self.renderer = axes.figure.canvas.get_renderer()

    def extent(self, text):
        """Bounding box of the text alone, without its leader line."""
        text.update_positions(self.renderer)
        return Text.get_window_extent(text, self.renderer).expanded(1.04, 1.1)

    def keep_free(self, box):
        self.taken.append(box)

    def put(self, text, place, steps=None, reach=14, leader=False, **style):
        """`steps`: directions to try, best first; `reach`: offset in points; `leader`: draw a leader line."""
        if leader:
            style["arrowprops"] = {"arrowstyle": "-", "color": style.get("color", FAINT), "linewidth": 0.7,
                                   "shrinkA": 0, "shrinkB": 2}
        style = {"ha": "center", "va": "center", "fontsize": 8.5, "color": INK, "zorder": 9,
                 "bbox": {"boxstyle": "round,pad=0.18", "facecolor": "white", "edgecolor": "none", "alpha": 0.82},
                 **style}
        mark = self.axes.annotate(text.replace("$", r"\$"), place, xytext=(0, 0), textcoords="offset points",
                                  annotation_clip=False, **style)
        frame, best = self.axes.get_window_extent(self.renderer), None
        own = self.extent(mark)
        points = 72 / self.axes.figure.dpi
        for distance in (1, 2, 3.2):
            for dx, dy in steps or self.AROUND:
                at = (dx * (reach * distance + dx * dx * own.width * points / 2),
                      dy * (reach * distance + own.height * points / 2))
                moved = own.translated(at[0] / points, at[1] / points)
                outside = own.width * own.height - clash(moved, [frame])
                cost = clash(moved, self.taken) + 0.5 * max(outside, 0)
                if best is None or cost < best[0] - 1e-6:
                    best = cost, at, moved
            if best[0] < 1e-6:
                break
        mark.set_position(best[1])
        self.taken.append(best[2])
        return mark


def number_mark(axes, place, index, **style):
    """The number of a stage, in its colour."""
    return axes.annotate(f"{index + 1}", place, ha="center", va="center", fontsize=7.5, color="white",
                         fontweight="bold", zorder=11, annotation_clip=False,
                         bbox={"boxstyle": "circle,pad=0.22", "facecolor": stage_colour(index), "edgecolor": "none"},
                         **style)


def dimension(axes, begin, end, text, labels, steps):
    """A dimension line with arrows at both ends and its value."""
    axes.annotate("", begin, end, arrowprops={"arrowstyle": "<->", "color": FAINT, "linewidth": 0.8, "shrinkA": 0,
                                              "shrinkB": 0}, annotation_clip=False, zorder=8)
    middle = [(a + b) / 2 for a, b in zip(begin, end)]
    steep = abs(end[1] - begin[1]) > 2 * abs(end[0] - begin[0])
    labels.put(text, middle, steps=steps, reach=1, color=FAINT, rotation=90 if steep else 0,
               bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.95})


class Programme:
    """Stages or actions: a bar with their durations, and one row of text each."""
    MOST = 14
    PLACES = 0.32, 2.35, 3.35, 4.55  # inches: name, kind, duration, what happens

    def __init__(self, title, rows, total="", shares=None):
        """rows: [(name, kind, duration, text)]; shares: fractions of the bar, or None."""
        self.title, self.total = title, total
        self.shares = shares
        kept = list(enumerate(rows))
        self.left_out = max(0, len(kept) - self.MOST)
        if self.left_out:
            kept = kept[:self.MOST - 2] + kept[-2:]
        room = WIDTH - 2 * MARGIN - self.PLACES[3]
        self.rows = [(i, name, kind, duration, wrapped(text, room)) for i, (name, kind, duration, text) in kept]

    @property
    def height(self):
        lines = sum(len(text) for *_, text in self.rows) + (1 if self.left_out else 0)
        return 0.3 + (0.28 if self.shares else 0) + lines * LINE + 0.06 * len(self.rows)

    def write(self, sheet, top):
        sheet.text(MARGIN, top, self.title, fontweight="bold", fontsize=9)
        sheet.text(WIDTH - MARGIN, top, self.total, ha="right", color=FAINT)
        top += 0.24
        if self.shares:
            self.bar(sheet, top)
            top += 0.28
        for position, (i, name, kind, duration, text) in enumerate(self.rows):
            if self.left_out and position == len(self.rows) - 2:
                sheet.text(MARGIN + self.PLACES[0], top, f"… {self.left_out} more …", color=FAINT)
                top += LINE
            sheet.figure.text((MARGIN + 0.1) / WIDTH, 1 - (top + 0.065) / sheet.height, f"{i + 1}", ha="center",
                              va="center", color="white", fontsize=7, fontweight="bold",
                              bbox={"boxstyle": "circle,pad=0.2", "facecolor": stage_colour(i), "edgecolor": "none"})
            room = self.PLACES[1] - self.PLACES[0]
            name = name if len(wrapped(name, room, 9.6)) == 1 else wrapped(name, room - 0.15, 9.6)[0] + "…"  # bold
            sheet.text(MARGIN + self.PLACES[0], top, name, fontweight="bold")
            sheet.text(MARGIN + self.PLACES[1], top, kind)
            sheet.text(MARGIN + self.PLACES[2], top, duration)
            for line in text:
                sheet.text(MARGIN + self.PLACES[3], top, line)
                top += LINE
            top += 0.06

    def bar(self, sheet, top):
        width, left = WIDTH - 2 * MARGIN, MARGIN
        total = sum(self.shares)
        for i, share in enumerate(self.shares):
            piece = width * share / total if total > 0 else width / len(self.shares)
            sheet.box(left, top, piece, 0.16, facecolor=stage_colour(i), edgecolor="white", linewidth=0.8)
            if piece > 0.16:
                sheet.text(left + piece / 2, top + 0.08, f"{i + 1}", ha="center", va="center", color="white",
                           fontsize=7.5, fontweight="bold")
            left += piece
