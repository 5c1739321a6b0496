"""Draws figures of runs, studies and probes for papers and slides, and writes the plotted data.
For a run: field of a frame, forces, stress ratio, energies, local densities, contact network, cracks and fragments;
for a lever: mesh and curves; for a study: its charts; for a probe: yield surfaces. `pulvis figure` runs this module.

All figures go into FOLDER/pictures/ (or the folder given by -o), except those of which nothing was recorded. With
--series, or with -o FILE and --field, one figure is drawn; FILE.csv holds its data in SI units. With --format gsf, raster
images are written as Gwyddion Simple Fields, one per file; with --format xyz, the particles of all frames for OVITO.
Exit codes: 2 if the requested data does not exist, 4 if the machine lacks a required program.
"""
import argparse
import re
import sys
from dataclasses import replace
from pathlib import Path

from matplotlib import pyplot as plt

from pulvis.errors import PulvisError
from pulvis.figures.afm import AFM_FIGURES, LEVELS, simple_fields
from pulvis.figures.animation import NoEncoder, animate, writer_for
from pulvis.figures.bonds import breaking, cracks, fragment_sizes
from pulvis.figures.colours import colour_map
from pulvis.figures.curves import chosen_series, energies, forces, friction, stress_ratio
from pulvis.figures.densities import density_profile, local_density
from pulvis.figures.fields import DEFAULT_FIELD, field_picture
from pulvis.figures.look import NotDrawn, Options, write_csv
from pulvis.figures.network import contact_network, rose
from pulvis.figures.pressing import compaction_curve, heckel, radial_ratio
from pulvis.figures.probe import figures_of_probe
from pulvis.figures.quantities import inches, length
from pulvis.figures.space import asked_place, section_picture, space_network, space_picture, space_profile
from pulvis.figures.space_bonds import space_cracks
from pulvis.figures.space_density import density_slice
from pulvis.figures.study import figures_of_study
from pulvis.results import Run

FORMATS = {".png", ".svg", ".pdf", ".csv", ".xyz"}
PRESSING = {"compaction_curve": compaction_curve, "heckel": heckel, "radial_ratio": radial_ratio}  # in a die
PLANE_FIGURES = {"force": forces, "stress_ratio": stress_ratio, **PRESSING, "friction": friction, "energies": energies,
                 "local_density": local_density, "density_profile": density_profile,
                 "contact_network": contact_network, "contact_rose": rose, "cracks": cracks,
                 "breaking": breaking, "fragment_sizes": fragment_sizes}
SPACE_FIGURES = {"section": section_picture, "local_density": density_slice, "density_profile": space_profile,
                 "contact_network": space_network, "force": forces, "stress_ratio": stress_ratio, **PRESSING, "energies": energies,
                 "cracks": space_cracks, "breaking": breaking, "fragment_sizes": fragment_sizes}
NAMED_FIGURES = {"plane": PLANE_FIGURES, "space": SPACE_FIGURES, "lever": AFM_FIGURES}  # of a run, besides its fields
GROUPS = {"probe": (figures_of_probe, lambda folder: (folder / "probe.toml").exists()),
          "study": (figures_of_study, lambda folder: (folder / "curves.json").exists() and not (folder / "run.h5").exists())}
OF_A_FIELD = (field_picture, space_picture, section_picture)
LIKE_EVERY_FIGURE = {"limits": None}  # colour limits apply to a single field
DENSITY = "local_density"  # drawn like a field if asked for


def printable(text):
    """Escapes control characters, which the terminal would interpret."""
    return "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in str(text))


def write(figure, path, options):
    """figure: a Figure, bytes, or a function that writes the file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(figure, bytes):
        path.write_bytes(figure)
    elif callable(figure):
        figure(path)
    elif path.suffix == ".csv":
        write_csv(path, figure.table)
    else:
        figure.savefig(path, dpi=options.dpi)
        plt.close(figure)


class Place:
    """Output folder. `pulvis figure` moves its files into place, since it knows which old files it may replace."""

    def __init__(self, asked, options):
        self.draw_into, self.options = asked.draw_into, options

    def save(self, figure, path):
        if self.draw_into:
            number = len(list(self.draw_into.iterdir()))
            write(figure, self.draw_into / f"{number:06}{path.suffix}", self.options)
            with open(self.draw_into / "list", "a", encoding="utf-8", errors="surrogateescape") as file:
                file.write(f"{number:06}{path.suffix} {path}\n")
            return
        if path.exists() or path.is_symlink():
            raise PulvisError(f"{path} already exists; pulvis figure only replaces files it has drawn itself")
        write(figure, path, self.options)
        print(printable(path))


def save_images(run, asked, options, place):
    if "images" not in run.file:
        raise PulvisError(f"{asked.folder} has no images; gsf is for rasters of a lever")
    for name, image in simple_fields(run, options.level):
        place.save(image, asked.to / f"{name}.gsf")


def save_particles(run, asked, options, place):
    """All frames, or the one asked for, in one file."""
    if options.series or options.field or asked.animate:
        raise PulvisError("xyz is a table of particles: use it without --series, --field and --animate")
    path = asked.output if asked.output and asked.output.suffix == ".xyz" else asked.to / "particles.xyz"
    place.save(lambda file: run.write_xyz(file, options.frame), path)


def kind_of(run):
    """Which of NAMED_FIGURES a run has."""
    return "lever" if run.is_solid else "space" if run.in_space else "plane"


def picture_for(run, field=None):
    """The function that draws a field."""
    if field == DENSITY:
        return NAMED_FIGURES[kind_of(run)][DENSITY]
    return space_picture if run.in_space else field_picture


def save_all(run, asked, options, place):
    field = (options.field or DEFAULT_FIELD).replace(":", "_")
    names = {**({} if run.is_solid else {field: picture_for(run, options.field)}), **NAMED_FIGURES[kind_of(run)]}
    of_a_field = (*OF_A_FIELD, *([names[DENSITY]] if DENSITY in names and (options.field == DENSITY or options.own_range) else []))
    drawn = 0
    for name, draw in names.items():
        path = asked.to / f"{name}.{asked.format}"
        try:
            figure = draw(run, options if draw in of_a_field else replace(options, **LIKE_EVERY_FIGURE))
        except NotDrawn as reason:
            print(f"figures: no {path.name}: {reason}")
            continue
        if figure is not None and (path.suffix != ".csv" or hasattr(figure, "table")):
            place.save(figure, path)
            drawn += 1
    if not drawn:
        print("figures: nothing recorded of what they show")


def save_group(figures, what, asked, options, place):
    """Figures of a probe or a study."""
    if options.series or options.field or asked.animate or asked.across or asked.at or options.level != "none" \
            or asked.format in ("csv", "gsf", "xyz"):
        raise PulvisError(f"a {what} has its own figures: use it without --series, --field, --across, --at, --animate, --level and csv")
    for name, figure in figures(asked.folder, options):
        path = asked.to / f"{name}.{asked.format}"
        if figure is None:
            print(f"figures: no run has the data shown in {path.name}")
        else:
            place.save(figure, path)


def save_run(run, asked, options, place):
    file = asked.output if asked.output and asked.output.suffix in FORMATS else None
    if not run.in_space and (asked.across or asked.at):
        raise PulvisError("--across and --at are for sections, which only 3D runs have")
    if (asked.across or asked.at) and (options.series or asked.animate):
        raise PulvisError("--across and --at are for sections: use them without --series and --animate")
    if asked.at and run.frames:
        asked_place(run, run.frame(options.frame), options)
    if options.level != "none" and "images" not in run.file:
        raise PulvisError(f"--level is for raster images, and {asked.folder} has none")
    if options.series and options.field:
        raise PulvisError("--field draws a field, --series curves: give one of them")
    if asked.format == "xyz" or (file and file.suffix == ".xyz"):
        save_particles(run, asked, options, place)
        return
    if asked.animate:
        if options.series or file or asked.output:
            raise PulvisError("--animate names its output file: use it without --series and -o")
        if options.own_range:
            raise PulvisError("--range frame is for density maps: a film has one colour range", key="--range")
        writer_for(asked.animate)
        place.save(lambda path: animate(run, path, options), asked.animate)
        return
    if asked.format == "gsf":
        if options.series or options.field or file:
            raise PulvisError("gsf is an image format: use it without --series, --field and an output file")
        save_images(run, asked, options, place)
        return
    if not options.series and not file:
        save_all(run, asked, options, place)
        return
    if run.is_solid and not options.series:
        raise PulvisError("a single figure of a lever shows one of its series: give --series")
    is_section = (asked.across or asked.at) and options.field != DENSITY
    draw_field = section_picture if is_section else picture_for(run, options.field)
    figure = chosen_series(run, options) if options.series else draw_field(run, options)
    if figure is None:
        raise PulvisError(f"no frame with {options.field or DEFAULT_FIELD}")
    place.save(figure, file or Path(f"{'-'.join(options.series).replace('/', '_')}.{asked.format}"))


def resolution(text):
    value = float(text) if re.fullmatch(r"\d+(\.\d*)?", text) else float("nan")
    if not 20 <= value <= 2400:
        raise PulvisError(f"--dpi {text}: allowed: 20 to 2400 dots per inch", key="--dpi")
    return value


def arguments(words=None):
    parser = argparse.ArgumentParser(prog="pulvis figure", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--frame", type=int, help="frame number, starting at 0 (default: the last frame)")
    parser.add_argument("--field",
                        help=f"field of cells or particles (default: {DEFAULT_FIELD}); NAME:k for component k")
    parser.add_argument("--series", action="append", default=[], help="series of the history to draw")
    parser.add_argument("--against", help="series on the horizontal axis (default: time)")
    parser.add_argument("--format", choices=["png", "svg", "pdf", "csv", "gsf", "xyz"], default="png")
    parser.add_argument("--level", choices=LEVELS, default="none", help="levelling of raster images")
    parser.add_argument("--width", help="width of every figure, e.g. 85mm")
    parser.add_argument("--height", help="height of every figure, e.g. 60mm")
    parser.add_argument("--no-title", action="store_true")
    parser.add_argument("--cmap", help="colour map for continuous values: a name of matplotlib")
    parser.add_argument("--range", help="colour range of the field as LOW:HIGH, e.g. 0:400MPa; frame: of each density map its own")
    parser.add_argument("--dpi", default="200")
    parser.add_argument("--across", choices=["x", "y", "z"], help="3D only: axis normal to sections and density maps (default: y)")
    parser.add_argument("--at", help="position along that axis, e.g. 2mm (default: near the middle)")
    parser.add_argument("--animate", type=Path, help="animate all frames of the field, or of a lever; .mp4 or .gif file")
    parser.add_argument("-o", "--output", type=Path, help="output file, or a folder for all figures")
    parser.add_argument("--draw-into", type=Path, help=argparse.SUPPRESS)
    asked = parser.parse_args(words)
    if asked.against and not asked.series:
        parser.error("--against gives the horizontal axis of --series")
    if asked.frame is not None and asked.frame < 0:
        parser.error(f"--frame {asked.frame}: allowed: from 0")
    if asked.output and asked.output.suffix not in ("", *FORMATS) and (asked.field or asked.series) and not asked.output.is_dir():
        parser.error(f"-o {asked.output}: allowed: {', '.join(sorted(FORMATS))}, or a folder for all figures")
    asked.to = asked.output or asked.folder / "pictures"
    return asked


def options_of(asked):
    options = Options(across=asked.across or "y", at=length("--at", asked.at), frame=asked.frame, field=asked.field, series=asked.series, against=asked.against, level=asked.level,
                      width=inches("--width", asked.width), height=inches("--height", asked.height),
                      title=not asked.no_title, cmap=asked.cmap, limits=asked.range, dpi=resolution(asked.dpi),
                      vector=(asked.output.suffix if asked.output and asked.output.suffix in FORMATS else f".{asked.format}")
                      in (".svg", ".pdf"))
    colour_map(options)  # rejects an unknown colormap before anything is drawn
    return options


def draw(asked):
    options = options_of(asked)
    place = Place(asked, options)
    with plt.rc_context(options.style()):
        try:
            what = next((name for name, (_, is_here) in GROUPS.items() if is_here(asked.folder)), None)
            if what:
                save_group(GROUPS[what][0], what, asked, options, place)
            else:
                save_run(Run(asked.folder), asked, options, place)
        except (OSError, ValueError, KeyError) as error:
            raise PulvisError(f"{asked.folder}: {error}") from error


def main(words=None):
    try:
        draw(arguments(words))
    except PulvisError as error:
        print(f"figures: {printable(error)}", file=sys.stderr)
        return 4 if isinstance(error, NoEncoder) else 2
    return 0
