"""What the pictures of a run have in common: reading run.h5, units, outlines and tools."""
import csv
import json
import re
import sys

import h5py
import numpy as np
from matplotlib import pyplot as plt

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555", "#8c6d1f",
           "#882255", "#117733"]
PREFIXES = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")]
SCALED = {"m", "N", "Pa", "J", "s", "m/s", "N/m", "V"}
STYLE = {"figure.dpi": 200, "font.size": 10, "axes.grid": True, "grid.color": "#e3e8ee",
         "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True,
         "svg.fonttype": "none", "pdf.fonttype": 42, "lines.linewidth": 1.6, "legend.frameon": False, "axes.titlesize": 11,
         "axes.prop_cycle": plt.cycler(linestyle=["-", "--", ":"]) * plt.cycler(color=COLOURS)}


def unit_for(unit, values):
    """The factor from SI to a unit an engineer would read, and that unit's name."""
    finite = np.abs(values[np.isfinite(values)]) if np.size(values) else np.array([])
    most = finite.max() if finite.size else 0
    if unit in ("-", ""):
        return 1.0, ""
    if unit not in SCALED or not most > 0:
        return 1.0, unit
    for size, prefix in PREFIXES:
        if most >= 0.9995 * size and not (unit[0] == "m" and size > 1):
            return 1 / size, prefix + unit
    return 1e9, "n" + unit


def labelled(name, unit):
    return f"{name} [{unit}]" if unit else name


def printable(text):
    """A control character in a name would be an order to the terminal."""
    return "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in str(text))


def refuse(why):
    print(f"figures: {printable(why)}", file=sys.stderr)
    sys.exit(2)


def write_csv(path, table):
    """table: [(name, unit, values)] in SI, of any lengths."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([f"{name} [{unit}]" for name, unit, _ in table])
        for i in range(max(len(values) for _, _, values in table)):
            writer.writerow([repr(float(values[i])) if i < len(values) else "" for _, _, values in table])


def draw_lines(run, x, lines, ylabel, title):
    """x: (label, values, unit); lines: [(label, values, unit)] of one unit."""
    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    x_factor, x_unit = unit_for(x[2], x[1])
    factor, unit = unit_for(lines[0][2], np.concatenate([values for _, values, _ in lines]))
    for label, values, _ in lines:
        axes.plot(x_factor * x[1], factor * values, label=label)
    axes.set_xlabel(labelled(x[0], x_unit))
    axes.set_ylabel(labelled(ylabel, unit))
    axes.set_title(f"{title}\n{run.title}", loc="left")
    axes.legend()
    figure.table = [(label, unit, values) for label, values, unit in [x, *lines]]
    return figure


class Run:
    def __init__(self, folder):
        if (folder / "run.h5").exists() and not (folder / "run.h5").is_file():
            raise OSError("run.h5 is no regular file")  # a named pipe would wait for a writer
        self.file = h5py.File(folder / "run.h5", "r")
        self.summary = {}
        if (folder / "summary.json").is_file():
            self.summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        self.is_solid = "mesh/hexahedra" in self.file
        self.title = self.summary.get("title") or self.file.attrs.get("title") or folder.name
        self.frames = [name for name in sorted(self.file["frames"])
                       if self.file["frames"][name].attrs.get("complete", 0) == 1]
        self.series = {}
        self.file["history"].visititems(self._keep_series)

    def _keep_series(self, name, item):
        if isinstance(item, h5py.Dataset):
            self.series[name] = item

    def frame(self, number=None):
        """The frame of that number, from 0; the last without one."""
        number = len(self.frames) - 1 if number is None else number
        if not -len(self.frames) <= number < len(self.frames):
            refuse(f"frame {number}: there are 0 to {len(self.frames) - 1}")
        return self.file["frames"][self.frames[number]]

    def values(self, name):
        return self.series[name][()][:self.series["time"].shape[0]]

    def matching(self, pattern):
        """Series of that name that are anything but zero: [(match, values, unit)]."""
        found = [(re.fullmatch(pattern, name), name) for name in sorted(self.series)]
        found = [(match, self.values(name), self.series[name].attrs["unit"])
                 for match, name in found if match]
        return [one for one in found if one[1].size and np.nanmax(np.abs(one[1])) > 0]


def tool_shift(run, tool, time):
    """How far a tool still has to go from `time` to the end, where the summary tells its place."""
    shift, times = np.zeros(2), run.values("time")
    for k, axis in enumerate("xy"):
        name = f"tool/{tool}/position_{axis}"
        if name in run.series and times.size:
            values = run.values(name)
            shift[k] = np.interp(time, times, values) - values[-1]
    return shift


def endless(points, far):
    """A chain of points that goes straight on for `far` at both ends."""
    begin, end = points[0] - points[1], points[-1] - points[-2]
    return np.vstack([points[0] + far * begin / np.hypot(*begin), points,
                      points[-1] + far * end / np.hypot(*end)])


def draw_tools(run, axes, time, limits):
    far = 4 * np.ptp(limits, axis=0).max()
    for tool in run.summary.get("tools", []):
        shift = tool_shift(run, tool.get("name"), time)
        if "points" in tool:
            points = np.array(tool["points"], float) + shift
        elif "point" in tool and "normal" in tool:
            along = np.array([-tool["normal"][1], tool["normal"][0]], float)
            points = np.array(tool["point"], float) + shift + np.outer([0, 1], far * along)
        else:
            continue  # a constraint touches nothing
        line = 1e3 * endless(points, far)
        axes.plot(line[:, 0], line[:, 1], color="#6b7683", linewidth=1.8, zorder=3)


def outlines(quads):
    """The edges that one quad alone has: the boundaries of the particles. [edges, 2]"""
    edges = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    return unique[count == 1]
