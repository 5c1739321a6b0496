#!/usr/bin/python3
"""The nine lines of a chart are told apart: also with each kind of colour blindness.

usage: line_colours.py CHART_JS

Reads the palettes and dashes of cli/report/page/chart.js. Lines of one dash pattern must differ in colour as anomalous
trichromats and dichromats see it (Machado, Oliveira & Fernandes 2009, severity 1, in linear RGB; distances in CIELAB),
and every line must differ from the paper.
"""
import itertools
import re
import sys
from pathlib import Path

import numpy as np

SEEN = {"all cones": np.eye(3),
        "no long cones": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        "no medium cones": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
        "no short cones": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]}
XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
APART, FROM_PAPER = 22, 30  # CIELAB; 2 is just seen side by side, thin lines need ten times that


def lab(colour, matrix):
    srgb = np.array([int(colour[i:i + 2], 16) for i in (1, 3, 5)]) / 255
    linear = np.where(srgb > 0.04045, ((srgb + 0.055) / 1.055) ** 2.4, srgb / 12.92)
    xyz = XYZ @ np.clip(np.array(matrix) @ linear, 0, 1) / (XYZ @ np.ones(3))
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def main():
    text = Path(sys.argv[1]).read_text(encoding="utf-8")
    faults = []
    for name in ("LIGHT", "DARK"):
        block = re.search(rf"const {name} = {{(.*?)}};", text, re.S)[1]
        paper = re.search(r'paper: "(#\w+)"', block)[1]
        colours = re.findall(r'"(#\w+)"', re.search(r"lines: \[(.*?)\]", block, re.S)[1])
        if len(colours) != 9:
            faults.append(f"{name}: {len(colours)} colours")
        for eyes, matrix in SEEN.items():
            seen = [lab(colour, matrix) for colour in colours]
            for first in range(0, len(colours), 3):  # lines of one dash pattern
                for a, b in itertools.combinations(range(first, min(first + 3, len(colours))), 2):
                    far = np.linalg.norm(seen[a] - seen[b])
                    if far < APART:
                        faults.append(f"{name}, {eyes}: {colours[a]} and {colours[b]} are {far:.1f} apart")
            for colour, at in zip(colours, seen):
                far = np.linalg.norm(at - lab(paper, matrix))
                if far < FROM_PAPER:
                    faults.append(f"{name}, {eyes}: {colour} is {far:.1f} from the paper")
    dashes = re.search(r"const DASHES = \[(.*?)\];", text)[1]
    if dashes.count("[") != 2 or not dashes.startswith("undefined"):
        faults.append(f"three dash patterns are wanted: {dashes}")
    if faults:
        sys.exit("\n".join(faults))
    print("ok: nine lines")


if __name__ == "__main__":
    main()
