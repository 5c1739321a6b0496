#!/usr/bin/python3
"""Figures of a run for papers and slides, and their numbers: the field of a frame, forces, stress ratio,
energies, local densities, the contact network, cracks and fragments; of a lever the solid and its curves.
`pulvis figure` runs it.

usage: figures.py RUN_FOLDER [--frame N] [--field NAME] [--series NAME]... [--against NAME]
                  [--format png|svg|pdf|csv|gsf] [--level none|plane|lines] [-o FILE_OR_FOLDER]

Reads RUN_FOLDER/run.h5 (complete frames only) and summary.json where there is one. All figures go into
RUN_FOLDER/pictures/ (or the folder of -o); what a run has not recorded is left out, with a line that says
so. With --series, or with -o FILE and --field, one figure is drawn; FILE.csv holds its numbers in SI. With
--format gsf the images of a raster are written as Gwyddion Simple Fields, one a file.
Needs python3-h5py, python3-numpy and python3-matplotlib. Exit codes: 2 for what is not there, 4 for a machine
that lacks something.
"""
import argparse
import sys
from pathlib import Path

try:
    import matplotlib
    import numpy as np

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection, PolyCollection

    from figures_afm import AFM_FIGURES, LEVELS, simple_fields
    from figures_bonds import BOND_FIELDS, breaking, cracks, draw_bonds, fragment_colours, fragment_sizes
    from figures_cell import Cell
    from figures_observed import contact_network, density_profile, local_density, rose
    from figures_probe import figures_of_probe
    from figures_parts import (STYLE, Run, draw_lines, draw_tools, labelled, outlines, printable, refuse, unit_for,
                               write_csv)
except ImportError as error:
    print(f"figures: {error}; needed: python3-h5py, python3-numpy, python3-matplotlib", file=sys.stderr)
    sys.exit(4)

DEFAULT_FIELD = "effective_stress"
FIELD_COLOURS = matplotlib.colormaps["viridis"].with_extremes(bad="#d5dbe2")  # what has no value is grey
FORMATS = {".png", ".svg", ".pdf", ".csv"}


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


def cell_field(run, frame, name):
    """(values, unit) of a field of cells or particles, for every cell: NAME, or NAME:k for a component of several."""
    name, _, component = name.partition(":")
    fields = [f for f in frame if frame[f].attrs.get("place") in ("cell", "particle")]
    if name not in fields:
        raise KeyError(f"no field {name} of cells or particles; there are: {', '.join(fields) or 'none'}")
    data = frame[name]
    count = int(data.attrs["components"])
    if data.ndim > 1 and not (component.isdigit() and 1 <= int(component) <= count):
        raise KeyError(f"{name} has {count} components: say {name}:1 to {name}:{count}")
    values = data[()] if data.ndim == 1 else data[:, int(component) - 1]
    if data.attrs["place"] == "particle":
        values = values[run.file["mesh/cell_particle"][()]]
    return values, data.attrs["unit"]


def field_picture(run, options):
    if not run.frames:
        return None
    name = options.field or DEFAULT_FIELD
    frame = run.frame(options.frame)
    try:
        values, unit = cell_field(run, frame, name)
    except KeyError as error:
        if options.field:  # asked for by name
            refuse(error.args[0])
        return None
    return draw_field(run, frame, name, values, unit)


def draw_field(run, frame, name, values, unit):
    cell = Cell(run, frame)
    position, limits = cell.position, 1e3 * cell.limits()
    quads, (factor, shown) = run.file["mesh/quads"][()], unit_for(unit, values)
    shape = np.ptp(limits[:, 1]) / np.ptp(limits[:, 0])
    figure, axes = plt.subplots(figsize=(7.2, min(max(6.0 * shape, 2.4), 9.0) + 0.9),
                                constrained_layout=True)
    faces = PolyCollection(1e3 * position[quads], edgecolors="face", linewidths=0.1)
    if name == "fragment":
        faces.set_facecolor(fragment_colours(values))
    else:
        faces.set(array=np.ma.masked_invalid(factor * values), cmap=FIELD_COLOURS)
    axes.add_collection(faces)
    edges = outlines(quads)
    axes.add_collection(LineCollection(1e3 * position[edges], colors="#1d2733", linewidths=0.4))
    faces.update_scalarmappable()  # colours for the images, too
    cell.draw(axes, faces.get_facecolor(), edges)
    draw_tools(run, axes, frame.attrs["time"], limits / 1e3)
    axes.set(xlim=limits[:, 0], ylim=limits[:, 1], aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    axes.grid(False)
    time_factor, time_unit = unit_for("s", np.array([frame.attrs["time"]]))
    label = name.replace("_", " ").replace(":", " ")
    axes.set_title(f"{label.capitalize()} at {time_factor * frame.attrs['time']:.4g} {time_unit}\n"
                   f"{run.title}", loc="left")
    if name in BOND_FIELDS:
        draw_bonds(run, figure, axes, frame, cell)
    if name != "fragment":
        bar = figure.colorbar(faces, ax=axes, shrink=0.9, label=labelled(label, shown))
        bar.outline.set_visible(False)
    middle = position[quads].mean(axis=1)
    figure.table = [("x", "m", middle[:, 0]), ("y", "m", middle[:, 1]), (name, unit, values)]
    return figure


def chosen_series(run, options):
    """The series that were asked for by name, over another one or over time."""
    against = options.against or "time"
    for name in [*options.series, against]:
        if name not in run.series:
            refuse(f"no series {name}; there are: {', '.join(sorted(run.series))}")
    units = {run.series[name].attrs["unit"] for name in options.series}
    if len(units) > 1:
        refuse(f"series of different units in one figure: {', '.join(sorted(units))}")
    lines = [(name, run.values(name), run.series[name].attrs["unit"]) for name in options.series]
    label = options.series[0] if len(lines) == 1 else "value"
    return draw_lines(run, (against, run.values(against), run.series[against].attrs["unit"]), lines, label,
                      ", ".join(options.series))


PLANE_FIGURES = {"force": force, "stress_ratio": stress_ratio, "energies": energies,
                 "local_density": local_density, "density_profile": density_profile,
                 "contact_network": contact_network, "contact_rose": rose, "cracks": cracks,
                 "breaking": breaking, "fragment_sizes": fragment_sizes}


def drawn(figure, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(figure, bytes):
        path.write_bytes(figure)
        return
    if path.suffix == ".csv":
        write_csv(path, figure.table)
    else:
        figure.savefig(path)
    plt.close(figure)


def save(figure, path, options):
    """`pulvis figure` puts what is in its folder into place: it knows which old files it may replace."""
    if options.draw_into:
        number = len(list(options.draw_into.iterdir()))
        drawn(figure, options.draw_into / f"{number:06}{path.suffix}")
        with open(options.draw_into / "list", "a", encoding="utf-8", errors="surrogateescape") as file:
            file.write(f"{number:06}{path.suffix} {path}\n")
        return
    if path.exists() or path.is_symlink():
        refuse(f"{printable(path)} is there already; pulvis figure replaces what it drew itself")
    drawn(figure, path)
    print(printable(path))


def save_fields(run, options):
    if "images" not in run.file:
        refuse(f"{options.run_folder} has no images; gsf is for rasters of a lever")
    for name, field in simple_fields(run, options.level):
        save(field, (options.output or options.run_folder / "pictures") / f"{name}.gsf", options)


def save_all(run, options):
    folder = options.output or options.run_folder / "pictures"
    names = AFM_FIGURES if run.is_solid else {
        (options.field or DEFAULT_FIELD).replace(":", "_"): field_picture, **PLANE_FIGURES}
    for name, draw in names.items():
        figure = draw(run, options)
        path = folder / f"{name}.{options.format}"
        if figure is None or path.suffix == ".csv" and not hasattr(figure, "table"):
            print(f"figures: nothing recorded for {path.name}")
        else:
            save(figure, path, options)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run_folder", type=Path)
    parser.add_argument("--frame", type=int, help="number of a frame, from 0; the last if not said")
    parser.add_argument("--field",
                        help=f"field of cells or particles, {DEFAULT_FIELD} if not said; NAME:k for component k")
    parser.add_argument("--series", action="append", default=[], help="series of the history to draw")
    parser.add_argument("--against", help="series of the other axis, time if not said")
    parser.add_argument("--format", choices=["png", "svg", "pdf", "csv", "gsf"], default="png")
    parser.add_argument("--level", choices=LEVELS, default="none", help="levelling of a raster's images")
    parser.add_argument("-o", "--output", type=Path, help="a file, or a folder for all figures")
    parser.add_argument("--draw-into", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.against and not options.series:
        parser.error("--against says over what --series is drawn")
    return options


def save_probe(options):
    if options.series or options.field or options.format in ("csv", "gsf"):
        refuse("a probe has its own figures: without --series, --field and csv")
    plt.rcParams.update(STYLE)
    folder = options.output or options.run_folder / "pictures"
    try:
        figures = figures_of_probe(options.run_folder)
    except (OSError, ValueError, KeyError) as error:
        refuse(f"{options.run_folder}: {error}")
    for name, figure in figures:
        save(figure, folder / f"{name}.{options.format}", options)


def main():
    options = arguments()
    if (options.run_folder / "probe.toml").exists():
        save_probe(options)
        return
    try:
        run = Run(options.run_folder)
    except (OSError, ValueError, KeyError) as error:
        refuse(f"{options.run_folder}: {error}")
    plt.rcParams.update(STYLE)
    file = options.output if options.output and options.output.suffix in FORMATS else None
    if options.format == "gsf":
        if options.series or options.field or file:
            refuse("gsf is a format of images: without --series, --field and a file")
        save_fields(run, options)
        return
    if not options.series and not file:
        save_all(run, options)
        return
    if run.is_solid and not options.series:
        refuse("one figure of a lever is one of its series: say --series")
    figure = chosen_series(run, options) if options.series else field_picture(run, options)
    if figure is None:
        refuse(f"no frame with {options.field or DEFAULT_FIELD}")
    save(figure, file or Path(f"{'-'.join(options.series).replace('/', '_')}.{options.format}"), options)


if __name__ == "__main__":
    main()
