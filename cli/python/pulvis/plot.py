"""Figures of a run, the same as from `pulvis figure`: run.plot.forces(), run.plot.field("effective_stress", frame=-1) ...

Each returns (Figure, Axes). Each accepts `ax`, existing axes to draw into, and the options of `pulvis figure`:

    width, height   "85mm", "3.3 in", or a number of inches
    title           False: no title
    cmap            a matplotlib colormap
    limits          limits of the colour scale: "0:400 MPa", ("0 MPa", None), or numbers in SI
    dpi             dots per inch
"""

from __future__ import annotations

import base64
import html
import io
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from pulvis.errors import RunError
from pulvis.figures import afm, bonds, curves, densities, fields, network, pressing, space, space_bonds, space_density
from pulvis.figures.animation import animate
from pulvis.figures.look import Options
from pulvis.figures.names import capital, name_of
from pulvis.figures.quantities import inches, length, with_unit

if TYPE_CHECKING:
    import os

    from matplotlib.figure import Figure

    from pulvis.results import Run

NEEDS = {"network": "output.contacts = true", "density": "output.density_cells", "forces": "tools",
         "cracks": "[[bond]]", "friction of a target": 'a stage of kind "shear"'}
DPI = 150


def options_of(given: dict[str, Any], at: float | str | None = None, **more: Any) -> Options:
    """Options from keyword arguments."""
    known = {"width", "height", "title", "cmap", "limits", "dpi"}
    if wrong := set(given) - known:
        raise TypeError(f"unknown: {', '.join(sorted(wrong))}; allowed: {', '.join(sorted(known))}")
    sizes = {side: inches(side, given[side]) for side in ("width", "height") if side in given}
    values: dict[str, Any] = {"dpi": DPI, **given, **sizes, "at": length("at", at), **more}
    return Options(**values)


class Plot:
    """Figures of a run."""

    def __init__(self, run: Run) -> None:
        self._run = run

    def __repr__(self):
        return f"<pictures of {self._run!r}: {', '.join(name for name in dir(self) if not name.startswith('_'))}>"

    def _own(self, ax):
        if ax is not None and not isinstance(ax, Axes):
            raise RunError(f"ax = {ax!r}: allowed: axes of matplotlib, or None for a new figure", self._run.folder, key="ax")
        return ax

    def _drawn(self, draw, what, options, ax=None, **more):
        self._own(ax)
        with plt.rc_context(options.context(ax)):
            figure = draw(self._run, options, *(() if ax is None else (ax,)), **more)
        if figure is None:
            needs = f": the scene needs {NEEDS[what]}" if what in NEEDS else ""
            raise RunError(f"{self._run.folder}: nothing recorded of {what}{needs}", self._run.folder)
        return figure, ax if ax is not None else figure.axes[0]

    def forces(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Forces on the tools over time; downward forces with reversed sign, small ones omitted."""
        return self._drawn(curves.forces, "forces", options_of(look), ax)

    def stress_ratio(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Axial and lateral stress, normalised by the yield stress, against relative density."""
        return self._drawn(curves.stress_ratio, "stress over yield stress", options_of(look), ax)

    def compaction_curve(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Pressure of the punches against relative density, with unloading; needs a die."""
        return self._drawn(pressing.compaction_curve, "a compaction in a die", options_of(look), ax)

    def heckel(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Heckel plot: ln[1/(1 - D)] against the pressure of the top punch, with the fitted line; needs a die."""
        return self._drawn(pressing.heckel, "a compaction in a die", options_of(look), ax)

    def radial_ratio(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Radial over axial stress against relative density while the powder is pressed; needs a die."""
        return self._drawn(pressing.radial_ratio, "a compaction in a die", options_of(look), ax)

    def friction(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Friction of the target over its distance, with the static and dynamic coefficients; needs a shear stage."""
        return self._drawn(curves.friction, "friction of a target", options_of(look), ax)

    def energies(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Energy balance over time: work of the tools or of the periodic cell, and all energy terms."""
        return self._drawn(curves.energies, "energies", options_of(look), ax)

    def series(self, *names: str, against: str = "time", ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """History series that share a unit, over time or against another series."""
        return self._drawn(curves.chosen_series, "series", options_of(look, series=list(names), against=against), ax)

    def curve(self, x: str, y: str, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """One series against another, for example curve("relative_density", "stress_ratio/axial")."""
        return self.series(y, against=x, ax=ax, **look)

    def field(self, name: str = fields.DEFAULT_FIELD, frame: int = -1, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """An element or particle field; "stress:2" is the second component. In three dimensions, a view of all particles
        from a corner."""
        draw = space.space_picture if self._run.in_space else fields.field_picture
        return self._drawn(draw, "frames", options_of(look, field=name, frame=frame), ax)

    def section(self, name: str = fields.DEFAULT_FIELD, frame: int = -1, across: str = "y", at: float | str | None = None,
                ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """3D only: the elements cut by a plane normal to an axis, near the middle or `at` a coordinate ("2mm", or m)."""
        if across not in ("x", "y", "z"):
            raise RunError(f"across {across}: allowed: x, y, z", self._run.folder, key="across")
        draw = space.section_picture if self._run.in_space else lambda *_: None
        return self._drawn(draw, "sections, which only 3D runs have", options_of(look, field=name, frame=frame, across=across, at=at), ax)

    def network(self, frame: int = -1, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Normal contact forces and force chains."""
        draw = space.space_network if self._run.in_space else network.contact_network
        return self._drawn(draw, "network", options_of(look, frame=frame), ax)

    def rose(self, frame: int = -1, **look: Any) -> tuple[Figure, Axes]:
        """Rose diagram of the contact normals; 2D only."""
        draw = (lambda *_: None) if self._run.in_space else network.rose
        return self._drawn(draw, "network in two dimensions" if self._run.in_space else "network", options_of(look, frame=frame))

    def density(self, frame: int | None = -1, across: str = "y", at: float | str | None = None,
                ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Local relative densities in a frame; frame=None shows several frames from first to last. In three dimensions, one
        layer of cells normal to an axis, in the middle or `at` a coordinate ("2mm", or m)."""
        if not self._run.in_space:
            return self._drawn(densities.local_density, "density", options_of(look, frame=frame), ax)
        if across not in ("x", "y", "z"):
            raise RunError(f"across {across}: allowed: x, y, z", self._run.folder, key="across")
        return self._drawn(space_density.density_slice, "density", options_of(look, frame=frame, across=across, at=at), ax)

    def density_profile(self, frame: int | None = None, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Relative density over the height, at several times or in one frame."""
        draw = space.space_profile if self._run.in_space else densities.density_profile
        return self._drawn(draw, "density", options_of(look, frame=frame), ax)

    def cracks(self, frame: int = -1, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Fragments, bonds, and cracks by mode. In three dimensions, bonds and cracks are dots in particles seen through."""
        draw = space_bonds.space_cracks if self._run.in_space else bonds.cracks
        return self._drawn(draw, "cracks", options_of(look, frame=frame), ax)

    def breaking(self, **look: Any) -> tuple[Figure, Axes]:
        """Crack length or area, bond energies and number of fragments over time, one above the other."""
        return self._drawn(bonds.breaking, "cracks", options_of(look))

    def fragment_sizes(self, frame: int = -1, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Fragment size distribution."""
        return self._drawn(bonds.fragment_sizes, "cracks", options_of(look, frame=frame), ax)

    def animate(self, name: str, path: str | os.PathLike[str], ax: Axes | None = None, per_second: int | None = None,
                **look: Any) -> Any:
        """Writes all frames as .mp4 (needs ffmpeg) or .gif at `per_second` frames per second; default 12, levers 3.

        `name` is a field; for a lever "solid" (its parts) or "plastic_strain", shown above the forces on its tip.
        Lever displacements too small to be seen are magnified; the title gives the factor.
        """
        options = options_of(look, field=name)
        with plt.rc_context(options.context(self._own(ax))):
            return animate(self._run, path, options, ax, per_second)

    def solid(self, frame: int = -1, **look: Any) -> tuple[Figure, Axes]:
        """Lever: its mesh in one frame."""
        return self._drawn(afm.solid, "frames of a lever", options_of(look, frame=frame))

    def force_curve(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Lever: vertical force against scanner travel, approach and retract as separate curves."""
        return self._drawn(afm.force_curve, "force curves", options_of(look), ax)

    def friction_loop(self, ax: Axes | None = None, **look: Any) -> tuple[Figure, Axes]:
        """Lever: lateral force, trace and retrace as separate curves."""
        return self._drawn(afm.friction_loop, "friction loops", options_of(look), ax)

    def images(self, level: str = "none", **look: Any) -> tuple[Figure, Axes]:
        """Raster scan: all channels, trace and retrace. level: "none", "plane" or "lines"."""
        return self._drawn(afm.images, "images", options_of(look, level=level))


def facts_of(run: Run) -> list[tuple[str, str]]:
    """[(label, text)]: the main results of a run."""
    mesh, facts = run.mesh, [("outcome", run.outcome)]
    if run.is_solid:
        facts += [(words, with_unit(run.calibration[key], "N/m")) for key, words in (("k_n", "normal stiffness"), ("k_l", "lateral stiffness"))
                  if run.calibration]
        facts += [(f"{words} of the loop", with_unit(loop.values[key], unit)) for loop in run.loops[:1]
                  for key, words, unit in (("half_width", "half-width", "N"), ("friction", "friction coefficient", "")) if loop.values.get(key) is not None]
        facts += [("pull-off force", with_unit(curve.values["pull_off"], "N"))
                  for curve in run.force_curves[:1]]
    else:
        facts.append(("particles", f"{mesh.node_particle.max() + 1:,}"))
    facts.append(("elements", f"{len(mesh.cells):,}"))
    samples = run.series("time") if run.has("time") else np.empty(0)
    if len(samples) and not run.is_solid:
        facts.append(("simulated time", with_unit(samples[-1], "s")))
    for name in () if run.is_solid else ("relative_density", "stress_ratio/axial", "stress_ratio/lateral"):
        if run.has(name) and len(samples):
            facts.append((name_of(name, run.labels).words, f"{run.series(name)[-1]:.4g}"))
    facts.append(("frames", str(len(run.frames))))
    if "wall_seconds" in run.summary:
        facts.append(("computed in", f"{run.summary['wall_seconds']:.3g} s"))
    if run.hash:
        facts.append(("hash of the final state", run.hash))
    return facts


def picture_of(run: Run) -> Figure | None:
    """The most informative figure of a run, or None."""
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
    """PNG bytes of that figure, for notebooks; None if there is none."""
    with plt.ioff():
        figure = picture_of(run)
    if figure is None:
        return None
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=110)
    plt.close(figure)
    return stream.getvalue()


def html_of(run: Run) -> str:
    """A small table and the figure, for notebooks."""
    rows = "".join(f"<tr><th style='text-align:left'>{html.escape(capital(words))}</th><td style='text-align:left'>"
                   f"{html.escape(text)}</td></tr>" for words, text in facts_of(run))
    png = png_of(run)
    picture = f"<img alt='Picture of the run' src='data:image/png;base64,{base64.b64encode(png).decode()}'>" if png else ""
    return (f"<div><b>{html.escape(str(run.title))}</b> <code>{html.escape(str(run.folder))}</code>"
            f"<div style='display:flex;gap:1em;align-items:flex-start;flex-wrap:wrap'><table>{rows}</table>{picture}</div></div>")
