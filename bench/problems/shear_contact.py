"""Partial slip of two pressed discs: friction work as the tangential force increases."""
import numpy as np

from .problem import (Problem, Reference, Setting, formulations, relative_rms, safeties,
                      stiffnesses)

R, MODULUS, THICKNESS, FRICTION = 2.5e-3, 200e9 / (1 - 0.3**2) / 2, 1e-3, 0.2  # of the pair, SI
SHARE = np.linspace(0.3, 0.6, 31)  # Q/(mu P)


def theory(load, share):
    """Work dissipated up to Q = share mu P, J: slip s(x) = 2 mu p0/(E* a) int_c sqrt(t^2 - c^2) dt of
    Cattaneo and Mindlin, times mu p(x), over c < |x| < a; slip increases monotonically."""
    per_thickness = load / THICKNESS
    a = np.sqrt(4 * per_thickness * R / (np.pi * MODULUS))
    p0 = 2 * per_thickness / (np.pi * a)
    x = np.linspace(a * np.sqrt(1 - share), a, 4001)
    rate = 2 * FRICTION * p0 / (MODULUS * a) * np.sqrt(np.maximum(x**2 - x[0]**2, 0))
    slip = np.concatenate([[0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(x))])
    return 2 * THICKNESS * np.trapz(FRICTION * p0 * np.sqrt(np.maximum(1 - (x / a)**2, 0)) * slip, x)


def observe(run):
    """Forces are averaged over both constraints: the shear wave travels between them."""
    shear = run.history("time") > 0.2 * run.history("time")[-1]  # the first fifth is for pressing
    load = 0.5 * (run.history("tool/head/force_y") - run.history("tool/base/force_y"))[shear]
    force = 0.5 * (run.history("tool/base/force_x") - run.history("tool/head/force_x"))[shear]
    share = np.maximum.accumulate(force / (FRICTION * load))
    work = np.interp(SHARE, share, run.history("energy/friction")[shear])
    return {"work": work / [theory(np.mean(load), s) for s in SHARE]}


def exact(observed):
    return Reference({"work": np.ones(len(SHARE))}, {}, "Cattaneo (1938), Mindlin (1949)")


def errors(values, reference):
    return {"work": relative_rms(values["work"], reference["work"])}


def meshes(sizes):
    key = "particle.disc.mesh."
    return [Setting(f"{e}/{r}/{f}", {key + "boundary_edges": e, key + "rings": r,
                                     key + "refinement": f}) for e, r, f in sizes]


def problems(quick):
    families = {"mesh (edges/rings/refinement)":
                meshes([(32, 2, 8), (48, 4, 24)] if quick else
                       [(32, 2, 16), (48, 4, 12), (48, 4, 24), (64, 4, 16), (96, 8, 48)])}
    if not quick:
        slower = [Setting(f"x {f}", {"stage.press.duration": f'"{0.02 * f} ms"',
                                     "stage.shear.duration": f'"{0.08 * f} ms"'}) for f in (0.5,)]
        families |= {"duration": slower, "safety": safeties((0.5,)),
                     "stiffness": stiffnesses((1, 8)), "formulation": formulations()}
    return [Problem("partial-slip", "partial slip of two pressed discs (Cattaneo, Mindlin)",
                    "benchmark/cattaneo-mindlin.toml", families, observe, exact, errors,
                    {"output.frames": 1, "output.samples": 2000})]
