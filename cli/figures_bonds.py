"""Pictures of bonds that break: cracks by their mode, pieces, what breaking took, sizes of the pieces."""
import colorsys

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.ticker import MaxNLocator

from figures_cell import Cell
from figures_observed import recorded, when
from figures_parts import draw_tools, labelled, outlines, unit_for

BOND_FIELDS = ("damage", "fragment")  # over them bonds and cracks are drawn
MODES = LinearSegmentedColormap.from_list("modes", ["#d55e00", "#b89bc4", "#0072b2"])
BOND_COLOUR = "#5b6672"


def fragment_colours(numbers):
    """A pale colour for every fragment, of its number alone: it keeps it from frame to frame. [n, 3]

    Hues and saturations follow a sequence that fills the plane evenly (Roberts' R2)."""
    return np.array([colorsys.hsv_to_rgb(number * 0.7548776662 % 1, 0.2 + 0.3 * (number * 0.5698402910 % 1), 0.95)
                     for number in np.asarray(numbers, float)])


def lines_of(frame, group):
    return 1e3 * np.stack([frame[f"{group}/start"][()], frame[f"{group}/end"][()]], axis=1)


def draw_bonds(run, figure, axes, frame, cell):
    """Thin lines along the bonds, and what is broken by the mode in which it broke."""
    bonds, broken = lines_of(frame, "bonds"), lines_of(frame, "cracks")
    shear = run.file["cracks/shear"][:len(broken)]
    broken = broken[:len(shear)]  # of a run that was killed the newest rows may be missing
    if cell.here:
        bonds += 1e3 * cell.shift[frame["bonds/ids"][:, 0], None]
        broken += 1e3 * cell.shift[run.file["cracks/particle"][:len(broken)], None]
    axes.add_collection(LineCollection(bonds, colors=BOND_COLOUR, linewidths=0.6, zorder=3))
    drawn = LineCollection(broken, array=shear, cmap=MODES, clim=(0, 1),
                           linewidths=1.6, capstyle="round", zorder=4)
    axes.add_collection(drawn)
    if len(broken):
        bar = figure.colorbar(drawn, ax=axes, shrink=0.9, label="cracks: share of shear (0 mode I, 1 mode II)")
        bar.outline.set_visible(False)


def cracks(run, options):
    """The pieces, each in a colour of its own, with bonds and cracks."""
    frame = recorded(run, options, "cracks")
    if frame is None:
        return None
    cell, quads = Cell(run, frame), run.file["mesh/quads"][()]
    owner = run.file["mesh/cell_particle"][()]
    position, limits = cell.position, 1e3 * cell.limits()
    shape = np.ptp(limits[:, 1]) / np.ptp(limits[:, 0])
    figure, axes = plt.subplots(figsize=(7.2, min(max(6.0 * shape, 2.4), 9.0) + 0.9), constrained_layout=True)
    colours = fragment_colours(frame["fragment"][()])[owner]
    axes.add_collection(PolyCollection(1e3 * position[quads], facecolors=colours, edgecolors="face", linewidths=0.1))
    edges = outlines(quads)
    axes.add_collection(LineCollection(1e3 * position[edges], colors="#8b96a3", linewidths=0.4))
    cell.draw(axes, colours, edges)
    draw_bonds(run, figure, axes, frame, cell)
    draw_tools(run, axes, frame.attrs["time"], limits / 1e3)
    axes.set(xlim=limits[:, 0], ylim=limits[:, 1], aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    axes.grid(False)
    count = len(frame["fragments/number"])
    axes.set_title(f"Cracks at {when(frame)}: {count} fragment{'' if count == 1 else 's'}\n{run.title}", loc="left")
    ends = np.concatenate([frame["cracks/start"][()], frame["cracks/end"][()]], axis=1).T
    of_crack = [(name, run.file[f"cracks/{name}"]) for name in ("time", "length", "shear", "energy")]
    figure.table = [*((name, "m", end) for name, end in zip(("x1", "y1", "x2", "y2"), ends)),
                    *((name, column.attrs["unit"], column[:ends.shape[1]]) for name, column in of_crack)]
    return figure


def breaking(run, _):
    """Crack length, energies of the bonds and the number of fragments over time."""
    if "bonds/crack_length" not in run.series:
        return None
    time = run.values("time")
    factor, unit = unit_for("s", time)
    groups = [("crack length", "m", {"bonds/crack_length": "broken so far"}),
              ("energy", "J", {"energy/fracture": "spent in breaking", "energy/bonds": "stored in bonds"}),
              ("fragments", "-", {"bonds/fragments": "fragments"})]
    figure, places = plt.subplots(len(groups), figsize=(6.4, 6.6), sharex=True, constrained_layout=True)
    figure.table = [("time", "s", time)]
    for axes, (label, si, names) in zip(places, groups):
        series = {name: run.values(name) for name in names}
        size, shown = unit_for(si, np.concatenate(list(series.values())))
        for name, values in series.items():
            axes.plot(factor * time, size * values, label=names[name])
            figure.table.append((name, si, values))
        axes.set_ylabel(labelled(label, shown))
        if len(names) > 1:
            axes.legend()
    places[-1].yaxis.set_major_locator(MaxNLocator(integer=True))
    places[-1].set_xlabel(labelled("time", unit))
    places[0].set_title(f"Bonds that break\n{run.title}", loc="left")
    return figure


def cumulative(area):
    """Equivalent diameters in ascending order, and the shares of number and of area up to each."""
    area = np.sort(area)
    count = np.arange(1, len(area) + 1) / len(area)
    return np.sqrt(4 * area / np.pi), count, np.cumsum(area) / area.sum()


def fragment_sizes(run, options):
    frame = recorded(run, options, "fragments")
    if frame is None or len(frame["fragments/area"]) < 2:
        return None
    diameter, number, area = cumulative(frame["fragments/area"][()])
    factor, unit = unit_for("m", diameter)
    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    x = factor * np.concatenate([[0], diameter])
    for label, share in (("of the area", area), ("of the number", number)):
        axes.step(x, 100 * np.concatenate([[0], share]), where="post", label=label)
    axes.set(xlabel=labelled("equivalent diameter", unit), ylabel="share up to it [%]",
             xlim=(0, 1.03 * x[-1]), ylim=(0, 102))
    axes.set_title(f"Sizes of {len(diameter)} fragments at {when(frame)}\n{run.title}", loc="left")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    figure.table = [("equivalent diameter", "m", diameter), ("share of the number", "-", number),
                    ("share of the area", "-", area)]
    return figure
