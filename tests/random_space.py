"""Random scenes in three dimensions: each must run to its end, with its energy in balance and the same bits on two threads.

  /usr/bin/python3 tests/random_space.py PROGRAM [--scenes N] [--seed S] [--first I] [--keep DIR]

Particles of one or two shapes and materials, elastic or plastic, from micrometres to decimetres, lie at random or in a lattice
in a box or a cylindrical die. A punch presses them to a density that was drawn, holds a force, or is hit by them; they are unloaded
and pushed out. Meshes, sizes, friction, adhesion, welds, damping, contact stiffness, formulation and speed are drawn too. All that is asked of a
run is in `faults` of random_scenes.py. A scene that is refused, or that stops in a health check that names what went wrong, is
reported and counted apart.
"""
import math
import random
import re
import sys

from random_scenes import MATERIALS, log_uniform, material, metres, try_all

# What a physical limit says when it stops a run (exit code 3); an energy balance is no such limit.
LIMITS = re.compile(r"penetration|inverted|det F|closest point|duration of stage")
SHAPES = ["sphere", "sphere", "ellipsoid", "superquadric", "cylinder", "polyhedron"]


class Scene:
    """Everything that was drawn, and the text that says it."""

    def __init__(self, seed, number):
        self.draw = draw = random.Random(f"space/{seed}/{number}")
        self.name, self.seed = f"space-{seed}-{number}", number
        self.size = log_uniform(draw, 1e-6, 0.1)  # m, of a particle
        self.materials = draw.sample(list(MATERIALS), draw.choice([1, 1, 2]))
        self.shapes = [draw.choice(SHAPES) for _ in self.materials]
        self.count = draw.randint(2, 14)
        self.lattice = self.shapes == ["sphere"] and draw.random() < 0.3
        self.round_die = not self.lattice and draw.random() < 0.4
        self.friction = draw.choice([0, draw.uniform(0, 1)])
        self.contact = draw.choice([None, None, log_uniform(draw, 0.5, 10)])
        self.damping = draw.choice([0, 0.1, draw.random()])
        self.mass_damping = draw.choice([0, 0, log_uniform(draw, 1e-3, 1e-1)])
        self.formulation = draw.choice(["one-point", "one-point", "one-point", "eight-point"])
        self.speed = log_uniform(draw, 5e-3, 3e-2)  # of a bar's wave in the softest
        self.packed = draw.uniform(0.1, 0.25) * (0.5 if "polyhedron" in self.shapes else 1)
        self.pressed = draw.uniform(0.7, 0.95 if self.plastic() else 0.8)
        self.action = draw.choice(["press", "press", "press and eject", "hold", "throw"])
        self.particles = "".join(self.particle(k) for k in range(len(self.materials)))
        # Drawn apart, so that all else stays what it was before there was adhesion.
        own = random.Random(f"adhesion/{seed}/{number}")
        self.adhesion = None if own.random() < 0.6 else (log_uniform(own, 1e-3, 0.2), log_uniform(own, 1e-3, 0.1))

        own = random.Random(f"welds/{seed}/{number}")
        self.welds = None if own.random() < 0.6 else (own.uniform(0.05, 0.8), log_uniform(own, 0.05, 1), own.uniform(1.5, 100))

    def plastic(self):
        return all(MATERIALS[material][3] for material in self.materials)

    def weakest(self):
        return min(MATERIALS[m][3] or 0.002 * MATERIALS[m][1] for m in self.materials)

    def pairs(self):
        return [(a, b) for i, a in enumerate(self.materials) for b in [*self.materials[i:], "bottom"]]

    def weld(self, a, b):
        """Of full strength at the pressure of first yield; the fracture energy is a multiple of what the bond stores then."""
        threshold, strength, toughness = self.welds
        strength *= 0.3 * self.weakest()
        spring = 20 * 0.5 * min(MATERIALS[m][1] for m in self.materials) / self.size  # Pa/m, less than that of any bond
        energy = toughness * strength ** 2 / spring
        return f'[[bond]]\nbetween = ["{a}", "{b}"]\norigin = "pressed"\nthreshold = "{threshold * self.weakest():.9g} Pa"\n' \
               f'growth = 0.3\nstrength = "{strength:.9g} Pa"\nfracture_energy = "{energy:.9g} J/m^2"\n'

    def bonds(self):
        welds = "" if self.welds is None else "".join(self.weld(a, b) for a, b in self.pairs())
        return welds + self.attraction()

    def attraction(self):
        if self.adhesion is None:
            return ""
        traction, reach = self.adhesion[0] * self.weakest(), self.adhesion[1] * self.size
        return "".join(f'[[bond]]\nbetween = ["{a}", "{b}"]\norigin = "adhesion"\nwork = "{traction * reach / 2:.9g} J/m^2"\n'
                       f'range = "{reach:.9g} m"\n' for a, b in self.pairs())

    # ---- particles ------------------------------------------------------------------------------------
    def mesh(self, sphere):
        draw = self.draw
        text = f"[particle.mesh]\ndivisions = {draw.randint(2 if sphere else 4, 6)}\nrings = {draw.randint(1, 3)}\n"
        return text + ('phase = "random"\n' if sphere and draw.random() < 0.5 else "")

    def particle(self, k):
        draw, shape, size = self.draw, self.shapes[k], self.size * (1 if k == 0 else self.draw.uniform(0.4, 1))
        text = f'[[particle]]\nname = "p{k}"\nmaterial = "{self.materials[k]}"\nshape = "{shape}"\n'
        if shape == "sphere":
            text += f'diameter = "{size:.9g} m"\n'
        elif shape == "ellipsoid":
            text += f"size = {metres(*(size * draw.uniform(0.6, 1.2) for _ in range(3)))}\n"
        elif shape == "superquadric":
            text += f"size = {metres(*(size * draw.uniform(0.7, 1.1) for _ in range(3)))}\n" \
                    f"exponent_xy = {draw.uniform(2, 6):.4g}\nexponent_z = {draw.uniform(2, 6):.4g}\n"
        elif shape == "cylinder":
            height = size * draw.uniform(0.5, 1.5)
            text += f'diameter = "{size:.9g} m"\nheight = "{height:.9g} m"\n' \
                    f'rounding = "{min(size, height) * draw.uniform(0.15, 0.45):.9g} m"\n'
        else:
            # A ball's points keep the hull's faces alike; edges are rounded.
            corners = [self.direction() for _ in range(draw.randint(8, 16))]
            text += f"corners = [{', '.join(metres(*(0.5 * size * x for x in corner)) for corner in corners)}]\n" \
                    f'rounding = "{0.5 * size * draw.uniform(0.1, 0.3):.9g} m"\n'
        return text + self.mesh(shape == "sphere")

    def direction(self):
        z, turn = self.draw.uniform(-1, 1), self.draw.uniform(0, 2 * math.pi)
        flat = math.sqrt(1 - z * z)
        return flat * math.cos(turn), flat * math.sin(turn), z

    # ---- where they lie -------------------------------------------------------------------------------
    def packing(self):
        draw = self.draw
        if self.lattice:
            self.cells = [draw.randint(1, 3) for _ in range(3)]
            self.width, self.depth = (n * self.size for n in self.cells[:2])
            return f'[[packing]]\nkind = "cubic"\nparticle = "p0"\ncells = {self.cells}\n'
        self.width = self.size * draw.uniform(2.5, 4)
        self.depth = self.width * draw.uniform(0.8, 1.2)
        wide = f'diameter = "{self.width:.9g} m"\n' if self.round_die else \
            f'width = "{self.width:.9g} m"\ndepth = "{self.depth:.9g} m"\n'
        text = f'[[packing]]\nkind = "random"\n{wide}density = {self.packed:.4g}\n'
        for k in range(len(self.materials)):
            text += f'[[packing.class]]\nparticle = "p{k}"\nnumber = {self.count}\n'
            if draw.random() < 0.3:
                text += f'distribution = "uniform"\nminimum = "{0.5 * self.size:.9g} m"\n' \
                        f'maximum = "{self.size:.9g} m"\nsizes = 2\n'
        return text

    def plane(self, name, point, normal):
        return f'[[tool]]\nname = "{name}"\nshape = "plane"\npoint = {point}\nnormal = {normal}\n'

    def height(self):
        """Of the powder, about: particles fill half of the cube of their size."""
        return self.cells[2] * self.size if self.lattice else \
            0.5 * self.count * len(self.materials) * self.size**3 / (self.width * self.depth * self.packed)

    def leaves(self):
        """Whether the compact is ejected past the mouth of its die."""
        return self.round_die and self.action == "press and eject"

    def tools(self):
        text = self.plane("bottom", metres(0, 0, 0), [0, 0, 1])
        if self.round_die:
            text += f'[[tool]]\nname = "die"\nshape = "die"\npoint = {metres(0, 0, 0)}\ndiameter = "{self.width:.9g} m"\n'
            if self.leaves():
                text += f'height = "{1.2 * self.height():.9g} m"\nrounding = "{0.2 * self.size:.9g} m"\n'
        else:
            for name, axis, at, sign in (("left", 0, 0, 1), ("right", 0, self.width, -1), ("front", 1, 0, 1),
                                         ("back", 1, self.depth, -1)):
                text += self.plane(name, metres(*(at if i == axis else 0 for i in range(3))),
                                   [sign if i == axis else 0 for i in range(3)])
        return text + self.plane("top", '["0 m", "0 m", "packing top"]', [0, 0, -1])

    # ---- what happens ---------------------------------------------------------------------------------
    def wave(self):
        return min(math.sqrt(MATERIALS[m][1] / MATERIALS[m][0]) for m in self.materials)

    def stage(self, name, kind, way, moves=(), more=""):
        duration = way / (self.speed * self.wave())
        return f'[[stage]]\nname = "{name}"\nkind = "{kind}"\nduration = "{duration:.9g} s"\n{more}' + "".join(
            f'[[stage.move]]\ntool = "{tool}"\ndisplacement = {metres(0, 0, z)}\nramp = 0.03\n' for tool, z in moves)

    def stages(self):
        height = self.height()
        if self.action == "throw":
            return self.stage("throw", "settle", height)
        if self.action == "hold":
            force = self.draw.uniform(0.1, 1.5) * self.weakest() * self.width * self.depth
            return self.stage("hold", "hold", height,
                              more=f'[[stage.servo]]\ntool = "top"\nforce = "{force:.9g} N"\nrise = 0.6\n'
                                   f'max_speed = "{2 * self.speed * self.wave():.9g} m/s"\ntolerance = 1e6\n')
        text = self.stage("press", "compact", height, [("top", -height)],
                          f"[stage.until]\nrelative_density = {self.pressed:.4g}\n")
        text += self.stage("lift", "unload", 0.1 * height, [("top", 0.1 * height)])
        if self.action == "press and eject":
            up = (1.3 if self.leaves() else 0.3) * height
            text += self.stage("push", "eject", up, [("top", up + 0.2 * height), ("bottom", up)])
        return text

    def text(self):
        packing = self.packing()
        tools, stages = self.tools(), self.stages()
        materials = ""
        for name in self.materials:
            materials += material(name)
            if self.mass_damping:
                density, youngs = MATERIALS[name][:2]
                rate = self.mass_damping * math.sqrt(youngs / density) / self.size
                materials += f'[material.damping]\nmass_proportional = "{rate:.9g} 1/s"\n'
        stiffness = f"stiffness = {self.contact:.9g}\n" if self.contact else ""
        return f'family = "compaction"\ndimension = 3\ntitle = "{self.name}"\nseed = {self.seed + 1}\n' \
            + materials + self.particles + packing + tools + stages + self.bonds() \
            + f"[contact]\nfriction = {self.friction:.9g}\n{stiffness}damping = {self.damping:.9g}\n" \
            + f'[element]\nformulation = "{self.formulation}"\n[output]\nsamples = 200\nframes = 2\n'

    def describe(self):
        shapes = ", ".join(f"{shape} of {material}" for shape, material in zip(self.shapes, self.materials))
        return f"{shapes}, {self.size:.2g} m, {'lattice' if self.lattice else 'random'} in a " \
               f"{'die' if self.round_die else 'box'}; {self.action} to {self.pressed:.2f} at {self.speed:.2g}; friction " \
               f"{self.friction:.2g}, contact {self.contact or 'default'}, damping {self.damping:.2g}, {self.formulation}" \
               + ("" if self.adhesion is None else f", adhesion {self.adhesion[0]:.2g} within {self.adhesion[1]:.2g}") \
               + ("" if self.welds is None else f", welds from {self.welds[0]:.2g}, {self.welds[1]:.2g}, {self.welds[2]:.2g}")


def density(summary, last):
    return f", relative density {float(last.get('relative_density', 'nan')):.3f}"


if __name__ == "__main__":
    sys.exit(try_all(__doc__, 60, Scene, LIMITS, density))
