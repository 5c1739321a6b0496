"""Animations of a powder field or a lever over all frames of a run, as MP4 or GIF."""
import shutil
from pathlib import Path

import numpy as np
from matplotlib import animation

from pulvis.errors import PulvisError
from pulvis.figures.bonds import BOND_FIELDS, draw_bonds
from pulvis.figures.cell import Cell
from pulvis.figures.colours import colours_of
from pulvis.figures.fields import DEFAULT_FIELD, field_of, paint
from pulvis.figures.lever_film import lever_film
from pulvis.figures.look import Options, close_up, shape_of, sheet
from pulvis.figures.room import Still, has_room
from pulvis.figures.space import space_film

SUFFIXES = (".mp4", ".gif")
PER_SECOND = 12
PER_SECOND_OF_LEVERS = 3  # they have about a dozen frames
MOST_DPI = 150  # of an animation: no more pixels than a screen has


class NoEncoder(PulvisError):
    """No video encoder is installed."""


def writer_for(path, per_second=PER_SECOND):
    if path.suffix == ".gif":
        return animation.PillowWriter(fps=per_second)
    if path.suffix != ".mp4":
        raise PulvisError(f"--animate {path}: allowed: a .mp4 or .gif file", key="--animate")
    if not shutil.which("ffmpeg"):
        raise NoEncoder(f"--animate {path}: MP4 needs the program ffmpeg (Debian: apt install ffmpeg); a GIF does not",
                        key="--animate")
    even = ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white"]  # the encoder accepts only even numbers of pixels
    return animation.FFMpegWriter(fps=per_second, codec="libx264",
                                  extra_args=["-pix_fmt", "yuv420p", "-crf", "18", *even])


def film(run, options=None, into=None):
    """(figure, axes, function that draws frame k with its colour bar or legend: clearing removes those, too)."""
    options = options or Options()
    if not run.frames:
        raise PulvisError("--animate: this run has no frames")
    if run.is_solid:
        return lever_film(run, options, into)
    if run.in_space:
        return space_film(run, options, into)
    key = options.field or DEFAULT_FIELD
    fields = [field_of(run, frame, key) for frame in run.frames]
    colours = colours_of(fields[0], np.concatenate([field.values for field in fields]), options)
    ends = np.array([1e3 * Cell(run, frame).limits() for frame in run.frames])
    limits = np.array([ends[:, 0].min(axis=0), ends[:, 1].max(axis=0)])
    size, beside = shape_of(limits)
    figure, axes = sheet(options, size, into, beside)

    def show(k):
        axes.clear()
        cell = paint(run, axes, run.frames[k], fields[k], colours, options, limits)
        if fields[k].name in BOND_FIELDS:
            draw_bonds(run, None, axes, run.frames[k], cell)
        colours.key(figure, axes)
        return []

    show(0)
    close_up(figure, options, into)
    return figure, axes, show


def animate(run, path, options=None, axes=None, per_second=None):
    """Writes the animation; returns (figure, axes) of its last frame."""
    options, path = options or Options(), Path(path)
    writer = writer_for(path, per_second or (PER_SECOND_OF_LEVERS if run.is_solid else PER_SECOND))
    figure, axes, show = film(run, options, axes)
    figure.canvas.draw()
    figure.set_layout_engine(Still() if has_room(figure) else "none")  # laid out once, so that nothing shifts between frames
    with writer.saving(figure, str(path), min(options.dpi, MOST_DPI)):
        for k in range(len(run.frames)):
            show(k)
            writer.grab_frame()
    return figure, axes
