"""Holds the page of a wedge calibration, as a browser left it, to the truth of its loops.

usage: wedge_page.py PAGE TRUTH
"""
import json
import re
import sys

FACETS, LOADS = 3, 5


def check(holds, what):
    if not holds:
        sys.exit(f"FAILED: {what}")


def told(page, name):
    """Value and error of a figure at the top, in the unit that stands there."""
    found = re.search(rf"<dt>{name}</dt><dd>([\d.e+-]+) ± ([\d.e+-]+)( \S+)?</dd>", page)
    check(found, f"no {name} with its error")
    return float(found[1]), float(found[2]), (found[3] or "").strip()


def distances(plot):
    """Of every mark, in pixels, from the line of its facet: marks of a facet stand before their line."""
    for facet in plot.split('<path class="curve"')[:-1]:
        rest = plot[plot.index(facet) + len(facet):]
        x0, y0, x1, y1 = map(float, re.search(r'd="M(\S+) (\S+)L(\S+) (\S+)"', rest).groups())
        for x, y in re.findall(r'<circle class="mark" cx="(\S+)" cy="(\S+)"', facet):
            yield abs(y0 + (y1 - y0) * (float(x) - x0) / (x1 - x0) - float(y))


def main():
    page = open(sys.argv[1], encoding="utf-8").read()
    truth = json.load(open(sys.argv[2], encoding="utf-8"))
    value, error, _ = told(page, "friction coefficient")
    check(abs(value - truth["friction"]) < 3 * error, f"friction {value} ± {error}")
    value, error, unit = told(page, "lateral sensitivity")
    check(unit == "nN/V" and abs(value - 1e9 * truth["sensitivity"]) < 3 * error, f"sensitivity {value} ± {error} {unit}")
    plots = re.findall(r'<div class="plot".*?</svg>', page, re.S)
    check(len(plots) == 2, f"{len(plots)} charts")
    for plot in plots:
        far = list(distances(plot))
        check(len(far) == FACETS * LOADS, f"{len(far)} marks with a line")
        check(max(far) < 2, f"a loop lies {max(far):.1f} pixels beside the line of its facet")
    check("wedge-traces.csv" in page and "slope_error" in page, "file or settings are not on the page")


if __name__ == "__main__":
    main()
