"""Figures of a lever: the deformed solid (first, middle and last frame) and its curves."""
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.collections import PolyCollection
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from figures_parts import draw_lines, unit_for

FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
COLOURS = ["#7aa6c2", "#d4b24c", "#8a8a8a", "#c77f6d"]  # lever, coating, tip, glue


def outer_faces(hexahedra):
    """Faces that belong to one hexahedron only, and which one."""
    seen = {}
    for cell, corners in enumerate(hexahedra):
        for face in FACES:
            nodes = tuple(dict.fromkeys(corners[i] for i in face))  # of a tetrahedron three, two or one are left
            if len(nodes) > 2:
                seen.setdefault(tuple(sorted(nodes)), []).append((nodes, cell))
    return [faces[0] for faces in seen.values() if len(faces) == 1]


def draw_solid(axis, position, faces, parts, title):
    polygons = [position[list(nodes)] * 1e6 for nodes, _ in faces]
    colours = [COLOURS[parts[cell]] for _, cell in faces]
    axis.add_collection3d(Poly3DCollection(polygons, facecolors=colours, edgecolors="#00000030",
                                           linewidths=0.3))
    low, high = position.min(axis=0) * 1e6, position.max(axis=0) * 1e6
    axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]), title=title,
             xlabel="x in µm", ylabel="y in µm", zlabel="z in µm")
    axis.set_box_aspect(np.maximum(high - low, 0.15 * (high - low).max()))
    axis.view_init(18, -60)


def solid(run, options):
    if not run.frames:
        return None
    chosen = run.frames if len(run.frames) <= 4 else [run.frames[0], run.frames[len(run.frames) // 2],
                                                      run.frames[-1]]
    if options.frame is not None:
        run.frame(options.frame)
        chosen = [run.frames[options.frame]]
    faces = outer_faces(run.file["mesh/hexahedra"][:].tolist())
    parts = run.file["mesh/cell_particle"][:]
    figure = plt.figure(figsize=(7 * len(chosen), 6))
    for i, name in enumerate(chosen):
        frame = run.file["frames"][name]
        axis = figure.add_subplot(1, len(chosen), i + 1, projection="3d")
        draw_solid(axis, frame["position"][:], faces, parts,
                   f"frame {int(name)}, {'actions done' if 'scanner/z' in run.series else 'load case'} "
                   f"{frame.attrs['time']:.3g}")
    last = position_of(run, chosen[-1])
    figure.table = [(axis, "m", last[:, k]) for k, axis in enumerate("xyz")]
    return figure


EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]


def cut(position, y):
    """The polygon in x and z where the plane y goes through a cell, its corners in turn; nothing elsewhere."""
    side = position[:, 1] - y
    points = [position[a] + side[a] / (side[a] - side[b]) * (position[b] - position[a])
              for a, b in EDGES if side[a] * side[b] < 0]
    if len(points) < 3:
        return None
    points = np.array(points)[:, [0, 2]]
    off = points - points.mean(axis=0)
    return points[np.argsort(np.arctan2(off[:, 1], off[:, 0]))]


def plastic_zones(run, options):
    """A section through the tip along the lever, around what has flowed: under the largest force, and at the end."""
    if not run.frames or "plastic_strain" not in run.file["frames"][run.frames[0]]:
        return None
    strains = [run.file["frames"][name]["plastic_strain"][:] for name in run.frames]
    rows = [int(run.file["frames"][name].attrs["step"]) - 1 for name in run.frames]
    chosen = [int(np.argmax(run.values("probe/force_z")[rows])), len(run.frames) - 1]
    if options.frame is not None:
        run.frame(options.frame)
        chosen = [options.frame]
    cells, reference = run.file["mesh/hexahedra"][:], run.file["mesh/reference"][:]
    flowed = np.flatnonzero(np.max(strains, axis=0) > 1e-6)
    if not flowed.size:
        return None
    zone = reference[cells[flowed]].reshape(-1, 3)
    middle, reach = zone.mean(axis=0), 0.7 * np.ptp(zone, axis=0)[[0, 2]].max()
    near = np.flatnonzero(np.abs(reference[cells].mean(axis=1) - middle).max(axis=1) < 3 * reach)
    top = max(strains[i].max() for i in chosen)
    figure, axes = plt.subplots(1, len(chosen), figsize=(7 * len(chosen), 5.5), squeeze=False)
    figure.table = []
    for axis, i in zip(axes[0], chosen):
        position = position_of(run, run.frames[i])
        shift = position[cells[flowed]].reshape(-1, 3).mean(axis=0)
        polygons, colours = [], []
        for cell in near:
            polygon = cut(position[cells[cell]], shift[1] + 1e-4 * reach)
            if polygon is not None:
                polygons.append((polygon - shift[[0, 2]]) * 1e6)
                colours.append(strains[i][cell])
        drawn = PolyCollection(polygons, array=np.array(colours), cmap="inferno_r", edgecolors="#00000040",
                               linewidths=0.4)
        drawn.set_clim(0, top)
        axis.add_collection(drawn)
        axis.set(xlim=(-1e6 * reach, 1e6 * reach), ylim=(-1e6 * reach, 1e6 * reach), aspect="equal",
                 xlabel="x in µm", ylabel="z in µm",
                 title=f"frame {int(run.frames[i])}: at most {strains[i].max():.3g}")
        axis.grid(False)
        figure.colorbar(drawn, ax=axis, label="accumulated plastic strain", shrink=0.85)
        figure.table.append((f"frame {int(run.frames[i])}: plastic strain by cell", "-", strains[i]))
    figure.suptitle("Plastic zones, section through the tip along the lever")
    figure.tight_layout()
    return figure


def position_of(run, name):
    return run.file["frames"][name]["position"][:]


def curve(x, y, title):
    """A figure of two series, where the run has them and the abscissa moves."""
    def draw(run, _):
        if x not in run.series or y not in run.series or not np.ptp(run.values(x)) > 0:
            return None
        named = [(name, run.values(name), run.series[name].attrs["unit"]) for name in (x, y)]
        return draw_lines(run, named[0], named[1:], y, title)
    return draw


CHANNELS = ["topography", "deflection", "friction"]
LEVELS = ["none", "plane", "lines"]


def levelled(values, level):
    """`plane`: the least-squares plane is taken off; `lines`: of every line its median."""
    if level == "lines":
        return values - np.median(values, axis=1, keepdims=True)
    if level != "plane":
        return values
    y, x = np.mgrid[:values.shape[0], :values.shape[1]]
    terms = np.column_stack([np.ones(values.size), x.ravel(), y.ravel()])
    plane = np.linalg.lstsq(terms, values.ravel(), rcond=None)[0]
    return values - (terms @ plane).reshape(values.shape)


def maps_of(run, level):
    """Every picture of every raster, levelled: (action, channel, direction, unit, values, (pixel width, height) in m or None).
    The difference is half of trace less retrace, of friction: what topography puts into both is not in it."""
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


def draw_map(figure, axis, action, channel, direction, unit, values, size):
    factor, shown = unit_for(unit, values)
    lines, pixels = values.shape
    extent = [0, 1e6 * size[0] * pixels, 0, 1e6 * size[1] * lines] if size else None
    axis.grid(False)
    picture = axis.imshow(factor * values, origin="lower", cmap="afmhot", extent=extent)
    named = "(trace − retrace)/2" if direction == "difference" else direction
    axis.set(title=f"{action}: {channel}, {named}", xlabel="along the scan [µm]" if size else "pixel",
             ylabel="across [µm]" if size else "line")
    figure.colorbar(picture, ax=axis, label=f"{channel} [{shown}]", shrink=0.8)


def images(run, options):
    """Rasters, trace above retrace; of friction half of their difference, too."""
    if "images" not in run.file:
        return None
    actions, traces = sorted(run.file["images"]), ["trace", "retrace", "difference"]
    figure, axes = plt.subplots(3 * len(actions), 3, figsize=(15, 13 * len(actions)), squeeze=False)
    for axis in axes.flat:
        axis.set_visible(False)
    figure.table = []
    for action, channel, direction, unit, values, size in maps_of(run, options.level):
        axis = axes[3 * actions.index(action) + traces.index(direction), CHANNELS.index(channel)]
        axis.set_visible(True)
        draw_map(figure, axis, action, channel, direction, unit, values, size)
        figure.table.append((f"{action} {channel} {direction}, line by line", unit, values.ravel()))
    figure.tight_layout()
    return figure


def simple_field(title, unit, values, size):
    """A Gwyddion Simple Field: magic line, header, one to four NULs up to a multiple of four bytes, 32-bit floats,
    little end first. Its first row is the upper one: the last line of the raster."""
    lines, pixels = values.shape
    wide, tall = size or (1, 1)
    fields = [("XRes", pixels), ("YRes", lines), ("XReal", repr(float(wide * pixels))), ("YReal", repr(float(tall * lines))),
              *([("XYUnits", "m")] if size else []), ("ZUnits", unit), ("Title", title)]
    head = "Gwyddion Simple Field 1.0\n" + "".join(f"{name} = {value}\n" for name, value in fields)
    head = head.encode("utf-8")
    return head + b"\0" * (4 - len(head) % 4) + values[::-1].astype("<f4").tobytes()


def simple_fields(run, level):
    """Of every picture: (name of the file, bytes)."""
    for action, channel, direction, unit, values, size in maps_of(run, level):
        named = f"{action}-{channel}-{direction}" + ("" if level == "none" else f"-{level}")
        yield named, simple_field(f"{action}: {channel}, {direction}", unit, values, size)


AFM_FIGURES = {"solid": solid, "plastic_zones": plastic_zones, "images": images,
               "force_curve": curve("scanner/z", "probe/force_z", "Force curve"),
               "friction_loop": curve("scanner/y", "probe/force_y", "Friction loop"),
               "detector": curve("scanner/y", "detector/lateral", "Lateral signal")}
