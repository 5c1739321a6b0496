#!/usr/bin/python3
"""Makes synthetic-transmission.csv: a record of an instrumented die that nobody measured.

usage: synthetic_transmission.py FILE, with the package pulvis in PYTHONPATH

A simulation of eight discs with the friction TRUE_FRICTION, sampled at forty densities, with normal noise. The notebook
6-fit-friction-to-a-measured-curve.ipynb finds the friction again.
"""
import sys
from pathlib import Path

import numpy as np

import pulvis

SCENE = Path(__file__).resolve().parents[3] / "scenes/compaction/regular-25.toml"
EIGHT = {
    "packing[0].rows": 4,
    "packing[0].columns": 2,
    "tool.right.point": ["20 mm", "0 mm"],
    "tool.top.point": ["0 mm", "40 mm"],
    "stage.press.duration": "1 ms",
    "stage.press.move[0].displacement": ["0 mm", "-4 mm"],
}
TRUE_FRICTION, NOISE = 0.17, 0.01
HEAD = "# Synthetic record, made by synthetic_transmission.py from a simulation: not measured\n" \
       "relative density [-],transmission [-]\n"


def main():
    sim = pulvis.Scene(SCENE, EIGHT, contact__friction=TRUE_FRICTION).simulation(threads=1).run(progress=False)
    density = np.linspace(0.80, 0.87, 40)
    transmission = np.interp(density, sim.history["relative_density"], sim.history["stress/transmission"])
    transmission += NOISE * np.random.default_rng(1).standard_normal(len(density))
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(HEAD)
        file.writelines(f"{d:.5f},{t:.4f}\n" for d, t in zip(density, transmission))
    return 0


if __name__ == "__main__":
    sys.exit(main())
