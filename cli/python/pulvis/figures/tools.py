"""The tools in figures: as bodies recorded by the run, or as lines from its summary."""
import numpy as np
from matplotlib.collections import PolyCollection

TOOL_FACE, TOOL_EDGE = "#dfe4ea", "#6b7683"


def tool_shift(run, tool, time):
    """Remaining travel of a tool from `time` to the end, where the summary gives its position."""
    shift, times = np.zeros(2), run.series("time")
    for k, axis in enumerate("xy"):
        name = f"tool/{tool}/position_{axis}"
        if run.has(name) and times.size:
            values = run.series(name)
            shift[k] = np.interp(time, times, values) - values[-1]
    return shift


def endless(points, far):
    """A polyline extended straight by `far` at both ends."""
    begin, end = points[0] - points[1], points[-1] - points[-2]
    return np.vstack([points[0] + far * begin / np.hypot(*begin), points,
                      points[-1] + far * end / np.hypot(*end)])


def bodies(run, frame):
    """Outlines of the tools in a frame, m, if the run recorded them: one polygon each."""
    if "tools/line_tool" not in run.file or "tools/outline" not in frame:
        return []
    corners, of_tool = frame["tools/outline"][()], run.file["tools/line_tool"][()]
    return [corners[of_tool == tool] for tool in np.unique(of_tool)]


def draw_tools(run, axes, frame, limits):
    """limits: of the plot, m."""
    recorded = bodies(run, frame)
    if recorded:
        axes.add_collection(PolyCollection([1e3 * one for one in recorded], facecolors=TOOL_FACE, edgecolors=TOOL_EDGE,
                                           linewidths=0.8, zorder=2.5))
        return
    far = 4 * np.ptp(limits, axis=0).max()
    for tool in run.summary.get("tools", []):
        shift = tool_shift(run, tool.get("name"), frame.attrs["time"])
        if "points" in tool:
            points = np.array(tool["points"], float) + shift
        elif "point" in tool and "normal" in tool:
            along = np.array([-tool["normal"][1], tool["normal"][0]], float)
            points = np.array(tool["point"], float) + shift + np.outer([0, 1], far * along)
        else:
            continue  # a constraint has no contact surface
        line = 1e3 * endless(points, far)
        axes.plot(line[:, 0], line[:, 1], color=TOOL_EDGE, linewidth=1.8, linestyle="-", zorder=3)


def outlines(quads):
    """Edges that belong to only one quad: the particle boundaries. [edges, 2]"""
    edges = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    return unique[count == 1]
