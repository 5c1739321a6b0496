"""Limit pressure of a perfectly plastic thick-walled cylinder, b/a = 2: a locking element exceeds it."""
import numpy as np

from .problem import Problem, Reference, durations, formulations, meshes, safeties

YIELD, THICKNESS, BORE, OUTER = 24e6, 1e-3, 5e-3, 10e-3  # Pa, m, m, m (radii)
# Of the displacement. The whole wall yields from a third of it, but the stress there still rotates towards
# that of plastic flow, and the exact pressure approaches its limit from 0.2% below.
WAY = np.linspace(0.8, 0.97, 35)


def observe(run):
    moved = run.history("tool/bore/position_x") - run.history("tool/bore/position_x")[0]
    bore = BORE + moved
    outer = np.sqrt(OUTER**2 - BORE**2 + bore**2)  # the wall area is constant, except for elastic strain
    pressure = np.abs(run.history("tool/bore/force_x")) / (2 * np.pi * bore * THICKNESS)
    limit = 2 / np.sqrt(3) * YIELD * np.log(outer / bore)
    return {"pressure": np.interp(WAY * moved[-1], moved, pressure / limit)}


def exact(observed):
    return Reference({"pressure": np.ones(len(WAY))}, {},
                     "2/sqrt 3 sigma_y ln(b/a) at the present radii")


def errors(values, reference):
    return {"pressure": float(abs(np.mean(values["pressure"]) - 1))}


def problems(quick):
    sizes = ((24, 2), (32, 3)) if quick else ((16, 1), (24, 2), (32, 3), (64, 5), (96, 8), (192, 16))
    families = {"mesh": meshes("cylinder", sizes)}
    if not quick:
        families |= {"formulation": formulations(),
                     "duration": durations("widen", 0.4, (0.25, 0.5, 2)),
                     "safety": safeties((0.5, 0.99))}
    return [Problem("thick-cylinder", "thick-walled cylinder to its limit pressure",
                    "benchmark/thick-cylinder.toml", families, observe, exact, errors,
                    {"output.frames": 1})]
