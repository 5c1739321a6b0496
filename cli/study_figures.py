#!/usr/bin/python3
"""Pictures of a study for papers and slides: every chart of its report, one curve a variation, and its fitted laws.

usage: study_figures.py STUDY_FOLDER

Reads STUDY_FOLDER/curves.json and summary.json and writes STUDY_FOLDER/pictures/*.png; the band of a variation with several
seeds lies between the smallest and the largest, its bars are the standard deviation. Needs python3-numpy and python3-matplotlib.
"""
import argparse
import json
import re
import sys
from pathlib import Path

import numpy as np

from figures import STYLE, labelled, plt, unit_for

MARK = b"pulvis study_figures"  # in every picture that this draws: it replaces no other


def factor_of(unit, lines, key):
    """One unit for all curves of a chart."""
    return unit_for("" if unit == "-" else unit, np.concatenate([line[key] for line in lines]))


def draw(curve, title):
    lines = [{key: np.array(value, float) if isinstance(value, list) else value
              for key, value in line.items()} for line in curve["lines"]]
    if not lines:
        return None
    x_factor, x_unit = factor_of(curve["x_unit"], lines, "x")
    factor, unit = factor_of(curve["y_unit"], lines, "y")
    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    for line in lines:
        label = line["variation"] + (f" ({line['runs']} seeds)" if line["runs"] > 1 else "")
        drawn, = axes.plot(x_factor * line["x"], factor * line["y"], label=label)
        if "low" in line:
            axes.fill_between(x_factor * line["x"], factor * line["low"], factor * line["high"],
                              color=drawn.get_color(), alpha=0.2, linewidth=0)
        if "standard_deviation" in line:
            some = slice(len(line["x"]) // 24, None, max(1, len(line["x"]) // 12))
            axes.errorbar(x_factor * line["x"][some], factor * line["y"][some],
                          factor * line["standard_deviation"][some], color=drawn.get_color(), fmt="none",
                          capsize=2, linewidth=1)
    axes.set_xlabel(labelled(curve["x"].replace("_", " "), x_unit))
    axes.set_ylabel(labelled(curve["y"].replace("_", " "), unit))
    axes.set_title(f"{curve['title'].replace('_', ' ')}\n{title}", loc="left")
    axes.legend(fontsize=8)
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


def draw_powers(fit, groups, title):
    def scale(unit, name):
        return unit_for("" if unit == "-" else unit,
                        np.array([point[name] for group in groups for point in group["points"]]))
    factor, unit = scale(fit["unit"], "value")
    key_factor, key_unit = scale(fit["key_unit"], "key")
    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    for group in groups:
        draw_power(axes, group, factor, f"{group['name']}: exponent {value_of(group, 'exponent'):.3g}", key_factor)
    axes.set_xlabel(labelled(fit["key"], key_unit))
    axes.set_ylabel(labelled(fit["series"], unit))
    axes.set_title(f"{fit['title'].replace('_', ' ')}\n{title}", loc="left")
    axes.legend(fontsize=8)
    return figure


def plain_ticks(axes):
    """On an axis of less than a decade: numbers instead of powers of ten."""
    for set_formatter in (axes.xaxis.set_major_formatter, axes.xaxis.set_minor_formatter):
        set_formatter(plt.FuncFormatter(lambda value, _: f"{value:g}"))


def draw_fit(fit, title):
    groups = [group for group in fit["groups"] if "not_fitted" not in group]
    if not groups:
        return None
    if fit["law"] == "power":
        return draw_powers(fit, groups, title)
    factor, unit = unit_for("" if fit["unit"] == "-" else fit["unit"],
                            np.array([point["strength"] for group in groups for point in group["points"]]))
    weibull = fit["law"] == "weibull"
    figure, axes = plt.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    for group in groups:
        shown = (f"modulus {value_of(group, 'modulus'):.3g}" if weibull else
                 f"k = {value_of(group, 'k'):.3g}, r² = {value_of(group, 'r_squared'):.3g}")
        (draw_weibull if weibull else draw_porosity)(axes, group, factor, f"{group['name']}: {shown}")
    axes.set_xlabel(labelled("strength", unit) if weibull else "porosity")
    axes.set_ylabel("ln(-ln(1 - P))" if weibull else labelled("strength", unit))
    if weibull:
        plain_ticks(axes)
    axes.set_title(f"{fit['title'].replace('_', ' ')}\n{title}", loc="left")
    axes.legend(fontsize=8)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("study_folder", type=Path)
    folder = parser.parse_args().study_folder
    try:
        curves = json.loads((folder / "curves.json").read_text(encoding="utf-8"))
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        title = summary["title"]
    except (OSError, ValueError) as error:
        sys.exit(f"study_figures: {folder}: {error}")
    pictures = folder / "pictures"
    pictures.mkdir(exist_ok=True)
    plt.rcParams.update(STYLE)
    drawn = [(draw(curve, title), f"{number + 1}-{curve['y']}-{curve['x']}") for number, curve in enumerate(curves)]
    drawn += [(draw_fit(fit, title), f"fit-{number + 1}-{fit['law']}")
              for number, fit in enumerate(summary.get("fits", []))]
    for figure, words in drawn:
        name = re.sub(r"[^A-Za-z0-9]+", "-", words) + ".png"
        if figure is None:
            print(f"study_figures: no run has what {name} shows")
            continue
        if (pictures / name).exists() and MARK not in (pictures / name).read_bytes()[:1024]:
            sys.exit(f"study_figures: {pictures / name} is there already, and was not drawn here")
        figure.savefig(pictures / name, metadata={"Software": MARK.decode()})
        plt.close(figure)
        print(pictures / name)


if __name__ == "__main__":
    main()
