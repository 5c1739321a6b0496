"""Error of the compaction scenes against run time, mesh and mesh phase; prints the tables in bench/results/unit-cell.md.

  /usr/bin/python3 bench/accuracy.py [cells] [phases] [matrix] [formulations]      (all: about six minutes)

The reference is the exact unit cell of the frictionless square packing (quarter disc between rigid
planes, plane strain, perfectly plastic; axial +-3 %, lateral +-10 %).
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/cli/pulvis"
REFERENCE = {0.80: (0.45, 0.10), 0.82: (0.62, 0.30), 0.85: (0.78, 0.47), 0.90: (1.10, 0.73),
             0.95: (1.44, 1.00)}
DENSITIES = [0.80 + 0.001 * i for i in range(61)]  # at which mesh phases are compared


def run(scene, overrides=(), threads=1):
    """Runs a scene; returns (density, axial, lateral) as lists, and the summary."""
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", ROOT / "scenes/compaction" / scene, "-o", f"{folder}/run",
                   "--threads", str(threads), "--set", "output.frames=1"]
        for override in overrides:
            command += ["--set", override]
        subprocess.run(command, check=True, capture_output=True)
        with open(f"{folder}/run/history.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        summary = json.loads(pathlib.Path(f"{folder}/run/summary.json").read_text())
    names = ("relative_density", "stress_ratio/axial", "stress_ratio/lateral")
    return [[float(row[f"{name} [-]"]) for row in rows] for name in names], summary


def at(xs, ys, x):
    for i in range(1, len(xs)):
        if xs[i] >= x:
            return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1])
    return ys[-1]


def errors(curve):
    """Errors relative to the exact unit cell: axial, then lateral."""
    return [f"{100 * (at(curve[0], curve[1 + k], d) / REFERENCE[d][k] - 1):+.1f}%" for k in (0, 1) for d in REFERENCE]


def cells():
    print("| mesh: edges, rings | quads | wall s | dt ns | " +
          " | ".join(f"axial {d:.2f}" for d in REFERENCE) + " | " +
          " | ".join(f"lateral {d:.2f}" for d in REFERENCE) + " |")
    print("|" + "---|" * 14)
    print("| exact, stress over yield stress | | | | " +
          " | ".join(f"{REFERENCE[d][k]:.2f}" for k in (0, 1) for d in REFERENCE) + " |")
    for name, edges, rings, core in (
            ("", 20, 1, "even"), ("as shipped: ", 40, 1, "even"), ("", 80, 2, "even"),
            ("", 160, 4, "even"), ("`draft`: ", 48, 0, "coarse"), ("`standard`: ", 72, 1, "coarse"),
            ("`fine`: ", 96, 2, "coarse")):
        curve, summary = run("unit-cell.toml", (f"particle.disc.mesh.boundary_edges={edges}",
                                                f"particle.disc.mesh.rings={rings}",
                                                f"particle.disc.mesh.core={core}"))
        label = f"{name}{edges}, {rings}" + (", coarse core" if core == "coarse" else "")
        cells_of = [label, str(summary["elements"]), f"{summary['wall_seconds']:.1f}",
                    f"{1e9 * summary['time'] / summary['steps']:.0f}"]
        print("| " + " | ".join(cells_of + errors(curve)) + " |", flush=True)


def formulations():
    """The unit cell with every element formulation: errors, and the minimum wall time of three runs."""
    print("| formulation | quads | wall s | " +
          " | ".join(f"axial {d:.2f}" for d in REFERENCE) + " | " +
          " | ".join(f"lateral {d:.2f}" for d in REFERENCE) + " |")
    print("|" + "---|" * 13)
    for edges, rings in ((20, 1), (40, 1), (80, 2)):
        names = ("four-point", "one-point", "standard")
        runs = {name: [] for name in names}
        for _ in range(3):  # interleaved: machine load affects all equally
            for name in names:
                runs[name].append(run("unit-cell.toml", (
                    f"particle.disc.mesh.boundary_edges={edges}",
                    f"particle.disc.mesh.rings={rings}", f"element.formulation={name}")))
        for name, of_name in runs.items():
            curve, summary = of_name[0]
            wall = min(s["wall_seconds"] for _, s in of_name)
            print(f"| {name} | {summary['elements']} | {wall:.2f} | " + " | ".join(errors(curve)) + " |",
                  flush=True)


def rms(curve, other):
    return math.sqrt(sum((a / b - 1) ** 2 for a, b in zip(curve, other)) / len(curve))


def axial(scene, overrides, threads=1):
    curve, _ = run(scene, overrides, threads)
    return [at(curve[0], curve[1], d) for d in DENSITIES]


def phases():
    print("| scene | turned as | rms from the unturned mesh, each run | all | rms about the mean |")
    print("|---|---|---|---|---|")
    for scene in ("unit-cell.toml", "unit-cell-fine.toml", "column.toml"):
        unturned = axial(scene, ())
        quarters = 4.5 if "fine" in scene else 9
        turns = {"quarters of an edge": [f'particle.disc.mesh.phase="{quarters * q / 4} deg"'
                                         for q in (1, 2, 3)],
                 "random, 6 seeds": [f"seed={seed}" for seed in range(1, 7)]}
        for name, overrides in turns.items():
            extra = ['particle.disc.mesh.phase="random"'] if "seed" in overrides[0] else []
            curves = [axial(scene, [*extra, o]) for o in overrides]
            family = curves + ([unturned] if not extra else [])
            mean = [sum(values) / len(family) for values in zip(*family)]
            each = [rms(c, unturned) for c in curves]
            about = math.sqrt(sum(rms(c, mean) ** 2 for c in family) / len(family))
            together = math.sqrt(sum(e * e for e in each) / len(each))
            print(f"| {scene} | {name} | {', '.join(f'{100 * e:.1f}' for e in each)} % | "
                  f"{100 * together:.1f} % | {100 * about:.1f} % |", flush=True)


def matrix():
    turned = 'particle.disc.mesh.phase="random"'
    for scene in ("regular-100.toml", "regular-100-cu.toml"):
        unturned = axial(scene, (), 2)
        difference = rms(axial(scene, (turned,), 2), unturned)
        print(f"{scene}: turned by random angles, {100 * difference:.1f} % rms from the unturned run")


if __name__ == "__main__":
    for task in sys.argv[1:] or ["cells", "phases", "matrix", "formulations"]:
        {"cells": cells, "phases": phases, "matrix": matrix,
         "formulations": formulations}[task]()
