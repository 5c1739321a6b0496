"""Force on a block pressed onto a ridge, against the position of the ridge between two boundary nodes:
how well the sampling points of an edge resolve a corner of a tool. Prints the table in docs/accuracy.md.

  /usr/bin/python3 bench/ridge.py      (about a minute)

Edges of 0.5 mm, a ridge of 90 degrees; the depth is that of the rounded ridge in the undeformed block.
"""
import csv
import math
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/cli/pulvis"
EDGE = 0.5  # mm
SHIFTS = [0, 0.125, 0.25, 0.375, 0.5]  # in edge lengths
ROUNDINGS = [0, 0.1, 0.2, 0.5, 1]
DEPTHS = [0.02, 0.1]

SCENE = """family = "compaction"
title = "Block on a ridge"
[[material]]
name = "steel"
density = "7850 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
[[particle]]
name = "block"
material = "steel"
outline = "rectangle"
width = "10 mm"
height = "5 mm"
[particle.mesh]
columns = 20
rows = 10
[[body]]
particle = "block"
position = ["0 mm", "2.5 mm"]
[[tool]]
name = "ridge"
shape = "polyline"
points = [["{left} mm", "-5 mm"], ["{middle} mm", "0 mm"], ["{right} mm", "-5 mm"]]
rounding = "{rounding} mm"
[[tool]]
name = "clamp"
shape = "constraint"
low = ["-5 mm", "5 mm"]
high = ["5 mm", "5 mm"]
holds = "both"
[[stage]]
name = "press"
kind = "compact"
duration = "0.15 ms"
[[stage.move]]
tool = "clamp"
displacement = ["0 mm", "-{travel} mm"]
ramp = 0.5
[[stage]]
name = "rest"
kind = "hold"
duration = "0.02 ms"
[contact]
damping = 0.5
[output]
frames = 1
samples = 100
"""


def force(shift, rounding, depth):
    """Mean force of the last samples, N."""
    middle = EDGE * shift
    scene = SCENE.format(left=middle - 5, middle=middle, right=middle + 5, rounding=EDGE * rounding,
                         travel=EDGE * (depth + rounding * (math.sqrt(2) - 1)))
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "ridge.toml"
        file.write_text(scene)
        subprocess.run([PROGRAM, "run", file, "-o", f"{folder}/run", "--threads", "1"], check=True,
                       capture_output=True)
        with open(f"{folder}/run/history.csv", newline="") as history:
            rows = list(csv.DictReader(history))
    return sum(-float(row["tool/ridge/force_y [N]"]) for row in rows[-8:]) / 8


def main():
    print("| rounding / edge | depth / edge | " + " | ".join(f"{s:g}" for s in SHIFTS) + " |")
    print("|---|---|" + "---|" * len(SHIFTS))
    for depth in DEPTHS:
        for rounding in ROUNDINGS:
            forces = [f"{force(shift, rounding, depth):.0f}" for shift in SHIFTS]
            print(f"| {rounding:g} | {depth:g} | " + " | ".join(forces) + " |", flush=True)


if __name__ == "__main__":
    main()
