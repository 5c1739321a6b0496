#!/usr/bin/python3
"""Generates the synthetic record for plate-fit.toml: a simulated plate test with known friction, plus noise.

usage: plate.py PULVIS [--out FOLDER] [--seed N]

Runs scenes/shear/plate-static.toml with the friction of TRUTH, using the program PULVIS. Writes friction against
distance, 60 samples per millimetre with a standard deviation of 0.002, to plate-measured.csv, and plate-truth.json.
"""
import argparse
import csv
import json
import random
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
TRUTH = {"coefficient": 0.185, "static_coefficient": 0.262}
NOISE, STEP = 0.002, 1 / 60e3  # -, m


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pulvis")
    parser.add_argument("--out", type=Path, default=HERE)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    source = random.Random(options.seed)
    with tempfile.TemporaryDirectory() as work:
        run = Path(work) / "run"
        settings = [word for key, value in TRUTH.items() for word in ("--set", f"friction[0].{key}={value}")]
        # its expectations assume other coefficients: exit code 3
        subprocess.run([options.pulvis, "run", HERE.parent / "shear/plate-static.toml", "-o", run, "--quiet", *settings],
                       check=False, stdout=subprocess.DEVNULL)
        with open(run / "history.csv", encoding="utf-8") as file:
            rows = [{name.split(" [")[0]: float(value or "nan") for name, value in row.items()}
                    for row in csv.DictReader(file)]
    start = rows[0]["tool/target/position_x"]
    points = [(row["tool/target/position_x"] - start, row["tool/target/force_x"] / row["tool/target/force_y"])
              for row in rows if row["tool/target/position_x"] > start]
    lines = ["# Synthetic record, made by scenes/lab/plate.py from a simulation: not measured", "distance [mm],friction"]
    at, k = 0.0, 0
    while at <= points[-1][0]:
        while k + 2 < len(points) and points[k + 1][0] < at:
            k += 1
        (x0, y0), (x1, y1) = points[k], points[k + 1]
        value = abs(y0 + (y1 - y0) * (at - x0) / (x1 - x0)) + source.gauss(0, NOISE)
        lines.append(f"{at * 1e3:.5f},{value:.5f}")
        at += STEP
    (options.out / "plate-measured.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    truth = {**TRUTH, "noise": NOISE, "seed": options.seed}
    (options.out / "plate-truth.json").write_text(json.dumps(truth, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
