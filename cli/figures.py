#!/usr/bin/python3
"""Pictures of a run for papers and slides: the field of a frame, forces, stress ratio and energies.

usage: figures.py RUN_FOLDER [--frame N] [--field NAME]

Reads RUN_FOLDER/run.h5 (complete frames only) and summary.json where there is one, and writes
RUN_FOLDER/pictures/*.png. What a run has not recorded is left out, with a line that says so.
Needs python3-h5py, python3-numpy and python3-matplotlib.
"""
import argparse
import json
import re
import sys
from pathlib import Path

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555", "#8c6d1f"]
PREFIXES = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")]
DEFAULT_FIELD = "effective_stress"
SCALED = {"m", "N", "Pa", "J", "s", "m/s", "N/m"}
STYLE = {"figure.dpi": 200, "font.size": 10, "axes.grid": True, "grid.color": "#e3e8ee",
         "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True,
         "lines.linewidth": 1.6, "legend.frameon": False, "axes.titlesize": 11,
         "axes.prop_cycle": plt.cycler(color=COLOURS)}


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


class Run:
    def __init__(self, folder):
        self.file = h5py.File(folder / "run.h5", "r")
        self.summary = {}
        if (folder / "summary.json").exists():
            self.summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        self.title = self.summary.get("title") or self.file.attrs.get("title") or folder.name
        self.frames = [name for name in sorted(self.file["frames"])
                       if self.file["frames"][name].attrs.get("complete", 0) == 1]
        self.series = {}
        self.file["history"].visititems(self._keep_series)

    def _keep_series(self, name, item):
        if isinstance(item, h5py.Dataset):
            self.series[name] = item

    def values(self, name):
        return self.series[name][()][:self.series["time"].shape[0]]

    def matching(self, pattern):
        """Series of that name that are anything but zero: [(match, values, unit)]."""
        found = [(re.fullmatch(pattern, name), name) for name in sorted(self.series)]
        found = [(match, self.values(name), self.series[name].attrs["unit"])
                 for match, name in found if match]
        return [one for one in found if one[1].size and np.nanmax(np.abs(one[1])) > 0]


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
    return figure


def time_axis(run):
    return "time", run.values("time"), "s"


def force(run, _):
    found = run.matching(r"tool/(.+)/force_([xyz])")
    most = max((np.nanmax(np.abs(values)) for _, values, _ in found), default=0)
    lines = []
    for match, values, unit in found:
        if np.nanmax(np.abs(values)) < 0.01 * most:
            continue
        turned = -np.nanmin(values) > np.nanmax(values)
        name = f"{match[1]}, {'−' if turned else ''}F{match[2]}"
        lines.append((name, -values if turned else values, unit))
    return draw_lines(run, time_axis(run), lines, "force", "Forces on the tools") if lines else None


def stress_ratio(run, _):
    lines = [(match[1], values, unit)
             for match, values, unit in run.matching(r"stress_ratio/(axial|lateral)")]
    if not lines:
        return None
    x = time_axis(run)
    if "relative_density" in run.series:
        x = "relative density", run.values("relative_density"), "-"
    return draw_lines(run, x, lines, r"stress ratio $\sigma/\sigma_y$", "Stress over yield stress")


def energies(run, _):
    lines = [(match[1], values, unit) for match, values, unit in run.matching(r"energy/(.+)")]
    return draw_lines(run, time_axis(run), lines, "energy", "Energies") if lines else None


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
            continue  # a grip touches nothing
        line = 1e3 * endless(points, far)
        axes.plot(line[:, 0], line[:, 1], color="#6b7683", linewidth=1.8, zorder=3)


def outlines(quads):
    """The edges that one quad alone has: the boundaries of the particles. [edges, 2]"""
    edges = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    return unique[count == 1]


def cell_field(frame, name):
    """(values, unit) of a cell field of one component: NAME, or NAME:k for one of several."""
    name, _, component = name.partition(":")
    fields = [f for f in frame if frame[f].attrs.get("place") == "cell"]
    if name not in fields:
        raise KeyError(f"no cell field {name}; there are: {', '.join(fields) or 'none'}")
    data = frame[name]
    count = int(data.attrs["components"])
    if data.ndim > 1 and not (component.isdigit() and 1 <= int(component) <= count):
        raise KeyError(f"{name} has {count} components: say {name}:1 to {name}:{count}")
    return (data[()] if data.ndim == 1 else data[:, int(component) - 1]), data.attrs["unit"]


def field_picture(run, options):
    if not run.frames:
        return None
    name = options.field or DEFAULT_FIELD
    number = options.frame if options.frame is not None else len(run.frames) - 1
    if not -len(run.frames) <= number < len(run.frames):
        sys.exit(f"figures: frame {number}: there are 0 to {len(run.frames) - 1}")
    frame = run.file["frames"][run.frames[number]]
    try:
        values, unit = cell_field(frame, name)
    except KeyError as error:
        if options.field:  # asked for by name
            sys.exit(f"figures: {error.args[0]}")
        return None
    return draw_field(run, frame, name, values, unit)


def draw_field(run, frame, name, values, unit):
    position = frame["position"][()]
    quads, (factor, shown) = run.file["mesh/quads"][()], unit_for(unit, values)
    low, high = position.min(axis=0), position.max(axis=0)
    margin = 0.03 * (high - low).max()
    limits = 1e3 * np.array([low - margin, high + margin])
    shape = np.ptp(limits[:, 1]) / np.ptp(limits[:, 0])
    figure, axes = plt.subplots(figsize=(7.2, min(max(6.0 * shape, 2.4), 9.0) + 0.9),
                                constrained_layout=True)
    faces = PolyCollection(1e3 * position[quads], array=factor * values, cmap="viridis",
                           edgecolors="face", linewidths=0.1)
    axes.add_collection(faces)
    axes.add_collection(LineCollection(1e3 * position[outlines(quads)], colors="#1d2733",
                                       linewidths=0.4))
    draw_tools(run, axes, frame.attrs["time"], limits / 1e3)
    axes.set(xlim=limits[:, 0], ylim=limits[:, 1], aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    axes.grid(False)
    time_factor, time_unit = unit_for("s", np.array([frame.attrs["time"]]))
    label = name.replace("_", " ").replace(":", " ")
    axes.set_title(f"{label.capitalize()} at {time_factor * frame.attrs['time']:.4g} {time_unit}\n"
                   f"{run.title}", loc="left")
    bar = figure.colorbar(faces, ax=axes, shrink=0.9, label=labelled(label, shown))
    bar.outline.set_visible(False)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run_folder", type=Path)
    parser.add_argument("--frame", type=int, help="number of a frame, from 0; the last if not said")
    parser.add_argument("--field",
                        help=f"cell field, {DEFAULT_FIELD} if not said; NAME:k for component k")
    options = parser.parse_args()
    try:
        run = Run(options.run_folder)
    except (OSError, ValueError) as error:
        sys.exit(f"figures: {options.run_folder}: {error}")
    pictures = options.run_folder / "pictures"
    pictures.mkdir(exist_ok=True)
    plt.rcParams.update(STYLE)
    field_name = (options.field or DEFAULT_FIELD).replace(":", "_")
    names = {field_name: field_picture, "force": force,
             "stress_ratio": stress_ratio, "energies": energies}
    for name, draw in names.items():
        figure = draw(run, options)
        if figure is None:
            print(f"figures: nothing recorded for {name}.png")
            continue
        figure.savefig(pictures / f"{name}.png")
        plt.close(figure)
        print(pictures / f"{name}.png")


if __name__ == "__main__":
    main()
