"""Lever results besides series and frames: friction loops, force curves, raster images."""
from collections import namedtuple

import numpy as np

Motion = namedtuple("Motion", "rows position force signal")
Motion.__doc__ = """One way of the scanner: `rows` of the history, its `position` in m, a `force` in N and the `signal` of the
detector in V. Of a force curve, the vertical force on the tip. Of a friction loop, the force with which the lever drags the tip
along the scan, as in the loop's values: force on the tip (`probe/force_y`) and signal have the opposite sign in the history."""
Loop = namedtuple("Loop", "action axis trace retrace values")
Loop.__doc__ = """A friction loop: the action that scanned it, "x" or "y", two Motions, and what summary.json says of it."""
ForceCurve = namedtuple("ForceCurve", "action approach retract values")
ForceCurve.__doc__ = """Two Motions, and what summary.json says: pull-off force in N, work in J, work of adhesion."""
Image = namedtuple("Image", "values unit pixel_width pixel_height")
Image.__doc__ = """Lines of a raster [lines, pixels], first line first, in `unit`; sizes of a pixel in m or None."""


def motion_of(run, rows, axis, sign=1):
    lateral = {"x": "normal", "y": "lateral", "z": "normal"}[axis]
    columns = [f"scanner/{axis}", f"probe/force_{axis}", f"detector/{lateral}"]
    return Motion(rows, *(way * run.series(name)[rows] if run.has(name) else None
                          for name, way in zip(columns, (1, sign, sign))))


def loops_of(run):
    time, loops = run.series("time"), []
    for values in run.summary.get("loops", []):
        action = values["action"]
        within = [np.flatnonzero((time > action + a + 1e-9) & (time <= action + b + 1e-9)) for a, b in ((0, 0.5), (0.5, 1))]
        both = np.concatenate(within)
        if not both.size:
            continue
        reach = {axis: np.ptp(run.series(f"scanner/{axis}")[both]) for axis in "yx" if run.has(f"scanner/{axis}")}
        axis = max(reach, key=lambda one: reach[one])
        trace, retrace = (motion_of(run, rows, axis, -1) for rows in within)
        loops.append(Loop(action, axis, trace, retrace, values))
    return loops


def vertical_moves(run):
    """For each row: +1 if the sample only moved up to reach it, -1 if it only moved down, 0 otherwise."""
    moves = {axis: np.diff(run.series(f"scanner/{axis}"), prepend=np.nan) if run.has(f"scanner/{axis}") else np.array(0.0)
             for axis in "xyz"}
    still = (moves["x"] == 0) & (moves["y"] == 0)
    return np.where(still, np.sign(np.nan_to_num(moves["z"])), 0)


def force_curves_of(run):
    if not run.has("scanner/z"):
        return []
    time, moves, curves = run.series("time"), vertical_moves(run), []
    for values in run.summary.get("force_curves", []):
        begin = int(np.searchsorted(time, values["action"] + 1e-9))
        end = begin
        while end < len(moves) and moves[end] < 0:
            end += 1
        last = begin
        while last > 0 and moves[last - 1] == 0:  # hold between approach and retract
            last -= 1
        first = last
        while first > 0 and moves[first - 1] > 0:
            first -= 1
        curves.append(ForceCurve(values["action"], motion_of(run, np.arange(max(first - 1, 0), last), "z"),
                                 motion_of(run, np.arange(max(begin - 1, 0), end), "z"), values))
    return curves


def images_of(run):
    def image(data):
        return Image(data[()], data.attrs["unit"], data.attrs.get("pixel_width"), data.attrs.get("pixel_height"))

    return {action: {name: image(data) for name, data in group.items()}
            for action, group in run.file.get("images", {}).items()}
