"""Figures of breaking bonds in three dimensions: fragments, with the places of bonds and cracks, seen from a corner."""
import numpy as np
from matplotlib.collections import PolyCollection

from pulvis.figures.bonds import BOND_COLOUR, MODES, SHEAR, cracks_title
from pulvis.figures.cell import Cell
from pulvis.figures.colours import fragment_colours
from pulvis.figures.look import Options, bar_beside, close_up, recorded, shape_of, sheet
from pulvis.figures.space import draw_scale, draw_tools, isometric, limits_of
from pulvis.figures.space_mesh import outer_sides

LEAST, MOST = 2.0, 60.0  # points^2, of a dot


def draw_dots(axes, position, area, points, **look):
    """Discs with a quarter of the areas of the bonds or cracks, so that neighbours stay apart; far ones first. points: of
    paper per metre."""
    seen = position @ isometric().T
    order = np.argsort(-seen[:, 2], kind="stable")
    if "c" in look:
        look["c"] = look["c"][order]
    # matplotlib's size of a marker is the square of its diameter.
    sizes = np.clip(area[order] / np.pi * points**2, LEAST, MOST)
    return axes.scatter(*1e3 * seen[order, :2].T, s=sizes, linewidths=0, **look)


def places_of_bonds(run, frame, cell):
    """Where bonds and cracks are drawn, m: with the particles whose faces they are on."""
    broken = frame["cracks/position"][()]
    of = run.file["cracks/particle"][:len(broken)]  # the newest rows may be missing if the run was killed
    return frame["bonds/position"][()] + cell.shift[frame["bonds/ids"][:, 0]], broken[:len(of)] + cell.shift[of]


def space_cracks(run, options=None, axes=None):
    """The fragments, each in a different colour, seen through; bonds as grey dots, and cracks coloured by fracture mode."""
    options = options or Options()
    frame = recorded(run, options, "cracks")
    if frame is None:
        return None
    rows, limits, cell = isometric(), limits_of(run, [frame]), Cell(run, frame)
    size, beside = shape_of(limits)
    figure, place = sheet(options, size, axes, beside)
    draw_tools(run, place, frame)
    quads, cells = outer_sides(run.mesh.cells)
    colours = fragment_colours(frame["fragment"][()])[run.mesh.cell_particle[cells]]
    seen = cell.position @ rows.T
    corners = seen[quads]
    flat = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    front = flat[:, 2] < 0
    order = np.flatnonzero(front)[np.argsort(-corners[front, :, 2].mean(axis=1), kind="stable")]
    place.add_collection(PolyCollection(1e3 * corners[order, :, :2], facecolors=colours[order], edgecolors="none", alpha=0.35, zorder=1))
    wide = (options.width or size[0]) / 1.2 if axes is None else axes.get_window_extent().width / figure.dpi
    points = 72 * wide / (1e-3 * np.ptp(limits[:, 0]))
    bonded, broken = places_of_bonds(run, frame, cell)
    draw_dots(place, bonded, frame["bonds/area"][()], points, color=BOND_COLOUR, zorder=3)
    shear = run.file["cracks/shear"][:len(broken)]
    drawn = draw_dots(place, broken, run.file["cracks/area"][:len(broken)], points, c=shear, cmap=MODES, vmin=0, vmax=1, zorder=4)
    place.set(xlim=limits[:, 0], ylim=limits[:, 1], aspect="equal")
    place.axis("off")
    draw_scale(place, limits)
    options.head(place, cracks_title(frame), run)
    if len(broken):
        bar_beside(figure, place, drawn, SHEAR)
    close_up(figure, options, axes)
    of_crack = [(name, run.file[f"cracks/{name}"]) for name in ("time", "area", "shear", "energy")]
    figure.table = [*((name, "m", broken[:, k]) for k, name in enumerate("xyz")),
                    *((name, column.attrs["unit"], column[:len(broken)]) for name, column in of_crack)]
    return figure
