"""Figures of a lever: the deformed solid (first, middle and last frame), plastic zones, loops and force curves."""
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.collections import PolyCollection
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from pulvis.figures.colours import colour_map
from pulvis.figures.hidden import dash_hidden
from pulvis.figures.look import COLOURS as LINES, Options, bar_beside, legend_beside, sheet, unit_for, worded
from pulvis.figures.names import capital, over
from pulvis.figures.room import has_room, legend_within, subplots
from pulvis.lever_results import vertical_moves

FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
SMALL_SOLID = 5.5  # inches, of a figure
SMALL_PADS = ((3, 3), (0, -4.5), (-6, -13))  # of ticks and labels along x, y, z of a small solid; matplotlib sets them far off short sides
SHORTEST_SIDE = 0.15  # of the box around a mesh, as drawn, over the longest
COLOURS = ["#7aa6c2", "#d4b24c", "#8a8a8a", "#c77f6d"]  # lever, coating, tip, glue


def outer_faces(hexahedra):
    """Faces that belong to only one hexahedron, and the index of that hexahedron."""
    seen = {}
    for cell, corners in enumerate(hexahedra):
        for face in FACES:
            nodes = tuple(dict.fromkeys(corners[i] for i in face))  # for a degenerate (tetrahedral) cell three, two or one remain
            if len(nodes) > 2:
                seen.setdefault(tuple(sorted(nodes)), []).append((nodes, cell))
    return [faces[0] for faces in seen.values() if len(faces) == 1]


def make_room(axes, ends):
    """Few ticks along the short sides, and the mesh as large as possible."""
    sides = np.ptp(ends, axis=0)
    wide, tall = axes.get_position(original=True).size * axes.figure.get_size_inches()
    small = axes.figure.get_figwidth() < SMALL_SOLID
    for axis, share, pads in zip((axes.xaxis, axes.yaxis, axes.zaxis), sides / sides.max(), SMALL_PADS):
        axis.set_major_locator(MaxNLocator((4 if small else 5) if share > 0.5 else 1 if small or share < 0.15 else 2))
        axis.labelpad = 24 if share > 0.5 else pads[1] if small else 3
        if share <= 0.5:
            axis.set_tick_params(pad=pads[0] if small else 0 if axis is axes.zaxis else 3)  # apart from the last one along y
    share = 0.66 if small and has_room(axes.figure) else 0.82  # the layout of a film leaves no margin for the labels
    axes.set_box_aspect(np.maximum(sides, SHORTEST_SIDE * sides.max()), zoom=min(1.7, max(share / 0.82, share * wide / tall)))


def draw_solid(axis, position, faces, colours, title, ends=None):
    """colours: one per face; ends: corners of the view, m [2, 3], if not the bounding box of the solid."""
    polygons = [position[list(nodes)] * 1e6 for nodes, _ in faces]
    axis.add_collection3d(Poly3DCollection(polygons, facecolors=colours, edgecolors="#00000030",
                                           linewidths=0.3, clip_on=False))  # the axes are a square, a lever is longer
    low, high = np.array([position.min(axis=0), position.max(axis=0)] if ends is None else ends) * 1e6
    axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]), title=title,
             xlabel="$x$ / µm", ylabel="$y$ / µm", zlabel="$z$ / µm")
    make_room(axis, [low, high])
    axis.view_init(18, -60)


def part_colours(run, faces):
    return [COLOURS[run.mesh.cell_particle[cell]] for _, cell in faces]


LOAD_CASES = ["at rest", "under a force normal to the sample", "under a lateral force", "under a force along the lever"]


def progress_words(run):
    """What the times of a lever's frames count: actions or load cases."""
    return "actions completed" if run.has("scanner/z") else "load case"


def moment_of_lever(run, frame):
    """The time of a lever's frame, in words: completed actions, or the load of a calibration."""
    case = round(frame.time)
    if progress_words(run) == "load case" and case < len(LOAD_CASES):
        return LOAD_CASES[case]
    return f"{progress_words(run)} {frame.time:.3g}"


def solid(run, options=None):
    options = options or Options()
    if not run.frames or not run.is_solid:
        return None
    chosen = run.frames if len(run.frames) <= 4 else [run.frames[0], run.frames[len(run.frames) // 2],
                                                      run.frames[-1]]
    if options.frame is not None:
        chosen = [run.frame(options.frame)]
    faces = outer_faces(run.mesh.cells.tolist())
    sides = np.ptp(chosen[0].nodes, axis=0)
    width, height = options.size(7, len(chosen) * (2.8 + 2.5 * np.sort(sides / sides.max())[1]))
    figure = plt.figure(figsize=(width, height))
    right, low, apart = (0.8, 0.12, 0.5) if width < SMALL_SOLID else (0.82, 0.06, 0.3)
    figure.subplots_adjust(left=0, right=right, bottom=low / len(chosen), top=1 - 0.3 / height, hspace=apart / height * len(chosen))
    colours = part_colours(run, faces)
    for i, frame in enumerate(chosen):
        axis = figure.add_subplot(len(chosen), 1, i + 1, projection="3d")
        title = f"frame {frame.number}, {moment_of_lever(run, frame)}" if options.title else ""
        draw_solid(axis, frame.nodes, faces, colours, title)
    last = chosen[-1].nodes
    figure.table = [(axis, "m", last[:, k]) for k, axis in enumerate("xyz")]
    return figure


EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]


def cut(position, y):
    """The polygon (x, z) in which the plane at y cuts a cell, corners in order; None if it does not."""
    side = position[:, 1] - y
    points = [position[a] + side[a] / (side[a] - side[b]) * (position[b] - position[a])
              for a, b in EDGES if side[a] * side[b] < 0]
    if len(points) < 3:
        return None
    points = np.array(points)[:, [0, 2]]
    off = points - points.mean(axis=0)
    return points[np.argsort(np.arctan2(off[:, 1], off[:, 0]))]


def zone_of(run, strains):
    """The plastic zone: cells near it, cells that have yielded, and half the size of the view, m."""
    cells, reference = run.mesh.cells, run.mesh.reference
    flowed = np.flatnonzero(np.max(strains, axis=0) > 1e-6)
    if not flowed.size:
        return None
    zone = reference[cells[flowed]].reshape(-1, 3)
    reach = 0.7 * np.ptp(zone, axis=0)[[0, 2]].max()
    off = np.abs(reference[cells].mean(axis=1) - zone.mean(axis=0)).max(axis=1)
    return np.flatnonzero(off < 3 * reach), flowed, reach


def draw_zone(axis, run, frame, strain, zone, drawing):
    """The section of one frame; returns the mappable for the colour bar. drawing: largest strain, Options."""
    (near, flowed, reach), (top, options) = zone, drawing
    position, polygons, colours = frame.nodes, [], []
    shift = position[run.mesh.cells[flowed]].reshape(-1, 3).mean(axis=0)
    for cell in near:
        polygon = cut(position[run.mesh.cells[cell]], shift[1] + 1e-4 * reach)
        if polygon is not None:
            polygons.append((polygon - shift[[0, 2]]) * 1e6)
            colours.append(strain[cell])
    drawn = PolyCollection(polygons, array=np.array(colours), cmap=colour_map(options, "inferno_r"),
                           edgecolors="#00000040", linewidths=0.4)
    drawn.set_clim(*options.clim([0, top], "-"))
    axis.add_collection(drawn)
    axis.set(xlim=(-1e6 * reach, 1e6 * reach), ylim=(-1e6 * reach, 1e6 * reach), aspect="equal",
             xlabel="$x$ / µm", ylabel="$z$ / µm")
    if options.title:
        axis.set_title(f"frame {frame.number}: at most {strain.max():.3g}", loc="left")
    axis.grid(False)
    return drawn


def plastic_zones(run, options=None):
    """Section through the tip along the lever, around the plastic zone: at the largest force, and at the end."""
    options = options or Options()
    if not run.frames or "plastic_strain" not in run.frames[0]:
        return None
    strains = [frame["plastic_strain"][:] for frame in run.frames]
    rows = [frame.step - 1 for frame in run.frames]
    chosen = [int(np.argmax(run.series("probe/force_z")[rows])), len(run.frames) - 1]
    if options.frame is not None:
        chosen = [run.frame(options.frame).number]
    zone = zone_of(run, strains)
    if zone is None:
        return None
    top = max(strains[i].max() for i in chosen)
    down, beside = (len(chosen), 1) if options.width and options.width < SMALL_ZONES else (1, len(chosen))
    figure, axes = subplots(down, beside, figsize=options.size(7 * beside, 5.5 * down), squeeze=False)
    figure.table = []
    for axis, i in zip(axes.flat, chosen):
        drawn = draw_zone(axis, run, run.frames[i], strains[i], zone, (top, options))
        bar_beside(figure, axis, drawn, worded(run, "plastic_strain", ""))
        figure.table.append((f"frame {i}: plastic strain by cell", "-", strains[i]))
    if options.title:
        figure.suptitle("Plastic zones, section through the tip along the lever")
    return figure


def draw_motions(run, motions, keys, title, options, axes, reversed_as=None):
    """motions: [(label, rows)]; keys: series of the x and y axes. `reversed_as`: y with the opposite sign, called so."""
    x_key, y_key = keys
    figure, axes = sheet(options, (6.4, 4.2), axes)
    x, y = run.series(x_key), run.series(y_key) * (-1 if reversed_as else 1)
    (x_factor, x_unit), (factor, unit) = unit_for(run.unit(x_key), x), unit_for(run.unit(y_key), y)
    drawn = []
    for k, (words, rows) in enumerate(motions):
        shown = np.full(y.shape, np.nan)  # no line between separate parts
        shown[rows] = factor * y[rows]
        drawn += axes.plot(x_factor * x, shown, label=words, color=LINES[k // 2 % len(LINES)] if len(motions) > 2
                           else LINES[k], linestyle="--" if k % 2 else "-")
    dash_hidden(axes, drawn)
    axes.set(xlabel=worded(run, x_key, x_unit), ylabel=over(reversed_as, unit) if reversed_as else worded(run, y_key, unit))
    options.head(axes, title, run)
    if len(motions) > 2:  # several loops fill the axes
        legend_beside(axes, options)
    else:
        legend_within(axes, options)
    y_name = reversed_as.lower() if reversed_as else y_key
    figure.table = [column for words, rows in motions for column in
                    ((f"{x_key}, {words}", run.unit(x_key), x[rows]), (f"{y_name}, {words}", run.unit(y_key), y[rows]))]
    return figure


def force_curve(run, options=None, axes=None, signal="probe/force_z"):
    """Approach and retract as separate curves; the retract is omitted if there is none."""
    if not run.has("scanner/z") or not np.ptp(run.series("scanner/z")) > 0:
        return None
    moves = vertical_moves(run)
    motions = [(words, np.flatnonzero((moves == way) | (np.append(moves[1:], 0) == way)))
               for words, way in (("approach", 1), ("retract", -1)) if (moves == way).any()]
    return draw_motions(run, motions, ("scanner/z", signal), "Force curve", options or Options(), axes) if motions else None


def friction_loop(run, options=None, axes=None, signal="force"):
    """Trace and retrace of every loop along the same axis as the first."""
    loops = run.loops
    if not loops:
        return None
    axis = loops[0].axis
    loops = [loop for loop in loops if loop.axis == axis]
    y = f"probe/force_{axis}" if signal == "force" else f"detector/{'lateral' if axis == 'y' else 'normal'}"
    if not run.has(y):
        return None
    motions = [((f"action {loop.action}, " if len(loops) > 1 else "") + words, np.append(way.rows[0] - 1, way.rows)) for loop in loops
               for words, way in (("trace", loop.trace), ("retrace", loop.retrace))]
    title = "Friction loop" if signal == "force" else "Lateral signal" if axis == "y" else "Normal signal"
    called = "Force that drags the tip" if signal == "force" else "Signal, as of that force"
    return draw_motions(run, motions, (f"scanner/{axis}", y), title, options or Options(), axes, called)


def detector(run, options=None, axes=None):
    return friction_loop(run, options, axes, "volts")


SMALL_ZONES = 6.5  # inches: plastic zones one above the other in a narrower figure
SMALL_IMAGES = 11  # inches: rasters side by side in a narrower figure are too small
CHANNELS = ["topography", "deflection", "friction"]
LEVELS = ["none", "plane", "lines"]


def levelled(values, level):
    """`plane`: subtracts the least-squares plane; `lines`: subtracts the median of each line."""
    if level == "lines":
        return values - np.median(values, axis=1, keepdims=True)
    if level != "plane":
        return values
    y, x = np.mgrid[:values.shape[0], :values.shape[1]]
    terms = np.column_stack([np.ones(values.size), x.ravel(), y.ravel()])
    plane = np.linalg.lstsq(terms, values.ravel(), rcond=None)[0]
    return values - (terms @ plane).reshape(values.shape)


def maps_of(run, level):
    """Every image of every raster, levelled: (action, channel, direction, unit, values, (pixel width, height) in m or None).
    The friction difference is half of trace minus retrace: both are of the same places, so that the slope of the surface
    contributes equally to both and cancels. It is positive where friction resists the probe."""
    for action in sorted(run.file.get("images", [])):
        for channel in CHANNELS:
            traces = {}
            for direction in ("trace", "retrace"):
                data = run.file[f"images/{action}/{channel}_{direction}"]
                size = (data.attrs["pixel_width"], data.attrs["pixel_height"]) if "pixel_width" in data.attrs else None
                traces[direction] = data[:]
                yield action, channel, direction, data.attrs["unit"], levelled(data[:], level), size
            if channel == "friction":
                half = (traces["trace"] - traces["retrace"]) / 2
                yield action, channel, "difference", data.attrs["unit"], levelled(half, level), size


def draw_map(figure, axis, one, options, heading):
    """heading: of its title, as the action."""
    action, channel, direction, unit, values, size = one
    factor, shown = unit_for(unit, values)
    lines, pixels = values.shape
    extent = [0, 1e6 * size[0] * pixels, 0, 1e6 * size[1] * lines] if size else None
    axis.grid(False)
    picture = axis.imshow(factor * values, origin="lower", cmap=colour_map(options, "afmhot"), extent=extent)
    named = "(trace − retrace)/2" if direction == "difference" else direction
    in_title = options.title and is_small(options)  # the unit, in place of a label at the bar
    if options.title:
        axis.set_title(over(f"{heading}{channel}, {named}", shown if in_title else ""), loc="left")
    across, up = ("$x$ / µm", "$y$ / µm") if is_small(options) else ("Along the scan / µm", "Across / µm")
    axis.set(xlabel=across if size else "Pixel", ylabel=up if size else "Line")
    bar_beside(figure, axis, picture, "" if in_title else over(capital(channel), shown))


def is_small(options):
    """Whether rasters get trace and retrace side by side, one channel below the other."""
    return bool(options.width) and options.width < SMALL_IMAGES


def images(run, options=None):
    """Rasters, trace above retrace; for friction also half of their difference."""
    options = options or Options()
    if "images" not in run.file:
        return None
    actions, traces = sorted(run.file["images"]), ["trace", "retrace", "difference"]
    beside = is_small(options)
    rows, columns = (len(CHANNELS) + 1, 2) if beside else (3, 3)
    figure, axes = subplots(rows * len(actions), columns, squeeze=False,
                            figsize=options.size(5 * columns, (3.8 if beside else 4.33) * rows * len(actions)))
    for axis in axes.flat:
        axis.set_visible(False)
    figure.table = []
    for one in maps_of(run, options.level):
        action, channel, direction, unit, values, _ = one
        down, right = traces.index(direction), CHANNELS.index(channel)
        down, right = (right + down // 2, down % 2) if beside else (down, right)
        axis = axes[rows * actions.index(action) + down, right]
        axis.set_visible(True)
        draw_map(figure, axis, one, options, f"{action}: " if len(actions) > 1 else "")
        figure.table.append((f"{action} {channel} {direction}, line by line", unit, values.ravel()))
    return figure


def simple_field(title, unit, values, size):
    """A Gwyddion Simple Field: magic line, header, one to four NULs up to a multiple of four bytes, 32-bit floats,
    little-endian. Its first row is the top one: the last line of the raster."""
    lines, pixels = values.shape
    wide, tall = size or (1, 1)
    fields = [("XRes", pixels), ("YRes", lines), ("XReal", repr(float(wide * pixels))), ("YReal", repr(float(tall * lines))),
              *([("XYUnits", "m")] if size else []), ("ZUnits", unit), ("Title", title)]
    head = "Gwyddion Simple Field 1.0\n" + "".join(f"{name} = {value}\n" for name, value in fields)
    head = head.encode("utf-8")
    return head + b"\0" * (4 - len(head) % 4) + values[::-1].astype("<f4").tobytes()


def simple_fields(run, level):
    """(file name, bytes) of every image."""
    for action, channel, direction, unit, values, size in maps_of(run, level):
        named = f"{action}-{channel}-{direction}" + ("" if level == "none" else f"-{level}")
        yield named, simple_field(f"{action}: {channel}, {direction}", unit, values, size)


AFM_FIGURES = {"solid": solid, "plastic_zones": plastic_zones, "images": images, "force_curve": force_curve,
               "friction_loop": friction_loop, "detector": detector}
