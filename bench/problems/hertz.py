"""Hertz line contact: load of an elastic disc between platens against their approach."""
import numpy as np

from .problem import (Problem, Reference, Setting, densities, durations, formulations, interpolated,
                      relative_rms, safeties, skins, stiffnesses, together)

R, MODULUS, THICKNESS = 5e-3, 200e9 / (1 - 0.3**2), 1e-3  # m, Pa, m: as in the scene
APPROACH = np.linspace(0.015e-3, 0.039e-3, 49)  # m, of both platens together; the scene ends at 0.04


def observe(run):
    way = 2 * R - run.history("tool/top/position_y") + run.history("tool/bottom/position_y")
    force = 0.5 * (run.history("tool/top/force_y") - run.history("tool/bottom/force_y"))
    return {"load": interpolated(way, force / THICKNESS, APPROACH)}


def closed_form(observed):
    """Johnson (1985), 4.45 and 5.57; the platens' approach rises with the load."""
    load = np.geomspace(1e3, 1e7, 4000)  # N/m
    half_width = np.sqrt(4 * load * R / (np.pi * MODULUS))
    approach = 2 * load / (np.pi * MODULUS) * (2 * np.log(4 * R / half_width) - 1)
    return Reference({"load": np.interp(APPROACH, approach, load)}, {},
                     "closed form, Johnson (1985) eq. 5.57")


def errors(values, reference):
    return {"load": relative_rms(values["load"], reference["load"])}


def meshes(sizes):
    return [Setting(f"{edges}/{rings}/{fine}", {"particle.disc.mesh.boundary_edges": edges,
                                                "particle.disc.mesh.rings": rings,
                                                "particle.disc.mesh.refinement": fine})
            for edges, rings, fine in sizes]


def problems(quick):
    families = {"mesh (edges/rings/refinement)":
                meshes([(16, 1, 4), (24, 1, 8)] if quick else
                       [(32, 2, 8), (48, 4, 12), (48, 4, 24), (64, 4, 32), (96, 8, 16), (96, 8, 32)])}
    if not quick:
        coarse = meshes([(48, 4, 24)])[0]
        families |= {"safety": safeties((0.5, 0.99)), "duration": durations("press", 0.08, (0.5, 2)),
                     "density": densities("steel", 7850, (4, 16, 100)),
                     "stiffness": stiffnesses((0.5, 1, 2, 8)), "skin": skins((0.25, 1)),
                     "formulation": formulations(),
                     "48/4/24, stiffness": [together(coarse, s) for s in stiffnesses((0.5, 1, 2, 8))]}
    return [Problem("hertz", "elastic disc between platens", "basic/disc-platens.toml", families,
                    observe, closed_form, errors, {"output.frames": 1})]
