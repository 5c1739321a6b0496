"""A disc in a periodic cell, pressed and released a little: the areal modulus of unloading."""
import numpy as np

from .problem import Problem, Reference, Setting, coarse_cores, meshes, soft, stiffnesses, together

STRAIN = 0.0012  # of the release, each axis, as in the scene
# Stiff springs on fine meshes, with surfaces that indent and without.
FINEST = [together(mesh, Setting(f"k {k}, C {c}", {"contact.stiffness": k, "contact.hardness": c}))
          for mesh in meshes("disc", ((120, 3), (160, 4))) for k in (40, 100) for c in (3, 1000)]


def observe(run):
    stress = 0.5 * (run.history("cell/stress_xx") + run.history("cell/stress_yy"))
    pressed = int(np.argmin(np.abs(run.history("time") - 1e-3)))
    return {"modulus": (stress[-1] - stress[pressed]) / (2 * STRAIN)}


def errors(values, reference):
    return {"modulus": abs(float(values["modulus"][0]) / float(reference["modulus"][0]) - 1)}


def reference(settings):
    def make(observed):
        all_values = [float(observed(s.overrides)["modulus"][0]) for s in settings]
        mean = float(np.mean(all_values))
        return Reference({"modulus": np.array([mean])}, {"modulus": float(np.ptp(all_values)) / 2 / mean},
                         f"mean of {len(settings)} runs with fine meshes and stiff springs: {mean / 1e9:.1f} GPa, "
                         f"from {min(all_values) / 1e9:.1f} to {max(all_values) / 1e9:.1f}")
    return make


def problems(quick):
    finest = [Setting("k 40", {"contact.stiffness": 40})] if quick else FINEST
    stiff = stiffnesses((0.5, 5) if quick else (0.5, 1, 2, 5, 10, 15, 20, 40, 100))
    cores = coarse_cores("disc")
    families = {"stiffness": stiff}
    if not quick:
        families |= {"coarse core": cores, "coarse core, soft": soft(cores),
                     "hardness": [Setting(f"C {c:g}", {"contact.hardness": c}) for c in (2, 3, 4, 1000)],
                     "no inerters": [together(Setting("c 0", {"contact.inertance": 0}), s) for s in stiff]}
    return [Problem("unloading-cell", "areal modulus of unloading of a disc in a periodic cell",
                    "periodic/release.toml", families, observe, reference(finest), errors,
                    {"output.frames": 1})]
