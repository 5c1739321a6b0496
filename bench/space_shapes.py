"""Sharp 3D grains for space_laws.py: deviation of coarse surfaces from the exact shapes, and how far they can be compacted."""
import csv
import itertools
import json
import re
import subprocess

from space_scenes import PLASTIC, body, contact, head, plane, stage


def polyhedron(corners, rounding):
    points = ", ".join("[" + ", ".join(f'"{x} m"' for x in corner) + "]" for corner in corners)
    return f'shape = "polyhedron"\ncorners = [{points}]\nrounding = "{rounding} m"\n'


def cube(edge, rounding):
    return polyhedron(list(itertools.product((0, edge), repeat=3)), rounding)


def octahedron(height, rounding):
    return polyhedron([tuple(sign * height / 2 if k == axis else 0 for k in range(3))
                       for axis in range(3) for sign in (1, -1)], rounding)


SHAPES = {
    "cube, edges rounded by 5% of their length": cube(1e-3, 5e-5),
    "octahedron, rounded by 2.5% of its height": octahedron(2e-3, 5e-5),
    "tablet of 1 by 0.2, rim rounded by 0.02": 'shape = "cylinder"\ndiameter = "1 mm"\nheight = "0.2 mm"\nrounding = "0.02 mm"\n',
    "superquadric, exponents 8": 'shape = "superquadric"\nsize = ["1 mm", "1 mm", "1 mm"]\nexponent_xy = 8\nexponent_z = 8\n',
    "ellipsoid of 5 by 1 by 1": 'shape = "ellipsoid"\nsize = ["1 mm", "0.2 mm", "0.2 mm"]\n',
    "sphere": 'shape = "sphere"\ndiameter = "1 mm"\n',
}


def particle(shape, divisions):
    return (f'\n[[particle]]\nname = "grain"\nmaterial = "m"\n{shape}'
            f'[particle.mesh]\ndivisions = {divisions}\nrings = 1\n')


def shapes(bench):
    """Deviation of the contact surface from the shape it represents."""
    divisions = (2, 3, 4, 6, 8)
    print("law shapes: greatest distance of the smooth surface from the shape, over the mean radius, by divisions (`pulvis check`)")
    print(" " * 42 + "  ".join(f"{n:>7}" for n in divisions))
    for name, shape in SHAPES.items():
        told = []
        for n in divisions:
            scene = bench.folder / "shape.toml"
            scene.write_text(head("Shape", PLASTIC) + particle(shape, n) + body(0, 0, 0, "grain") +
                             stage(1e-6, {}, kind="hold"), encoding="utf-8")
            text = subprocess.run([bench.program, "check", scene], capture_output=True, text=True, check=True).stdout
            told.append(re.search(r"surface within (\S+)", text)[1])
        print(f"{name:42}" + "  ".join(f"{share:>7}" for share in told), flush=True)


GRAINS = {  # with volume in m^3, computed with sharp edges; relative densities of packings
    "cubes, rounded by 7% of their length": (cube(3e-4, 2e-5), 2.7e-11, (0.4, 0.5)),
    "cubes, rounded by 13% of their length": (cube(3e-4, 4e-5), 2.7e-11, (0.4,)),
    "octahedra, rounded by 5% of their height": (octahedron(4e-4, 2e-5), 4 / 3 * 8e-12, (0.3,)),
}
COUNT, SIDE, END = 12, 1e-3, 0.9


def pressed(shape, volume, divisions, start):
    """Scene of grains in a box, pressed from above to the relative density END."""
    height = COUNT * volume / SIDE**2 / start
    text = head("Sharp", PLASTIC) + particle(shape, divisions)
    text += (f'\n[[packing]]\nkind = "random"\nwidth = "{SIDE} m"\ndepth = "{SIDE} m"\ndensity = {start}\n'
             f'[[packing.class]]\nparticle = "grain"\nnumber = {COUNT}\n')
    for axis, walls in enumerate((("left", "right"), ("front", "back"))):
        for wall, at, sign in zip(walls, (0, SIDE), (1, -1)):
            text += plane(wall, [at if k == axis else 0 for k in range(3)], [sign if k == axis else 0 for k in range(3)])
    text += plane("bottom", (0, 0, 0), [0, 0, 1])
    text += '\n[[tool]]\nname = "top"\nshape = "plane"\npoint = ["0 m", "0 m", "packing top"]\nnormal = [0, 0, -1]\n'
    text += stage(height / 15, {"top": (0, 0, -height * (1 - start / (END + 0.02)))}, ramp=0.05)
    text = text.replace("[[stage.move]]", f"[stage.until]\nrelative_density = {END}\n[[stage.move]]", 1)
    return text + contact(friction=1.0, damping=0.1)


def sharp(bench):
    """How far sharp grains can be compacted before a run aborts, and the energy balance at that point."""
    print(f"law sharp: {COUNT} grains of 316L in a box, random, friction 1: to a relative density of {END}, or until the run is stopped")
    print(f"{'grains':42} {'mesh':>4} {'from':>5} {'to':>6} {'balance':>8}  ended by")
    for (name, (shape, volume, densities)), n in itertools.product(GRAINS.items(), (4, 6)):
        for start in densities:
            scene, folder = bench.folder / "sharp.toml", bench.folder / "sharp"
            scene.write_text(pressed(shape, volume, n, start), encoding="utf-8")
            run = subprocess.run([bench.program, "run", scene, "-o", folder, "--overwrite"], capture_output=True, text=True, check=False)
            ended = re.search(r"the run failed: ([^;]*) at step", run.stderr)
            with open(folder / "history.csv", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            density = float(rows[-1]["relative_density [-]"]) if rows else start
            balance = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["energy_balance_error"]
            print(f"{name:42} {f'{n},1':>4} {start:5.2f} {density:6.3f} {balance:8.1e}  "
                  f"{ended[1] if ended else 'its stage'}", flush=True)
