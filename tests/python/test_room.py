"""No text of a figure leaves it, lies on another one or is too small to read, however narrow the figure is.

Every figure of the registries in pulvis.figures.command is drawn from folders that are made up (made_up.py): a new figure
that none of them can have fails until they hold what it shows.
"""
import warnings
from contextlib import contextmanager
from dataclasses import replace

import made_up
import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.legend import Legend
from matplotlib.text import Text

import pulvis
from pulvis.figures.animation import film
from pulvis.figures.command import DENSITY, GROUPS, NAMED_FIGURES, kind_of, picture_for
from pulvis.figures.curves import chosen_series
from pulvis.figures.fields import drawable
from pulvis.figures.look import NotDrawn, Options

WIDTHS = (85, 120, 180)  # mm: a column, one and a half, two of them
SMALLEST = 6  # points, of letters
OUTSIDE = 0.3  # points by which a box may leave the figure: boxes are wider than what is printed
LIES_ON = 1.0  # points by which two boxes may overlap, in the shorter direction
NARROWEST = 0.4  # inches, of axes
LONG_LABELS = 4  # series whose curves are drawn, of each run


@pytest.fixture(autouse=True)
def no_figure_stays():
    yield
    plt.close("all")


class Box:
    """A rectangle, turned as its text: middle, half sides and the directions of the sides. In points."""

    def __init__(self, extent, name, turn=0.0, sides=None, scale=1.0):
        self.name = name
        self.middle = scale * np.array([extent.x0 + extent.x1, extent.y0 + extent.y1]) / 2
        self.half = scale * np.array(sides if sides is not None else (extent.width, extent.height)) / 2
        self.ways = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])

    def reach(self, way):
        return np.abs(self.ways @ way) @ self.half

    def overlap(self, other):
        """How deep two boxes overlap: the least, over all directions in which they may be apart."""
        return min(self.reach(way) + other.reach(way) - abs(way @ (self.middle - other.middle)) for way in (*self.ways, *other.ways))

    def beyond(self, size):
        reach = np.array([self.reach(way) for way in np.eye(2)])
        return max(*(reach - self.middle), *(self.middle + reach - size))


def box_of(text, renderer, scale):
    """The box of a text as it is drawn. Its extent is upright: that of the turned box has the same middle."""
    extent, turn = text.get_window_extent(renderer), np.deg2rad(text.get_rotation())
    sides = None
    if turn % (np.pi / 2) > 1e-6:
        place = text.get_rotation()
        text.set_rotation(0)
        flat = text.get_window_extent(renderer)
        text.set_rotation(place)
        sides = flat.width, flat.height
        return Box(extent, repr(text.get_text()), turn, sides, scale)
    return Box(extent, repr(text.get_text()), scale=scale)


def drawn_texts(figure):
    """The texts that are drawn, as matplotlib draws them: it leaves out ticks beyond the ends of an axis."""
    texts, draw = [], Text.draw

    def keep(text, *rest, **more):
        if text.get_visible() and text.get_text().strip():
            texts.append(text)
        draw(text, *rest, **more)

    Text.draw = keep
    try:
        figure.draw_without_rendering()
    finally:
        Text.draw = draw
    return list(dict.fromkeys(texts))


def faults(figure):
    """What is wrong with the texts of a figure, in words."""
    texts, found = drawn_texts(figure), []
    renderer, scale = figure.canvas.get_renderer(), 72 / figure.dpi
    boxes = [box_of(text, renderer, scale) for text in texts]
    size = 72 * figure.get_size_inches()
    for text, box in zip(texts, boxes):
        if box.beyond(size) > OUTSIDE:
            found.append(f"{box.name} leaves the figure by {box.beyond(size):.1f} pt")
        if text.get_size() < SMALLEST - 1e-9:
            found.append(f"{box.name} has {text.get_size():.1f} pt")
    for k, one in enumerate(boxes):
        found += [f"{one.name} lies on {other.name} by {one.overlap(other):.1f} pt" for other in boxes[:k] if one.overlap(other) > LIES_ON]
    for legend in figure.findobj(Legend):
        frame, mine = Box(legend.get_window_extent(renderer), "a legend", scale=scale), set(legend.findobj(Text))
        found += [f"{box.name} lies on a legend by {box.overlap(frame):.1f} pt" for text, box in zip(texts, boxes)
                  if text not in mine and box.overlap(frame) > LIES_ON]
    return found + faults_of_axes(figure, list(zip(texts, boxes)), scale)


def faults_of_axes(figure, texts, scale):
    """Axes that are too small, and texts of others on them; those in three dimensions are larger than what they show."""
    found = []
    for axes in figure.axes:
        frame = Box(axes.get_window_extent(), "axes", scale=scale)
        if axes.name == "3d" or not axes.get_visible():
            continue
        if axes.get_label() != "<colorbar>" and 2 * frame.half.min() < 72 * NARROWEST:
            found.append(f"axes are {2 * frame.half[0]:.0f} by {2 * frame.half[1]:.0f} pt")
        found += [f"{box.name} lies on other axes by {box.overlap(frame):.1f} pt" for text, box in texts
                  if text.axes not in (axes, None) and text.axes not in axes.child_axes and box.overlap(frame) > LIES_ON]
    return found


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    place = tmp_path_factory.mktemp("made_up")
    return {make.__name__: make(place / make.__name__) for make in (made_up.powder, made_up.tablet, made_up.lever, made_up.study, made_up.probe,
                                                             made_up.probe_in_space)}


def runs_of(folders):
    return {name: pulvis.open(folders[name]) for name in ("powder", "tablet", "lever")}


def options_for(width):
    return Options(width=width / 25.4)


@contextmanager
def strictly(options):
    """In the style of the options; what matplotlib warns of is an error."""
    with plt.rc_context(options.style()), warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", "Creating legend with loc")  # on a busy machine
        yield


def check(wrong, name, figure):
    wrong += [f"{name}: {fault}" for fault in faults(figure)]
    plt.close(figure)


@pytest.mark.parametrize("width", WIDTHS)
def test_texts_of_runs_have_room(folders, width):
    wrong, options = [], options_for(width)
    with strictly(options):
        for kind, run in runs_of(folders).items():
            for name, draw in NAMED_FIGURES[kind_of(run)].items():
                figure = draw(run, options)
                if figure is None:
                    wrong.append(f"{kind} {name}: not drawn: made_up.py lacks what it shows")
                else:
                    check(wrong, f"{kind} {name}", figure)
    assert not wrong, f"at {width} mm:\n" + "\n".join(wrong)


@pytest.mark.parametrize("width", WIDTHS)
def test_texts_of_studies_and_probes_have_room(folders, width):
    wrong, options = [], options_for(width)
    with strictly(options):
        for kind, folder in [*((kind, kind) for kind in GROUPS), ("probe", "probe_in_space")]:
            for name, figure in GROUPS[kind][0](folders[folder], options):
                check(wrong, f"{folder} {name}", figure)
    assert not wrong, f"at {width} mm:\n" + "\n".join(wrong)


def test_texts_of_fields_series_and_films_have_room(folders):
    """In the narrowest figure, with the longest labels."""
    wrong, options = [], options_for(WIDTHS[0])
    with strictly(options):
        for kind, run in runs_of(folders).items():
            for name in drawable(run, run.frame()) if not run.is_solid else ():
                components = int(run.frame().dataset(name).attrs["components"])
                check(wrong, f"{kind} {name}", picture_for(run)(run, replace(options, field=f"{name}:1" if components > 1 else name)))
            if not run.is_solid:
                maps = picture_for(run, DENSITY)(run, replace(options, field=DENSITY, limits="frame"))
                check(wrong, f"{kind} density maps on their own scales", maps)
            check(wrong, f"film of {kind}", film(run, options)[0])
            for name in sorted(run.names, key=lambda name: -len(run.labels[name]))[:LONG_LABELS]:
                check(wrong, f"{kind} {name}", chosen_series(run, replace(options, series=[name])))
    assert not wrong, "\n".join(wrong)
