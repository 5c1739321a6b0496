"""Animation of a lever: its mesh, frame by frame, above the forces on its tip."""
import math

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.colors import Normalize

from pulvis.errors import PulvisError
from pulvis.figures.afm import draw_solid, outer_faces, part_colours, progress_words
from pulvis.figures.colours import colour_map
from pulvis.figures.look import legend_beside, unit_for, worded
from pulvis.figures.names import capital, over
from pulvis.figures.room import Room

PICTURES = ("solid", "plastic_strain")
VISIBLE = 0.08  # of the lever's length: smaller displacements are magnified to this size
FLAT = 1e-3  # of the largest force: a force that varies less is not drawn


def round_down(factor):
    """Rounds down to 1, 2 or 5 times a power of ten."""
    power = 10 ** math.floor(math.log10(factor))
    return power * max(digit for digit in (1, 2, 5) if digit * power <= factor * (1 + 1e-12))


def magnification(run):
    """Magnification of displacements; 1 if they are visible, or were already magnified."""
    if progress_words(run) == "load case":
        return 1
    moved = max(np.linalg.norm(frame.nodes - run.mesh.reference, axis=1).max() for frame in run.frames)
    length = np.ptp(run.mesh.reference, axis=0).max()
    return max(1, round_down(VISIBLE * length / moved)) if moved > 0 else 1


def forces_of(run):
    """[(key, values)] of the tip forces that vary."""
    keys = [f"probe/force_{axis}" for axis in "zyx" if run.has(f"probe/force_{axis}")]
    ranges = {key: np.ptp(run.series(key)) for key in keys}
    return [(key, run.series(key)) for key in keys if ranges[key] > FLAT * max(ranges.values())]


class Forces:
    """The force curves, with the current frame marked."""

    def __init__(self, run, axes, options):
        self.times, self.lines = run.series("time"), []
        forces = forces_of(run)
        factor, unit = unit_for("N", np.concatenate([values for _, values in forces]))
        for key, values in forces:
            line, = axes.plot(self.times, factor * values, alpha=0.35, linewidth=0.9)
            dot, = axes.plot([], [], "o", color=line.get_color(), label=worded(run, key, ""))
            self.lines.append((dot, factor * values))
        axes.set(xlabel=capital(progress_words(run)), ylabel=over("Force", unit))
        legend_beside(axes, options)

    def show(self, time):
        row = min(int(np.searchsorted(self.times, time - 1e-9)), len(self.times) - 1)
        for dot, values in self.lines:
            dot.set_data([self.times[row]], [values[row]])


def require_picture(run, key, into):
    there = [name for name in PICTURES if name == "solid" or all(name in frame for frame in run.frames)]
    if key not in there:
        raise PulvisError(f"--field {key}: a lever is animated as one of: {', '.join(there)}", key="--field")
    if into is not None:
        raise PulvisError("the animation of a lever has two axes of its own; allowed: without ax")


def sheet_of(run, options):
    """(figure, axes of the mesh, Forces or None)"""
    with_forces = bool(run.has("probe/force_z") and forces_of(run))
    figure = plt.figure(figsize=options.size(7.2, 6.4 if with_forces else 4.4), layout=Room())
    if not with_forces:
        return figure, figure.add_subplot(projection="3d"), None
    grid = figure.add_gridspec(2, 1, height_ratios=[2.4, 1])
    return figure, figure.add_subplot(grid[0], projection="3d"), Forces(run, figure.add_subplot(grid[1]), options)


def lever_film(run, options, into=None):
    """Like animation.film: figure, axes, and the function that draws frame k."""
    key = options.field or PICTURES[0]
    require_picture(run, key, into)
    faces, reference, times = outer_faces(run.mesh.cells.tolist()), run.mesh.reference, magnification(run)
    drawn = [reference + times * (frame.nodes - reference) for frame in run.frames]
    ends = np.array([np.min(drawn, axis=(0, 1)), np.max(drawn, axis=(0, 1))])
    figure, axes, forces = sheet_of(run, options)
    cells = [cell for _, cell in faces]
    scale = None
    if key != PICTURES[0]:
        values = [frame[key][:] for frame in run.frames]
        norm = Normalize(*options.clim(np.concatenate([[0], *values]), "-"))
        scale = plt.cm.ScalarMappable(norm, colour_map(options, "inferno_r"))
        figure.colorbar(scale, ax=axes, label=worded(run, key, ""), shrink=0.6, pad=0.12)

    def show(k):
        axes.clear()
        frame = run.frames[k]
        colours = scale.to_rgba(values[k][cells]) if scale else part_colours(run, faces)
        title = f"{capital(progress_words(run))} {frame.time:.3g}" + (f", displacements × {times:g}" if times > 1 else "")
        draw_solid(axes, drawn[k], faces, colours, "", ends)
        if options.title:
            axes.text2D(0.02, 0.98, title, transform=axes.transAxes, va="top")
        if forces:
            forces.show(frame.time)
        return []

    show(0)
    return figure, axes, show
