"""The declaration of a benchmark problem, and families of settings shared by many of them.

A setting is a dict of overrides, {"time.safety": 0.5}: passed to the program as --set time.safety=0.5.
"""
from dataclasses import dataclass, field
from typing import Callable

import numpy as np


@dataclass(frozen=True)
class Setting:
    label: str
    overrides: dict = field(default_factory=dict)


@dataclass(frozen=True)
class Reference:
    values: dict         # name -> array, as `observe` gives them
    uncertainty: dict    # measure -> uncertainty of the reference itself, None if it is exact
    text: str            # its source


@dataclass(frozen=True)
class Problem:
    name: str
    title: str
    scene: str                 # path below scenes/
    families: dict             # name -> [Setting]; the scene as shipped is always run too
    observe: Callable          # (run) -> {name: array}: the compared data; stored with the run
    reference: Callable        # (observed: overrides -> {name: array}) -> Reference
    errors: Callable           # (values, reference values) -> {measure: share}
    always: dict = field(default_factory=dict)  # overrides of every run
    standard: bool = True      # run by default; the others take long


def meshes(particle, sizes, core="even"):
    """Mesh sizes of a disc: (edges, rings)."""
    key = f"particle.{particle}.mesh."
    return [Setting(f"{edges}/{rings}" + (" coarse" if core == "coarse" else ""),
                    {key + "boundary_edges": edges, key + "rings": rings, key + "core": f'"{core}"'})
            for edges, rings in sizes]


# Those of `accuracy` draft, standard and fine, with values in between.
COARSE_CORES = ((48, 0), (60, 0), (60, 1), (72, 1), (84, 1), (96, 2))


def coarse_cores(particle, sizes=COARSE_CORES):
    """Cores with a third of the edges of the outline."""
    return meshes(particle, sizes, "coarse")


def safeties(values=(0.25, 0.5, 0.75, 0.8, 0.95, 0.99)):
    return [Setting(f"{v:g}", {"time.safety": v}) for v in values]


def durations(stage, milliseconds, factors=(0.25, 0.5, 2, 4)):
    return [Setting(f"x {f:g}", {f"stage.{stage}.duration": f'"{milliseconds * f:.10g} ms"'})
            for f in factors]


def densities(material, kg_per_m3, factors=(3, 10, 30, 100)):
    return [Setting(f"x {f:g}", {f"material.{material}.density": f'"{kg_per_m3 * f:g} kg/m^3"'})
            for f in factors]


def stiffnesses(values=(0.35, 0.5, 1, 2, 5, 20, 40)):
    return [Setting(f"{v:g}", {"contact.stiffness": v}) for v in values]


SOFT = Setting("k 0.5", {"contact.stiffness": 0.5})


def soft(settings):
    """The same with soft contact springs, and surfaces that do not indent."""
    return [together(s, SOFT) for s in settings]


def skins(values=(0.1, 0.25, 1, 2)):
    return [Setting(f"{v:g}", {"contact.skin": v}) for v in values]


def formulations(values=("four-point", "standard")):
    return [Setting(v, {"element.formulation": f'"{v}"'}) for v in values]


def together(*settings):
    """Merges several settings: later ones win."""
    overrides = {}
    for setting in settings:
        overrides |= setting.overrides
    return Setting(", ".join(s.label for s in settings), overrides)


def interpolated(xs, ys, points):
    """Linear interpolation; xs is increasing except for noise at its ends."""
    return np.interp(points, np.maximum.accumulate(xs), ys)


def relative_rms(values, reference):
    return float(np.sqrt(np.mean((np.asarray(values) / np.asarray(reference) - 1) ** 2)))


def extrapolated(coarse, middle, fine, ratio=2.0):
    """Richardson extrapolation with the observed order, limited to 1 to 2, since noise has no order."""
    coarse, middle, fine = (np.asarray(v) for v in (coarse, middle, fine))
    shrink = np.linalg.norm(middle - coarse) / np.linalg.norm(fine - middle)
    order = min(max(np.log(shrink) / np.log(ratio), 1.0), 2.0)
    return fine + (fine - middle) / (ratio**order - 1), order


def own_series(observed, errors, settings, ratio=2.0):
    """Extrapolates the three finest meshes of the scene; uncertainty: distance from the finest."""
    runs = [observed(s.overrides) for s in settings]
    values, orders = {}, []
    for name in runs[0]:
        values[name], order = extrapolated(*(r[name] for r in runs), ratio=ratio)
        orders.append(f"{name} {order:.1f}")
    return Reference(values, errors(runs[-1], values),
                     f"own meshes {', '.join(s.label for s in settings)} extrapolated "
                     f"(order: {', '.join(orders)})")
