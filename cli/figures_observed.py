"""Pictures of local densities and of the contact network of a run."""
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.ticker import MaxNLocator

from figures_cell import Cell
from figures_parts import draw_tools, labelled, outlines, unit_for

MAPS = 4  # density maps side by side: evenly over the run, the last frame among them


def when(frame):
    factor, unit = unit_for("s", np.array([frame.attrs["time"]]))
    return f"{factor * frame.attrs['time']:.4g} {unit}"


def recorded(run, options, name):
    """The frame to draw, or none where the run has not recorded `name`."""
    if not run.frames or name not in run.frame(options.frame):
        return None
    return run.frame(options.frame)


def chosen_frames(run, options):
    """Of those with anything between the tools: a compact may have left its die."""
    frames = [run.frame(number) for number in
              ([options.frame] if options.frame is not None else range(len(run.frames)))]
    frames = [frame for frame in frames if np.isfinite(frame["local_density"][()]).any()]
    numbers = np.unique(np.linspace(0, len(frames) - 1, MAPS).round().astype(int))
    return [frames[number] for number in numbers] if frames else []


def draw_map(axes, frame, low, high):
    """The cells of one frame, with their densities written in where there is room."""
    density = frame["local_density"][()].reshape(len(frame["density_grid/y"]) - 1, -1)
    x, y = 1e3 * frame["density_grid/x"][()], 1e3 * frame["density_grid/y"][()]
    mesh = axes.pcolormesh(x, y, density, cmap="viridis", vmin=low, vmax=high, edgecolors="white",
                           linewidth=0.5)
    if density.shape[1] <= 8:
        for (j, i), value in np.ndenumerate(density):
            if np.isfinite(value):
                dark = (value - low) / (high - low) > 0.6
                axes.text((x[i] + x[i + 1]) / 2, (y[j] + y[j + 1]) / 2, f"{value:.3f}", size=7,
                          ha="center", va="center", color="#1d2733" if dark else "white")
    axes.set(aspect="equal", xlabel="x [mm]", title=f"t = {when(frame)}")
    axes.grid(False)
    return mesh


def density_table(frame):
    x, y = (frame[f"density_grid/{axis}"][()] for axis in "xy")
    middle_x, middle_y = np.meshgrid((x[1:] + x[:-1]) / 2, (y[1:] + y[:-1]) / 2)
    return [("x", "m", middle_x.ravel()), ("y", "m", middle_y.ravel()),
            ("relative density", "-", frame["local_density"][()].ravel())]


def local_density(run, options):
    if recorded(run, options, "local_density") is None:
        return None
    frames = chosen_frames(run, options)
    if not frames:
        return None
    values = np.concatenate([frame["local_density"][()].ravel() for frame in frames])
    low, high = np.nanmin(values), np.nanmax(values)
    low, high = (low, high) if high - low > 1e-6 else (low - 0.01, high + 0.01)
    figure, axes = plt.subplots(1, len(frames), figsize=(3.3 * len(frames) + 1.3, 4.4), sharey=True,
                                squeeze=False, constrained_layout=True)
    for place, frame in zip(axes[0], frames):
        mesh = draw_map(place, frame, low, high)
    axes[0][0].set_ylabel("y [mm]")
    bar = figure.colorbar(mesh, ax=axes[0].tolist(), label="relative density", shrink=0.85)
    bar.outline.set_visible(False)
    figure.suptitle(f"Local relative density\n{run.title}", x=0.01, ha="left", fontsize=11)
    figure.table = density_table(frames[-1])
    return figure


def density_profile(run, options):
    frame = recorded(run, options, "density_profile")
    frames = chosen_frames(run, options) if frame is not None else []
    if not frames or len(frames[0]["density_profile"]) < 2:
        return None
    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    for frame in frames:
        lines = 1e3 * frame["density_grid/y"][()]
        values = frame["density_profile"][()]
        axes.plot(np.repeat(values, 2), np.repeat(lines, 2)[1:-1], label=f"t = {when(frame)}")
    axes.set(xlabel="relative density", ylabel="y [mm]")
    axes.set_title(f"Relative density along the height\n{run.title}", loc="left")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    figure.table = [("y", "m", (lines[1:] + lines[:-1]) / 2e3), ("relative density", "-", values)]
    return figure


def network_lines(frame, cell):
    """Lines of the contacts, from centre to centre or to where a tool acts, and their forces."""
    centre = frame["particle_centre"][()]
    pairs, tools = frame["contacts/ids"][()], frame["tool_contacts/ids"][()]
    end = cell.other_end(pairs, centre, frame["contacts/point"][()])
    lines = np.concatenate([np.stack([centre[pairs[:, 0]], end], axis=1),
                            np.stack([centre[tools[:, 0]], frame["tool_contacts/point"][()]], axis=1)])
    lines += cell.shift[np.concatenate([pairs[:, 0], tools[:, 0]]), None]
    return 1e3 * lines, np.concatenate([frame["contacts/normal_force"][()],
                                  frame["tool_contacts/normal_force"][()]])


def contact_network(run, options):
    frame = recorded(run, options, "contacts")
    if frame is None or len(frame["contacts/ids"]) + len(frame["tool_contacts/ids"]) == 0:
        return None
    cell, quads = Cell(run, frame), run.file["mesh/quads"][()]
    position, limits = cell.position, 1e3 * cell.limits()
    low, high = position.min(axis=0), position.max(axis=0)
    lines, force = network_lines(frame, cell)
    chained = quads[frame["force_chain"][()][run.file["mesh/cell_particle"][()]] > 0]
    factor, unit = unit_for("N", force)
    size = 1e3 * np.sqrt(np.prod(high - low) / len(frame["particle_centre"]))
    points = 72 * 6 / np.ptp(limits[:, 0]) * 0.28 * size  # of the strongest line
    shape = np.ptp(limits[:, 1]) / np.ptp(limits[:, 0])
    figure, axes = plt.subplots(figsize=(7.4, min(max(6.0 * shape, 2.4), 9.0) + 0.9),
                                constrained_layout=True)
    axes.add_collection(PolyCollection(1e3 * position[chained], color="#fbdccb", linewidths=0.1))
    edges = outlines(quads)
    axes.add_collection(LineCollection(1e3 * position[edges], colors="#8b96a3", linewidths=0.5))
    cell.draw(axes, edges=edges)
    drawn = LineCollection(lines, array=factor * force, cmap="viridis_r", capstyle="round",
                           clim=(0, factor * force.max()),
                           linewidths=np.maximum(0.3, points * force / force.max()), zorder=3)
    axes.add_collection(drawn)
    draw_tools(run, axes, frame.attrs["time"], limits / 1e3)
    axes.set(xlim=limits[:, 0], ylim=limits[:, 1], aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    axes.grid(False)
    chains = "; shaded: force chains" if len(chained) else ""
    axes.set_title(f"Normal contact forces at {when(frame)}{chains}\n{run.title}", loc="left")
    bar = figure.colorbar(drawn, ax=axes, shrink=0.9, label=labelled("normal force", unit))
    bar.outline.set_visible(False)
    ends = lines.reshape(-1, 4).T / 1e3
    figure.table = [*((name, "m", end) for name, end in zip(("x1", "y1", "x2", "y2"), ends)),
                    ("normal force", "N", force)]
    return figure


def rose(run, options):
    frame = recorded(run, options, "rose")
    if frame is None or not np.any(frame["rose/number"][()]):
        return None
    number, force = frame["rose/number"][()], frame["rose/force"][()]
    middle = np.arange(2 * len(number)) * np.pi / len(number)
    figure, axes = plt.subplots(figsize=(5, 5.2), subplot_kw={"projection": "polar"},
                                constrained_layout=True)
    width = np.pi / len(number)
    axes.bar(middle, 100 * np.tile(force, 2), width, color="#0072b2", alpha=0.55,
             label="of the normal force")
    axes.bar(middle, 100 * np.tile(number, 2), width, fill=False, edgecolor="#d55e00", linewidth=1.4,
             label="of the number")
    axes.set_rlabel_position(25)
    axes.yaxis.set_major_locator(MaxNLocator(4))  # labels of more would lie on each other
    axes.yaxis.set_major_formatter("{x:g} %")
    axes.set_title(f"Directions of the contact normals at {when(frame)}\n{run.title}", loc="left")
    axes.legend(loc="lower right", bbox_to_anchor=(1.1, -0.08))
    figure.table = [("direction", "rad", middle[:len(number)]), ("share of the number", "-", number),
                    ("share of the normal force", "-", force)]
    return figure
