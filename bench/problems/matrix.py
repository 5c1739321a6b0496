"""Compaction of a regular matrix by 10 %: force on the top punch against its travel."""
import numpy as np

from .problem import (Problem, Reference, coarse_cores, densities, durations, formulations, interpolated, meshes,
                      safeties, skins, soft, stiffnesses, together)

COMPRESSION = np.linspace(0.001, 0.10, 100)
MATERIALS = {"": ("316L", 7990), "-cu": ("OFHC-Cu", 8940)}


def observe(run):
    y = run.history("tool/top/position_y")
    return {"force": interpolated(1 - y / y[0], run.history("tool/top/force_y"), COMPRESSION)}


def errors(values, reference):
    """L2 norm over the whole travel; largest error beyond 1 % compression, relative to the local force."""
    difference = values["force"] - reference["force"]
    beyond = COMPRESSION > 0.01
    return {"L2": float(np.linalg.norm(difference) / np.linalg.norm(reference["force"])),
            "largest": float(np.max(np.abs(difference / reference["force"])[beyond]))}


def finest(settings):
    """The finest affordable mesh; its uncertainty is a third of the change to it."""
    def make(observed):
        *_, middle, fine = [observed(s.overrides) for s in settings]
        uncertain = {m: e / 3 for m, e in errors(middle, fine).items()}
        return Reference(fine, uncertain, f"own mesh {settings[-1].label}, uncertain by a third of "
                                          f"its distance from {settings[-2].label}")
    return make


# Safeties that give 100 discs (25: half as many) the numbers of steps in Table 5.3 of the thesis.
TABLE_5_3 = {"": (0.66, 0.38, 0.316), "-cu": (0.708, 0.454, 0.344)}


def small(suffix, quick):
    """25 discs: cheap enough for every family."""
    material, rho = MATERIALS[suffix]
    if quick:
        families = {"mesh": meshes("disc", ((12, 1), (16, 1)))}
        fine = ((12, 1), (16, 1))
    else:
        mesh = {s.label: s for s in meshes("disc", ((16, 1), (20, 1), (24, 1), (32, 1), (40, 1),
                                                    (48, 1), (60, 2), (80, 2)))}
        fine = ((80, 2), (120, 3)) if not suffix else ((60, 2), (80, 2))
        families = {"mesh": list(mesh.values()), "coarse core": coarse_cores("disc"),
                    "coarse core, soft": soft(coarse_cores("disc")), "duration": durations("press", 2.8, (0.25, 0.5, 2)),
                    "density": densities(material, rho, (4, 16, 100)),
                    "safety": safeties((*TABLE_5_3[suffix], 0.99))}
        if not suffix:
            four_point = formulations(("four-point",))[0]
            coarse = {s.label: s for s in families["coarse core"]}
            families["coarse core, faster"] = [
                together(coarse[m], s) for m in ("60/1 coarse", "72/1 coarse", "84/1 coarse")
                for s in durations("press", 2.8, (0.5,))]
            families |= {"stiffness": stiffnesses((0.5, 2, 5, 20)),
                         "skin": skins((0.25, 1)), "formulation": formulations(),
                         "mesh, formulation": [together(mesh[m], four_point) for m in ("48/1", "60/2")] +
                         [together(coarse["72/1 coarse"], four_point)],
                         "mesh, density": [together(mesh[m], s) for m in ("24/1", "32/1", "60/2")
                                           for s in densities(material, rho, (4, 16))]}
    return Problem(f"matrix-25{suffix}", f"regular matrix of 25 discs, {material}",
                   f"compaction/regular-25{suffix}.toml", families, observe,
                   finest(meshes("disc", fine)), errors, {"output.frames": 1})


def large(suffix, quick):
    """100 discs: the thesis case, and its time-step study."""
    material, rho = MATERIALS[suffix]
    sizes = ((12, 1), (16, 1)) if quick else ((32, 1), (40, 1), (60, 2), (80, 2))
    families = {"mesh": meshes("disc", sizes)}
    if not quick:
        families["coarse core"] = coarse_cores("disc", ((48, 0), (60, 1), (72, 1)))
        faster = durations("press", 5.6, (0.5,))
        families["coarse core, faster"] = [
            together(s, faster[0]) for s in coarse_cores("disc", ((60, 1), (72, 1), (84, 1)))]
        if not suffix:
            four_point = formulations(("four-point",))[0]
            families["mesh, formulation"] = [
                together(s, four_point) for s in (*meshes("disc", ((40, 1), (60, 2))),
                                                  *coarse_cores("disc", ((72, 1),)))]
    return Problem(f"matrix-100{suffix}", f"regular matrix of 100 discs, {material}",
                   f"compaction/regular-100{suffix}.toml", families, observe,
                   finest(meshes("disc", sizes[-2:])), errors, {"output.frames": 1}, standard=False)


def problems(quick):
    return [make(suffix, quick) for make in (small, large) for suffix in MATERIALS]
