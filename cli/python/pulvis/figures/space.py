"""Figures of particles in three dimensions: view from a corner, section, contact network, density profile along z.

Faces are drawn back to front (painter's algorithm), in orthographic projection, to scale."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from pulvis.errors import PulvisError
from pulvis.figures.cell import Cell
from pulvis.figures.colours import colour_map, colours_of
from pulvis.figures.densities import draw_profiles, profile_table
from pulvis.figures.fields import DEFAULT_FIELD, OUTLINE, field_of
from pulvis.figures.look import NotDrawn, Options, bar_beside, close_up, moment, printed, recorded, seam, set_axes, shape_of, sheet, unit_for
from pulvis.figures.names import label
from pulvis.figures.network import need_contacts, network_lines
from pulvis.figures.quantities import with_unit
from pulvis.figures.space_mesh import density_along_z, outer_sides, section
from pulvis.figures.space_tools import cross_section, cut, normals, pieces, rims
from pulvis.figures.tools import TOOL_EDGE, TOOL_FACE

TURN, TILT = -np.pi / 4, np.arctan(np.sqrt(0.5))  # the isometric view, as in the report
LIGHT = np.array([-0.35, 0.5, -0.8]) / np.linalg.norm([-0.35, 0.5, -0.8])
DARKEST = 0.6  # brightness of faces turned away from the light
PROFILES = 4  # number of times at which the density along z is drawn


def isometric():
    """Rotation matrix, rows: right, up, away from the viewer."""
    ct, st, cu, su = np.cos(TURN), np.sin(TURN), np.cos(TILT), np.sin(TILT)
    return np.array([[ct, -st, 0], [su * st, su * ct, cu], [cu * st, cu * ct, -su]])


def limits_of(run, frames):
    """Bounds of the projections of all frames, mm: lower left, upper right."""
    seen = []
    for frame in frames:
        cell = Cell(run, frame)
        drawn = (cell.position, cell.edges().reshape(-1, 3), pieces(run, frame)[0].reshape(-1, 3))
        seen += [points @ isometric()[:2].T for points in drawn if len(points)]
    low, high = np.min([one.min(axis=0) for one in seen], axis=0), np.max([one.max(axis=0) for one in seen], axis=0)
    margin = 0.03 * (high - low).max()
    return 1e3 * np.array([low - margin, high + margin])


def draw_tools(run, axes, frame):
    """Tool faces seen from the inside, behind the powder; and the borders of the surfaces."""
    rows, (corners, _) = isometric(), pieces(run, frame)
    if not len(corners):
        return
    inside = normals(corners) @ rows[2] < 0
    axes.add_collection(PolyCollection(1e3 * corners[inside] @ rows[:2].T, facecolors=TOOL_FACE, edgecolors="face", linewidths=0.2,
                                       alpha=0.6, zorder=0.5))
    axes.add_collection(LineCollection(1e3 * rims(run, frame) @ rows[:2].T, colors=TOOL_EDGE, linewidths=0.6, zorder=0.6))


def draw_scale(axes, limits):
    """Axis directions and a scale bar, below the plot."""
    rows, wide = isometric(), np.ptp(limits[:, 0])
    corner, long = limits[0] + 0.055 * wide, 0.045 * wide
    for k, name in enumerate("xyz"):
        tip = corner + long * rows[:2, k]
        axes.plot(*np.stack([corner, tip], axis=1), color=TOOL_EDGE, linewidth=0.8, linestyle="-")
        axes.text(*(corner + 1.45 * (tip - corner)), f"${name}$", ha="center", va="center", color=TOOL_EDGE)
    power = 10 ** np.floor(np.log10(0.25 * wide))
    bar = max(step * power for step in (1, 2, 2.5) if step * power <= 0.25 * wide)
    right, low = limits[1, 0] - 0.02 * wide, limits[0, 1] + 0.02 * wide
    axes.plot([right - bar, right], [low, low], color=OUTLINE, linewidth=2, linestyle="-", solid_capstyle="butt")
    axes.text(right - bar / 2, low + 0.012 * wide, with_unit(1e-3 * bar, "m"), ha="center", va="bottom")


def shaded(faces, light):
    """Shades faces that are turned away from the light."""
    rgb = faces.get_facecolor()[:, :3] * light[:, None]
    faces.set_array(None)
    faces.set_facecolor(rgb)
    faces.set_edgecolor(rgb)


def paint(run, axes, frame, field, colours, options, limits, sides=None):
    """Draws one frame into axes. sides: outer_sides of the mesh."""
    rows, cell = isometric(), Cell(run, frame)
    position = cell.position
    quads, cells = sides or outer_sides(run.mesh.cells)
    normal = normals(position[quads]) @ rows.T
    front = normal[:, 2] < 0
    quads, cells, normal = quads[front], cells[front], normal[front]
    seen = position @ rows.T
    order = np.argsort(-seen[quads, 2].mean(axis=1), kind="stable")
    draw_tools(run, axes, frame)
    faces = PolyCollection(1e3 * seen[quads[order], :2], linewidths=0.6 * seam(options), joinstyle="round", zorder=1)
    colours.paint(faces, field.values[cells[order]])
    shaded(faces, DARKEST + (1 - DARKEST) * np.maximum(0, normal[order] @ LIGHT))
    axes.add_collection(faces)
    axes.add_collection(LineCollection(1e3 * cell.edges() @ rows[:2].T, colors="#d55e00", linewidths=0.8, zorder=2))
    axes.set(xlim=limits[:, 0], ylim=limits[:, 1], aspect="equal")
    axes.axis("off")
    draw_scale(axes, limits)
    options.head(axes, f"{field.title} at {moment(frame)}", run)


def asked_field(run, options):
    """(frame, field), or None if the run has neither and no field was requested by name."""
    if not run.frames:
        return None
    frame = run.frame(options.frame)
    try:
        return frame, field_of(run, frame, options.field or DEFAULT_FIELD)
    except PulvisError:
        if options.field:
            raise
        return None


def space_picture(run, options=None, axes=None):
    """All particles from a corner."""
    options = options or Options()
    asked = asked_field(run, options)
    if asked is None:
        return None
    frame, field = asked
    limits = limits_of(run, [frame])
    size, beside = shape_of(limits)
    figure, place = sheet(options, size, axes, beside)
    colours = colours_of(field, field.values, options)
    paint(run, place, frame, field, colours, options, limits)
    colours.key(figure, place)
    close_up(figure, options, axes)
    middle = Cell(run, frame).position[run.mesh.cells].mean(axis=1)
    figure.table = [*((name, "m", middle[:, k]) for k, name in enumerate("xyz")), (field.key, field.unit, field.values)]
    return figure


def space_network(run, options=None, axes=None):
    """Normal contact forces as lines between centres, seen from a corner; particles in force chains are shaded."""
    options = options or Options()
    frame = recorded(run, options, "contacts")
    if frame is None:
        return None
    need_contacts(run, frame)
    cell = Cell(run, frame)
    rows, limits, (lines, force) = isometric(), limits_of(run, [frame]), network_lines(frame, cell)
    size, beside = shape_of(limits)
    figure, place = sheet(options, size, axes, beside)
    draw_tools(run, place, frame)
    quads, cells = outer_sides(run.mesh.cells)
    position, chained = cell.position, frame["force_chain"][()][run.mesh.cell_particle[cells]] > 0
    seen = 1e3 * position @ rows[:2].T
    for which, shade in ((~chained, "#dfe5ec"), (chained, "#f3b692")):  # seen through: the lines run inside
        place.add_collection(PolyCollection(seen[quads[which]], facecolors=shade, edgecolors="none", alpha=0.12, zorder=1))
    order = np.argsort(-(lines @ rows[2]).mean(axis=1), kind="stable")
    wide = (options.width or size[0]) / 1.2 if axes is None else axes.get_window_extent().width / figure.dpi
    diameter = 1e3 * np.cbrt(np.prod(np.ptp(position, axis=0)) / len(frame["particle_centre"]))
    points = 72 * wide / np.ptp(limits[:, 0]) * 0.14 * diameter  # width of the line for the largest force
    low, high = options.clim(np.append(force, 0), "N")
    factor, unit = unit_for("N", force)
    drawn = LineCollection(1e3 * lines[order] @ rows[:2].T, array=factor * force[order], cmap=colour_map(options, "viridis_r"),
                           capstyle="round", clim=(factor * low, factor * high), zorder=3,
                           linewidths=np.maximum(0.3, points * np.abs(force[order]) / np.abs(force).max()))
    place.add_collection(drawn)
    place.set(xlim=limits[:, 0], ylim=limits[:, 1], aspect="equal")
    place.axis("off")
    draw_scale(place, limits)
    chains = "; shaded: force chains" if chained.any() else ""
    options.head(place, f"Normal contact forces at {moment(frame)}{chains}", run)
    bar_beside(figure, place, drawn, label(("normal force", "F_n"), unit))
    close_up(figure, options, axes)
    ends = lines.reshape(-1, 6).T
    figure.table = [*((name, "m", end) for name, end in zip(("x1", "y1", "z1", "x2", "y2", "z2"), ends)), ("normal force", "N", force)]
    return figure


def asked_place(run, frame, options):
    """`options.at`, if it is in the powder."""
    axis = "xyz".index(options.across)
    places = Cell(run, frame).position[:, axis]
    low, high = places.min(), places.max()
    if options.at is not None and not low <= options.at <= high:
        raise PulvisError(f"--at {with_unit(options.at, 'm')}: allowed: {with_unit(low, 'm')} to {with_unit(high, 'm')}, where the powder is "
                          f"along {options.across}", key="--at")
    return options.at


def fullest(run, position, axis):
    """The position in the middle third where a plane cuts the most cells, m: avoids gaps between two layers."""
    low, high = position[:, axis].min(), position[:, axis].max()
    corners = position[run.mesh.cells, axis]
    begin, end = np.sort(corners.min(axis=1)), np.sort(corners.max(axis=1))
    places = low + (high - low) * (0.5 + np.array([0, *(side * k / 48 for k in range(1, 9) for side in (-1, 1))]) + 1e-6)
    return places[np.argmax(np.searchsorted(begin, places) - np.searchsorted(end, places))]


def section_picture(run, options=None, axes=None):
    """The cells cut by a plane through the powder, normal to `options.across` at `options.at` (m); by default near
    the middle."""
    options = options or Options()
    asked = asked_field(run, options)
    if asked is None:
        return None
    (frame, field), axis = asked, "xyz".index(options.across)
    position, others = Cell(run, frame).position, [name for name in "xyz" if name != options.across]
    ends = np.array([position.min(axis=0), position.max(axis=0)])
    at = fullest(run, position, axis) if asked_place(run, frame, options) is None else options.at
    polygons, cells = section(run.mesh.cells, position, axis, at)
    lines = cut(pieces(run, frame)[0], axis, at)
    limits = np.delete(np.array([np.minimum(ends[0], pieces(run, frame)[0].reshape(-1, 3).min(axis=0, initial=np.inf)),
                                 np.maximum(ends[1], pieces(run, frame)[0].reshape(-1, 3).max(axis=0, initial=-np.inf))]), axis, axis=1)
    margin = 0.03 * np.ptp(limits, axis=0).max()
    limits = 1e3 * (limits + np.array([[-margin], [margin]]))
    size, beside = shape_of(limits)
    figure, place = sheet(options, size, axes, beside)
    colours = colours_of(field, field.values, options)
    faces = PolyCollection([1e3 * polygon for polygon in polygons], linewidths=0.25, zorder=1)
    colours.paint(faces, field.values[cells])
    faces.set_edgecolor(OUTLINE)
    place.add_collection(faces)
    place.add_collection(LineCollection(1e3 * lines, colors=TOOL_EDGE, linewidths=1.8, zorder=2))
    set_axes(place, limits, others)
    options.head(place, f"{field.title} in the plane ${options.across}$ = {printed(at, 'm')} at {moment(frame)}", run)
    colours.key(figure, place)
    close_up(figure, options, axes)
    middle = np.array([polygon.mean(axis=0) for polygon in polygons]).reshape(-1, 2)
    figure.table = [(others[0], "m", middle[:, 0]), (others[1], "m", middle[:, 1]), (field.key, field.unit, field.values[cells])]
    return figure


def profile_of(run, frame, room):
    """The recorded one, if it has several layers; else that of the mesh."""
    if "density_profile" in frame and len(frame["density_profile"]) > 1:
        return frame["density_profile"][()], frame["density_grid/z"][()]
    if room is None:
        raise NotDrawn("the die does not stand along z; needed for a density along z: output.density_cells with several layers along z")
    return density_along_z(run.mesh.cells, frame["position"][()], room)


def space_profile(run, options=None, axes=None):
    """Relative density along z, at several times or in the requested frame."""
    options = options or Options()
    if not run.frames:
        return None
    numbers = [options.frame] if options.frame is not None else np.unique(
        np.linspace(0, len(run.frames) - 1, PROFILES).round().astype(int))
    if "cell" in run.frame(int(numbers[0])):
        raise NotDrawn("a powder without walls has no density along z", run.folder)
    profiles = []
    for frame in (run.frame(int(number)) for number in numbers):
        room = cross_section(run, frame, frame["position"][()])
        profile = profile_of(run, frame, room)
        if profile is not None and np.isfinite(profile[0]).any():
            profiles.append((moment(frame), *profile))
    if not profiles:
        raise NotDrawn("no powder between the tools", run.folder)
    figure, place = sheet(options, (6.4, 4.2), axes)
    draw_profiles(place, "z", profiles, options)
    options.head(place, f"Relative density along z {room.inside if room else 'in the die'}", run)
    figure.table = profile_table("z", profiles)
    return figure


def space_film(run, options, into):
    """Like animation.film."""
    key, sides = options.field or DEFAULT_FIELD, outer_sides(run.mesh.cells)
    fields = [field_of(run, frame, key) for frame in run.frames]
    colours = colours_of(fields[0], np.concatenate([field.values for field in fields]), options)
    limits = limits_of(run, run.frames)
    size, beside = shape_of(limits)
    figure, axes = sheet(options, size, into, beside)

    def show(k):
        axes.clear()
        paint(run, axes, run.frames[k], fields[k], colours, options, limits, sides)
        colours.key(figure, axes)
        return []

    show(0)
    close_up(figure, options, into)
    return figure, axes, show
