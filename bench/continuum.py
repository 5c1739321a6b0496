"""Powders of spheres in three dimensions as a continuum: against published laws, and by how much the number of particles, the
mesh and the speed change them. Prints tables of docs/accuracy.md.

  /usr/bin/python3 bench/continuum.py isostatic     pressure and coordination number against Fleck, Kuhn & McMeeking 1992
  /usr/bin/python3 bench/continuum.py triaxial      twelve spheres in a closing box on three meshes
  /usr/bin/python3 bench/continuum.py convergence   a die: particles, mesh, speed, seeds
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/cli/pulvis"
DIE = ROOT / "scenes/periodic/cap-spheres-die.toml"


def run(scene, settings, threads=1):
    """Its series, and its summary."""
    with tempfile.TemporaryDirectory() as folder:
        words = [PROGRAM, "run", scene, "-o", folder + "/run", "--threads", str(threads)]
        for setting in ["output.frames=1", "output.samples=300", "output.contacts=true", *settings]:
            words += ["--set", setting]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 3):
            sys.exit(done.stderr)
        with h5py.File(folder + "/run/run.h5") as file:
            history = {}
            file["history"].visititems(lambda name, one: history.update({name: one[:]}) if isinstance(one, h5py.Dataset) else None)
        return history, json.loads(pathlib.Path(folder, "run/summary.json").read_text())


def at(history, density, series):
    return float(np.interp(density, history["relative_density"], series))


def in_cell(count, side):
    """Settings for so many spheres of 1 mm in a cell of this width and depth, mm."""
    return [f"packing[0].class[0].number={count}", f'cell.width="{side} mm"', f'cell.depth="{side} mm"',
            f'packing[0].width="{side} mm"', f'packing[0].depth="{side} mm"']


def pressure(history):
    return -sum(history[f"cell/stress_{part}"] for part in ("xx", "yy", "zz")) / 3


def isostatic():
    """p = 2.97 rho^2 (rho - rho_0)/(1 - rho_0) sigma_y, rho_0 = 0.64; Z = 12 rho in stage I (Fleck, Kuhn & McMeeking 1992)."""
    densities = (0.68, 0.70, 0.72, 0.74, 0.76, 0.78, 0.80, 0.82, 0.85)
    sigma_y, start = 50e6, 0.64
    print("60 spheres, perfectly plastic, E/sigma_y = 2300, pressed isostatically: p/sigma_y, and coordination number Z")
    print("friction  seed  " + "  ".join(f"{d:11.2f}" for d in densities))
    law = [2.97 * d * d * (d - start) / (1 - start) for d in densities]
    print("law             " + "  ".join(f"{p:5.3f} {12 * d:5.2f}" for p, d in zip(law, densities)))
    for friction in (0, 0.2):
        for seed in (1, 2):
            strain = math.log(0.6 / 0.87) / 3
            cell = [f"stage[0].cell.strain_{part}={strain:.6f}" for part in ("xx", "yy", "zz")]
            history, _ = run(DIE, [*cell, f"seed={seed}", f"contact.friction={friction}", "material.Cu.hardening_modulus=\"0 Pa\""])
            p, z = pressure(history) / sigma_y, history["network/coordination"]
            print(f"{friction:8}  {seed:4}  " + "  ".join(f"{at(history, d, p):5.3f} {at(history, d, z):5.2f}" for d in densities))


def triaxial():
    densities = (0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.78)
    print("twelve spheres in a closing box: mean pressure on the planes over sigma_y at relative densities")
    print("mesh   elements  steps  " + "  ".join(f"{d:6}" for d in densities))
    for divisions, rings in ((4, 1), (7, 1), (10, 2)):
        mesh = [f"particle.{name}.mesh.{key}={value}" for name in ("small", "medium", "large")
                for key, value in (("divisions", divisions), ("rings", rings))]
        history, summary = run(ROOT / "scenes/compaction-3d/triaxial-12.toml", mesh)
        side = 3 - 2 * np.interp(history["time"], history["time"], history["tool/left/position_x"] + 1.5)
        force = sum(abs(history[f"tool/{wall}/force_{axis}"]) for wall, axis in
                    (("left", "x"), ("right", "x"), ("front", "y"), ("back", "y"), ("bottom", "z"), ("top", "z"))) / 6
        p = force / side**2 / 50e6
        print(f"{f'{divisions},{rings}':5}  {summary['elements']:8}  {summary['steps']:5}  " +
              "  ".join(f"{at(history, d, p):6.3f}" for d in densities), flush=True)


def convergence():
    densities = (0.7, 0.8, 0.9)
    print("copper spheres pressed in a die: axial stress / lateral over axial stress at relative densities, and processor time")
    print("case                     " + "  ".join(f"{d:13}" for d in densities) + "   steps   wall, s")
    base = ['stage[0].cell.strain_zz=-0.42', 'stage[0].duration="0.2 ms"']
    cases = [("60 spheres", [])]
    cases += [(f"60 spheres, seed {seed}", [f"seed={seed}"]) for seed in (2, 3)]
    for count, side in ((30, 3), (120, 4.8)):
        cases += [(f"{count} spheres", in_cell(count, side))]
    cases += [("60 spheres, half speed", ['stage[0].duration="0.4 ms"']), ("60 spheres, double speed", ['stage[0].duration="0.1 ms"']),
              *((f"60 spheres, mesh {divisions},1", [f"particle.ball.mesh.divisions={divisions}"]) for divisions in (6,))]
    for name, settings in cases:
        history, summary = run(DIE, [*base, *settings])
        axial = -history["cell/stress_zz"]
        lateral = -0.5 * (history["cell/stress_xx"] + history["cell/stress_yy"])
        cells = [f"{at(history, d, axial) / 1e6:7.2f} {at(history, d, lateral) / at(history, d, axial):5.3f}" for d in densities]
        print(f"{name:25}" + "  ".join(cells) + f"  {summary['steps']:6}  {summary['wall_seconds']:8.0f}", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("isostatic", "triaxial", "convergence"))
    {"isostatic": isostatic, "triaxial": triaxial, "convergence": convergence}[parser.parse_args().what]()
