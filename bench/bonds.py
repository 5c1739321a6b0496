"""Cost of a bonded contact row compared with an unbonded one.

  /usr/bin/python3 bench/bonds.py [--rounds 7] [--program build/release/cli/pulvis]

A matrix of elastic blocks is pressed in a die, unbonded or bonded, on one thread: the same bodies and the same rows,
all in contact. Times are those of the systems that process the rows (edge_contact, bond_forces), from summary.json.
Runs are interleaved, so that machine load affects all equally. Instructions are counted by callgrind inside these
systems only, over the same steps (needs valgrind). A row is a boundary edge against one neighbour: four points.
"""
import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BLOCKS, EDGES = 12, 10  # per side of the matrix, per side of a block
ROWS = 2 * 2 * BLOCKS * (BLOCKS - 1) * EDGES  # both sides of every edge between two blocks
SYSTEMS = ("edge_contact", "bond_forces")
STEPS, COUNTED_STEPS = 3000, 150

GLUE = '''[[bond]]
between = ["stone", "stone"]
origin = "initial"
strength = "200 MPa"
fracture_energy = "2 kJ/m^2"
'''
RUBBING = "friction = 0.1\ndamping = 0.1\n"
CASES = {  # name: bonds, contact
    "touching, smooth": ("", ""),
    "touching, friction and damping": ("", RUBBING),
    "glued": (GLUE, ""),
    "glued, friction and damping": (GLUE, RUBBING),
}


def scene(bonds, contact):
    side = f'"{BLOCKS} mm"'
    walls = "".join(f'[[tool]]\nname = "{name}"\nshape = "plane"\npoint = [{point}]\nnormal = {normal}\n'
                    for name, point, normal in (("left", '"0 mm", "0 mm"', [1, 0]),
                                                ("right", f'{side}, "0 mm"', [-1, 0]),
                                                ("bottom", '"0 mm", "0 mm"', [0, 1]),
                                                ("top", f'"0 mm", {side}', [0, -1])))
    return f'''family = "compaction"
title = "Blocks"
thickness = "1 mm"
[[material]]
name = "stone"
density = "2000 kg/m^3"
youngs_modulus = "20 GPa"
poissons_ratio = 0.25
[material.damping]
mass_proportional = "50000 1/s"
[[particle]]
name = "block"
material = "stone"
outline = "rectangle"
width = "1 mm"
height = "1 mm"
[particle.mesh]
columns = {EDGES}
rows = {EDGES}
[[packing]]
kind = "square"
particle = "block"
rows = {BLOCKS}
columns = {BLOCKS}
spacing = "1 mm"
corner = ["0 mm", "0 mm"]
{bonds}{walls}[[stage]]
name = "press"
kind = "compact"
duration = "40 us"
[[stage.move]]
tool = "top"
displacement = ["0 mm", "-0.1 mm"]
[[stage]]
name = "hold"
kind = "hold"
duration = "1 s"
[contact]
{contact}[output]
samples = 2
frames = 1
'''


def run(program, folder, case, steps, before=()):
    file, results = folder / "scene.toml", folder / "run"
    file.write_text(scene(*CASES[case]))
    done = subprocess.run([*before, program, "run", file, "-o", results, "--overwrite", "--quiet", "--threads", "1",
                           "--stop-after", str(steps)], capture_output=True, text=True)
    if done.returncode != 130:
        sys.exit(f"bonds.py: {case}: exit code {done.returncode}\n{done.stderr}")
    return json.loads((results / "summary.json").read_text())


def nanoseconds(program, folder, case):
    summary = run(program, folder, case, STEPS)
    seconds = sum(cost["seconds"] for cost in summary["cost"] if cost["system"] in SYSTEMS)
    return 1e9 * seconds / summary["steps"] / ROWS


def instructions(program, folder, case):
    out = folder / "callgrind.out"

    def within(steps):
        run(program, folder, case, steps, (
            "valgrind", "--tool=callgrind", f"--callgrind-out-file={out}",
            *(f"--toggle-collect=pulvis::{system}::operator()*" for system in SYSTEMS)))
        return int(re.search(r"^(?:totals|summary): (\d+)", out.read_text(), re.M)[1])
    first = COUNTED_STEPS // 3  # these steps bring the blocks into contact
    return (within(COUNTED_STEPS) - within(first)) / (COUNTED_STEPS - first) / ROWS


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/cli/pulvis")
    parser.add_argument("--no-counts", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        times = {case: [] for case in CASES}
        for _ in range(options.rounds):
            for case in CASES:
                times[case].append(nanoseconds(options.program, folder, case))
        counts = {} if options.no_counts else {
            case: instructions(options.program, folder, case) for case in CASES}
    print(f"{ROWS} rows, a row and step\n{'':32}{'ns, least':>10}{'median':>8}{'instructions':>14}")
    for case in CASES:
        print(f"{case:32}{min(times[case]):10.1f}{statistics.median(times[case]):8.1f}"
              + (f"{counts[case]:14.0f}" if counts else ""))
    for glued, touching in (("glued", "touching, smooth"),
                            ("glued, friction and damping", "touching, friction and damping")):
        ratios = [min(times[glued]) / min(times[touching]),
                  statistics.median(times[glued]) / statistics.median(times[touching])]
        if counts:
            ratios.append(counts[glued] / counts[touching])
        print(f"{glued} over {touching}: " + ", ".join(f"{r:.2f}" for r in ratios))


if __name__ == "__main__":
    main()
