"""The contact network: forces as lines between centres, and the directions of the contact normals."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.ticker import MaxNLocator

from pulvis.figures.cell import Cell
from pulvis.figures.colours import colour_map
from pulvis.figures.look import NotDrawn, Options, bar_beside, close_up, moment, recorded, seam, set_axes, shape_of, sheet, unit_for
from pulvis.figures.names import label
from pulvis.figures.room import legend_under, subplots
from pulvis.figures.tools import draw_tools, outlines


def need_contacts(run, frame):
    if len(frame["contacts/ids"]) + len(frame["tool_contacts/ids"]) == 0:
        raise NotDrawn(f"no contacts in frame {frame.number}, at {moment(frame)}", run.folder)


def network_lines(frame, cell):
    """Contact lines, m [contacts, 2, axes], from centre to centre or to the contact point on a tool, and normal forces."""
    centre = frame["particle_centre"][()]
    pairs, tools = frame["contacts/ids"][()], frame["tool_contacts/ids"][()]
    end = cell.other_end(pairs, centre, frame["contacts/point"][()])
    lines = np.concatenate([np.stack([centre[pairs[:, 0]], end], axis=1),
                            np.stack([centre[tools[:, 0]], frame["tool_contacts/point"][()]], axis=1)])
    lines += cell.shift[np.concatenate([pairs[:, 0], tools[:, 0]]), None]
    return lines, np.concatenate([frame["contacts/normal_force"][()], frame["tool_contacts/normal_force"][()]])


def contact_network(run, options=None, into=None):
    options = options or Options()
    frame = recorded(run, options, "contacts")
    if frame is None:
        return None
    need_contacts(run, frame)
    cell, quads = Cell(run, frame), run.mesh.cells
    position, limits = cell.position, 1e3 * cell.limits()
    lines, force = network_lines(frame, cell)
    chained = quads[frame["force_chain"][()][run.mesh.cell_particle] > 0]
    factor, unit = unit_for("N", force)
    size = 1e3 * np.sqrt(np.prod(np.ptp(position, axis=0)) / len(frame["particle_centre"]))
    inches, beside = shape_of(limits)
    figure, axes = sheet(options, inches, into, beside)
    wide = (options.width or inches[0]) / 1.2 if into is None else into.get_window_extent().width / figure.dpi
    points = 72 * wide / np.ptp(limits[:, 0]) * 0.28 * size  # width of the line for the largest force
    low, high = options.clim(np.append(force, 0), "N")
    axes.add_collection(PolyCollection(1e3 * position[chained], color="#fbdccb", linewidths=seam(options)))
    edges = outlines(quads)
    axes.add_collection(LineCollection(1e3 * position[edges], colors="#8b96a3", linewidths=0.5))
    cell.draw(axes, edges=edges)
    drawn = LineCollection(1e3 * lines, array=factor * force, cmap=colour_map(options, "viridis_r"),
                           capstyle="round", clim=(factor * low, factor * high),
                           linewidths=np.maximum(0.3, points * np.abs(force) / np.abs(force).max()), zorder=3)
    axes.add_collection(drawn)
    draw_tools(run, axes, frame, limits / 1e3)
    set_axes(axes, limits)
    chains = "; shaded: force chains" if len(chained) else ""
    options.head(axes, f"Normal contact forces at {moment(frame)}{chains}", run)
    bar_beside(figure, axes, drawn, label(("normal force", "F_n"), unit))
    close_up(figure, options, into)
    ends = lines.reshape(-1, 4).T
    figure.table = [*((name, "m", end) for name, end in zip(("x1", "y1", "x2", "y2"), ends)),
                    ("normal force", "N", force)]
    return figure


def rose(run, options=None):
    options = options or Options()
    frame = recorded(run, options, "rose")
    if frame is None:
        return None
    if not np.any(frame["rose/number"][()]):
        raise NotDrawn(f"no contacts between particles in frame {frame.number}, at {moment(frame)}", run.folder)
    number, force = frame["rose/number"][()], frame["rose/force"][()]
    middle = np.arange(2 * len(number)) * np.pi / len(number)
    figure, axes = subplots(figsize=options.size(5, 5.2), subplot_kw={"projection": "polar"})
    width = np.pi / len(number)
    axes.bar(middle, 100 * np.tile(force, 2), width, color="#0072b2", alpha=0.55,
             label="of the normal force")
    axes.bar(middle, 100 * np.tile(number, 2), width, fill=False, edgecolor="#d55e00", linewidth=1.4,
             label="of the number")
    axes.set_rlabel_position(25)
    axes.yaxis.set_major_locator(MaxNLocator(4, prune="lower"))  # more would overlap; 0 is under the bars
    axes.yaxis.set_major_formatter("{x:g} %")
    options.head(axes, f"Directions of the contact normals at {moment(frame)}", run, of_width=5)
    legend_under(axes, ncols=2)  # below the rim and its labels
    figure.table = [("direction", "rad", middle[:len(number)]), ("share of the number", "-", number),
                    ("share of the normal force", "-", force)]
    return figure
