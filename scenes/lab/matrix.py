#!/usr/bin/python3
"""Generates synthetic sliding-plate tests for a test matrix, and their settings: no measured data.

usage: matrix.py [--seed N]

Load, roughness, direction, speed and powder at two levels each, in a half-fraction of all combinations (the product of
all signs is +, so that no two factors always change together), two runs each: 32 tests of 20 mm, written by synthetic.py.
A trigger gives the offset of the clocks. The coefficient of a run is a mean plus the effects of its levels plus run-to-run scatter (matrix-truth.json).
Writes matrix.toml and the folder matrix/.
"""
import argparse
import itertools
import json
import random
from pathlib import Path

import synthetic

HERE = Path(__file__).parent
MEAN, PEAK, SCATTER = 0.2, 0.035, 0.002  # dynamic; static minus dynamic; run-to-run standard deviation
FACTORS = {  # levels; the second adds this value to the mean, the first subtracts it
    "load": (["500 N", "1 kN"], -0.006),
    "roughness": (["0.1 um", "1 um"], 0.012),
    "direction": (["aligned", "transverse"], 0.008),
    "speed": (["0.7 mm/s", "2.2 mm/s"], 0.0),
    "powder": (["316L", "OFHC Cu"], 0.010),
}
POISSON = {"316L": 0.3, "OFHC Cu": 0.35}
FORCE = {"500 N": 500.0, "1 kN": 1000.0}
SPEED = {"0.7 mm/s": 0.7, "2.2 mm/s": 2.2}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=5)
    options = parser.parse_args()
    source = random.Random(options.seed)
    noisy = lambda channel: source.gauss(0.0, synthetic.NOISE[channel])
    synthetic.MAKER = "matrix.py"
    synthetic.DISTANCE, synthetic.PRESS_INTERVAL, synthetic.PRESS_AFTER = 20.0, 0.2, 4.0
    folder = HERE / "matrix"
    folder.mkdir(exist_ok=True)
    settings = ["# Synthetic sliding-plate tests under a matrix of conditions: pulvis reduce scenes/lab/matrix.toml",
                "# Made by matrix.py from known effects (matrix-truth.json); nothing here was measured.",
                'title = "Synthetic matrix of conditions"', "", "[compact]", 'length = "10 mm"']
    number = 0
    for signs in itertools.product((-1, 1), repeat=len(FACTORS)):
        if signs[0] * signs[1] * signs[2] * signs[3] * signs[4] < 0:
            continue
        levels = {name: of[0][(sign + 1) // 2] for (name, of), sign in zip(FACTORS.items(), signs)}
        synthetic.FORCE, synthetic.SPEED = FORCE[levels["load"]], SPEED[levels["speed"]]
        synthetic.POISSON = POISSON[levels["powder"]]
        for _ in range(2):
            number += 1
            dynamic = MEAN + sum(of[1] * sign for of, sign in zip(FACTORS.values(), signs)) + source.gauss(0, SCATTER)
            run = {"static": dynamic + PEAK + source.gauss(0, SCATTER), "dynamic": dynamic,
                   "press": 8.4 + source.random(), "logger": 4.2 + source.random(), "drift": 0.0}
            synthetic.write_press(folder / f"press-{number:02}.csv", run, noisy)
            synthetic.write_logger(folder / f"logger-{number:02}.csv", run, noisy)
            settings += ["", "[[run]]", f'name = "run-{number:02}"', f'press = "matrix/press-{number:02}.csv"',
                         f'logger = "matrix/logger-{number:02}.csv"',
                         f'offset = "{run["press"] - run["logger"]:.3f} s"']
            settings += [f'{name} = "{level}"' for name, level in levels.items()]
    (HERE / "matrix.toml").write_text("\n".join(settings) + "\n", encoding="utf-8")
    truth = {"mean": MEAN, "peak": PEAK, "scatter": SCATTER, "seed": options.seed,
             "effects": {name: {level: sign * of[1] for level, sign in zip(of[0], (-1, 1))}
                         for name, of in FACTORS.items()}}
    (HERE / "matrix-truth.json").write_text(json.dumps(truth, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
