#!/usr/bin/python3
"""Generates synthetic AFM records from known parameters: no measured data.

usage: volts.py [--out FOLDER] [--seed N] [--noise VOLTS]

Force curves on a hard surface and on a sample, friction loops on two slopes of a wedge and on the flat sample, side
contacts of a test probe, and the calibrated lever. Slope and size of the normal signal are like those of A.2.3 of the
thesis (0.0125 V/nm). The lever data in the settings (volts-lever.json, volts.toml) deviate from the true values by a
fraction of their uncertainties, as a calibration does. Also writes volts-truth.json.
"""
import argparse
import json
import math
import random
from pathlib import Path

TRUTH = {"k_n": 0.32, "k_l": 76.0, "arm": 14.8e-6, "share_twist": 0.93,
         "slope": 1.25e7, "normal_sensitivity": 0.32 / 1.25e7, "lateral_sensitivity": 180e-9, "crosstalk": 0.008,
         "friction": 0.22, "adhesion": 18e-9, "wedge_friction": 0.15, "wedge_adhesion": 9e-9, "hard_adhesion": 12e-9,
         "probe_arm": 26.1e-6, "side_slope": 76.0 * 14.8e-6 / (0.93 * 180e-9 * 26.1e-6)}
STATED = {"k_n": 1.03, "k_l": 0.98, "arm": 1.004}  # over the true value; the stated uncertainties are 4, 4 and 1 %
SLOPES, LOADS = (14.1, -12.6), (1.0, 2.5, 4.0, 5.5, 7.0)  # degrees (stated 14.0, -12.5), V
PLACES, STICKING, SWAY = 200, 8, 0.08  # SWAY: deviation of the normal signal in trace and retrace, over load


class Noise:
    """Noise with correlated neighbours."""

    def __init__(self, dice, size):
        self.dice, self.size, self.last = dice, size, 0.0

    def __call__(self):
        self.last = 0.5 * self.last + self.dice.gauss(0, self.size)
        return self.last


def force_curves(dice, noise, adhesion, stiffness, count, lateral):
    """Rows of curves: approach and retract, with a tilted zero-force line, a small jump into contact, a pull-off."""
    rows = []
    for curve in range(1, count + 1):
        touch, slope = dice.uniform(190, 210), stiffness * TRUTH["slope"] * 1e-9 * (1 + dice.gauss(0, 0.003))
        pull = adhesion * (1 + dice.gauss(0, 0.04)) / TRUTH["normal_sensitivity"] if lateral is None else \
            adhesion / TRUTH["normal_sensitivity"]
        for retrace in (False, True):
            for i in range(0, 401, 2):
                d = 400 - i if retrace else i
                if retrace and i == 0:
                    continue
                y = slope * (d - touch) * (1.004 if retrace else 1.0)
                y = (y if y > -pull else 0.0) if retrace else (y if y > -0.15 * pull else 0.0)
                row = [str(curve), str(d), f"{0.1 + 1.2e-4 * d + y + noise():.5f}"]
                if lateral is not None:
                    row.append(f"{-0.05 + TRUTH['crosstalk'] * y + lateral():.5f}")
                rows.append(",".join(row))
    return rows


def sideways(load, slope, sign, mu, adhesion):
    s, c = math.sin(slope), math.cos(slope)
    return (load * (s + sign * mu * c) + sign * mu * adhesion) / (c - sign * mu * s)


def loop(load, up, down, noise, head):
    """Rows of one loop: the tip sticks after each reversal; the normal signal causes crosstalk."""
    rows, normal = [], (load * (1 + SWAY), load * (1 - SWAY))
    for i in range(PLACES):
        there = up + (down - up) * max(0.0, 1 - i / STICKING)
        retrace = down + (up - down) * max(0.0, 1 - (PLACES - 1 - i) / STICKING)
        volts = [v + 0.04 + TRUTH["crosstalk"] * n + noise() for v, n in zip((there, retrace), normal)]
        rows.append(f"{head}{load},{5 * i}," + ",".join(f"{v:.5f}" for v in (*volts, *(n + noise() for n in normal))))
    return rows


def side_contacts(dice, noise):
    rows = []
    for contact in range(1, 5):
        touch, slope = dice.uniform(18, 22), TRUTH["side_slope"] * 1e-9 * (1 + dice.gauss(0, 0.005))
        for i in range(101):
            d = 0.5 * i
            rows.append(f"{contact},{d},{max(0.0, slope * (d - touch)) + noise():.5f}")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    parser.add_argument("--seed", type=int, default=5)
    parser.add_argument("--noise", type=float, default=0.003)
    options = parser.parse_args()
    dice = random.Random(options.seed)
    noise = Noise(dice, options.noise)

    def write(name, header, rows):
        text = "\n".join(["# Synthetic: made by volts.py from volts-truth.json.", header, *rows]) + "\n"
        (options.out / f"volts-{name}.csv").write_text(text)

    write("hard", "curve,displacement [nm],normal [V],lateral [V]",
          force_curves(dice, noise, TRUTH["hard_adhesion"], 1.0, 5, Noise(dice, options.noise)))
    write("sample", "curve,displacement [nm],normal [V]",
          force_curves(dice, noise, TRUTH["adhesion"], 0.9, 8, None))
    normal, lateral = TRUTH["normal_sensitivity"], TRUTH["lateral_sensitivity"]
    rows = []
    for degrees in SLOPES:
        for load in LOADS:
            up, down = (sideways(load * normal, math.radians(degrees), sign, TRUTH["wedge_friction"],
                                 TRUTH["wedge_adhesion"]) / lateral for sign in (1, -1))
            rows += loop(load, up, down, noise, f"{degrees - math.copysign(0.1, degrees):g},")
    write("wedge", "slope [deg],load [V],position [nm],trace [V],retrace [V],normal_trace [V],normal_retrace [V]", rows)
    rows = []
    for load in (1, 2, 3, 4, 5, 6):
        up = sideways(load * normal, 0, 1, TRUTH["friction"], TRUTH["adhesion"]) / lateral
        rows += loop(float(load), up, -up, noise, "")
    write("loops", "load [V],position [nm],trace [V],retrace [V],normal_trace [V],normal_retrace [V]", rows)
    write("side", "curve,displacement [nm],lateral [V]", side_contacts(dice, noise))
    stated = {name: TRUTH[name] * STATED.get(name, 1) for name in ("k_n", "k_l", "arm", "share_twist")}
    (options.out / "volts-lever.json").write_text(json.dumps({"calibration": stated}, indent=2) + "\n")
    (options.out / "volts-truth.json").write_text(json.dumps(TRUTH, indent=2) + "\n")


if __name__ == "__main__":
    main()
