"""Plastic spheres in three dimensions: one between platens, in a closing box, fourteen in a cell, twenty at random."""
import numpy as np

from .problem import Problem, Reference, Setting, durations, interpolated, relative_rms, soft, together

INDENTING = {"contact.stiffness": 40, "contact.hardness": 3}
HARD = {"contact.stiffness": 40, "contact.hardness": 1000}
STIFF_ONLY = Setting("k 10, no indentation", {"contact.stiffness": 10, "contact.hardness": 1000})


def meshes(sizes):
    """(divisions, rings) of the cubed sphere."""
    return [Setting(f"{d},{r}", {"particle.ball.mesh.divisions": d, "particle.ball.mesh.rings": r}) for d, r in sizes]


def finest(sizes):
    """Stiff springs on fine meshes, with surfaces that indent and without."""
    settings = [together(mesh, Setting(name, overrides)) for mesh in meshes(sizes)
                for name, overrides in (("k 40, indents", INDENTING), ("k 40, no indentation", HARD))]

    def make(observed):
        runs = [observed(s.overrides) for s in settings]
        values = {name: np.mean([run[name] for run in runs], axis=0) for name in runs[0]}
        apart = [errors(run, values) for run in runs]
        return Reference(values, {m: max(a[m] for a in apart) for m in apart[0]},
                         f"mean of {', '.join(s.label for s in settings)}; uncertainty: the farthest of them")
    return make


def errors(values, reference):
    return {name: relative_rms(values[name], reference[name]) for name in reference}


APPROACH = np.linspace(0.01, 0.195, 75)  # of each platen, over the radius


def slope_of_release(distance, force):
    """From 95 to 50% of the last force before the release: that of the largest compression."""
    turn = int(np.argmin(distance))
    down = force[turn:] / force[turn]
    first, last = (int(np.argmax(down < share)) for share in (0.95, 0.5))
    fit = np.polyfit(distance[turn:][first:last + 1], force[turn:][first:last + 1], 1)
    return np.array([-fit[0]])


def between_platens(run):
    top, bottom = run.history("tool/top/position_z"), run.history("tool/bottom/position_z")
    force = 0.5 * (run.history("tool/top/force_z") - run.history("tool/bottom/force_z"))
    pressed = slice(0, int(np.argmin(top)) + 1)
    approach = (1 - (top - bottom) / 10e-3)[pressed]
    return {"force": interpolated(approach, force[pressed], APPROACH), "slope": slope_of_release(top - bottom, force)}


def stress_at(densities, series):
    def observe(run):
        return {"stress": interpolated(run.history("relative_density"), run.history(series), densities)}
    return observe


def of_powder(run):
    density, top = run.history("relative_density"), run.history("tool/top/position_z")
    force = 0.5 * (run.history("tool/top/force_z") - run.history("tool/bottom/force_z"))
    pressed = slice(0, int(np.argmin(top)) + 1)
    return {"force": interpolated(density[pressed], force[pressed], np.linspace(0.65, 0.89, 25)),
            "slope": slope_of_release(top, force)}


def problems(quick):
    sizes = ((3, 1), (4, 1)) if quick else ((4, 1), (4, 4), (5, 1), (6, 1), (7, 1), (8, 1), (8, 2), (10, 2))
    every = meshes(sizes)
    standard = next((s for s in every if s.label == "7,1"), every[-1])

    def families(stage, milliseconds, values=(0.5, 2, 5, 20, 40)):
        found = {"mesh": every}
        if not quick:
            stiffness = [Setting(f"k {k:g}", {"contact.stiffness": k}) for k in values]
            found |= {"mesh, k 0.5": soft(every),
                      "mesh, k 10 without indentation": [together(m, STIFF_ONLY) for m in every],
                      "7,1: stiffness": [together(standard, s) for s in stiffness],
                      "7,1: duration": [together(standard, s) for s in durations(stage, milliseconds, (0.5, 2))],
                      "eight points": [together(m, Setting("eight-point", {"element.formulation": '"eight-point"'}))
                                       for m in every[:5]]}
        return found

    fine = ((3, 1), (4, 1)) if quick else ((12, 2), (16, 2))
    few, many = {"output.frames": 1}, {"output.frames": 1, "output.samples": 2000}
    turned = {"body[0].axis": "[1, 2, 3]", "body[0].angle": '"40 deg"'}
    return [
        Problem("sphere-platens", "sphere of 316L between platens, its mesh turned by 40 degrees about (1, 2, 3)",
                "compaction-3d/one-sphere.toml", families("press", 0.25), between_platens, finest(fine), errors,
                {**many, **turned}),
        Problem("sphere-box", "perfectly plastic sphere in a closing box, relative density 0.62 to 0.935",
                "compaction-3d/unit-cell-sc.toml", families("press", 0.4),
                stress_at(np.linspace(0.62, 0.935, 64), "stress_ratio/axial"), finest(fine), errors,
                {**many, "let.move": '"(D - D*(pi/6/0.94)^(1/3))/2"', "stage.press.duration": '"0.4 ms"'}),
        Problem("spheres-fcc", "fourteen spheres of a face-centred cubic cell in a closing box, relative density 0.6 to 0.84",
                "compaction-3d/unit-cell-fcc.toml", {"mesh": every[:5], "mesh, k 0.5": soft(every[:5])},
                stress_at(np.linspace(0.65, 0.84, 39), "stress_ratio/axial"),
                finest(((3, 1), (4, 1)) if quick else ((10, 2), (12, 2))), errors, few),
        Problem("powder-20", "twenty spheres of 316L at random in a die, pressed to a relative density of 0.9 and released",
                "compaction-3d/random-20-316L.toml",
                {"mesh": every[:5], "mesh, k 0.5": soft(every[:5])},
                of_powder, finest(((3, 1),) if quick else ((8, 2), (10, 2))), errors, many, standard=False)]
