"""Coordination number of soft particles against density: fits Z = Z0 + xi (phi - phi0)^beta to every run of the study
scenes/studies/soft-discs.toml and prints the table in bench/results/soft-discs.md.

  build/release/cli/pulvis study scenes/studies/soft-discs.toml -o runs/soft-discs
  /usr/bin/python3 bench/soft_discs.py runs/soft-discs

phi is the area of the deformed particles over that of the cell, with overlaps counted once. Z is the mean number of
neighbours without rattlers: particles with too few contacts for stability (3, with friction 2) are removed repeatedly until
none is left. phi0 is the onset of pressure: a straight line fitted from 0.1% to 1% of Young's modulus is zero there.
Z0, xi and beta are a least-squares fit from 0.01 above phi0 on; then Z0 and xi again with beta = 1/2.
"""
import argparse
import pathlib
import re

import h5py
import numpy as np

YOUNGS_MODULUS = 10e6  # Pa, of scenes/periodic/soft-discs.toml
BEYOND = 0.01          # above phi0: closer to it, contacts still open and close
BETAS = np.arange(0.20, 1.201, 0.01)


def neighbours(ids, particles, needed):
    """Mean number of contacts of the particles that are not rattlers."""
    held = np.ones(particles, bool)
    while True:
        pairs = ids[held[ids].all(axis=1)] if len(ids) else ids
        count = np.bincount(pairs.ravel(), minlength=particles)
        loose = held & (count < needed)
        if not loose.any():
            return count[held].mean() if held.any() else 0.0
        held &= ~loose


def curve_of(folder, friction):
    """phi, Z and pressure of every frame."""
    rows = []
    with h5py.File(folder / "run.h5") as file:
        quads = file["mesh/quads"][:]
        particles = int(file["mesh/cell_particle"][:].max()) + 1
        time = file["history/time"][:]
        pressure = -(file["history/stress/xx"][:] + file["history/stress/yy"][:]) / 2
        overlap = file["history/contact_overlap"][:]
        for frame in file["frames"].values():
            if frame.attrs.get("complete") != 1:
                continue
            x, y = np.moveaxis(frame["position"][:][quads], 2, 0)
            area = 0.5 * np.abs(np.sum(x * np.roll(y, -1, 1) - np.roll(x, -1, 1) * y, axis=1)).sum()
            a, b = frame["cell"][1:]
            now = frame.attrs["time"]
            phi = area * (1 - np.interp(now, time, overlap)) / abs(a[0] * b[1] - a[1] * b[0])
            z = neighbours(frame["contacts/ids"][:], particles, 2)
            rows.append((phi, z, np.interp(now, time, pressure)))
    return np.array(sorted(rows)).T


def line(x, y):
    slope, start = np.polyfit(x, y, 1)
    return start, slope, np.sqrt(np.mean((y - start - slope * x) ** 2))


def fit(phi, z, pressure):
    soft = (pressure > 1e-3 * YOUNGS_MODULUS) & (pressure < 1e-2 * YOUNGS_MODULUS)
    start, slope, _ = line(phi[soft], pressure[soft])
    phi0 = -start / slope
    dense = phi > phi0 + BEYOND
    x, y = phi[dense] - phi0, z[dense]
    beta = min(BETAS, key=lambda b: line(x**b, y)[2])
    z0, xi, rms = line(x**0.5, y)
    return phi0, beta, z0, xi, rms, phi[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=pathlib.Path)
    print("| particles | friction | seed | phi0 | up to | beta | Z0 | xi | rms of Z |\n|---|---|---|---|---|---|---|---|---|")
    everything = {}
    for folder in sorted(parser.parse_args().study.iterdir()):
        name = re.fullmatch(r"(\w+),friction=([\d.]+),seed=(\d+)", folder.name)
        if not name or not (folder / "summary.json").exists():
            continue
        shape, friction, seed = name[1], float(name[2]), name[3]
        found = fit(*curve_of(folder, friction))
        everything.setdefault((shape, friction), []).append(found)
        phi0, beta, z0, xi, rms, last = found
        print(f"| {shape} | {friction:g} | {seed} | {phi0:.3f} | {last:.3f} | {beta:.2f} | {z0:.2f} | {xi:.2f} | {rms:.3f} |")
    for (shape, friction), values in everything.items():
        phi0, beta, z0, xi, *_ = np.mean(values, axis=0)
        print(f"| {shape} | {friction:g} | mean | {phi0:.3f} | | {beta:.2f} | {z0:.2f} | {xi:.2f} | |")


if __name__ == "__main__":
    main()
