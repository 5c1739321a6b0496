"""Figures of breaking bonds: cracks by mode, fragments, fracture energy, fragment sizes."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.ticker import MaxNLocator

from pulvis.figures.cell import Cell
from pulvis.figures.colours import fragment_colours
from pulvis.figures.hidden import dash_hidden
from pulvis.figures.look import Options, bar_beside, close_up, legend_beside, moment, recorded, seam, set_axes, shape_of, sheet, unit_for, worded
from pulvis.figures.names import label
from pulvis.figures.room import subplots
from pulvis.figures.tools import draw_tools, outlines

BOND_FIELDS = ("damage", "fragment")  # fields with bonds and cracks drawn on top
MODES = LinearSegmentedColormap.from_list("modes", ["#d55e00", "#b89bc4", "#0072b2"])
BOND_COLOUR = "#5b6672"
SHEAR = "Share of shear (0 mode I, 1 mode II)"


def lines_of(frame, group):
    return 1e3 * np.stack([frame[f"{group}/start"][()], frame[f"{group}/end"][()]], axis=1)


def draw_bonds(run, figure, axes, frame, cell, alone=False):
    """Thin lines along the bonds, and broken ones coloured by fracture mode; their colour bar, if any, goes into `figure`:
    below the axes, or beside them if `alone`."""
    bonds, broken = lines_of(frame, "bonds"), lines_of(frame, "cracks")
    shear = run.file["cracks/shear"][:len(broken)]
    broken = broken[:len(shear)]  # the newest rows may be missing if the run was killed
    if cell.here:
        bonds += 1e3 * cell.shift[frame["bonds/ids"][:, 0], None]
        broken += 1e3 * cell.shift[run.file["cracks/particle"][:len(broken)], None]
    axes.add_collection(LineCollection(bonds, colors=BOND_COLOUR, linewidths=0.6, zorder=3))
    drawn = LineCollection(broken, array=shear, cmap=MODES, clim=(0, 1),
                           linewidths=1.6, capstyle="round", zorder=4)
    axes.add_collection(drawn)
    if not len(broken):
        return
    if alone:
        bar_beside(figure, axes, drawn, SHEAR)
    elif figure is not None:
        bar = figure.colorbar(drawn, ax=axes, location="bottom", shrink=0.8, aspect=40,
                              label=f"Cracks: {SHEAR[0].lower()}{SHEAR[1:]}")
        bar.outline.set_visible(False)


def cracks_title(frame):
    count = len(frame["fragments/number"])
    return f"Cracks at {moment(frame)}: {count} fragment{'' if count == 1 else 's'}"


def cracks(run, options=None, into=None):
    """The fragments, each in a different colour, with bonds and cracks."""
    options = options or Options()
    frame = recorded(run, options, "cracks")
    if frame is None:
        return None
    cell, quads = Cell(run, frame), run.mesh.cells
    owner = run.mesh.cell_particle
    position, limits = cell.position, 1e3 * cell.limits()
    size, beside = shape_of(limits)
    figure, axes = sheet(options, size, into, beside)
    colours = fragment_colours(frame["fragment"][()])[owner]
    axes.add_collection(PolyCollection(1e3 * position[quads], facecolors=colours, edgecolors="face",
                                       linewidths=seam(options)))
    edges = outlines(quads)
    axes.add_collection(LineCollection(1e3 * position[edges], colors="#8b96a3", linewidths=0.4))
    cell.draw(axes, colours, edges)
    set_axes(axes, limits)
    draw_bonds(run, figure, axes, frame, cell, alone=True)
    draw_tools(run, axes, frame, limits / 1e3)
    options.head(axes, cracks_title(frame), run)
    close_up(figure, options, into)
    ends = np.concatenate([frame["cracks/start"][()], frame["cracks/end"][()]], axis=1).T
    of_crack = [(name, run.file[f"cracks/{name}"]) for name in ("time", "length", "shear", "energy")]
    figure.table = [*((name, "m", end) for name, end in zip(("x1", "y1", "x2", "y2"), ends)),
                    *((name, column.attrs["unit"], column[:ends.shape[1]]) for name, column in of_crack)]
    return figure


def breaking(run, options=None):
    """Crack length (in three dimensions: area), bond energies and number of fragments over time."""
    options = options or Options()
    broken, si = ("bonds/crack_area", "m^2") if run.in_space else ("bonds/crack_length", "m")
    if not run.has(broken):
        return None
    time = run.series("time")
    factor, unit = unit_for("s", time)
    groups = [(broken, si, {broken: "broken so far"}),
              (("energy", "E"), "J", {"energy/fracture": "dissipated in breaking", "energy/bonds": "stored in bonds"}),
              ("bonds/fragments", "-", {"bonds/fragments": "fragments"})]
    figure, places = subplots(len(groups), figsize=options.size(6.4, 6.6), sharex=True)
    figure.table = [("time", "s", time)]
    for axes, (name, si, names) in zip(places, groups):
        series = {key: run.series(key) for key in names}
        size, shown = unit_for(si, np.concatenate(list(series.values())))
        dash_hidden(axes, [axes.plot(factor * time, size * values, label=names[key])[0] for key, values in series.items()])
        figure.table += [(key, si, values) for key, values in series.items()]
        axes.set_ylabel(worded(run, name, shown))
        if len(names) > 1:
            axes.legend()
    places[-1].yaxis.set_major_locator(MaxNLocator(integer=True, min_n_ticks=1))
    places[-1].set_xlabel(worded(run, "time", unit))
    options.head(places[0], "Bonds that break", run)
    return figure


def cumulative(size, in_space=False):
    """Equivalent diameters in ascending order, with cumulative fractions by number and by size: areas, or volumes."""
    size = np.sort(size)
    count = np.arange(1, len(size) + 1) / len(size)
    diameter = np.cbrt(6 * size / np.pi) if in_space else np.sqrt(4 * size / np.pi)
    return diameter, count, np.cumsum(size) / size.sum()


def fragment_sizes(run, options=None, axes=None):
    """Cumulative distribution of the equivalent diameters: of circles of the same area, or spheres of the same volume."""
    options = options or Options()
    kind = "volume" if run.in_space else "area"
    frame = recorded(run, options, "fragments")
    if frame is None or len(frame[f"fragments/{kind}"]) < 2:
        return None
    diameter, number, size = cumulative(frame[f"fragments/{kind}"][()], run.in_space)
    factor, unit = unit_for("m", diameter)
    figure, axes = sheet(options, (6.4, 4.2), axes)
    x = factor * np.concatenate([[0], diameter])
    dash_hidden(axes, [axes.step(x, 100 * np.concatenate([[0], share]), where="post", label=words)[0]
                       for words, share in ((f"of the {kind}", size), ("of the number", number))])
    axes.set(xlabel=label(("equivalent diameter", "d"), unit), ylabel="Cumulative share / %",
             xlim=(0, 1.03 * x[-1]), ylim=(0, 102))
    options.head(axes, f"Sizes of {len(diameter)} fragments at {moment(frame)}", run)
    legend_beside(axes, options)
    figure.table = [("equivalent diameter", "m", diameter), ("share of the number", "-", number),
                    (f"share of the {kind}", "-", size)]
    return figure
