#!/usr/bin/python3
"""Compares simulated and reduced results with published numbers (published.csv): misfits, and a figure of them.

usage: published.py PULVIS [--runs FOLDER] [--figure FILE.png]

1. Wall friction only (Kahhal et al. 2022, iron in a multi-particle finite element model of different geometry):
   wall-friction.toml with three packings and wall friction 0 and 0.2; the rise of the top force at equal density, and the
   difference of top and bottom force, means over relative densities of 0.83 to 0.85. Existing runs are reused.
2. The thesis's transmission coefficients: the friction coefficient that each implies by (3.1), for compacts of the stated
   mass at a relative density of 0.6 to 0.7, which the thesis does not state; and the coefficient of copper by (3.1) and
   (3.2) from its 70 N under 1 kN.
"""
import argparse
import csv
import math
import subprocess
from pathlib import Path
from statistics import mean, stdev

HERE = Path(__file__).parent
SEEDS, WALLS = (1, 2, 3), (0.0, 0.2)
DENSITIES = [0.83 + 0.001 * i for i in range(21)]
DIE = 15e-3  # m
POWDERS = {  # mass in kg, density of the solid, Poisson's ratio (Table 3.2; 3.3.1 step 2; handbook densities)
    "copper": (10e-3, 8940, 0.35), "316L": (10e-3, 7990, 0.3), "salt": (10e-3, 2165, 0.252), "sugar": (5e-3, 1590, 0.25)}


def published():
    with open(HERE / "published.csv", encoding="utf-8") as file:
        return {row["name"]: float(row["value [-]"]) for row in csv.DictReader(l for l in file if not l.startswith("#"))}


def run(pulvis, folder, seed, wall):
    out = folder / f"seed={seed},wall={wall:g}"
    if not (out / "summary.json").exists():
        subprocess.run([pulvis, "run", HERE / "wall-friction.toml", "-o", out, "--overwrite", "--quiet", "--set", f"seed={seed}",
                        "--set", f"friction[0].coefficient={wall}", "--set", f"friction[1].coefficient={wall}"], check=True)
    with open(out / "history.csv", encoding="utf-8") as file:
        rows = [{name.split(" [")[0]: value for name, value in row.items()} for row in csv.DictReader(file)]
    return [[float(row[name]) for row in rows] for name in ("relative_density", "stress/axial_top", "stress/axial_bottom")]


def at(x, y, where):
    i = next(i for i in range(1, len(x)) if x[i] >= where)
    return y[i - 1] + (y[i] - y[i - 1]) * (where - x[i - 1]) / (x[i] - x[i - 1])


def walls(pulvis, folder):
    """Rise of the top force, and force differences without and with friction, for each packing."""
    found = []
    for seed in SEEDS:
        tops, bottoms = [], []
        for wall in WALLS:
            density, top, bottom = run(pulvis, folder, seed, wall)
            tops.append(mean(at(density, top, d) for d in DENSITIES))
            bottoms.append(mean(at(density, bottom, d) for d in DENSITIES))
        found.append((tops[1] / tops[0] - 1, 1 - bottoms[0] / tops[0], 1 - bottoms[1] / tops[1]))
    return list(zip(*found))


def exponent(powder, density):
    mass, solid, nu = POWDERS[powder]
    length = mass / (solid * density * math.pi / 4 * DIE ** 2)
    return 4 * nu / (1 - nu) * length / DIE


def coefficient(ratio, k):
    mu = ratio  # mu exp(-k mu) = ratio, the smaller solution
    for _ in range(100):
        mu = ratio * math.exp(k * mu)
    return mu


def draw(file, found, told):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    fig, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    names = ["rise of the force,\nwall friction 0 to 0.2", "difference of the forces,\nwall friction 0", "the same, 0.2"]
    for i, values in enumerate(found):
        axes.plot([i] * len(values), [100 * v for v in values], "o", color="#0072b2", label="Pulvis, three packings" if i == 0 else None)
        axes.errorbar(i + 0.08, 100 * mean(values), 100 * stdev(values), fmt="_", color="#0072b2", capsize=4, label="mean, deviation" if i == 0 else None)
        axes.plot(i - 0.08, 100 * told[i], "D", color="#d55e00", label="Kahhal et al. 2022" if i == 0 else None)
    axes.axhline(0, color="#999999", linewidth=0.8)
    axes.set(xticks=range(3), xticklabels=names, ylabel="per cent")
    axes.legend(frameon=False)
    fig.savefig(file, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pulvis")
    parser.add_argument("--runs", type=Path, default=Path("runs/published"))
    parser.add_argument("--figure", type=Path)
    options = parser.parse_args()
    values = published()
    told = [values["kahhal-force-rise"], values["kahhal-difference-without"], values["kahhal-difference-with"]]
    found = walls(options.pulvis, options.runs)
    for name, one, other in zip(("rise of the force", "difference without friction", "difference with friction"), found, told):
        print(f"{name}: {100 * mean(one):.1f} +- {100 * stdev(one):.1f} % ({', '.join(f'{100 * v:.1f}' for v in one)}), "
              f"published {100 * other:.1f} %, misfit {100 * (mean(one) - other):+.1f}")
    for powder in POWDERS:
        t = values[f"thesis-transmission-{powder}"]
        low, high = (-math.log(t) / exponent(powder, d) for d in (0.6, 0.7))
        print(f"{powder}: transmission {t} means a coefficient of {low:.3f} to {high:.3f}")
    low, high = (coefficient(values["thesis-shear-copper"], exponent("copper", d)) for d in (0.7, 0.6))
    print(f"copper, 70 N under 1 kN: dynamic coefficient {low:.4f} to {high:.4f}")
    if options.figure:
        draw(options.figure, found, told)


if __name__ == "__main__":
    main()
