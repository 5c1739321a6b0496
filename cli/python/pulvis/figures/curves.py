"""Curves of a run's history: forces, stress ratios, energies, and any series against any other."""
import re

import numpy as np

from pulvis.errors import PulvisError
from pulvis.figures.look import Options, draw_lines
from pulvis.figures.names import capital, joined, name_of
from pulvis.figures.room import legend_within


LEAST_LOAD = 0.05  # of the largest


def matching(run, pattern):
    """Series whose names match and that are not all zero: [(match, values, unit)]."""
    found = [(re.fullmatch(pattern, name), name) for name in sorted(run.names)]
    found = [(match, run.series(name), run.unit(name)) for match, name in found if match]
    return [one for one in found if one[1].size and np.nanmax(np.abs(one[1])) > 0]


def time_axis(run):
    return "time", run.series("time"), run.unit("time")


def forces(run, options=None, axes=None):
    found = matching(run, r"tool/(.+)/force_([xyz])")
    most = max((np.nanmax(np.abs(values)) for _, values, _ in found), default=0)
    lines = []
    for match, values, unit in found:
        if np.nanmax(np.abs(values)) < 0.01 * most:
            continue
        turned = -np.nanmin(values) > np.nanmax(values)
        name = f"{match[1]}, ${'-' if turned else ''}F_{match[2]}$"
        lines.append((name, -values if turned else values, unit))
    return draw_lines(run, time_axis(run), lines, ("force", "F"), "Forces on the tools", options, axes) if lines else None


def stress_ratio(run, options=None, axes=None):
    lines = [(joined(f"{match[1]} stress", name_of(match[0], run.labels).symbol), values, unit)
             for match, values, unit in matching(run, r"stress_ratio/(axial|lateral)")]
    if not lines:
        return None
    x = ("relative_density", run.series("relative_density"), "-") if run.has("relative_density") else time_axis(run)
    return draw_lines(run, x, lines, ("stress over yield stress", r"\sigma/\sigma_y"), "Stress over yield stress", options,
                      axes)


def friction(run, options=None, axes=None):
    """Friction of the target of a shear stage over its distance, with the static and dynamic coefficients."""
    if not run.has("shear/friction"):
        return None
    slides = run.series("shear/distance") != 0  # before that the powder is loaded
    if not np.any(np.isfinite(run.series("shear/friction")[slides])):
        return None
    distance, values = run.series("shear/distance")[slides], run.series("shear/friction")[slides]
    figure = draw_lines(run, ("shear/distance", distance, run.unit("shear/distance")),
                        [(r"measured $\mu$", values, run.unit("shear/friction"))], "shear/friction", "Friction of the target",
                        options, axes)
    axes = axes or figure.axes[0]
    for kind, colour, dashes in (("static", "#d55e00", "--"), ("dynamic", "#009e73", ":")):
        value = (run.summary.get("shear") or {}).get(f"{kind}_friction")
        if value is not None:
            axes.axhline(value, color=colour, linestyle=dashes, linewidth=1.2, label=f"{kind}: {value:.3g}")
    if len(axes.get_legend_handles_labels()[0]) > 1:
        legend_within(axes, options or Options())
    return figure


def energies(run, options=None, axes=None):
    lines = [(capital(name_of(match[0], run.labels).words.removesuffix(" energy")), values, unit)
             for match, values, unit in matching(run, r"energy/(.+)")]
    return draw_lines(run, time_axis(run), lines, ("energy", "E"), "Energies", options, axes) if lines else None


def drawn_values(run, name):
    """A series as it is drawn: the ratio of the forces on two punches says nothing while they hardly touch the powder."""
    values = run.series(name)
    if name != "stress/transmission" or not run.has("stress/axial_top"):
        return values
    load = run.series("stress/axial_top")
    return np.where(load > LEAST_LOAD * np.nanmax(load), values, np.nan)


def chosen_series(run, options=None, axes=None):
    """The series requested by name, against another one or over time."""
    options = options or Options()
    against = options.against or "time"
    for name in [*options.series, against]:
        run.dataset(name)  # raises if there is no such series
    units = {run.unit(name) for name in options.series}
    if len(units) > 1:
        raise PulvisError(f"series of different units in one figure: {', '.join(sorted(units))}")
    names = {name: name_of(name, run.labels) for name in options.series}
    lines = [(capital(joined(*name)), drawn_values(run, key), run.unit(key)) for key, name in names.items()]
    symbols = {name.symbol for name in names.values()}
    shared = symbols.pop() if len(symbols) == 1 else ""
    word = {"N": "force", "Pa": "stress", "m": "length", "J": "energy", "V": "signal"}.get(next(iter(units)), "value")
    ylabel = options.series[0] if len(lines) == 1 else (word, shared)
    title = ", ".join(dict.fromkeys(capital(name.words) for name in names.values()))
    figure = draw_lines(run, (against, run.series(against), run.unit(against)), lines, ylabel, title, options, axes)
    figure.table = [(name, run.unit(name), run.series(name)) for name in (against, *options.series)]
    return figure
