#!/usr/bin/python3
"""Generates synthetic AFM friction loops from known parameters: no measured data.

usage: wedge.py [--out FOLDER] [--seed N] [--noise VOLTS]

Facets of a grating at +14.0, 0 and -12.5 degrees, five loads each, raw traces of 256 positions, trace and
retrace, with correlated noise and the tip sticking after each reversal. Also writes wedge-truth.json.
"""
import argparse
import json
import math
import random
from pathlib import Path

TRUTH = {"friction": 0.1, "sensitivity": 180e-9, "adhesion": 9e-9, "crosstalk": 2.5e5, "offset": 0.03}
SLOPES, LOADS = (14.0, 0.0, -12.5), (20, 45, 70, 95, 120)  # degrees, nN
PLACES, STICKING = 256, 6.0


def force(load, slope, sign):
    mu, a = sign * TRUTH["friction"], TRUTH["adhesion"]
    s, c = math.sin(slope), math.cos(slope)
    return (load * (s + mu * c) + mu * a) / (c - mu * s)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    parser.add_argument("--seed", type=int, default=3)
    parser.add_argument("--noise", type=float, default=0.003)
    options = parser.parse_args()
    dice = random.Random(options.seed)
    lines = ["# Synthetic: made by wedge.py from wedge-truth.json.",
             "slope [deg],load [nN],position [nm],trace [V],retrace [V]"]
    for degrees in SLOPES:
        for load in LOADS:
            up, down = (force(load * 1e-9, math.radians(degrees), sign) / TRUTH["sensitivity"]
                        for sign in (1, -1))
            seen = TRUTH["offset"] + TRUTH["crosstalk"] * load * 1e-9
            noise = [0.0, 0.0]
            for i in range(PLACES):
                noise = [0.6 * n + dice.gauss(0, options.noise) for n in noise]
                trace = up + (down - up) * math.exp(-i / STICKING)
                retrace = down + (up - down) * math.exp(-(PLACES - 1 - i) / STICKING)
                lines.append(f"{degrees},{load},{2 * i},{trace + seen + noise[0]:.5f},"
                             f"{retrace + seen + noise[1]:.5f}")
    (options.out / "wedge-traces.csv").write_text("\n".join(lines) + "\n")
    (options.out / "wedge-truth.json").write_text(json.dumps(TRUTH, indent=2) + "\n")


if __name__ == "__main__":
    main()
