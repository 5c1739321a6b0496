"""A disc of 316L crushed by a tenth of its diameter between platens: force against compression."""
import numpy as np

from .problem import (coarse_cores, Problem, densities, durations, formulations, interpolated, meshes, own_series,
                      relative_rms, safeties, skins, soft, stiffnesses)

COMPRESSION = np.linspace(0.01, 0.10, 61)
DIAMETER = 10e-3  # m, as in the scene


def observe(run):
    gap = run.history("tool/top/position_y") - run.history("tool/bottom/position_y")
    force = 0.5 * (run.history("tool/top/force_y") - run.history("tool/bottom/force_y"))
    return {"force": interpolated(1 - gap / DIAMETER, force, COMPRESSION)}


def errors(values, reference):
    return {"force": relative_rms(values["force"], reference["force"])}


def problems(quick):
    sizes = ((12, 1), (16, 1)) if quick else ((16, 1), (20, 1), (24, 1), (32, 1), (40, 1), (48, 1),
                                              (60, 2), (80, 2), (120, 3))
    finest = meshes("disc", ((12, 1), (16, 1), (20, 1)) if quick else ((40, 1), (80, 2), (160, 4)))
    families = {"mesh": meshes("disc", sizes)}
    if not quick:
        families |= {"coarse core": coarse_cores("disc"), "coarse core, soft": soft(coarse_cores("disc")),
                     "safety": safeties(), "duration": durations("press", 0.6),
                     "density": densities("316L", 7990), "stiffness": stiffnesses(),
                     "skin": skins(), "formulation": formulations()}
    return [Problem(f"crushed-disc-mu{friction:g}",
                    f"disc of 316L crushed by 10 % between platens, friction {friction:g}",
                    "benchmark/crushed-disc.toml", families, observe,
                    lambda observed: own_series(observed, errors, finest), errors,
                    {"output.frames": 1, "contact.friction": friction})
            for friction in (0, 0.1)]
