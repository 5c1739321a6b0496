#!/usr/bin/python3
"""Pictures of a study for papers and slides: every chart of its report, one curve a variation.

usage: study_figures.py STUDY_FOLDER

Reads STUDY_FOLDER/curves.json and writes STUDY_FOLDER/pictures/*.png; the band of a variation with several
seeds lies between the smallest and the largest. Needs python3-numpy and python3-matplotlib.
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
    axes.set_xlabel(labelled(curve["x"].replace("_", " "), x_unit))
    axes.set_ylabel(labelled(curve["y"].replace("_", " "), unit))
    axes.set_title(f"{curve['title'].replace('_', ' ')}\n{title}", loc="left")
    axes.legend(fontsize=8)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("study_folder", type=Path)
    folder = parser.parse_args().study_folder
    try:
        curves = json.loads((folder / "curves.json").read_text(encoding="utf-8"))
        title = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["title"]
    except (OSError, ValueError) as error:
        sys.exit(f"study_figures: {folder}: {error}")
    pictures = folder / "pictures"
    pictures.mkdir(exist_ok=True)
    plt.rcParams.update(STYLE)
    for number, curve in enumerate(curves):
        figure = draw(curve, title)
        name = re.sub(r"[^A-Za-z0-9]+", "-", f"{number + 1}-{curve['y']}-{curve['x']}") + ".png"
        if figure is None:
            print(f"study_figures: no run has both series of {name}")
            continue
        if (pictures / name).exists() and MARK not in (pictures / name).read_bytes()[:1024]:
            sys.exit(f"study_figures: {pictures / name} is there already, and was not drawn here")
        figure.savefig(pictures / name, metadata={"Software": MARK.decode()})
        plt.close(figure)
        print(pictures / name)


if __name__ == "__main__":
    main()
