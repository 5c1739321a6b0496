#!/usr/bin/python3
"""Generates synthetic records of an instrumented die from a known wall friction and stress ratio: no measured data.

usage: die.py [--out FOLDER] [--seed N] [--noise FACTOR]

Two compressions of 316L on a rigid press: a cylindrical die of 15 mm with a gauge in its wall 3 mm above the bottom punch,
and a rectangular die of 12 mm x 20 mm whose wall measures its mean stress. Friction and stress ratio change linearly with the
relative density (die-truth.json: reference for the tests of the reduction); the top pressure follows Kawakita's law.
Noise: 20 N on both punches, 0.2 MPa on the wall, 1 um of displacement; one standard deviation each.
"""
import argparse
import json
import math
import random
from pathlib import Path

SOLID_DENSITY = 7.99e-3                      # g/mm^3
KAWAKITA = {"initial_density": 0.52, "a": 0.43, "b": 0.021}  # -, -, 1/MPa
FRICTION = {"at": 0.6, "value": 0.22, "slope": -0.35}        # mu = value + slope (D - at)
RATIO = {"at": 0.6, "value": 0.42, "slope": 0.55}            # K, in the same way
LARGEST = 400.0                              # MPa
SAMPLES, INTERVAL = 1200, 0.05               # of the loading; s
NOISE = {"force": 20.0, "radial": 0.2, "displacement": 1e-3}  # N, MPa, mm
DIES = {
    "round": {"area": math.pi / 4 * 15.0 ** 2, "wall_length": 15.0 / 4, "fill": 18.0, "gauge": 3.0},
    "slot": {"area": 12.0 * 20.0, "wall_length": 12.0 / 2, "fill": 24.0, "gauge": None},
}


def density_at(p):
    k = KAWAKITA
    return k["initial_density"] / (1 - k["a"] * k["b"] * p / (1 + k["b"] * p))


def linear(law, density):
    return law["value"] + law["slope"] * (density - law["at"])


def write(path, die, noisy):
    lines = ["# Synthetic record, made by scenes/lab/die.py: not measured",
             "time [s],displacement [mm],top [kN],bottom [kN],radial [MPa]"]
    rest = 20
    for i in range(rest + SAMPLES + 1):
        top = LARGEST * max(0, i - rest) / SAMPLES
        density = density_at(top)
        height = die["fill"] * KAWAKITA["initial_density"] / density
        mu, ratio = linear(FRICTION, density), linear(RATIO, density)
        loss = mu * ratio * height / die["wall_length"]
        bottom = top * math.exp(-loss)
        if die["gauge"] is None:
            radial = ratio * (top - bottom) / loss
        else:
            radial = ratio * top * math.exp(-loss * (1 - die["gauge"] / height))
        row = [i * INTERVAL, die["fill"] - height + noisy("displacement"),
               (top * die["area"] + noisy("force")) / 1e3, (bottom * die["area"] + noisy("force")) / 1e3,
               radial + noisy("radial")]
        lines.append(",".join(f"{v:.5f}" for v in row))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--noise", type=float, default=1.0, help="times the assumed noise")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    source = random.Random(options.seed)
    noisy = lambda channel: source.gauss(0.0, NOISE[channel] * options.noise)
    truth = {"friction": FRICTION, "stress_ratio": RATIO, "kawakita": KAWAKITA, "seed": options.seed,
             "noise_factor": options.noise, "mass_g": {}}
    for name, die in DIES.items():
        write(options.out / f"die-{name}.csv", die, noisy)
        mass = KAWAKITA["initial_density"] * SOLID_DENSITY * die["area"] * die["fill"]
        truth["mass_g"][name] = round(mass, 6)
    (options.out / "die-truth.json").write_text(json.dumps(truth, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
