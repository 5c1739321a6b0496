"""Elastic wave in a bar: forces on both ends against d'Alembert's solution."""
import numpy as np

from .problem import (Problem, Reference, Setting, formulations, safeties, skins, stiffnesses,
                      together)

LENGTH, AREA, RHO, MODULUS = 0.1, 8e-6, 8000.0, 200e9  # as in the scene, SI
STAGE, WAY, RAMP = 80e-6, 0.078e-3, 0.025
C = np.sqrt(MODULUS / RHO)
TIME = np.linspace(0, 76e-6, 1521)


def speed(time):
    u = np.clip(time / (RAMP * STAGE), 0, 1)
    return WAY / STAGE / (1 - RAMP) * u**3 * (10 - 15 * u + 6 * u**2)


def reflected(first):
    """Arrivals of the wave at an end, each doubled by reflection at the rigid plane."""
    return 2 * sum(speed(TIME - (first + 2 * n) * LENGTH / C) for n in range(4))


def exact(observed):
    return Reference({"left": -RHO * C * AREA * (speed(TIME) + reflected(2)),
                      "right": RHO * C * AREA * reflected(1)}, {}, "d'Alembert's solution")


def observe(run):
    return {name: np.interp(TIME, run.history("time"), run.history(f"tool/{name}/force_x"))
            for name in ("left", "right")}


def errors(values, reference):
    return {name: float(np.linalg.norm(values[name] - reference[name]) /
                        np.linalg.norm(reference[name])) for name in values}


def meshes(columns):
    return [Setting(f"{c}", {"particle.bar.mesh.columns": c}) for c in columns]


def problems(quick):
    families = {"columns": meshes((25, 50) if quick else (25, 50, 200, 400, 800))}
    if not quick:
        families |= {"safety": safeties((0.25, 0.5, 0.75, 0.99)), "stiffness": stiffnesses((0.5, 1, 2, 10)),
                     "damping": [Setting(f"{v:g}", {"contact.damping": v}) for v in (0.1, 0.3, 1)],
                     "skin": skins((0.25, 2)), "formulation": formulations(),
                     "columns, stiffness": [together(m, s) for m in meshes((200, 400))
                                            for s in stiffnesses((0.5, 1, 10))]}
    return [Problem("bar-wave", "wave in an elastic bar between rigid planes",
                    "benchmark/bar-wave.toml", families, observe, exact, errors,
                    {"output.frames": 1, "output.samples": 4000})]
