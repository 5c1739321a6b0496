"""Draws a set-up given as JSON."""
import argparse
import json
from pathlib import Path

from pulvis.preview import lever, powder, space
from pulvis.preview.sheet import FAINT, LINE, MARGIN, STYLE, WARNING, WIDTH, Sheet, plt, wrapped


def footer_rows(setup):
    room = WIDTH - 2 * MARGIN
    rows = [(part, WARNING) for line in setup["warnings"] for part in wrapped(f"Warning: {line}", room)]
    return rows + [(part, FAINT) for part in wrapped(setup["run"].replace("run:", "Run:", 1), room) if part]


def draw(setup):
    """The figure of a set-up as written by `pulvis preview -o FILE.json`."""
    plt.rcParams.update(STYLE)
    drawing = space.SpaceDrawing if setup.get("dimension") == 3 else powder.PowderDrawing
    scene = lever.LeverDrawing(setup) if setup["family"] == "afm" else drawing(setup)
    title, footer = wrapped(setup["title"] or setup["file"], WIDTH - 2 * MARGIN, 13), footer_rows(setup)
    top = MARGIN + 0.24 * len(title) + 0.22
    body = max(scene.height, scene.column.height) + 0.15
    sheet = Sheet(top + body + scene.programme.height + LINE * len(footer) + 0.3)
    for i, line in enumerate(title):
        sheet.text(MARGIN, MARGIN - 0.08 + 0.24 * i, line, fontsize=13, fontweight="bold")
    sheet.text(MARGIN, top - 0.24, f"{setup['file']}: set-up before the run", color=FAINT)
    scene.draw(sheet, MARGIN, top)
    scene.column.write(sheet, WIDTH - MARGIN - scene.column.width, top)
    at = top + body
    scene.programme.write(sheet, at)
    at += scene.programme.height + 0.1
    for line, colour in footer:
        sheet.text(MARGIN, at, line, color=colour)
        at += LINE
    return sheet.figure


def main():
    parser = argparse.ArgumentParser(prog="python3 -m pulvis.preview", description=__doc__)
    parser.add_argument("setup", type=Path, help="JSON of pulvis preview -o FILE.json")
    parser.add_argument("-o", "--output", type=Path, required=True, help=".png, .svg or .pdf")
    parser.add_argument("--draw-into", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    figure = draw(json.loads(options.setup.read_text(encoding="utf-8")))
    place = options.output
    if options.draw_into:  # `pulvis preview` moves it into place: it knows which old files it may replace
        place = options.draw_into / f"preview{options.output.suffix}"
    figure.savefig(place, facecolor="white")
    if options.draw_into:
        with open(options.draw_into / "list", "w", encoding="utf-8", errors="surrogateescape") as file:
            file.write(f"{place.name} {options.output}\n")
