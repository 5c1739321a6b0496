"""Figures of a study: every chart of its report, one curve per variation, and its fitted laws.

The band of a variation with several seeds spans the smallest to the largest value; its bars are the standard deviation.
"""
import json
import re

import numpy as np
from matplotlib import pyplot as plt

from pulvis.figures.hidden import dash_hidden
from pulvis.figures.look import COLOURS as LINES, Options, sheet, unit_for, worded
from pulvis.figures.names import capital, name_of


def factor_of(unit, lines, key):
    """One unit for all curves of a chart."""
    return unit_for("" if unit == "-" else unit, np.concatenate([line[key] for line in lines]))


def draw(curve, title, options, axes=None):
    lines = [{key: np.array(value, float) if isinstance(value, list) else value
              for key, value in line.items()} for line in curve["lines"]]
    if not lines:
        return None
    x_factor, x_unit = factor_of(curve["x_unit"], lines, "x")
    factor, unit = factor_of(curve["y_unit"], lines, "y")
    figure, axes = sheet(options, (6.4, 4.2), axes)
    curves = []
    for k, line in enumerate(lines):
        style = {"color": LINES[k % len(LINES)], "linestyle": ("-", "--", ":")[k // len(LINES) % 3]}
        label = line["variation"] + (f" ({line['runs']} seeds)" if line["runs"] > 1 else "")
        drawn, = axes.plot(x_factor * line["x"], factor * line["y"], label=label, **style)
        curves.append(drawn)
        if "low" in line:
            axes.fill_between(x_factor * line["x"], factor * line["low"], factor * line["high"],
                              color=drawn.get_color(), alpha=0.2, linewidth=0)
        if "standard_deviation" in line:
            some = slice(len(line["x"]) // 24, None, max(1, len(line["x"]) // 12))
            axes.errorbar(x_factor * line["x"][some], factor * line["y"][some],
                          factor * line["standard_deviation"][some], color=drawn.get_color(), fmt="none",
                          capsize=2, linewidth=1)
    dash_hidden(axes, curves)
    axes.set_xlabel(worded(curve["x"], x_unit))
    axes.set_ylabel(worded(curve["y"], unit))
    options.head(axes, f"{titled(curve['title'])}\n{title}")
    axes.legend(fontsize="small")
    return figure


def value_of(group, name):
    return next(parameter["value"] for parameter in group["parameters"] if parameter["name"] == name)


def draw_weibull(axes, group, factor, label):
    strength = factor * np.array([point["strength"] for point in group["points"]])
    chance = np.array([point["failure_probability"] for point in group["points"]])
    marks, = axes.semilogx(strength, np.log(-np.log(1 - chance)), "o", markersize=4, label=label)
    ends = np.array([strength.min(), strength.max()])
    axes.plot(ends, value_of(group, "modulus") * np.log(ends / (factor * value_of(group, "scale"))),
              color=marks.get_color())


def draw_porosity(axes, group, factor, label):
    porosity = np.array([point["porosity"] for point in group["points"]])
    marks, = axes.plot(porosity, [factor * point["strength"] for point in group["points"]], "o", markersize=4,
                       label=label)
    along = np.linspace(porosity.min(), porosity.max(), 60)
    axes.plot(along, factor * value_of(group, "dense_strength") * np.exp(-value_of(group, "k") * along),
              color=marks.get_color())


def draw_power(axes, group, factor, label, key_factor):
    key = np.array([point["key"] for point in group["points"]])
    marks, = axes.plot(key_factor * key, [factor * point["value"] for point in group["points"]], "o", markersize=4,
                       label=label)
    along = np.geomspace(key.min(), key.max(), 60)
    law = value_of(group, "value") * (along / value_of(group, "at")) ** value_of(group, "exponent")
    axes.plot(key_factor * along, factor * law, color=marks.get_color())


def draw_powers(fit, groups, title, options):
    def scale(unit, name):
        return unit_for("" if unit == "-" else unit,
                        np.array([point[name] for group in groups for point in group["points"]]))
    factor, unit = scale(fit["unit"], "value")
    key_factor, key_unit = scale(fit["key_unit"], "key")
    figure, axes = sheet(options, (6.4, 4.2))
    for group in groups:
        draw_power(axes, group, factor, f"{group['name']}: exponent {value_of(group, 'exponent'):.3g}", key_factor)
    axes.set_xlabel(worded(fit["key"], key_unit))
    axes.set_ylabel(worded(fit["series"], unit))
    options.head(axes, f"{titled(fit['title'])}\n{title}")
    axes.legend(fontsize="small")
    return figure


def plain_ticks(axes):
    """On a log axis of less than a decade: plain numbers instead of powers of ten."""
    for set_formatter in (axes.xaxis.set_major_formatter, axes.xaxis.set_minor_formatter):
        set_formatter(plt.FuncFormatter(lambda value, _: f"{value:g}"))


def draw_fit(fit, title, options):
    groups = [group for group in fit["groups"] if "not_fitted" not in group]
    if not groups:
        return None
    if fit["law"] == "power":
        return draw_powers(fit, groups, title, options)
    factor, unit = unit_for("" if fit["unit"] == "-" else fit["unit"],
                            np.array([point["strength"] for group in groups for point in group["points"]]))
    weibull = fit["law"] == "weibull"
    figure, axes = sheet(options, (6.4, 4.2))
    for group in groups:
        shown = (f"modulus {value_of(group, 'modulus'):.3g}" if weibull else
                 f"k = {value_of(group, 'k'):.3g}, r² = {value_of(group, 'r_squared'):.3g}")
        (draw_weibull if weibull else draw_porosity)(axes, group, factor, f"{group['name']}: {shown}")
    axes.set_xlabel(worded("strength", unit) if weibull else "Porosity")
    axes.set_ylabel(r"$\ln(-\ln(1 - P))$" if weibull else worded("strength", unit))
    if weibull:
        plain_ticks(axes)
    options.head(axes, f"{titled(fit['title'])}\n{title}")
    axes.legend(fontsize="small")
    return figure


def titled(text):
    """Replaces keys in a chart title by their names."""
    return capital(" ".join(name_of(word).words if "/" in word or "_" in word else word for word in text.split(" ")))


def figures_of_study(folder, options=None):
    """Name and figure of each; None if no run has the data."""
    options = options or Options()
    curves = json.loads((folder / "curves.json").read_text(encoding="utf-8"))
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    title = summary["title"]
    drawn = [(f"{number + 1}-{curve['y']}-{curve['x']}", draw(curve, title, options)) for number, curve in enumerate(curves)]
    drawn += [(f"fit-{number + 1}-{fit['law']}", draw_fit(fit, title, options))
              for number, fit in enumerate(summary.get("fits", []))]
    return [(re.sub(r"[^A-Za-z0-9]+", "-", words), figure) for words, figure in drawn]
