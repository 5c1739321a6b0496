#!/usr/bin/python3
"""Generates synthetic records of a press from known compression curves: no measured data.

usage: press.py [--out FOLDER] [--seed N] [--noise FACTOR]

A press whose deflection is a cubic polynomial of its force is run once with its punches in contact and three times
with powder in a cylindrical die of 15 mm. The three powders follow the law of Heckel (above 100 MPa), that of Kawakita and
that of Cooper and Eaton. Also writes press-truth.json, the reference for the tests of the reduction. Noise: 10 N
and 1 um, one standard deviation each.
"""
import argparse
import json
import math
import random
from pathlib import Path

DIAMETER = 15.0                       # mm
AREA = math.pi / 4 * DIAMETER ** 2    # mm^2
SOLID_DENSITY = 7.99e-3               # g/mm^3
GIVE = [1.2e-5, -1.4e-10, 8e-16]      # mm/N, mm/N^2, mm/N^3
MEETING = 31.7                        # mm, press displacement at which the punches meet
LARGEST = 70e3                        # N
RATE, INTERVAL = 2.0e3, 0.05          # N/s, s
FILL = 12.0                           # mm
UNLOADING_MODULUS = 45e3              # MPa
NOISE = {"force": 10.0, "displacement": 1e-3}  # N, mm

HECKEL = {"initial_density": 0.56, "from": 100.0, "yield_pressure": 420.0, "A": 1.05}  # MPa
KAWAKITA = {"initial_density": 0.52, "a": 0.43, "b": 0.021}                            # 1/MPa
COOPER_EATON = {"initial_density": 0.50, "a1": 0.42, "k1": 12.0, "a2": 0.55, "k2": 210.0}


def heckel(p):
    """Rearrangement below HECKEL['from'], with continuous density; the straight line beyond."""
    h = HECKEL
    line = lambda q: 1 - math.exp(-(q / h["yield_pressure"] + h["A"]))
    if p >= h["from"]:
        return line(p)
    return h["initial_density"] + (line(h["from"]) - h["initial_density"]) * math.sqrt(p / h["from"])


def kawakita(p):
    k = KAWAKITA
    return k["initial_density"] / (1 - k["a"] * k["b"] * p / (1 + k["b"] * p))


def cooper_eaton(p):
    c = COOPER_EATON
    if p <= 0:
        return c["initial_density"]
    filled = c["a1"] * math.exp(-c["k1"] / p) + c["a2"] * math.exp(-c["k2"] / p)
    return c["initial_density"] / (1 - filled * (1 - c["initial_density"]))


def give(force):
    return sum(c * force ** (i + 1) for i, c in enumerate(GIVE))


def mass(density):
    return density * SOLID_DENSITY * AREA * FILL  # g


def forces():
    """Up at RATE to the largest force and down again, with a short rest before and after."""
    rest, up = int(1.0 / INTERVAL), int(LARGEST / RATE / INTERVAL)
    for i in range(rest):
        yield 0.0, True
    for i in range(up + 1):
        yield LARGEST * i / up, True
    for i in range(up - 1, -1, -1):
        yield LARGEST * i / up, False
    for i in range(rest):
        yield 0.0, False


def write(path, height_at, noisy, zero=MEETING):
    lines = ["# Synthetic record, made by scenes/lab/press.py: not measured",
             "time [s],force [kN],displacement [mm]"]
    for i, (force, is_loading) in enumerate(forces()):
        place = zero - height_at(force, is_loading) + give(force)
        lines.append(f"{i * INTERVAL:.2f},{(force + noisy('force')) / 1e3:.5f},"
                     f"{place + noisy('displacement'):.5f}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def height_of(law):
    """Height of the compact in mm: from the law during loading, elastic after the largest force."""
    solid = law(0.0) * FILL
    lowest = solid / law(LARGEST / AREA)

    def height_at(force, is_loading):
        if is_loading:
            return solid / law(force / AREA)
        return lowest * (1 + (LARGEST - force) / AREA / UNLOADING_MODULUS)
    return height_at


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--noise", type=float, default=1.0, help="times the assumed noise")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    source = random.Random(options.seed)
    noisy = lambda channel: source.gauss(0.0, NOISE[channel] * options.noise)
    write(options.out / "press-empty.csv", lambda force, is_loading: 0.0, noisy)
    laws = {"heckel": (heckel, HECKEL), "kawakita": (kawakita, KAWAKITA),
            "cooper-eaton": (cooper_eaton, COOPER_EATON)}
    truth = {"unloading_modulus_MPa": UNLOADING_MODULUS, "give_mm": GIVE, "seed": options.seed,
             "noise_factor": options.noise, "curves": {}}
    for name, (law, values) in laws.items():
        zero = FILL if name == "cooper-eaton" else MEETING  # this press was zeroed at the fill level
        write(options.out / f"press-{name}.csv", height_of(law), noisy, zero)
        truth["curves"][name] = {**values, "mass_g": round(mass(law(0.0)), 6), "fill_height_mm": FILL,
                                 "final_height_mm": height_of(law)(0.0, False)}
    (options.out / "press-truth.json").write_text(json.dumps(truth, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
