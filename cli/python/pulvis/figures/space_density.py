"""Local densities in three dimensions: one layer of cells normal to an axis."""
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator

from pulvis.figures.colours import colour_map
from pulvis.figures.densities import ends_of, room_of, write_values
from pulvis.figures.look import Options, bar_beside, close_up, moment, printed, recorded, set_axes, shape_of, sheet, worded
from pulvis.figures.space import asked_place
from pulvis.figures.space_tools import cut, pieces
from pulvis.figures.tools import TOOL_EDGE

WRITTEN_UP_TO = 10  # up to this many cells side by side, density values are printed


def layer_of(lines, at):
    """The layer of cells at a coordinate; by default the middle one."""
    middle = (lines[0] + lines[-1]) / 2 if at is None else at
    return int(np.clip(np.searchsorted(lines, middle, side="right") - 1, 0, len(lines) - 2))


def density_slice(run, options=None, axes=None):
    """The layer of cells normal to `options.across` at `options.at` (m), by default in the middle; the colour scale is
    that of the whole frame."""
    options = options or Options()
    frame = recorded(run, options, "local_density")
    if frame is None or not np.isfinite(frame["local_density"][()]).any():
        return None
    values, lines = frame.density()
    axis, others = "xyz".index(options.across), [k for k in range(3) if "xyz"[k] != options.across]
    at = asked_place(run, frame, options)
    if at is not None and not lines[axis][0] <= at <= lines[axis][-1]:
        return None  # outside the tools
    layer = layer_of(lines[axis], at)
    cells = np.take(values, layer, axis).T  # rows: the second of the two remaining axes
    low, high = ends_of(options, [frame])
    across, up = (1e3 * lines[k] for k in others)
    limits = np.array([[across[0], up[0]], [across[-1], up[-1]]])
    limits += 0.03 * np.ptp(limits, axis=0).max() * np.array([[-1], [1]])
    size, beside = shape_of(limits)
    figure, place = sheet(options, size, axes, beside)
    drawn = place.pcolormesh(across, up, cells, cmap=colour_map(options), vmin=low, vmax=high, edgecolors="white", linewidth=0.5)
    if cells.shape[1] <= WRITTEN_UP_TO and not options.narrow:
        write_values(place, (across, up), cells, (low, high), room_of(figure, axes, 1.6))
    at = (lines[axis][layer] + lines[axis][layer + 1]) / 2
    walls = cut(pieces(run, frame)[0], axis, at)
    place.add_collection(LineCollection(1e3 * walls, colors=TOOL_EDGE, linewidths=1.8, zorder=2))
    names = ["xyz"[k] for k in others]
    set_axes(place, limits, names)
    # The default locator depends on the height, which the layout only knows in the end.
    place.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    ends = " to ".join(printed(lines[axis][layer + k], "m") for k in (0, 1))
    options.head(place, f"Local relative density, ${options.across}$ from {ends}, at {moment(frame)}", run)
    bar_beside(figure, place, drawn, worded(run, "local_density", ""))
    close_up(figure, options, axes)
    middles = np.meshgrid(*((one[1:] + one[:-1]) / 2 for one in lines), indexing="ij")
    figure.table = [*((name, "m", middle.ravel()) for name, middle in zip("xyz", middles)), ("relative density", "-", values.ravel())]
    return figure
