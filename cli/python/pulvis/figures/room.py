"""Room for the texts of a figure, however narrow it is: labels are broken into lines, ticks thinned out, legends put below.

It is a layout engine, so that figures have it whatever draws them.
"""
import re
import textwrap

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.font_manager import FontProperties
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import ScaledTranslation

SMALLEST = 6  # points, of letters
LONGEST = 1.0  # a label is as long as its side at most
MOST_LINES = 4  # of a label
FEWEST = 12  # letters on a line of a title or a legend
MOST_COLUMNS = 4  # of a legend below a figure
UNITS = r"(?<=\d) (?=[GMkmµn]?(?:s|m|Pa|N|J|V|seeds)\b)"  # the space between a number and its unit
PAD = 3.5  # points around axes with their labels
APART = 2.0  # points between the labels of two ticks
UNDER = 3.8  # heights of letters that ticks and label of an axis take


def renderer_of(figure):
    """Measures texts, whatever the figure is drawn or written with."""
    return figure._get_renderer()


def points_of(size):
    """A font size in points; it may be a word, as "small"."""
    return FontProperties(size=size).get_size_in_points()


def wrapped(text, letters):
    """The text on lines of at most so many letters; a number keeps its unit."""
    return textwrap.fill(re.sub(UNITS, "\u00a0", text), letters, break_on_hyphens=False, break_long_words=False).replace("\u00a0", " ")


def pieces_of(text):
    """Words of a label; mathtext is one word, and so is "/ MPa"."""
    words = re.findall(r"(?:\$[^$]*\$|[^\s$])+", text)
    joined = []
    for word in words:
        if joined and joined[-1] == "/":
            joined[-1] += f" {word}"
        else:
            joined.append(word)
    return joined


def broken_into(text, lines):
    """The text on so many lines, of about the same length."""
    words = pieces_of(text)
    lengths = [len(re.sub(r"\\[a-z]+|[${}_^]", "", word)) + 1 for word in words]
    least = [[np.inf] * (lines + 1) for _ in range(len(words) + 1)]  # the longest line, of the first words on n lines
    begin = [[0] * (lines + 1) for _ in range(len(words) + 1)]
    least[0] = [0] * (lines + 1)
    for end in range(1, len(words) + 1):
        for n in range(1, lines + 1):
            for first in range(end):
                longest = max(least[first][n - 1] if n > 1 or first == 0 else np.inf, sum(lengths[first:end]))
                if longest < least[end][n]:
                    least[end][n], begin[end][n] = longest, first
    rows, end = [], len(words)
    for n in range(lines, 0, -1):
        first = begin[end][n]
        rows.insert(0, " ".join(words[first:end]))
        end = first
    return "\n".join(row for row in rows if row)


def sides_of(axes):
    """[(axis, whether it is upright)] of flat axes."""
    return [] if axes.name in ("3d", "polar") else [(axes.xaxis, False), (axes.yaxis, True)]


def length_of(artist, renderer, upright):
    extent = artist.get_window_extent(renderer)
    return extent.height if upright else extent.width


def fit_label(axis, upright, renderer):
    """Breaks a label that is longer than its axis; then makes it smaller. Returns whether it changed."""
    words, changed = axis.label, False
    text = " ".join(words.get_text().split())
    side = LONGEST * length_of(axis.axes, renderer, upright)
    for lines in range(2, MOST_LINES + 1):
        if not text or length_of(words, renderer, upright) <= side or len(pieces_of(text)) < lines:
            break
        if words.get_text().count("\n") < lines - 1:
            words.set_text(broken_into(text, lines))
            changed = True
    while text and length_of(words, renderer, upright) > 1.15 * side and words.get_size() > SMALLEST:
        words.set_size(max(SMALLEST, words.get_size() - 0.5))
        changed = True
    return changed


def tick_labels(axis, upright, renderer):
    """Begin and end of the labels that are seen along an axis, ascending."""
    low, high = sorted(axis.get_view_interval())
    slack = 1e-9 * (high - low)
    labels = [label for place, label in zip(axis.get_majorticklocs(), axis.get_majorticklabels())
              if low - slack <= place <= high + slack and label.get_text()]
    extents = [label.get_window_extent(renderer) for label in labels]
    return sorted((extent.y0, extent.y1) if upright else (extent.x0, extent.x1) for extent in extents)


def fit_ticks(axis, upright, renderer):
    """Fewer ticks where their labels would touch. Returns whether it changed."""
    gap, changed = APART * axis.figure.dpi / 72, False
    for count in (5, 4, 3, 2, 1):
        ends = tick_labels(axis, upright, renderer)
        if not isinstance(axis.get_major_locator(), MaxNLocator) or all(a[1] + gap <= b[0] for a, b in zip(ends, ends[1:])):
            break
        if len(ends) > count:
            axis.set_major_locator(MaxNLocator(count, steps=[1, 2, 2.5, 5, 10], integer=axis.get_major_locator()._integer))
            changed = True
    return changed


def titles_of(axes):
    """The titles of axes, on the left, in the middle and on the right."""
    return [title for title in (axes._left_title, axes.title, axes._right_title) if title.get_text()]


def fit_title(title, renderer, right):
    """Breaks the lines of a title that go beyond `right`, then makes it smaller. Returns whether it changed."""
    changed, lines = False, title.get_text().split("\n")
    extent = title.get_window_extent(renderer)
    while extent.x1 > right and (max(map(len, lines)) > FEWEST or title.get_size() > SMALLEST):
        most = max(map(len, lines))
        if most > FEWEST:
            letters = max(FEWEST, min(most - 1, int(most * (right - extent.x0) / extent.width)))
            lines = "\n".join(wrapped(line, letters) for line in lines).split("\n")
            title.set_text("\n".join(lines))
        if most <= FEWEST or max(map(len, lines)) >= most:
            if title.get_size() <= SMALLEST:
                break
            title.set_size(max(SMALLEST, title.get_size() - 0.5))
        extent, changed = title.get_window_extent(renderer), True
    return changed


def right_of(axes):
    """How far a title of axes may go: to the axes on their right, or the end of the figure."""
    frame = axes.get_window_extent()
    others = [other.get_window_extent() for other in axes.figure.axes if other is not axes and other.get_label() != "<colorbar>"]
    beside = [one.x0 for one in others if one.x0 >= frame.x1 and one.y0 < frame.y1 and one.y1 > frame.y0]
    return min([axes.figure.bbox.x1, *beside]) - 2


class Room(ConstrainedLayoutEngine):
    """Constrained layout that makes room for the texts, with the legends of the figure below everything."""

    def execute(self, figure):
        renderer, below = renderer_of(figure), legends_height(figure)
        self.set(rect=(0, below, 1, 1 - below), w_pad=PAD / 72, h_pad=PAD / 72)
        for _ in range(3):
            super().execute(figure)
            if not self._fit(figure, renderer):
                break

    @staticmethod
    def _fit(figure, renderer):
        changed = False
        for axes in figure.axes:
            if not axes.get_visible():
                continue
            for part in (axes, *axes.child_axes):
                part.apply_aspect(part.get_axes_locator()(part, renderer) if part.get_axes_locator() else None)
                for axis, upright in sides_of(part):
                    changed |= fit_ticks(axis, upright, renderer)
                    changed |= fit_label(axis, upright, renderer)
            axes._update_title_position(renderer)
            for title in titles_of(axes) if axes.name != "3d" else ():
                changed |= fit_title(title, renderer, right_of(axes))
        if figure._suptitle:
            changed |= fit_title(figure._suptitle, renderer, figure.bbox.x1 - 2)
        return changed


class Still(Room):
    """Leaves everything in its place, for the frames of a film, and fits the texts of each."""

    def execute(self, figure):
        self._fit(figure, renderer_of(figure))


def has_room(figure):
    """Whether the figure is one of ours, which may be changed as a whole."""
    return isinstance(figure.get_layout_engine(), Room)


def subplots(*counts, **more):
    return plt.subplots(*counts, layout=Room(), **more)


def legends_height(figure):
    """The part of the height of a figure that its legends take."""
    renderer = renderer_of(figure)
    return sum(legend.get_window_extent(renderer).height for legend in figure.legends) / figure.bbox.height


def legend_below(figure, handles, grows=True, **more):
    """One legend for the whole figure, below everything, in as many columns as fit; `grows`: the figure becomes higher by it."""
    first = not figure.legends
    for legend in list(figure.legends):
        legend.remove()
    words = [handle.get_label() for handle in handles]
    letters = max(FEWEST, *map(len, words))
    columns, size = min(len(words), MOST_COLUMNS), points_of(plt.rcParams["legend.fontsize"])
    while True:
        legend = figure.legend(handles, [wrapped(text, letters) for text in words], loc="lower center", bbox_to_anchor=(0.5, 0),
                               ncol=columns, borderaxespad=0.2, columnspacing=1.2, handlelength=1.8, fontsize=size, **more)
        if legend.get_window_extent(renderer_of(figure)).width < 0.97 * figure.bbox.width or (columns, letters) == (1, FEWEST):
            break
        legend.remove()
        if columns > 1:
            columns -= 1
        elif size > SMALLEST:
            size = SMALLEST
        else:
            letters = max(FEWEST, letters - 4)
    legend.set_in_layout(False)
    if first and grows:
        figure.set_figheight(figure.get_figheight() * (1 + legends_height(figure)))
    return legend


def legend_under(axes, **more):
    """A legend of some axes, under their label."""
    size = points_of(plt.rcParams["font.size"])
    down = ScaledTranslation(0, -UNDER * size / 72, axes.figure.dpi_scale_trans)
    return axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0), bbox_transform=axes.transAxes + down, borderaxespad=0, **more)


def legend_within(axes, options, share=0.55, **more):
    """The legend in axes, or beside them by loc and bbox_to_anchor in `more`; below the figure where it is wider than `share`
    of it, or higher than half of it."""
    figure = axes.figure
    if has_room(figure):
        legend = axes.legend(**{**more, "loc": "upper left"})  # its size: the best place for it takes long to find
        extent = legend.get_window_extent(renderer_of(figure))
        legend.remove()
        if extent.width > share * figure.bbox.width or extent.height > 0.5 * figure.bbox.height:
            legend_below(figure, axes.get_legend_handles_labels()[0], not options.height)
            return
    axes.legend(**more)
