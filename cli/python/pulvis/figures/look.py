"""Common to all figures: style, size, units, and line plots."""
import csv
from dataclasses import dataclass, field as of_dataclass

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.ticker import FuncFormatter
from matplotlib.transforms import offset_copy

from pulvis.errors import RunError
from pulvis.figures.hidden import dash_hidden
from pulvis.figures.names import label, name_of, plain
from pulvis.figures.quantities import limits_of, unit_for, with_unit
from pulvis.figures.room import UNDER, has_room, legend_below, legend_within, legends_height, points_of, subplots, wrapped

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555", "#8c6d1f",
           "#882255", "#117733"]
STYLE = {"figure.dpi": 200, "font.size": 10, "axes.grid": True, "grid.color": "#e3e8ee",
         "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True,
         "svg.fonttype": "none", "pdf.fonttype": 42, "lines.linewidth": 1.6, "legend.frameon": False, "axes.titlesize": 11,
         "axes.prop_cycle": plt.cycler(linestyle=["-", "--", ":"]) * plt.cycler(color=COLOURS)}
# For one journal column: font and line sizes for a figure printed at actual size.
NARROW = {"font.size": 8, "axes.titlesize": 8.5, "lines.linewidth": 1.2, "axes.linewidth": 0.6, "legend.fontsize": 7,
          "xtick.major.width": 0.6, "ytick.major.width": 0.6}
NARROW_BELOW = 120 / 25.4  # inches

MANY_LINES = 5
OWN_RANGE = "frame"  # colour limits: those of each frame


class NotDrawn(RunError):
    """A figure that this run cannot have, with the reason."""


@dataclass
class Options:
    """Options of a figure."""

    frame: int = None        # frame number; None: the last
    field: str = None
    series: list = of_dataclass(default_factory=list)
    against: str = None
    level: str = "none"      # levelling of raster images
    width: float = None      # inches, as is height
    height: float = None
    title: bool = True
    cmap: str = None
    limits: object = None    # colour limits: "LOW:HIGH" with units, or (low, high) in SI; None: from the values; "frame"
    dpi: float = 200
    vector: bool = False     # SVG or PDF
    across: str = "y"        # axis normal to a 3D section
    at: float = None         # m, its position; None: the middle

    @property
    def narrow(self):
        return bool(self.width) and self.width < NARROW_BELOW

    def style(self):
        """For plt.rc_context."""
        return {**STYLE, **(NARROW if self.narrow else {})}

    def context(self, axes=None):
        """For plt.rc_context in Python: axes passed by the caller keep the style of their figure."""
        return {} if axes is not None else {**self.style(), "figure.dpi": self.dpi}

    def size(self, wide, tall, beside=0.0):
        """Figure size in inches, default wide x tall; `beside`: part of the height that does not scale with width."""
        if not self.width:
            return wide, self.height or tall
        return self.width, self.height or (tall - beside) * self.width / wide + beside

    @property
    def own_range(self):
        """Whether every density map has the colour scale of its own frame."""
        return self.limits == OWN_RANGE

    def clim(self, values, unit):
        """Colour limits in SI: as requested, or from `values` where one is open."""
        values = np.asarray(values, float)
        finite = values[np.isfinite(values)]
        ends = (finite.min(), finite.max()) if finite.size else (0.0, 1.0)
        asked = limits_of(None if self.own_range else self.limits, unit)
        return tuple(end if one is None else one for one, end in zip(asked, ends))

    def head(self, axes, text, run=None, of_width=7.2):
        """The title of axes; of_width: default width of the figure, inches."""
        if self.title:
            size = points_of(plt.rcParams["axes.titlesize"])
            letters = int((self.width or of_width) * 72 * 0.8 / (0.5 * size))
            lines = (text if run is None else f"{text}\n{run.title}").split("\n")
            axes.set_title("\n".join(wrapped(line, letters) for line in lines), loc="left")


def sheet(options, size, axes=None, beside=0.0):
    """(figure, axes): the given `axes` and their figure, or new ones."""
    if axes is not None:
        return axes.figure, axes
    return subplots(figsize=options.size(*size, beside))


def printed(value, unit):
    """A quantity in a title, with a minus sign as on the axes."""
    return with_unit(value, unit).replace("-", "−")


def moment(frame):
    """The time of a frame, in words."""
    return with_unit(frame.attrs["time"], "s")


def shape_of(limits):
    """Figure size in inches for these limits, and the part of the height that does not scale with the width."""
    shape = np.ptp(limits[:, 1]) / np.ptp(limits[:, 0])
    return (7.2, min(max(6.0 * shape, 2.4), 9.0) + 0.9), 0.9


def seam(options):
    """Width of the edges that close anti-aliasing gaps between elements: at least one pixel."""
    return 0.35 if options.vector else max(0.35, 1.3 * 72 / options.dpi)


def name_lengths(axes, extent, x=None, y=None):
    """Labels axes that are drawn in mm, in the unit that suits the extent (m). x, y: symbols; None: not a length."""
    factor, unit = unit_for("m", np.ptp(extent, axis=0))
    ticks = FuncFormatter(lambda place, _: f"{1e-3 * factor * place:.6g}".replace("-", "−"))
    for axis, symbol in ((axes.xaxis, x), (axes.yaxis, y)):
        if symbol:
            axis.set_label_text(f"${symbol}$ / {unit}")
            axis.set_major_formatter(ticks)


def set_axes(axes, limits, names="xy"):
    """limits: mm."""
    axes.set(xlim=limits[:, 0], ylim=limits[:, 1], aspect="equal")
    name_lengths(axes, 1e-3 * limits, *names)
    axes.grid(False)


def bar_beside(figure, axes, mappable, words, **more):
    """A colour bar of the same height as its axes; below flat ones, which are too low for its label on two lines."""
    high = np.ptp(axes.get_ylim()) / np.ptp(axes.get_xlim())
    size = points_of(plt.rcParams["axes.labelsize"])
    if has_room(figure) and 0.5 * size * len(plain(words)) > 2 * 0.75 * 72 * figure.get_figwidth() * high:
        down = (UNDER if axes.axison else 0.5) * size
        under = offset_copy(axes.transAxes, figure, y=-down, units="points")
        place = axes.inset_axes([0.1, -0.035 / high, 0.8, 0.035 / high], transform=under)
        more["orientation"] = "horizontal"
    else:
        place = axes.inset_axes([1.03, 0, 0.035, 1])
    bar = figure.colorbar(mappable, cax=place, label=words, **more)
    bar.outline.set_visible(False)
    return bar


def close_up(figure, options, axes):
    """Trims empty space above and below a plot with a fixed aspect ratio; not in `axes` given by the caller."""
    if axes is not None or options.height:
        return
    figure.canvas.draw()
    legends = legends_height(figure) * figure.get_figheight()
    figure.set_figheight(figure.get_tightbbox().height + legends + 0.1)


def recorded(run, options, name):
    """The frame to draw, or None if the run did not record `name`."""
    if not run.frames or name not in run.frame(options.frame):
        return None
    return run.frame(options.frame)


def write_csv(path, table):
    """table: [(name, unit, values)] in SI; lengths may differ."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([f"{name} [{unit}]" for name, unit, _ in table])
        for i in range(max(len(values) for _, _, values in table)):
            writer.writerow([repr(float(values[i])) if i < len(values) else "" for _, _, values in table])


def worded(run, name, unit):
    """An axis label. name: a series or field of the run, or (words, symbol)."""
    return label(name_of(name, run.labels) if isinstance(name, str) else name, unit)


def place_legend(axes, count, options):
    """Puts the legend beside the curves if there are many, or below them if there is no room."""
    if count < MANY_LINES:
        legend_within(axes, options)
    else:
        legend_beside(axes, options)


def legend_beside(axes, options):
    """The legend on the right of the axes; below them in a narrow figure."""
    if options.narrow and has_room(axes.figure):
        legend_below(axes.figure, axes.get_legend_handles_labels()[0], not options.height)
    else:
        legend_within(axes, options, 0.35, loc="upper left", bbox_to_anchor=(1.01, 1))


def draw_lines(run, x, lines, ylabel, title, options=None, into=None):
    """x: (key, values, unit); lines: [(label, values, unit)] in one unit; ylabel: a series,
    or (words, symbol)."""
    options = options or Options()
    figure, axes = sheet(options, (6.4, 4.2), into)
    x_factor, x_unit = unit_for(x[2], x[1])
    factor, unit = unit_for(lines[0][2], np.concatenate([values for _, values, _ in lines]))
    drawn = [axes.plot(x_factor * x[1], factor * values, label=one)[0] for one, values, _ in lines]
    dash_hidden(axes, drawn)
    axes.set_xlabel(worded(run, x[0], x_unit))
    axes.set_ylabel(worded(run, ylabel, unit))
    options.head(axes, title, run)
    if len(lines) > 1:
        place_legend(axes, len(lines) if into is None else 0, options)
    figure.table = [(x[0], x[2], x[1]), *((plain(one), unit, values) for one, values, unit in lines)]
    return figure
