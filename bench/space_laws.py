#!/usr/bin/python3
"""3D runs compared with analytical laws and independent solutions, and their cost: one table each.

usage: space_laws.py [--pulvis PROGRAM] [--folder DIR] LAW...

LAW  hertz      an elastic sphere between frictionless planes, and two spheres: F = 4/3 E* sqrt(R) d^(3/2) (Hertz 1882)
     flatten    a plastic sphere between frictionless planes against axisymmetric elements (axisymmetric_sphere.py)
     perfect    the same without hardening against a fit to finite elements (Jackson & Green 2005)
     cell       a sphere in a cubic box on four meshes: observed order, wall stress against the mean stress of the particle
     turns      force of a sphere between planes for random rotations of its mesh: rms over the mean
     taylor     copper rod against a rigid wall at 227 m/s: length, radius of the mushroomed end
     mindlin    partial slip of pressed contacts: compliance, friction work per cycle (Mindlin & Deresiewicz 1953)
     inertia    kinetic energy of a turning sphere, over that of a solid one
     dense      27 plastic spheres pressed to a relative density of 0.94: meshes and contact stiffnesses
     shapes     deviation of the smooth surfaces of coarse meshes from the exact shapes
     sharp      how far sharp grains can be compacted before a run aborts
     cost       time per element and step, memory per element: 27 to 1,000 spheres
"""
import argparse
import math
import pathlib
import subprocess

import numpy as np

from space_powders import cost, dense
from space_scenes import OUTPUT, PLASTIC, ROOT, STEEL, Bench, ball, body, contact, head, plane, stage
from space_shapes import shapes, sharp


def finite_hertz(approach, radius, young, poisson):
    """Force of a sphere pressed between two planes, `approach` of each to the centre: Hertz, with the surface displacement caused by
    the opposite contact in a half space (Tatara 1991, eq. 13)."""
    star = young / (1 - poisson**2)
    force = 0.0
    for _ in range(100):
        a2 = (3 * force * radius / (4 * star)) ** (2 / 3)
        far = 2 * (1 + poisson) * radius**2 / (a2 + 4 * radius**2) ** 1.5 + (1 - poisson**2) / math.sqrt(a2 + 4 * radius**2)
        force = 4 / 3 * star * math.sqrt(radius) * (approach + force / (math.pi * young) * far) ** 1.5
    return force


def huber(r, z, a):
    """-sigma_zz over the maximum pressure below a Hertz contact of radius a (Huber 1904; Johnson 1985, eq. 3.46)."""
    q = r * r + z * z - a * a
    u = 0.5 * (q + np.sqrt(q * q + 4 * a * a * z * z))
    return (z / np.sqrt(u)) ** 3 * a * a * u / (u * u + a * a * z * z)


def profile(bench, name, h, radius, star):
    """Element stresses below the top contact, less than 0.6 a deep, against Huber's solution averaged over each: number of elements,
    root mean square and largest difference over the maximum pressure."""
    import h5py
    corner = np.array([[i, j, k] for k in (-1, 1) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    with h5py.File(bench.folder / name / "run.h5") as file:
        last = file["frames"][sorted(file["frames"])[-1]]
        x, stress, nodes = last["position"][:], last["stress"][:, 2], file["mesh/hexahedra"][:]
    top, force = h["tool/top/position_z"][-1], abs(h["tool/top/force_z"][-1])
    a = (3 * force * radius / (4 * star)) ** (1 / 3)
    middle = x[nodes].mean(1)
    near = (np.hypot(middle[:, 0], middle[:, 1]) < a) & (top - middle[:, 2] < 0.6 * a)
    law = np.zeros(near.sum())
    for point in corner / math.sqrt(3):
        at = np.einsum("i,eij->ej", np.prod(1 + corner * point, 1) / 8, x[nodes[near]])
        law += huber(np.hypot(at[:, 0], at[:, 1]), np.maximum(top - at[:, 2], 1e-12), a) / 8
    error = -stress[near] / (1.5 * force / (math.pi * a * a)) - law
    return len(error), math.sqrt(np.mean(error**2)), np.abs(error).max()


def hertz(bench):
    radius, share, young, nu = 5e-3, 0.1, 200e9, 0.3
    star = young / (1 - nu**2)
    at = (0.01, 0.02, 0.03, 0.05, 0.075, 0.0999)
    print("law hertz: force over Hertz's at approaches d/R of each contact, and over Tatara's, which knows the other contact;")
    print("stress below the contact at the end against Huber's: number of elements, rms, largest difference over the greatest")
    print(f"{'case':40} {'elements':>9}  " + "  ".join(f"{s:>6}" for s in at))
    for divisions, stiffness, two in ((8, 10, False), (12, 0.5, False), (12, 2, False), (12, 10, False), (12, 40, False), (16, 10, False),
                                      (12, 10, True)):
        rings = 2
        text = head("Hertz", STEEL) + ball(2 * radius, divisions, rings) + body(0, 0, radius)
        height = 4 * radius if two else 2 * radius
        if two:
            text += body(0, 0, 3 * radius)
        # Between two equal spheres the approach is twice that against a plane, for the same force.
        contacts = 4 if two else 2
        text += plane("bottom", (0, 0, 0), (0, 0, 1)) + plane("top", (0, 0, height), (0, 0, -1))
        text += stage(1.5e-4 * contacts / 2, {"top": (0, 0, -contacts * share * radius)}, ramp=0.5)
        text += contact(stiffness=stiffness, damping=0.3) + OUTPUT
        name = f"hertz-{divisions}-{stiffness}-{'two' if two else 'one'}"
        h = bench.run(name, text)
        d = (height - h["tool/top/position_z"]) / contacts / radius
        f = 0.5 * (np.abs(h["tool/top/force_z"]) + np.abs(h["tool/bottom/force_z"]))
        forces = [np.interp(s, d, f) for s in at]
        what = f"{'two spheres' if two else 'sphere'}, {divisions} divisions, stiffness {stiffness}"
        hertzian = [4 / 3 * star * radius**2 * s**1.5 for s in at]
        finite = [finite_hertz(s * radius, radius, young, nu) for s in at]
        number, rms, largest = profile(bench, name, h, radius, star)
        print(f"{what:40} {divisions**3 + 6 * divisions**2 * rings:9d}  " + "  ".join(f"{x / y:6.3f}" for x, y in zip(forces, hertzian)))
        print(f"{'  over that of two contacts':40} {'':9}  " + "  ".join(f"{x / y:6.3f}" for x, y in zip(forces, finite)) +
              f"   stress: {number}, {100 * rms:.1f}%, {100 * largest:.1f}%", flush=True)


def flatten(bench):
    radius = 5e-3
    reference = bench.folder / "axisymmetric.csv"
    if not reference.exists():
        subprocess.run(["/usr/bin/python3", ROOT / "bench/axisymmetric_sphere.py", "--edges", "12", "--csv", reference],
                       check=True, stdout=subprocess.DEVNULL)
    rows = np.genfromtxt(reference, delimiter=",", skip_header=1)
    at = (0.03, 0.05, 0.1, 0.15, 0.195)
    print("law flatten: force over pi R^2 sigma_y at set approaches of plane and centre over R")
    print(f"{'case':34} {'elements':>9}  " + "  ".join(f"{s:>7}" for s in at))
    print(f"{'axisymmetric':34} {'':9}  " + "  ".join(f"{np.interp(s, rows[:, 0], rows[:, 1]):7.4f}" for s in at))
    for formulation, meshes in (("one-point", ((4, 1), (4, 4), (6, 1), (7, 1), (8, 2), (12, 2))), ("eight-point", ((4, 4), (6, 1)))):
        for divisions, rings in meshes:
            text = head("Flattening", PLASTIC) + ball(2 * radius, divisions, rings) + body(0, 0, radius)
            text += plane("bottom", (0, 0, 0), (0, 0, 1)) + plane("top", (0, 0, 2 * radius), (0, 0, -1))
            text += stage(6e-4, {"top": (0, 0, -0.4 * radius)}) + contact(damping=0.1)
            text += f'\n[element]\nformulation = "{formulation}"\n' + OUTPUT
            h = bench.run(f"flatten-{formulation}-{divisions}-{rings}", text)
            d = (2 * radius - h["tool/top/position_z"]) / 2 / radius
            f = 0.5 * (np.abs(h["tool/top/force_z"]) + np.abs(h["tool/bottom/force_z"])) / (math.pi * radius**2 * 240e6)
            print(f"{formulation + f', {divisions} divisions, {rings} rings':34} {divisions**3 + 6 * divisions**2 * rings:9d}  " +
                  "  ".join(f"{np.interp(s, d, f):7.4f}" for s in at))


def jackson_green(approach, sigma_y, young, poisson):
    """Force of an elastic, perfectly plastic sphere on a rigid flat over pi R^2 sigma_y, approach over R: fit of their finite elements
    by Jackson & Green, J. Tribol. 127 (2005) 343, up to a contact radius of 0.41 R. The hardness decreases with contact radius, as
    found by Mesarovic & Fleck, Int. J. Solids Struct. 37 (2000) 7071."""
    star, c = young / (1 - poisson**2), 1.295 * math.exp(0.736 * poisson)
    critical = (math.pi * c * sigma_y / (2 * star)) ** 2
    w = approach / critical
    a = math.sqrt(approach * (w / 1.9) ** (0.14 * math.exp(23 * sigma_y / star)))
    hardness = 2.84 * (1 - math.exp(-0.82 * a**-0.7))
    force = math.exp(-0.25 * w ** (5 / 12)) * w**1.5 + 4 * hardness / c * (1 - math.exp(-(w ** (5 / 9)) / 25)) * w
    return force * 4 / 3 * (math.pi * c * sigma_y / 2) ** 3 / star**2 / (math.pi * sigma_y), a


def perfect(bench):
    radius, sigma_y = 5e-3, 240e6
    at = (0.01, 0.02, 0.03, 0.04, 0.05)
    print("law perfect: a perfectly plastic sphere between frictionless planes: force over pi R^2 sigma_y at approaches over R")
    print(f"{'case':34} " + "  ".join(f"{s:>7}" for s in at))
    fit = [jackson_green(s, sigma_y, 200e9, 0.3) for s in at]
    print(f"{'Jackson & Green':34} " + "  ".join(f"{f:7.4f}" for f, _ in fit))
    print(f"{'  radius of the contact over R':34} " + "  ".join(f"{a:7.4f}" for _, a in fit))
    reference = bench.folder / "axisymmetric-perfect.csv"
    if not reference.exists():
        subprocess.run(["/usr/bin/python3", ROOT / "bench/axisymmetric_sphere.py", "--edges", "12", "--hardening", "0", "--approach", "0.06",
                        "--csv", reference], check=True, stdout=subprocess.DEVNULL)
    rows = np.genfromtxt(reference, delimiter=",", skip_header=1)
    print(f"{'axisymmetric':34} " + "  ".join(f"{np.interp(s, rows[:, 0], rows[:, 1]):7.4f}" for s in at))
    for divisions, rings in ((6, 1), (7, 1), (8, 2), (12, 2)):
        text = head("Flattening", STEEL + 'yield_stress = "240 MPa"\n') + ball(2 * radius, divisions, rings) + body(0, 0, radius)
        text += plane("bottom", (0, 0, 0), (0, 0, 1)) + plane("top", (0, 0, 2 * radius), (0, 0, -1))
        text += stage(5e-4, {"top": (0, 0, -0.11 * radius)}) + contact(damping=0.1, stiffness=2) + OUTPUT
        h = bench.run(f"perfect-{divisions}", text)
        d = (2 * radius - h["tool/top/position_z"]) / 2 / radius
        f = 0.5 * (h["tool/top/force_z"] - h["tool/bottom/force_z"]) / (math.pi * radius**2 * sigma_y)
        print(f"{f'{divisions} divisions, {rings} rings':34} " + "  ".join(f"{np.interp(s, d, f):7.4f}" for s in at), flush=True)


def cell(bench):
    radius = 5e-3
    move = 0.11 * 2 * radius
    print("law cell: a perfectly plastic sphere in a cubic box that closes in alike; wall stress over sigma_y at densities")
    at = (0.6, 0.65, 0.7)
    print(f"{'divisions':>9} {'elements':>9}  " + "  ".join(f"{s:>8}" for s in at) + "   wall over mean stress at the end")
    found = []
    perfectly = STEEL + 'yield_stress = "240 MPa"\n'
    span = np.linspace(0.55, 0.72, 60)
    for divisions, rings in ((4, 1), (6, 1), (7, 1), (8, 2), (16, 2)):
        text = head("Cell", perfectly) + ball(2 * radius, divisions, rings) + body(radius, radius, radius)
        size = 2 * radius
        for axis, low, high in ((0, "left", "right"), (1, "front", "back"), (2, "bottom", "top")):
            normal = [0, 0, 0]
            normal[axis] = 1
            text += plane(low, (0, 0, 0), normal)
            point = [0, 0, 0]
            point[axis] = size
            text += plane(high, point, [-n for n in normal])
        half = move / 2
        moves = {}
        for axis, low, high in ((0, "left", "right"), (1, "front", "back"), (2, "bottom", "top")):
            d = [0.0, 0.0, 0.0]
            d[axis] = half
            moves[low] = tuple(d)
            moves[high] = tuple(-c for c in d)
        text += stage(6e-4, moves) + contact(damping=0.1) + OUTPUT.replace("frames = 4", "frames = 4\nparticle_stress = true")
        h = bench.run(f"cell-{divisions}-{rings}", text)
        sides = [h["tool/top/position_z"] - h["tool/bottom/position_z"], h["tool/right/position_x"] - h["tool/left/position_x"],
                 h["tool/back/position_y"] - h["tool/front/position_y"]]
        volume = sides[0] * sides[1] * sides[2]
        density = 4 / 3 * math.pi * radius**3 / volume
        stress = np.mean([np.abs(h[f"tool/{t}/force_{a}"]) for t, a in
                          (("top", "z"), ("bottom", "z"), ("left", "x"), ("right", "x"), ("front", "y"), ("back", "y"))], 0)
        stress = stress / np.mean(sides, 0) ** 2 / 240e6
        values = [np.interp(s, density, stress) for s in at]
        if divisions in (4, 8, 16):
            found.append(np.interp(span, density, stress))
        mean = ""
        if "stress/mean" in h:
            mean = f"{stress[-1] * 240e6 / abs(h['stress/mean'][-1]):.4f}"
        print(f"{divisions:9d} {divisions**3 + 6 * divisions**2 * rings:9d}  " + "  ".join(f"{v:8.4f}" for v in values) + f"   {mean}", flush=True)
    # Single values oscillate as faces come into contact one by one: differences of whole curves decrease steadily.
    one, two = (np.sqrt(np.mean((a - b) ** 2)) for a, b in zip(found, found[1:]))
    print(f"  root mean square of the differences from density 0.55 to 0.72, 4 to 8 and 8 to 16 divisions: {one:.4f}, {two:.4f}; "
          f"observed order {math.log2(one / two):.2f}")


def turns(bench):
    radius, number = 5e-3, 32
    print("law turns: 32 spheres (16 of 8 divisions), each with its mesh turned at random, between two planes: rms of single forces over their mean")
    for name, material in (("plastic", PLASTIC), ("elastic", STEEL)):
        for divisions, rings in ((4, 1), (4, 4), (6, 1), (7, 1), (8, 2)):
            row = []
            text = head("Turns", material) + ball(2 * radius, divisions, rings, 'phase = "random"\n')
            count = number if divisions < 8 else 16
            for i in range(count):
                text += body(3 * radius * i, 0, radius)
            text += plane("bottom", (0, 0, 0), (0, 0, 1))
            for i in range(count):
                # A separate punch for each: the punch forces are compared.
                text += (f'\n[[tool]]\nname = "p{i}"\nshape = "punch"\npoint = ["{3 * radius * i} m", "0 m", "{2 * radius} m"]\n'
                         f'normal = [0, 0, -1]\ndiameter = "{2.6 * radius} m"\n')
            text += stage(1.2e-3, {f"p{i}": (0, 0, -0.2 * radius) for i in range(count)}) + contact(damping=0.1) + OUTPUT
            h = bench.run(f"turns-{name}-{divisions}-{rings}", text)
            d = (2 * radius - h["tool/p0/position_z"]) / (2 * radius)
            for s in (0.01, 0.02, 0.03, 0.05, 0.07, 0.095):
                f = [np.interp(s, d, np.abs(h[f"tool/p{i}/force_z"])) for i in range(count)]
                row.append(np.std(f) / np.mean(f))
            print(f"  {name:8} {divisions} divisions, {rings} rings: compressed by 1, 2, 3, 5, 7, 9.5% of the diameter: " +
                  "  ".join(f"{100 * r:.2f}%" for r in row), flush=True)


def taylor(bench):
    length, radius, speed = 32.4e-3, 3.2e-3, 227
    copper = """
[[material]]
name = "m"
density = "8930 kg/m^3"
youngs_modulus = "117 GPa"
poissons_ratio = 0.35
yield_stress = "400 MPa"
hardening_modulus = "100 MPa"
"""
    print("law taylor: final length and radius of the foot, mm (literature 21.4 to 21.5 and 7.0 to 7.2)")
    import h5py
    for formulation, grid, divisions, rings, axial in (
            ("one-point", "extruded", 4, 3, 30), ("one-point", "extruded", 6, 4, 48), ("one-point", "extruded", 8, 5, 60),
            ("eight-point", "extruded", 4, 3, 30), ("one-point", "cube", 6, 3, 48), ("one-point", "cube", 10, 4, 10)):
        text = head("Taylor", copper)
        text += (f'\n[[particle]]\nname = "rod"\nmaterial = "m"\nshape = "cylinder"\ndiameter = "{2 * radius} m"\n'
                 f'height = "{length} m"\nrounding = "0.1 mm"\n[particle.mesh]\ngrid = "{grid}"\ndivisions = {divisions}\n'
                 f'rings = {rings}\naxial_divisions = {axial}\n')
        text += body(0, 0, length / 2, "rod", f'velocity = ["0 m/s", "0 m/s", "-{speed} m/s"]\n')
        text += plane("wall", (0, 0, 0), (0, 0, 1))
        text += '\n[[stage]]\nname = "impact"\nkind = "settle"\nduration = "80 us"\n' + contact()
        text += f'\n[element]\nformulation = "{formulation}"\n' + OUTPUT
        name = f"taylor-{formulation}-{grid}-{divisions}-{rings}-{axial}"
        bench.run(name, text)
        with h5py.File(bench.folder / name / "run.h5") as file:
            frame = sorted(file["frames"])[-1]
            x = file[f"frames/{frame}/position"][:]
        across = np.hypot(x[:, 0], x[:, 1])
        axis = x[across < 1e-9 + 1e-6 * radius, 2]
        print(f"  {name:36} length at the axis {1e3 * np.ptp(axis):.3f}, of all nodes {1e3 * np.ptp(x[:, 2]):.3f}  "
              f"foot {1e3 * across.max():.3f}", flush=True)


def inertia(bench):
    radius, rate = 5e-3, 1000
    print("law inertia: a free sphere that turns: its kinetic energy over 1/2 (2/5 m R^2) w^2")
    solid = 0.5 * 0.4 * (4 / 3 * math.pi * radius**3 * 7990) * radius**2 * rate**2
    for divisions, rings in ((2, 1), (3, 3), (4, 1), (4, 4), (7, 1), (8, 2), (12, 2)):
        text = head("Inertia", STEEL) + ball(2 * radius, divisions, rings)
        text += body(0, 0, 0, more=f'angular_velocity = ["0 rad/s", "0 rad/s", "{rate} rad/s"]\n')
        text += plane("far", (0, 0, -2 * radius), (0, 0, 1)) + stage(1e-7, {}, "settle") + OUTPUT
        h = bench.run(f"inertia-{divisions}-{rings}", text)
        print(f"  {divisions} divisions, {rings} rings: {h['energy/kinetic'][0] / solid:.4f}", flush=True)


def partial_slip(h, top, radius, young, nu, mu, begins):
    """A contact that is pressed and moved back and forth along x. `begins`: of the first slip, and of the cycle. Contact radius
    (Hertz), amplitude of q = Q/(mu N), compliance and work of friction in a cycle over Mindlin & Deresiewicz's."""
    time, force, x = h["time"], h[f"tool/{top}/force_x"], h[f"tool/{top}/position_x"]
    x = x - x[0]
    forth, cycle = (time > begins[0]) & (time <= begins[1]), time >= begins[1] * (1 - 1e-9)
    force = -force if force[forth].sum() < 0 else force
    n = np.mean(np.abs(h[f"tool/{top}/force_z"][cycle]))
    q = np.ptp(force[cycle]) / 2 / (mu * n)
    a = (3 * n * radius * (1 - nu**2) / (4 * young)) ** (1 / 3)
    # Johnson (1985), Sec. 7.2 and 7.4, one of the bodies rigid: displacement, and the area of its hysteresis loop with the force.
    k = 3 * mu * n / (16 * a) * (2 - nu) * 2 * (1 + nu) / young
    law = 4.8 * k * mu * n * (1 - (1 - q) ** (5 / 3) - 5 * q / 6 * (1 + (1 - q) ** (2 / 3)))
    load = np.clip(force[forth] / (mu * n), 0, 1)
    fitted = np.linalg.lstsq(np.stack([1 - (1 - load) ** (2 / 3), load], 1), x[forth], rcond=None)[0][0]
    return a, q, fitted / k, np.trapz(force[cycle], x[cycle]) / law


def domed_punches(dome, contacts):
    """Discs glued to a floor; each is pressed by its own rigid punch with a dome of this radius, to a depth of a^2/dome, and moved."""
    height, diameter = 6e-3, 12e-3
    r = np.linspace(0, diameter / 3, 161)
    profile = ", ".join(f'["{x:.9e} m", "{math.sqrt(dome**2 - x**2) - dome:.9e} m"]' for x in r)
    text = (f'\n[[particle]]\nname = "disc"\nmaterial = "m"\nshape = "cylinder"\ndiameter = "{diameter} m"\nheight = "{height} m"\n'
            'rounding = "0.25 mm"\n[particle.mesh]\ngrid = "extruded"\ndivisions = 8\nrings = 4\naxial_divisions = 6\n')
    text += plane("floor", (0, 0, 0), (0, 0, 1))
    text += ('\n[[bond]]\nbetween = ["m", "floor"]\norigin = "initial"\nstrength = "1e12 Pa"\nfracture_energy = "1e9 J/m^2"\n'
             'reach = 0.2\n')
    moves = [{}, {}, {}, {}]
    for i, a in enumerate(contacts):
        x, depth = 2.2 * diameter * i, a * a / dome
        text += body(x, 0, height / 2, "disc")
        text += (f'\n[[tool]]\nname = "punch{i}"\nshape = "punch"\npoint = ["{x} m", "0 m", "{height} m"]\nnormal = [0, 0, -1]\n'
                 f'diameter = "{2 * diameter / 3} m"\nprofile = [{profile}]\n')
        moves[0][f"punch{i}"] = (0, 0, -depth)
        for move, by in zip(moves[1:], (0.4, -0.8, 0.8)):
            move[f"punch{i}"] = (by * depth, 0, 0)
    for name, duration, move in zip(("press", "forth", "against", "again"), (1e-4, 5e-5, 1e-4, 1e-4), moves):
        text += stage(duration, move, "compact", name, 0.5)
    return text


def mindlin(bench):
    mu, nu, young = 0.3, 0.45, 200e9
    material = STEEL.replace("0.3", f"{nu}")
    output = OUTPUT.replace("200", "400")
    print("law mindlin: a contact is pressed and then moved back and forth. Compliance: of the first slip, fitted by")
    print("k (1 - (1 - q)^(2/3)) + L q, k over Mindlin's; work: that of friction in a cycle over Mindlin & Deresiewicz's;")
    print("q: amplitude of Q/(mu N); p/E: largest pressure of Hertz over Young's modulus")

    def show(what, found, radius, face):
        a, q, compliance, work = found
        pressure = 2 / math.pi * a / radius / (1 - nu**2)
        print(f"  {what:44} contact radius {1e3 * a:.2f} mm, {a / face:.1f} faces, p/E {pressure:.3f}, q {q:.2f}: "
              f"compliance {compliance:.3f}, work {work:.3f}", flush=True)

    for dome, contacts in ((50e-3, (1.2e-3, 1.7e-3, 2.3e-3, 2.9e-3)), (10e-3, (1.7e-3, 2.3e-3, 2.9e-3))):
        text = head("Mindlin", material) + domed_punches(dome, contacts) + contact(friction=mu, damping=0.3) + output
        h = bench.run(f"mindlin-dome-{1e3 * dome:.0f}", text)
        for i in range(len(contacts)):
            show(f"disc, dome of {1e3 * dome:.0f} mm", partial_slip(h, f"punch{i}", dome, young, nu, mu, (1.02e-4, 1.5e-4)), dome, 0.75e-3)

    # A sphere between four planes, of which two move forth and back and the others against them, so that it neither moves nor turns.
    radius = 5e-3
    for divisions, d in ((8, 0.05), (8, 0.1)):
        text = head("Mindlin", material) + ball(2 * radius, divisions, 1) + body(0, 0, radius)
        text += plane("bottom", (0, 0, 0), (0, 0, 1)) + plane("top", (0, 0, 2 * radius), (0, 0, -1))
        text += plane("front", (0, -radius, 0), (0, 1, 0)) + plane("back", (0, radius, 0), (0, -1, 0))
        press, t = d * radius, 0.48 * d * radius
        text += stage(1.5e-4, {"top": (0, 0, -press), "bottom": (0, 0, press), "front": (0, press, 0), "back": (0, -press, 0)}, ramp=0.5)
        for name, by, duration in (("forth", t, 5e-5), ("against", -2 * t, 1e-4), ("again", 2 * t, 1e-4)):
            text += stage(duration, {"top": (by, 0, 0), "bottom": (by, 0, 0), "front": (-by, 0, 0), "back": (-by, 0, 0)}, "compact", name, 0.5)
        h = bench.run(f"mindlin-sphere-{divisions}-{d}", text + contact(friction=mu, damping=0.3) + output)
        show(f"sphere, {divisions} divisions, approach {d} R", partial_slip(h, "top", radius, young, nu, mu, (1.55e-4, 2e-4)),
             radius, math.pi / 2 * radius / divisions)


LAWS = {f.__name__: f for f in (hertz, flatten, perfect, cell, turns, taylor, mindlin, inertia, dense, cost, shapes, sharp)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--pulvis", default=ROOT / "build/release/cli/pulvis")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/space-laws")
    parser.add_argument("--rounds", type=int, default=3, help="of `cost`; one takes some minutes")
    parser.add_argument("laws", nargs="+", choices=sorted(LAWS), metavar="LAW")
    options = parser.parse_args()
    bench = Bench(options.pulvis, options.folder, options.rounds)
    for law in options.laws:
        LAWS[law](bench)


if __name__ == "__main__":
    main()
