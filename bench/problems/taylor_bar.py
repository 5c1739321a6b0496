"""Taylor impact of a copper slab: final length, and width of the mushroomed end."""
import numpy as np

from .problem import Problem, Setting, formulations, own_series, safeties, skins, stiffnesses, together


def observe(run):
    """Means over the last quarter of the run, when the bar has rebounded and only vibrates."""
    frames = [run.frame("position", -1 - i)[1] for i in range(10)]
    return {"length": np.array([np.mean([np.ptp(x[:, 1]) for x in frames])]),
            "width": np.array([np.mean([np.ptp(x[:, 0]) for x in frames])])}


def errors(values, reference):
    return {name: float(abs(values[name][0] / reference[name][0] - 1)) for name in values}


def meshes(columns):
    return [Setting(f"{c} x {c * 10 // 3}", {"particle.bar.mesh.columns": c,
                                             "particle.bar.mesh.rows": c * 10 // 3})
            for c in columns]


def problems(quick):
    finest = meshes((6, 9, 12)) if quick else meshes((12, 24, 48))
    families = {"mesh": meshes((6, 9)) if quick else meshes((6, 9, 15, 18, 24, 36))}
    if not quick:
        families |= {"safety": safeties(), "stiffness": stiffnesses((0.35, 0.5, 1, 4)),
                     "damping": [Setting(f"{v:g}", {"contact.damping": v}) for v in (0, 0.3, 1)],
                     "skin": skins(), "formulation": formulations(),
                     "mesh, safety": [together(m, s) for m in meshes((6, 9, 24))
                                      for s in safeties((0.5, 0.25))]}
    return [Problem("taylor-bar", "Taylor impact of a copper slab, plane strain, 150 m/s",
                    "benchmark/taylor-bar.toml", families, observe,
                    lambda observed: own_series(observed, errors, finest), errors,
                    {"output.frames": 40})]
