"""Pictures of a run, those of `pulvis figure`: run.plot.forces(), run.plot.field("effective_stress", frame=-1) ...

Each returns (Figure, Axes). Each takes `ax`, axes of your own to draw into, and what `pulvis figure` takes:

    width, height   "85mm", "3.3 in", or a number of inches
    title           False: none
    cmap            a colour map of matplotlib
    limits          ends of the colours: "0:400 MPa", ("0 MPa", None), or numbers in SI
    dpi             dots per inch
"""

from __future__ import annotations

import base64
import html
import io
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import pyplot as plt

from pulvis.errors import RunError
from pulvis.figures import afm, bonds, curves, densities, fields, network, space, space_density
from pulvis.figures.animation import animate
from pulvis.figures.look import Options
from pulvis.figures.names import capital, name_of
from pulvis.figures.quantities import inches, with_unit

if TYPE_CHECKING:
    import os

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pulvis.results import Run

NEEDS = {"network": "output.contacts = true", "density": "output.density_cells", "forces": "tools",
         "cracks": "[[bond]]"}
DPI = 150


def options_of(given: dict[str, Any], **more: Any) -> Options:
    """Options of what was given by name."""
    known = {"width", "height", "title", "cmap", "limits", "dpi"}
    if wrong := set(given) - known:
        raise TypeError(f"unknown: {', '.join(sorted(wrong))}; allowed: {', '.join(sorted(known))}")
    sizes = {side: inches(side, given[side]) for side in ("width", "height") if side in given}
    values: dict[str, Any] = {"dpi": DPI, **given, **sizes, **more}
    return Options(**values)


class Plot:
    """Pictures of a run."""

    def __init__(self, run: Run) -> None:
        self._run = run

    def __repr__(self):
        return f"<pictures of {self._run!r}: {', '.join(name for name in dir(self) if not name.startswith('_'))}>"

    def _drawn(self, draw, what, options, ax=None, **more):
        with plt.rc_context(options.context(ax)):
            figure = draw(self._run, options, *(() if ax is None else (ax,)), **more)
        if figure is None:
            needs = f": the scene needs {NEEDS[what]}" if what in NEEDS else ""
            raise RunError(f"{self._run.folder}: nothing recorded of {what}{needs}", self._run.folder)
        return figure, ax if ax is not None else figure.axes[0]

    def forces(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Forces on the tools over time; those that pull down turned over, small ones left out."""
        return self._drawn(curves.forces, "forces", options_of(look), ax)

    def stress_ratio(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Axial and lateral stress over the yield stress, against the relative density."""
        return self._drawn(curves.stress_ratio, "stress over yield stress", options_of(look), ax)

    def energies(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """All energies over time: what the tools did, and where it went."""
        return self._drawn(curves.energies, "energies", options_of(look), ax)

    def series(self, *names: str, against: str = "time", ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Series of the history, of one unit, over time or another series."""
        return self._drawn(curves.chosen_series, "series", options_of(look, series=list(names), against=against), ax)

    def curve(self, x: str, y: str, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """One series against another, as curve("relative_density", "stress_ratio/axial")."""
        return self.series(y, against=x, ax=ax, **look)

    def field(self, name: str = fields.DEFAULT_FIELD, frame: int = -1, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """A field of elements or particles; "stress:2" is the second component. In three dimensions all particles from a
        corner."""
        draw = space.space_picture if self._run.in_space else fields.field_picture
        return self._drawn(draw, "frames", options_of(look, field=name, frame=frame), ax)

    def section(self, name: str = fields.DEFAULT_FIELD, frame: int = -1, across: str = "y", at: float | None = None,
                ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """In three dimensions: the elements that a plane across an axis cuts, near the middle or `at` a place (m)."""
        if across not in ("x", "y", "z"):
            raise RunError(f"across {across}: allowed: x, y, z", self._run.folder, key="across")
        draw = space.section_picture if self._run.in_space else lambda *_: None
        return self._drawn(draw, "sections, which only 3D runs have", options_of(look, field=name, frame=frame, across=across, at=at), ax)

    def network(self, frame: int = -1, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Normal forces of the contacts, and force chains."""
        draw = space.space_network if self._run.in_space else network.contact_network
        return self._drawn(draw, "network", options_of(look, frame=frame), ax)

    def rose(self, frame: int = -1, **look: Any) -> tuple[Figure, Axes]:
        """Directions of the contacts' normals, in two dimensions."""
        draw = (lambda *_: None) if self._run.in_space else network.rose
        return self._drawn(draw, "network in two dimensions" if self._run.in_space else "network", options_of(look, frame=frame))

    def density(self, frame: int | None = -1, across: str = "y", at: float | None = None, ax: Axes | None = None,
                **look: Any) -> tuple[Figure, Axes]:
        """Local densities of a frame; of several frames from the first to the last with frame=None. In three dimensions a layer
        of cells across an axis, in the middle or `at` a place (m)."""
        if not self._run.in_space:
            return self._drawn(densities.local_density, "density", options_of(look, frame=frame), ax)
        if across not in ("x", "y", "z"):
            raise RunError(f"across {across}: allowed: x, y, z", self._run.folder, key="across")
        return self._drawn(space_density.density_slice, "density", options_of(look, frame=frame, across=across, at=at), ax)

    def density_profile(self, frame: int | None = None, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Relative density along the height, at several times or in one frame."""
        draw = space.space_profile if self._run.in_space else densities.density_profile
        return self._drawn(draw, "density", options_of(look, frame=frame), ax)

    def cracks(self, frame: int = -1, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Fragments, bonds, and cracks by their mode."""
        return self._drawn(bonds.cracks, "cracks", options_of(look, frame=frame), ax)

    def fragment_sizes(self, frame: int = -1, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Sizes of the fragments."""
        return self._drawn(bonds.fragment_sizes, "cracks", options_of(look, frame=frame), ax)

    def animate(self, name: str, path: str | os.PathLike[str], ax: Axes | None = None, per_second: int | None = None,
                **look: Any) -> Any:
        """Writes all frames as .mp4 (needs ffmpeg) or .gif, `per_second` of them a second: 12, of levers 3.

        `name` is a field; of a lever "solid", its parts, or "plastic_strain", above the forces on its tip.
        Displacements of a lever that could not be seen are drawn larger; the title says how many times.
        """
        options = options_of(look, field=name)
        with plt.rc_context(options.context(ax)):
            return animate(self._run, path, options, ax, per_second)

    def solid(self, frame: int = -1, **look: Any) -> tuple[Figure, Axes]:
        """A lever: its solid in a frame."""
        return self._drawn(afm.solid, "frames", options_of(look, frame=frame))

    def force_curve(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """A lever: vertical force over the travel of the scanner, approach and retract apart."""
        return self._drawn(afm.force_curve, "force curves", options_of(look), ax)

    def friction_loop(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """A lever: lateral force, trace and retrace apart."""
        return self._drawn(afm.friction_loop, "friction loops", options_of(look), ax)

    def images(self, level: str = "none", **look: Any) -> tuple[Figure, Axes]:
        """A raster: all channels, trace and retrace. level: "none", "plane" or "lines"."""
        return self._drawn(afm.images, "images", options_of(look, level=level))


def facts_of(run: Run) -> list[tuple[str, str]]:
    """[(words, text)] of what a run came to."""
    mesh, facts = run.mesh, [("outcome", run.outcome)]
    if run.is_solid:
        facts += [(name_of(key).words, with_unit(run.calibration[key], "N/m")) for key in ("k_n", "k_l") if run.calibration]
        facts += [(name_of(f"loop/{key}").words, with_unit(loop.values[key], unit)) for loop in run.loops[:1]
                  for key, unit in (("half_width", "N"), ("friction", "")) if loop.values.get(key) is not None]
        facts += [(name_of("curve/pull_off").words, with_unit(curve.values["pull_off"], "N"))
                  for curve in run.force_curves[:1]]
    else:
        facts.append(("particles", f"{mesh.node_particle.max() + 1:,}"))
    facts.append(("elements", f"{len(mesh.cells):,}"))
    samples = run.series("time") if run.has("time") else np.empty(0)
    if len(samples) and not run.is_solid:
        facts.append(("simulated time", with_unit(samples[-1], "s")))
    for name in () if run.is_solid else ("relative_density", "stress_ratio/axial", "stress_ratio/lateral"):
        if run.has(name) and len(samples):
            facts.append((name_of(name).words, f"{run.series(name)[-1]:.4g}"))
    facts.append(("frames", str(len(run.frames))))
    if "wall_seconds" in run.summary:
        facts.append(("computed in", f"{run.summary['wall_seconds']:.3g} s"))
    if run.hash:
        facts.append(("hash of the final state", run.hash))
    return facts


def picture_of(run: Run) -> Figure | None:
    """The figure that shows a run best, or None."""
    plot = Plot(run)
    if not run.is_solid:
        makers = [lambda: plot.field(title=False, width=4.6), lambda: plot.forces(title=False, width=4.6)]
    else:
        makers = [] if not run.loops else [lambda: plot.friction_loop(title=False, width=4.6)]
        makers += [lambda: plot.force_curve(title=False, width=4.6), lambda: plot.solid(title=False, width=4.6)]
    for make in makers:
        try:
            return make()[0]
        except RunError:
            continue
    return None


def png_of(run: Run) -> bytes | None:
    """Bytes of its picture, for notebooks; None without any."""
    with plt.ioff():
        figure = picture_of(run)
    if figure is None:
        return None
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=110)
    plt.close(figure)
    return stream.getvalue()


def html_of(run: Run) -> str:
    """A small table and the picture, for notebooks."""
    rows = "".join(f"<tr><th style='text-align:left'>{html.escape(capital(words))}</th><td style='text-align:left'>"
                   f"{html.escape(text)}</td></tr>" for words, text in facts_of(run))
    png = png_of(run)
    picture = f"<img alt='Picture of the run' src='data:image/png;base64,{base64.b64encode(png).decode()}'>" if png else ""
    return (f"<div><b>{html.escape(str(run.title))}</b> <code>{html.escape(str(run.folder))}</code>"
            f"<div style='display:flex;gap:1em;align-items:flex-start;flex-wrap:wrap'><table>{rows}</table>{picture}</div></div>")
