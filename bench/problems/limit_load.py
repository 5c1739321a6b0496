"""Limit loads of perfectly plastic bodies: a thick-walled cylinder, a deep double-edge notch (locking)."""
import numpy as np

from .problem import Problem, Reference, Setting, durations, formulations, safeties

YIELD, NOTCH_YIELD, THICKNESS = 240e6, 24e6, 1e-3  # Pa, Pa, m: of the scenes
INNER, OUTER = 10e-3, 20e-3     # m, of the cylinder
LIGAMENT = 2e-3                 # m, half of it: what the quarter holds
WAY = np.linspace(0.7, 1, 31)   # of the way, where all of it flows


def observe_cylinder(run):
    """Pressure in the bore over the limit at the bore's present radius; volume is kept."""
    moved = np.abs(run.history("tool/bore/position_x") - run.history("tool/bore/position_x")[0])
    inner = INNER + moved
    outer = np.sqrt(OUTER**2 - INNER**2 + inner**2)
    pressure = np.abs(run.history("tool/bore/force_x")) / (2 * np.pi * inner * THICKNESS)
    limit = 2 / np.sqrt(3) * YIELD * np.log(outer / inner)
    return {"load": np.interp(WAY * moved[-1], moved, pressure / limit)}


def observe_notch(run):
    moved = run.history("tool/end/position_y") - run.history("tool/end/position_y")[0]
    stress = np.abs(run.history("tool/ligament/force_y")) / (LIGAMENT * THICKNESS)
    return {"load": np.interp(WAY * moved[-1], moved, stress * np.sqrt(3) / ((2 + np.pi) * NOTCH_YIELD))}


def exact(text):
    return lambda observed: Reference({"load": np.ones(len(WAY))}, {}, text)


def errors(values, reference):
    return {"load": float(abs(np.mean(values["load"]) - 1))}


def problems(quick):
    rings = [Setting(f"{e}/{r}", {"particle.cylinder.mesh.boundary_edges": e,
                                  "particle.cylinder.mesh.rings": r})
             for e, r in ((16, 2), (24, 2), (80, 8), (160, 16))[:2 if quick else 4]]
    grids = [Setting(f"{c} x {c * 3 // 2}", {"particle.quarter.mesh.columns": c,
                                             "particle.quarter.mesh.rows": c * 3 // 2})
             for c in ((10, 20) if quick else (10, 20, 60))]
    cylinder = {"mesh": rings, "duration": durations("widen", 0.5), "safety": safeties((0.5, 0.99)),
                "formulation": formulations()}
    notch = {"mesh": grids, "duration": durations("pull", 0.4, (0.5, 2)), "safety": safeties((0.5, 0.99)),
             "formulation": formulations()}
    if quick:
        cylinder, notch = {"mesh": rings}, {"mesh": grids}
    return [Problem("thick-cylinder", "thick-walled cylinder, b/a = 2, to its limit load",
                    "benchmark/thick-cylinder.toml", cylinder, observe_cylinder,
                    exact("p = 2 sigma_y/sqrt 3 ln(b/a) at the present radii"), errors,
                    {"output.frames": 1}),
            Problem("double-edge-notch", "deep double-edge notch to its limit load",
                    "benchmark/double-edge-notch.toml", notch, observe_notch,
                    exact("(2 + pi)/sqrt 3 sigma_y on the ligament, slip-line field"), errors,
                    {"output.frames": 1})]
