"""Colouring of field values: a continuous scale with a colour bar, or discrete colours with a legend."""
import colorsys
import difflib

import matplotlib
import numpy as np
from matplotlib.colors import BoundaryNorm, Normalize
from matplotlib.patches import Patch

from pulvis.errors import PulvisError
from pulvis.figures.look import COLOURS, bar_beside, unit_for
from pulvis.figures.names import label
from pulvis.figures.room import has_room, legend_below, renderer_of

NO_VALUE = "#d5dbe2"  # what has no value is grey
COUNTS = ("coordination", "tools_touched")  # ordered integers
MOST_IN_LEGEND = 12
WIDEST_LEGEND = 0.3  # of the figure, beside the picture


def fragment_colours(numbers):
    """A pale colour for every fragment, from its number only, so that it stays the same in all frames. [n, 3]

    Hues and saturations follow a low-discrepancy sequence (Roberts' R2)."""
    return np.array([colorsys.hsv_to_rgb(number * 0.7548776662 % 1, 0.2 + 0.3 * (number * 0.5698402910 % 1), 0.95)
                     for number in np.asarray(numbers, float)]).reshape(-1, 3)


def colour_map(options, otherwise="viridis"):
    name = options.cmap or otherwise
    if name not in matplotlib.colormaps:
        near = difflib.get_close_matches(name, list(matplotlib.colormaps), 4) or ["viridis", "cividis", "magma", "coolwarm"]
        raise PulvisError(f"--cmap {name}: no such colour map; allowed: those of matplotlib, e.g. {', '.join(near)}; append _r "
                          "to reverse one", key="--cmap")
    return matplotlib.colormaps[name].with_extremes(bad=NO_VALUE)


class Scale:
    """Numbers on a continuous scale; ordered integers in steps."""

    def __init__(self, field, values, options):
        values = np.asarray(values, float)
        low, high = options.clim(values, field.unit)
        if not low < high:
            low, high = low - 0.5, low + 0.5
        self.factor, shown = unit_for(field.unit, np.array([low, high]))
        self.label = label(field.label, shown)
        self.map, self.steps = colour_map(options), None
        if field.name in COUNTS:
            self.steps = np.arange(np.floor(low + 0.5), np.floor(high + 0.5) + 1)
            self.norm = BoundaryNorm(np.append(self.steps, self.steps[-1] + 1) - 0.5, self.map.N)
        else:
            self.norm = Normalize(self.factor * low, self.factor * high)
        above, below = (values > high).any(), (values < low).any()
        self.extend = {(True, True): "both", (True, False): "max", (False, True): "min"}.get((above, below), "neither")

    def paint(self, faces, values):
        faces.set(array=np.ma.masked_invalid(self.factor * np.asarray(values, float)), cmap=self.map, norm=self.norm)
        faces.update_scalarmappable()

    def key(self, figure, axes):
        mappable = matplotlib.cm.ScalarMappable(self.norm, self.map)
        more = {"ticks": self.steps[::max(1, len(self.steps) // 10)]} if self.steps is not None else {"extend": self.extend}
        bar_beside(figure, axes, mappable, self.label, **more).ax.minorticks_off()


class Kinds:
    """Integers that stand for categories: one colour each, and a legend if there are few."""

    def __init__(self, field, values):
        self.words, self.names = label(field.label, ""), field.names
        self.known = np.unique(values)
        self.none = 0 if field.name == "force_chain" else None  # value that means "in none"
        listed = bool(self.names) or len(self.known) <= len(COLOURS) and field.name != "fragment"
        self.colours = {int(k): COLOURS[i % len(COLOURS)] for i, k in enumerate(range(len(self.names)) if self.names else self.known)} \
            if listed else None

    def of(self, values):
        if self.colours is None:
            found = fragment_colours(values)
        else:
            found = np.array([matplotlib.colors.to_rgb(self.colours[int(value)]) for value in values]) * 0.65 + 0.35
        if self.none is not None:
            found[np.asarray(values) == self.none] = matplotlib.colors.to_rgb(NO_VALUE)
        return found

    def paint(self, faces, values):
        numbers, where = np.unique(values, return_inverse=True)
        faces.set_facecolor(self.of(numbers)[where])

    def key(self, figure, axes):
        if len(self.known) > MOST_IN_LEGEND:
            return
        patches = [Patch(facecolor=colour, label=self.names[k] if self.names else "none" if k == self.none else str(k))
                   for k, colour in zip(self.known, self.of(self.known))]
        legend = axes.legend(handles=patches, title=self.words, loc="upper left", bbox_to_anchor=(1.01, 1))
        if has_room(figure) and legend.get_window_extent(renderer_of(figure)).width > WIDEST_LEGEND * figure.bbox.width:
            legend.remove()
            legend_below(figure, patches, grows=False, title=self.words)


def colours_of(field, values, options):
    """field: fields.Field of one frame; values: of all frames that share the colour scale."""
    if field.whole and field.name not in COUNTS:
        if options.limits and not options.own_range or options.cmap:
            raise PulvisError(f"--range and --cmap are for fields with a continuous scale; {field.name} has a colour for each number")
        return Kinds(field, values)
    return Scale(field, values, options)
