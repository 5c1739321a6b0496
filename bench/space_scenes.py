"""Generates and runs 3D scenes for space_laws.py and space_powders.py."""
import csv
import math
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent

STEEL = """
[[material]]
name = "m"
density = "7990 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
"""
PLASTIC = STEEL + 'yield_stress = "240 MPa"\nhardening_modulus = "440 MPa"\n'


def head(title, material):
    return f'family = "compaction"\ndimension = 3\ntitle = "{title}"\n{material}'


def ball(diameter, divisions, rings, phase=""):
    return (f'\n[[particle]]\nname = "ball"\nmaterial = "m"\nshape = "sphere"\ndiameter = "{diameter} m"\n'
            f'[particle.mesh]\ndivisions = {divisions}\nrings = {rings}\n{phase}')


def body(x, y, z, particle="ball", more=""):
    return f'\n[[body]]\nparticle = "{particle}"\nposition = ["{x} m", "{y} m", "{z} m"]\n{more}'


def plane(name, point, normal):
    p = ", ".join(f'"{c} m"' for c in point)
    return f'\n[[tool]]\nname = "{name}"\nshape = "plane"\npoint = [{p}]\nnormal = {list(normal)}\n'


def stage(duration, moves, kind="compact", name="press", ramp=0.3):
    text = f'\n[[stage]]\nname = "{name}"\nkind = "{kind}"\nduration = "{duration} s"\n'
    for tool, d in moves.items():
        p = ", ".join(f'"{c} m"' for c in d)
        text += f'[[stage.move]]\ntool = "{tool}"\ndisplacement = [{p}]\nramp = {ramp}\n'
    return text


def contact(**keys):
    return "\n[contact]\n" + "".join(f"{k} = {v}\n" for k, v in keys.items())


OUTPUT = '\n[output]\nframes = 4\nsamples = 200\n[limits]\nenergy_balance = 0.02\n'


class Bench:
    def __init__(self, program, folder, rounds):
        self.program, self.folder, self.rounds = program, folder, rounds
        folder.mkdir(parents=True, exist_ok=True)

    def run(self, name, text, *options):
        """History of the scene as arrays by series name, without units."""
        scene = self.folder / f"{name}.toml"
        scene.write_text(text, encoding="utf-8")
        result = subprocess.run([self.program, "run", scene, "-o", self.folder / name, "--overwrite", *options],
                                capture_output=True, text=True)
        if result.returncode:
            sys.exit(f"{name}: exit {result.returncode}\n{result.stdout[-2000:]}{result.stderr[-2000:]}")
        with open(self.folder / name / "history.csv", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        data = np.array([[float(v) if v else math.nan for v in row] for row in rows[1:]])
        return {title.split(" [")[0]: data[:, i] for i, title in enumerate(rows[0])}
