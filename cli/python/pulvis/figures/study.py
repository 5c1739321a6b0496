"""Figures of a study: every chart of its report, one curve per variation, and its fitted laws.

The band of a variation with several seeds spans the smallest to the largest value; its bars are the standard deviation.
"""
import json
import re

import numpy as np
from matplotlib import pyplot as plt

from pulvis.figures.hidden import dash_hidden
from pulvis.figures.look import COLOURS as LINES, Options, sheet, unit_for
from pulvis.figures.names import capital, label, name_of
from pulvis.figures.room import legend_within


def name_in(summary, key):
    return name_of(key, summary.get("labels", {}))


def title_of(summary, chart):
    """The title of a chart, with words instead of keys, and of its study."""
    words = [name_in(summary, word).words if "/" in word or "_" in word else word for word in chart["title"].split(" ")]
    return f"{capital(' '.join(words))}\n{summary['title']}"


def factor_of(unit, lines, key):
    """One unit for all curves of a chart."""
    return unit_for("" if unit == "-" else unit, np.concatenate([line[key] for line in lines]))


def draw(curve, summary, options, axes=None):
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
        variation = line["variation"] + (f" ({line['runs']} seeds)" if line["runs"] > 1 else "")
        drawn, = axes.plot(x_factor * line["x"], factor * line["y"], label=variation, **style)
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
    axes.set_xlabel(label(name_in(summary, curve["x"]), x_unit))
    axes.set_ylabel(label(name_in(summary, curve["y"]), unit))
    options.head(axes, title_of(summary, curve))
    legend_within(axes, options, fontsize="small")
    return figure


def value_of(group, name):
    return next(parameter["value"] for parameter in group["parameters"] if parameter["name"] == name)


# What is drawn over what: names in the points and lines of summary.json.
DRAWN = {"weibull": ("failure_probability", "strength"), "ryshkewitch_duckworth": ("strength", "porosity"),
         "power": ("value", "key")}


def axes_of(fit, summary):
    """((words, symbol), unit) of y and x."""
    strength = ("strength", r"\sigma_f"), fit["unit"]
    return {"weibull": (((r"$\ln(-\ln(1 - P))$", ""), "-"), strength),
            "ryshkewitch_duckworth": (strength, (("porosity", ""), "-")),
            "power": ((name_in(summary, fit.get("series", "")), fit["unit"]),
                      (name_in(summary, fit.get("key", "")), fit.get("key_unit")))}[fit["law"]]


def told(fit, group):
    shown = {"weibull": {"modulus": "modulus "}, "ryshkewitch_duckworth": {"k": "k = ", "r_squared": "r² = "},
             "power": {"exponent": "exponent "}}[fit["law"]]
    return f"{group['name']}: " + ", ".join(f"{words}{value_of(group, name):.3g}" for name, words in shown.items())


def column(of, name, factor):
    values = np.array([point[name] for point in of] if isinstance(of, list) else of[name], float)
    return np.log(-np.log(1 - values)) if name == "failure_probability" else factor * values


def plain_ticks(axes):
    """On a log axis of less than a decade: plain numbers instead of powers of ten."""
    for set_formatter in (axes.xaxis.set_major_formatter, axes.xaxis.set_minor_formatter):
        set_formatter(plt.FuncFormatter(lambda value, _: f"{value:g}"))


def draw_fit(fit, summary, options):
    groups = [group for group in fit["groups"] if "not_fitted" not in group]
    if not groups:
        return None
    y, x = DRAWN[fit["law"]]
    (y_name, y_unit), (x_name, x_unit) = axes_of(fit, summary)
    (factor, y_unit), (x_factor, x_unit) = (
        unit_for("" if unit == "-" else unit, np.concatenate([column(group["points"], name, 1) for group in groups]))
        for name, unit in ((y, y_unit), (x, x_unit)))
    figure, axes = sheet(options, (6.4, 4.2))
    for group in groups:
        marks, = axes.plot(column(group["points"], x, x_factor), column(group["points"], y, factor), "o", markersize=4,
                           label=told(fit, group))
        if "line" in group:  # not in studies of older versions
            axes.plot(column(group["line"], x, x_factor), column(group["line"], y, factor), color=marks.get_color())
    axes.set(xlabel=label(x_name, x_unit), ylabel=label(y_name, y_unit))
    if fit["law"] == "weibull":
        axes.set_xscale("log")
        plain_ticks(axes)
    options.head(axes, title_of(summary, fit))
    legend_within(axes, options, fontsize="small")
    return figure


def figures_of_study(folder, options=None):
    """Name and figure of each; None if no run has the data."""
    options = options or Options()
    curves = json.loads((folder / "curves.json").read_text(encoding="utf-8"))
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    drawn = [(f"{number + 1}-{curve['y']}-{curve['x']}", draw(curve, summary, options)) for number, curve in enumerate(curves)]
    drawn += [(f"fit-{number + 1}-{fit['law']}", draw_fit(fit, summary, options))
              for number, fit in enumerate(summary.get("fits", []))]
    return [(re.sub(r"[^A-Za-z0-9]+", "-", words), figure) for words, figure in drawn]
