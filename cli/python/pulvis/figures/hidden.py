"""Curves that lie on one another: the later ones are dashed, so that all of them are seen."""
import numpy as np

CELL = 0.004   # of the axes: the width of a line is 0.006 of a usual figure
ROW = 1 << 20  # a cell (i, j) has the number ROW i + j
MOST = 1000    # cells that one stretch between two samples passes
MOSTLY = 0.95  # the part of a curve that another one needs to cover to hide it
SEGMENT = 4    # length of what is seen of each curve in turn, in widths of the line


def cells_of(axes, line):
    """The numbers of the cells of a fine grid over the axes that the curve passes."""
    axes.get_xlim(), axes.get_ylim()  # scales the axes to their curves, which matplotlib does on demand
    with np.errstate(all="ignore"):
        places = (axes.transScale + axes.transLimits).transform(line.get_xydata()) / CELL
    if line.get_drawstyle() == "steps-post":
        corners = np.column_stack([places[1:, 0], places[:-1, 1]])
        places = np.insert(places, np.arange(1, len(places)), corners, axis=0)
    start, way = places[:-1], np.diff(places, axis=0)
    drawn = np.isfinite(way).all(axis=1)
    start, way = start[drawn], way[drawn]
    steps = 2 + np.minimum(2 * np.abs(way).max(axis=1, initial=0), MOST).astype(int)
    which = np.repeat(np.arange(len(steps)), steps)
    along = (np.arange(len(which)) - np.repeat(np.cumsum(steps) - steps, steps)) / (steps[which] - 1)
    i, j = np.floor(start[which] + along[:, None] * way[which]).astype(int).T
    return np.unique(ROW * i + j)


def hides(upper, lower):
    """Whether the curve through the cells `upper` covers the one through `lower`, to the width of a line."""
    covered = np.unique([upper + ROW * i + j for i in (-1, 0, 1) for j in (-1, 0, 1)])
    return len(lower) > 0 and np.isin(lower, covered).mean() >= MOSTLY


def dash_hidden(axes, lines):
    """lines: in the order in which they are drawn. Of curves that lie on one another, each is seen in turn: the lowest
    through the gaps of all others, the uppermost in its dashes."""
    stacks = []  # of [(line, cells)], from below
    for line in lines:
        cells = cells_of(axes, line)
        under = next((stack for stack in stacks if any(hides(cells, below) for _, below in stack)), None)
        if under is None:
            stacks.append([(line, cells)])
        else:
            under.append((line, cells))
    for stack in stacks:
        for k, (line, _) in enumerate(stack[1:], start=1):
            line.set_linestyle((0, (SEGMENT * (len(stack) - k), SEGMENT * k)))
            line.set_dash_capstyle("butt")
