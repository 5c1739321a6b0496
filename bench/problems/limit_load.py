"""Limit load of a perfectly plastic deep double-edge notch: a locking element exceeds it."""
import numpy as np

from .problem import Problem, Reference, Setting, durations, formulations, safeties

YIELD, THICKNESS, LIGAMENT = 24e6, 1e-3, 2e-3  # Pa, m, m (half of it: what the quarter holds)
WAY = np.linspace(0.7, 1, 31)  # of the displacement, where the whole ligament yields


def observe(run):
    moved = run.history("tool/end/position_y") - run.history("tool/end/position_y")[0]
    stress = np.abs(run.history("tool/ligament/force_y")) / (LIGAMENT * THICKNESS)
    return {"load": np.interp(WAY * moved[-1], moved, stress * np.sqrt(3) / ((2 + np.pi) * YIELD))}


def exact(observed):
    return Reference({"load": np.ones(len(WAY))}, {},
                     "(2 + pi)/sqrt 3 sigma_y on the ligament, slip-line field")


def errors(values, reference):
    return {"load": float(abs(np.mean(values["load"]) - 1))}


def problems(quick):
    grids = [Setting(f"{c} x {c * 3 // 2}", {"particle.quarter.mesh.columns": c,
                                             "particle.quarter.mesh.rows": c * 3 // 2})
             for c in ((10, 20) if quick else (10, 20, 60))]
    families = {"mesh": grids}
    if not quick:
        families |= {"duration": durations("pull", 0.4, (0.5, 2)), "safety": safeties((0.5, 0.99)),
                     "formulation": formulations()}
    return [Problem("double-edge-notch", "deep double-edge notch to its limit load",
                    "benchmark/double-edge-notch.toml", families, observe, exact, errors,
                    {"output.frames": 1})]
