"""Die compaction of one disc: axial and lateral stress at relative densities of 0.80 to 0.95."""
import numpy as np

from .problem import (Problem, Reference, coarse_cores, densities, durations, formulations, interpolated, meshes,
                      own_series, relative_rms, safeties, skins, soft, stiffnesses, together)

DENSITY = np.linspace(0.80, 0.95, 61)
# Exact unit cell of the frictionless square packing, perfectly plastic (axial +-3 %, lateral +-10 %).
TABLE = {0.80: (0.45, 0.10), 0.82: (0.62, 0.30), 0.85: (0.78, 0.47), 0.90: (1.10, 0.73),
         0.95: (1.44, 1.00)}


def observe(run):
    density = run.history("relative_density")
    return {name: interpolated(density, run.history(f"stress_ratio/{name}"), DENSITY)
            for name in ("axial", "lateral")}


def errors(values, reference):
    return {name: relative_rms(values[name], reference[name]) for name in ("axial", "lateral")}


def reference(finest, table):
    def make(observed):
        own = own_series(observed, errors, finest)
        if not table:
            return own
        apart = [relative_rms(np.interp(list(TABLE), DENSITY, own.values[name]),
                              [pair[i] for pair in TABLE.values()])
                 for i, name in enumerate(("axial", "lateral"))]
        return Reference(own.values, own.uncertainty, own.text +
                         f"; from the exact cell's table {100 * apart[0]:.1f} % "
                         f"(axial), {100 * apart[1]:.1f} % (lateral)")
    return make


def problems(quick):
    sizes = ((12, 1), (16, 1)) if quick else ((16, 1), (20, 1), (24, 1), (32, 1), (40, 1), (48, 1),
                                              (60, 2), (80, 2), (120, 3))
    finest = meshes("disc", ((12, 1), (16, 1), (20, 1)) if quick else ((40, 1), (80, 2), (160, 4)))
    mesh = {s.label: s for s in meshes("disc", sizes)}
    speed = {s.label: s for s in durations("press", 1)}
    density = {s.label: s for s in densities("316L", 7990)}
    families = {"mesh": list(mesh.values())}
    if not quick:
        families |= {
            "coarse core": coarse_cores("disc"), "coarse core, soft": soft(coarse_cores("disc")),
            "safety": safeties(), "duration": list(speed.values()), "density": list(density.values()),
            "stiffness": stiffnesses(), "skin": skins(), "formulation": formulations(),
            "mesh, faster": [together(mesh[m], speed[f]) for m in ("24/1", "32/1", "60/2", "80/2")
                             for f in ("x 0.5", "x 0.25")],
            "mesh, stiffness": [together(mesh["80/2"], s) for s in stiffnesses((0.5, 2, 40))]}
    kinds = {"unit-cell": ("perfectly plastic", {}),
             "unit-cell-hardening": ("H = 440 MPa",
                                     {"material.316L.hardening_modulus": '"440 MPa"'})}
    return [Problem(name, f"unit cell of the square packing in a die, {text}",
                    "compaction/unit-cell.toml", families, observe,
                    reference(finest, not always), errors,
                    {"output.frames": 1, **always})
            for name, (text, always) in kinds.items()]
