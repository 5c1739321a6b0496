#!/usr/bin/python3
"""Taylor's rod with axisymmetric finite elements: what the wall does to the radius of the foot.

usage: axisymmetric_rod.py [--radial N]

Independent of Pulvis: the elements of axisymmetric_sphere.py, real masses, a wall without friction. The nodes of the foot
either stay on the wall for the whole time, as in the literature, or leave it when they are pulled. Takes minutes with 5
elements along the radius, half an hour with 10.
"""
import argparse

import numpy as np
from axisymmetric_sphere import Body

RADIUS, LENGTH, SPEED, DENSITY, END = 3.2e-3, 32.4e-3, 227, 8930, 80e-6
COPPER = {"young": 117e9, "poisson": 0.35, "yield_stress": 400e6, "hardening": 100e6}


def rod(radial):
    """Ten times as many elements along the axis, from half as long at the foot to one and a half times at the end."""
    axial = 10 * radial
    share = np.linspace(0, 1, axial + 1)
    nodes = np.array([(r, LENGTH * (0.5 * z + 0.5 * z**2)) for z in share for r in RADIUS * np.arange(radial + 1) / radial])
    first = np.array([j * (radial + 1) + i for j in range(axial) for i in range(radial)])
    return nodes, np.stack([first, first + 1, first + radial + 2, first + radial + 1], 1)


def shortest(body):
    x = body.x[body.quads]
    sides = [np.hypot(*(x[:, (i + 1) % 4] - x[:, i]).T) for i in (0, 1, 2, 3)]
    diagonals = x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]
    area = 0.5 * np.abs(diagonals[0][:, 0] * diagonals[1][:, 1] - diagonals[0][:, 1] * diagonals[1][:, 0])
    return min(np.min(sides), (area / np.maximum(*(np.hypot(*d.T) for d in diagonals))).min())


def fly(radial, held):
    body = Body(*rod(radial), *COPPER.values())
    body.add_masses(DENSITY * np.einsum("eg,gi->ei", body.dV, body.N))
    body.v[:, 1] = -SPEED
    axis, foot = body.X[:, 0] < 1e-12, body.X[:, 1] < 1e-12
    wave = np.sqrt((body.bulk + 4 / 3 * body.mu) / DENSITY)
    t = 0
    while t < END:
        dt = 0.4 * shortest(body) / wave
        f = body.forces()
        body.keep()
        body.v += f / body.mass[:, None] * dt
        body.v[axis, 0] = 0
        if held:
            body.v[foot, 1] = 0
        x = body.x + dt * body.v
        below = x[:, 1] < 0
        x[below, 1] = 0
        body.v[below, 1] = -body.x[below, 1] / dt
        body.x = x
        t += dt
    rim = body.x[:, 0].argmax()
    print(f"{'held' if held else 'free':>5} {radial:7d} {1e3 * np.ptp(body.x[axis, 1]):8.3f} {1e3 * body.x[rim, 0]:8.3f} "
          f"{1e3 * body.x[rim, 1]:9.3f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--radial", type=int, default=5, help="elements along the radius")
    asked = parser.parse_args()
    print("mm: length on the axis, radius of the outermost node, its height over the wall")
    print(f"{'foot':>5} {'radial':>7} {'length':>8} {'radius':>8} {'height':>9}")
    for held in (True, False):
        fly(asked.radial, held)


if __name__ == "__main__":
    main()
