#!/usr/bin/python3
"""Pictures of a run for papers and slides: the field of a frame, forces, stress ratio, energies,
local densities and the contact network.

usage: figures.py RUN_FOLDER [--frame N] [--field NAME]

Reads RUN_FOLDER/run.h5 (complete frames only) and summary.json where there is one, and writes
RUN_FOLDER/pictures/*.png. What a run has not recorded is left out, with a line that says so.
Needs python3-h5py, python3-numpy and python3-matplotlib.
"""
import argparse
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402

from figure_parts import STYLE, Run, draw_tools, labelled, outlines, unit_for  # noqa: E402
from observed_figures import contact_network, density_profile, local_density, rose  # noqa: E402

DEFAULT_FIELD = "effective_stress"


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
    frame = run.frame(options.frame)
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
             "stress_ratio": stress_ratio, "energies": energies,
             "local_density": local_density, "density_profile": density_profile,
             "contact_network": contact_network, "contact_rose": rose}
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
