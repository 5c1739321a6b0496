"""Figures of powders pressed in a die: compaction curve, Heckel plot, radial over axial stress.

Sources: Heckel (1961), ln[1/(1 - D)] = K P + A, D the relative density, P the pressure of the top punch; fitted by the program
(scenes/results/density_fits.hpp), whose parameters are in summary.json.
"""
import numpy as np

from pulvis.figures.hidden import dash_hidden
from pulvis.figures.look import Options, draw_lines, sheet
from pulvis.figures.names import label
from pulvis.figures.quantities import unit_for, with_unit
from pulvis.figures.room import legend_within

PUNCHES = {"top": "stress/axial_top", "bottom": "stress/axial_bottom"}
LEAST_SHARE = 0.01  # of the largest pressure: below, a punch is hardly in contact
WALLS = ("radial", "radial_left", "radial_right", "radial_front", "radial_back")


def density_of(run):
    """The relative density, or None if the run has no die with an axial stress."""
    return run.series("relative_density") if run.has("relative_density") and run.has(PUNCHES["top"]) else None


def while_pressed(density, pressure):
    """Samples up to the largest density that bear at least a hundredth of the largest pressure, as the fitted laws have them."""
    finite = np.isfinite(density) & np.isfinite(pressure)
    if not finite.any():
        return np.zeros(len(density), bool)
    before = np.arange(len(density)) <= np.argmax(np.where(finite, density, -np.inf))
    most = pressure[finite & before].max()
    return finite & before & (pressure > 0) & (pressure >= LEAST_SHARE * most)


def until_unloaded(density, pressure):
    """Samples up to the one at which the top punch no longer bears after the largest density: what follows is ejection."""
    finite = np.isfinite(density) & np.isfinite(pressure)
    if not finite.any():
        return finite
    peak = np.argmax(np.where(finite, density, -np.inf))
    free = np.flatnonzero(pressure[peak:] <= 1e-3 * pressure[finite].max())
    return finite & (np.arange(len(density)) <= (peak + free[0] if len(free) else len(density)))


def compaction_curve(run, options=None, axes=None):
    """Pressure of the punches against the relative density, with unloading."""
    density = density_of(run)
    if density is None:
        return None
    inside = until_unloaded(density, run.series(PUNCHES["top"]))
    lines = [(f"{punch} punch", run.series(name)[inside], "Pa") for punch, name in PUNCHES.items() if run.has(name)]
    if not inside.any() or not any(np.nanmax(values, initial=0) > 0 for _, values, _ in lines):
        return None
    return draw_lines(run, ("relative_density", density[inside], "-"), lines, ("pressure of the punch", "P"), "Compaction curve",
                      options, axes)


def heckel_law(run):
    """{parameter: value} of the line that the program has fitted, and its r²; None if there is none."""
    laws = (run.summary.get("fits") or {}).get("laws", [])
    law = next((one for one in laws if one["law"] == "heckel" and "parameters" in one), None)
    return law and {**{one["name"]: one["value"] for one in law["parameters"]}, "r_squared": law.get("r_squared")}


def told(law):
    """The fitted line in a legend."""
    fit = f", $r^2$ = {law['r_squared']:.3f}" if law["r_squared"] is not None else ""
    return f"line: $1/K$ = {with_unit(1 / law['K'], 'Pa')}, $A$ = {law['A']:.3g}{fit}"


def heckel(run, options=None, axes=None):
    """ln[1/(1 - D)] against the pressure of the top punch while the powder is pressed, with the line of summary.json."""
    options, density = options or Options(), density_of(run)
    if density is None:
        return None
    pressure = run.series(PUNCHES["top"])
    used = while_pressed(density, pressure) & (density < 1)
    if used.sum() < 2:
        return None
    pressure, density = pressure[used], density[used]
    ordinate = -np.log(1 - density)
    factor, unit = unit_for("Pa", pressure)
    figure, axes = sheet(options, (6.4, 4.2), axes)
    drawn = axes.plot(factor * pressure, ordinate, label="run")
    figure.table = [("pressure", "Pa", pressure), ("relative density", "-", density), ("ln 1/(1 - D)", "-", ordinate)]
    law = heckel_law(run)
    if law:
        line = law["K"] * pressure + law["A"]
        ends = [pressure.argmin(), pressure.argmax()]
        drawn += axes.plot(factor * pressure[ends], line[ends], linewidth=1.2, label=told(law))
        figure.table.append(("fitted line", "-", line))
    dash_hidden(axes, drawn)
    axes.set_xlabel(label(("pressure of the top punch", "P"), unit))
    axes.set_ylabel(r"$\ln[1/(1 - \rho)]$")
    options.head(axes, "Heckel plot", run)
    if law:
        legend_within(axes, options, 0.7)
    return figure


def radial_ratio(run, options=None, axes=None):
    """Radial over axial stress against the relative density while the powder is pressed: the mean of the walls over that of the
    punches."""
    density = density_of(run)
    walls = [run.series(f"stress/{wall}") for wall in WALLS if run.has(f"stress/{wall}")]
    if density is None or not walls:
        return None
    axial = np.mean([run.series(name) for name in PUNCHES.values() if run.has(name)], axis=0)
    used = while_pressed(density, axial)
    if used.sum() < 2:
        return None
    is_round = run.has("stress/radial")
    words, symbol = ("radial", "rad") if is_round else ("lateral", "lat")
    ratio = np.mean(walls, axis=0)[used] / axial[used]
    ylabel = f"{words} over axial stress", rf"\sigma_\mathrm{{{symbol}}}/\sigma_\mathrm{{ax}}"
    return draw_lines(run, ("relative_density", density[used], "-"), [(f"{words} over axial stress", ratio, "-")], ylabel,
                      f"{words.capitalize()} over axial stress", options, axes)
