"""The field of a frame: particles with coloured elements, outlines, tools, the periodic cell."""
from dataclasses import dataclass, field as of_dataclass

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from pulvis.errors import PulvisError
from pulvis.figures.bonds import BOND_FIELDS, draw_bonds
from pulvis.figures.cell import Cell
from pulvis.figures.colours import colours_of
from pulvis.figures.look import Options, close_up, moment, seam, set_axes, shape_of, sheet
from pulvis.figures.names import Name, capital, joined, name_of
from pulvis.figures.tools import draw_tools, outlines
from pulvis.frames import names_in

DEFAULT_FIELD = "effective_stress"
OUTLINE = "#1d2733"


@dataclass
class Field:
    """The plotted field of one frame: one value per cell."""

    key: str                  # as requested: NAME or NAME:k
    values: np.ndarray
    unit: str
    label: Name
    whole: bool = False
    names: list = of_dataclass(default_factory=list)

    @property
    def name(self):
        return self.key.partition(":")[0]

    @property
    def title(self):
        """Its words, with the symbol of the component."""
        return capital(joined(self.label.words, self.label.symbol if ":" in self.key else ""))


def drawable(run, frame):
    """Names of the fields that can be drawn."""
    return [*(name for name in frame.fields if frame[name].attrs["place"] in ("cell", "particle")),
            *run.file.get("particles", [])]


def field_of(run, frame, key):
    """A cell or particle field as one value per cell: NAME, or NAME:k for a component."""
    name, _, component = key.partition(":")
    known = drawable(run, frame)
    if name not in known:
        raise PulvisError(f"no field {name} of cells or particles; there are: {', '.join(known) or 'none'}")
    data = frame.dataset(name)
    count = int(data.attrs.get("components", 1))
    if data.ndim > 1 and not (component.isdigit() and 1 <= int(component) <= count):
        raise PulvisError(f"{name} has {count} components: choose {name}:1 to {name}:{count}")
    values = data[()] if data.ndim == 1 else data[:, int(component) - 1]
    if data.attrs.get("place", "particle") == "particle":
        values = values[run.mesh.cell_particle]
    return Field(key, values, data.attrs["unit"], name_of(key, run.labels, count), np.issubdtype(data.dtype, np.integer), names_in(data))


def paint(run, axes, frame, field, colours, options, limits=None):
    """Draws one frame into axes. limits: mm; by default those of the drawn objects."""
    cell, quads = Cell(run, frame), run.mesh.cells
    limits = 1e3 * cell.limits() if limits is None else limits
    edge = seam(options)
    faces = PolyCollection(1e3 * cell.position[quads], edgecolors="face", linewidths=edge, joinstyle="round")
    colours.paint(faces, field.values)
    faces.set_edgecolor("face")
    axes.add_collection(faces)
    edges = outlines(quads)
    axes.add_collection(LineCollection(1e3 * cell.position[edges], colors=OUTLINE, linewidths=max(0.4, edge),
                                       capstyle="round", zorder=2.2))
    cell.draw(axes, faces.get_facecolor(), edges, edge)
    draw_tools(run, axes, frame, limits / 1e3)
    set_axes(axes, limits)
    options.head(axes, f"{field.title} at {moment(frame)}", run)
    return cell


def draw_field(run, frame, field, options, into=None):
    limits = 1e3 * Cell(run, frame).limits()
    size, beside = shape_of(limits)
    figure, axes = sheet(options, size, into, beside)
    colours = colours_of(field, field.values, options)
    cell = paint(run, axes, frame, field, colours, options, limits)
    if field.name in BOND_FIELDS:
        draw_bonds(run, figure, axes, frame, cell)
    colours.key(figure, axes)
    close_up(figure, options, into)
    middle = cell.position[run.mesh.cells].mean(axis=1)
    figure.table = [("x", "m", middle[:, 0]), ("y", "m", middle[:, 1]), (field.key, field.unit, field.values)]
    return figure


def field_picture(run, options=None, axes=None):
    options = options or Options()
    if not run.frames:
        return None
    frame = run.frame(options.frame)
    try:
        field = field_of(run, frame, options.field or DEFAULT_FIELD)
    except PulvisError:
        if options.field:  # requested by name
            raise
        return None
    return draw_field(run, frame, field, options, axes)
