"""Local densities of a run: maps at several times, and profiles over the height."""
import numpy as np
from matplotlib import pyplot as plt

from pulvis.figures.colours import colour_map
from pulvis.figures.hidden import dash_hidden
from pulvis.figures.look import Options, bar_beside, close_up, legend_beside, moment, name_lengths, recorded, sheet, worded
from pulvis.figures.names import label, name_of
from pulvis.figures.room import subplots

LETTERS, LINE = 24, 10  # points of width and height that a printed density value takes
MAPS = 4  # density maps side by side: evenly over the run, including the last frame
FEW_MAPS = 2  # where there is no room for more
MANY_MAPS_FROM = 6.5  # inches


def chosen_frames(run, options, count=MAPS):
    """Frames with particles between the tools: the compact may have been ejected from the die."""
    frames = [run.frame(number) for number in
              ([options.frame] if options.frame is not None else range(len(run.frames)))]
    frames = [frame for frame in frames if np.isfinite(frame["local_density"][()]).any()]
    numbers = np.unique(np.linspace(0, len(frames) - 1, count).round().astype(int))
    return [frames[number] for number in numbers] if frames else []


def grid_of(frame):
    """Corners of the density grid, m: lower left, upper right."""
    return np.stack([frame[f"density_grid/{axis}"][()][[0, -1]] for axis in "xy"], axis=1)


def symbol_of(run):
    """For a bar that is too short for words."""
    return f"${name_of('local_density', run.labels).symbol or 'D'}$"


def ends_of(options, frames):
    """Ends of the colour scale of the local densities of some frames."""
    low, high = options.clim(np.concatenate([frame["local_density"][()].ravel() for frame in frames]), "-")
    return (low, high) if high - low > 1e-6 else (low - 0.01, high + 0.01)


def write_values(axes, lines, density, ends, room):
    """Prints the densities into their cells if they fit. lines: between the cells, across and up; room: width in points."""
    (x, y), (low, high) = lines, ends
    points = room / np.ptp(x)
    if points * np.diff(x).min() < LETTERS or points * np.diff(y).min() < LINE:
        return
    for (j, i), value in np.ndenumerate(density):
        if np.isfinite(value):
            axes.text((x[i] + x[i + 1]) / 2, (y[j] + y[j + 1]) / 2, f"{value:.3f}", size=7, ha="center", va="center",
                      color="#1d2733" if (value - low) / (high - low) > 0.6 else "white")


def room_of(figure, axes, beside, maps=1):
    """About the width of a map in points. axes: those of the caller, or None for a new figure, with `beside` inches for labels."""
    return 72 * ((figure.get_figwidth() - beside) / maps if axes is None else 0.7 * axes.get_window_extent().width / figure.dpi)


def draw_map(axes, frame, ends, colours, room):
    """The cells of one frame, with density values printed if they fit; room: width of the map in points."""
    low, high = ends
    density = frame["local_density"][()].reshape(len(frame["density_grid/y"]) - 1, -1)
    x, y = 1e3 * frame["density_grid/x"][()], 1e3 * frame["density_grid/y"][()]
    mesh = axes.pcolormesh(x, y, density, cmap=colours, vmin=low, vmax=high, edgecolors="white",
                           linewidth=0.5)
    write_values(axes, (x, y), density, ends, room)
    axes.set(aspect="equal", title=f"$t$ = {moment(frame)}")
    name_lengths(axes, grid_of(frame), x="x")
    axes.grid(False)
    return mesh


def draw_profiles(axes, along, profiles, options):
    """profiles: (time in words, densities [slices], places [slices + 1] m along the axis `along`) of each curve."""
    dash_hidden(axes, [axes.plot(np.repeat(density, 2), 1e3 * np.repeat(places, 2)[1:-1], label=f"$t$ = {time}")[0]
                       for time, density, places in profiles])
    axes.set_xlabel(label(("relative density", r"\rho"), ""))
    name_lengths(axes, np.concatenate([places for _, _, places in profiles]), y=along)
    legend_beside(axes, options)


def profile_table(along, profiles):
    """The middles of the slices and their densities, of every curve."""
    named = (lambda name, time: f"{name}, t = {time}") if len(profiles) > 1 else lambda name, _: name
    return [column for time, density, places in profiles for column in
            ((named(along, time), "m", (places[1:] + places[:-1]) / 2), (named("relative density", time), "-", density))]


def density_table(frame):
    x, y = (frame[f"density_grid/{axis}"][()] for axis in "xy")
    middle_x, middle_y = np.meshgrid((x[1:] + x[:-1]) / 2, (y[1:] + y[:-1]) / 2)
    return [("x", "m", middle_x.ravel()), ("y", "m", middle_y.ravel()),
            ("relative density", "-", frame["local_density"][()].ravel())]


def local_density(run, options=None, axes=None):
    """Maps at several times, or of the requested frame; on one colour scale, or each on that of its own frame."""
    options = options or Options()
    count = FEW_MAPS if options.width and options.width < MANY_MAPS_FROM else MAPS
    frames = chosen_frames(run, options, count) if recorded(run, options, "local_density") is not None else []
    if not frames:
        return None
    if axes is None:
        figure, places = subplots(1, len(frames), figsize=options.size(3.3 * len(frames) + 1.3, 4.4, 0.9), sharey=True,
                                  squeeze=False)
        places = places[0].tolist()
    else:
        figure, places, frames = axes.figure, [axes], frames[-1:]
    shared = not options.own_range or len(places) == 1
    room = room_of(figure, axes, 1.5 if shared else 0.7, len(frames))
    for place, frame in zip(places, frames):
        mesh = draw_map(place, frame, ends_of(options, frames if shared else [frame]), colour_map(options), room)
        if not shared:
            bar = figure.colorbar(mesh, ax=place, location="bottom", aspect=12, label=symbol_of(run))
            bar.outline.set_visible(False)
    name_lengths(places[0], grid_of(frames[0]), x="x", y="y")
    if len(places) == 1:
        bar_beside(figure, places[0], mesh, worded(run, "local_density", ""))
        places[0].set_title("")
        options.head(places[0], f"Local relative density at {moment(frames[0])}", run)
    elif shared:
        figure.colorbar(mesh, ax=places, label=worded(run, "local_density", ""), shrink=0.85).outline.set_visible(False)
    if options.title and len(places) > 1:
        figure.suptitle(f"Local relative density\n{run.title}", x=0.01, ha="left", fontsize=plt.rcParams["axes.titlesize"])
    close_up(figure, options, axes)
    figure.table = density_table(frames[-1])
    return figure


def density_profile(run, options=None, axes=None):
    options = options or Options()
    frame = recorded(run, options, "density_profile")
    frames = chosen_frames(run, options) if frame is not None else []
    if not frames or len(frames[0]["density_profile"]) < 2:
        return None
    figure, axes = sheet(options, (6.4, 4.2), axes)
    profiles = [(moment(frame), frame["density_profile"][()], frame["density_grid/y"][()]) for frame in frames]
    draw_profiles(axes, "y", profiles, options)
    options.head(axes, "Relative density along the height", run)
    figure.table = profile_table("y", profiles)
    return figure
