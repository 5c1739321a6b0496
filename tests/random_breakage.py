"""Random scenes of things that break: each must run to its end, with its energy in balance and the same bits on two threads.

  /usr/bin/python3 tests/random_breakage.py PROGRAM [--scenes N] [--seed S] [--first I] [--keep DIR]

Blocks of walls, hexagons, discs and other outlines of one or two materials, elastic or plastic, are glued, weld under
pressure, stick to a punch and cling, in whatever mixture was drawn, and are crushed, sheared, torn, pushed out of a die
or thrown against a wall. Strengths, energies, stiffness, drawn strengths, meshes, friction and damping are drawn too.
The health checks of every run are on, and its energies balance to 1% in the end; all that is asked of it is in `faults`. A scene that
is refused, or that stops in a health check that names what went bad, is told and counted apart.
"""
import math
import random
import re
import sys

from random_scenes import MATERIALS, log_uniform, material, metres, try_all

SIDE = 1e-3  # m, of a particle
# What a physical limit says when it stops a run (exit code 3); an energy balance is no such limit.
LIMITS = re.compile(r"penetration|inverted|det F|turned over|itself|hole|lost|left behind|unconverged|ridge|passed through")


class Scene:
    """Everything that was drawn, and the text that says it."""

    def __init__(self, seed, number):
        self.draw = draw = random.Random(f"{seed}/{number}")
        self.name, self.seed = f"breakage-{seed}-{number}", number
        self.materials = draw.sample(list(MATERIALS), draw.choice([1, 1, 2]))
        self.layout = draw.choice(["wall", "wall", "hexagons", "discs", "rounded", "ellipses", "superellipses"])
        self.columns, self.rows = draw.randint(2, 4), draw.randint(2, 4)
        self.friction = draw.choice([0, draw.uniform(0, 0.6)])
        self.contact = draw.choice([0.5, 0.5, log_uniform(draw, 0.5, 10)])
        self.damping = draw.choice([0, 0.1, draw.random()])
        self.mass_damping = draw.choice([0, 0, log_uniform(draw, 1e3, 1e5)])
        self.action = draw.choice(["crush", "crush in a die", "shear", "tear", "eject", "throw"])
        if self.layout in ("rounded", "ellipses", "superellipses", "discs") and self.action == "tear":
            self.action = "crush in a die"  # what touches in points has hardly anything to tear
        self.speed = log_uniform(draw, 2e-3, 2e-2)  # of a bar's wave in the softest
        self.way = draw.uniform(0.05, 0.25)          # of the height
        self.place_bodies()
        self.bonds = self.draw_bonds()

    # ---- bodies ---------------------------------------------------------------------------------------
    def particle(self, name, material, outline, mesh):
        return f'[[particle]]\nname = "{name}"\nmaterial = "{material}"\n{outline}[particle.mesh]\n{mesh}'

    def place_bodies(self):
        draw, self.particles, self.bodies = self.draw, "", []
        kinds = draw.choice([1, 2, 3])
        self.edges = []  # m, their lengths
        for k in range(kinds):
            material = self.materials[k % len(self.materials)]
            self.particles += self.particle(f"p{k}", material, *self.outline())
        self.used = self.materials[:kinds]
        wide, high = self.cell()
        for row in range(self.rows):
            shift = 0.5 * wide if row % 2 and self.layout in ("wall", "hexagons") and self.staggered else 0
            for column in range(self.columns):
                k = draw.randrange(kinds) if len(self.bodies) >= kinds else len(self.bodies)  # every class once
                self.bodies.append((k, (column + 0.5) * wide + shift, (row + 0.5) * high))
        # Edges of the rounded outlines stand out a little.
        half = 0.501 * SIDE
        xs, ys = [x for _, x, _ in self.bodies], [y for _, _, y in self.bodies]
        self.left, self.right = min(xs) - half, max(xs) + half
        self.bottom, self.top = min(ys) - half, max(ys) + half
        if self.layout == "hexagons":
            across = SIDE / math.sqrt(3)
            self.left, self.right = min(xs) - 1.001 * 0.5 * SIDE, max(xs) + 1.001 * 0.5 * SIDE
            self.bottom, self.top = min(ys) - 1.001 * across, max(ys) + 1.001 * across

    def outline(self):
        draw = self.draw
        if self.layout == "wall":
            columns, rows = draw.randint(2, 8), draw.randint(2, 8)
            self.edges += [SIDE / columns, SIDE / rows]
            self.staggered = getattr(self, "staggered", draw.random() < 0.5)
            return (f'outline = "rectangle"\nwidth = "{SIDE} m"\nheight = "{SIDE} m"\n',
                    f"columns = {columns}\nrows = {rows}\n")
        edges = 4 * draw.randint(6, 14)
        self.edges.append(3 * SIDE / edges)
        mesh = f"boundary_edges = {edges}\nrings = 1\n"
        if self.layout == "hexagons":
            self.staggered = True
            edges = 12 * draw.randint(2, 4)
            self.edges[-1] = 3.46 * SIDE / edges
            return (f'outline = "polygon"\nsides = 6\ndiameter = "{2 * SIDE / math.sqrt(3):.15g} m"\n',
                    f"boundary_edges = {edges}\nrings = 1\n")
        if self.layout == "discs":
            return f'outline = "disc"\ndiameter = "{SIDE} m"\n', mesh + draw.choice(["", 'phase = "random"\n'])
        if self.layout == "rounded":
            return (f'outline = "rounded_rectangle"\nwidth = "{SIDE} m"\nheight = "{SIDE} m"\n'
                    f'radius = "{draw.uniform(0.1, 0.4) * SIDE} m"\n', f"boundary_edges = {max(40, edges)}\n")
        if self.layout == "ellipses":
            return (f'outline = "ellipse"\nwidth = "{SIDE} m"\nheight = "{draw.uniform(0.8, 1) * SIDE} m"\n',
                    f"boundary_edges = {max(32, edges)}\n")
        return (f'outline = "superellipse"\nwidth = "{SIDE} m"\nheight = "{SIDE} m"\n'
                f'exponent = {draw.uniform(2, 6)}\n', f"boundary_edges = {max(40, edges)}\n")

    def cell(self):
        if self.layout == "hexagons":
            return SIDE, SIDE * math.sqrt(3) / 2
        apart = 1 if self.layout in ("wall", "discs") else 1.004
        return apart * SIDE, apart * SIDE

    # ---- bonds ----------------------------------------------------------------------------------------
    def law(self, materials, weakness=1.0):
        """Keys of a cohesive law; its energy from just more than its spring stores to far more."""
        draw = self.draw
        softest = min(MATERIALS[m][1] for m in materials)
        strength = weakness * log_uniform(draw, 2e-4, 1e-2) * softest
        stiffness = draw.choice([20, log_uniform(draw, 5, 100)])
        bulk = min(MATERIALS[m][1] / (3 * (1 - 2 * MATERIALS[m][2])) for m in materials)
        spring = stiffness * self.contact * bulk / (2 * max(self.edges)) / 2
        ratio = draw.choice([1, draw.uniform(0.5, 3)])
        most = strength * max(1, ratio)
        energy = draw.choice([log_uniform(draw, 1.3, 10), log_uniform(draw, 10, 300)]) * most**2 / (2 * spring)
        text = f'strength = "{strength:.9g} Pa"\nfracture_energy = "{energy:.9g} J/m^2"\nstiffness = {stiffness:.9g}\n'
        if ratio != 1:
            text += f'shear_strength = "{ratio * strength:.9g} Pa"\n' \
                    f'shear_fracture_energy = "{energy * draw.uniform(1, 3):.9g} J/m^2"\n' \
                    f'mixed_mode_exponent = {draw.uniform(1, 3):.9g}\n'
        return text, strength

    def bond(self, first, second, origin, materials, weakness=1.0):
        draw, text = self.draw, f'[[bond]]\nbetween = ["{first}", "{second}"]\norigin = "{origin}"\n'
        if origin == "adhesion":
            reach = log_uniform(draw, 0.01, 0.3) * min(self.edges)
            traction = log_uniform(draw, 1e-6, 1e-3) * min(MATERIALS[m][1] for m in materials)
            return text + f'work = "{0.5 * traction * reach:.9g} J/m^2"\nrange = "{reach:.9g} m"\n'
        law, strength = self.law(materials, weakness)
        text += law
        if origin == "initial":
            reach = 0.01 if self.layout in ("wall", "hexagons") else draw.uniform(0.1, 0.5)
            if draw.random() < 0.4:
                text += f"weibull_modulus = {log_uniform(draw, 2, 30):.9g}\n"
            return text + f"reach = {reach:.9g}\n"
        return text + f'threshold = "{log_uniform(draw, 0.1, 10) * strength:.9g} Pa"\n' \
                      f"growth = {log_uniform(draw, 0.01, 1):.9g}\n"

    def draw_bonds(self):
        draw, text, self.origins = self.draw, "", []
        pairs = [(a, b) for i, a in enumerate(self.used) for b in self.used[i:]]
        touching = {tuple(sorted((self.material_of(a), self.material_of(b))))
                    for i, a in enumerate(self.bodies) for b in self.bodies[:i] if self.touch(a, b)}
        for a, b in pairs:
            origins = [origin for origin, chance in (("initial", 0.75), ("pressed", 0.4), ("adhesion", 0.25))
                       if draw.random() < chance] or ["initial"]
            for origin in origins:
                if origin == "initial" and tuple(sorted((a, b))) not in touching:
                    continue
                self.origins.append(origin)
                text += self.bond(a, b, origin, (a, b))
        if self.action not in ("tear", "throw"):
            for tool in ("top", "bottom"):
                if draw.random() < 0.25:
                    self.origins.append(f"pressed on {tool}")
                    text += self.bond(self.used[0], tool, "pressed", (self.used[0],), 0.3)
        return text

    def material_of(self, body):
        return self.materials[body[0] % len(self.materials)]

    def touch(self, a, b):
        dx, dy = abs(a[1] - b[1]), abs(a[2] - b[2])
        wide, high = self.cell()
        if self.layout in ("wall", "hexagons"):
            beside = 0.9 if self.layout == "wall" else 0.6
            return (dy < 0.1 * high and dx < 1.1 * wide) or (dx < beside * wide and dy < 1.1 * high)
        return dx + dy < 1.1 * max(wide, high)

    # ---- tools ----------------------------------------------------------------------------------------
    def plane(self, name, x, y, nx, ny):
        return f'[[tool]]\nname = "{name}"\nshape = "plane"\npoint = {metres(x, y)}\nnormal = [{nx}, {ny}]\n'

    def held(self, body, below):
        """The rim of a body, which its neighbours do not reach."""
        _, x, y = self.bodies[body]
        reach, rim = SIDE, 0.3 * SIDE
        low, high = (y - reach, y - rim) if below else (y + rim, y + reach)
        name = f"{'below' if below else 'above'}-{body}"
        return f'[[tool]]\nname = "{name}"\nshape = "constraint"\nbody = {body}\n' \
               f'low = {metres(x - reach, low)}\nhigh = {metres(x + reach, high)}\nholds = "both"\n'

    def torn(self):
        return range(len(self.bodies) - self.columns, len(self.bodies))  # the topmost row

    def tools(self):
        if self.action == "tear":
            return "".join(self.held(body, True) for body in range(self.columns)) + \
                "".join(self.held(body, False) for body in self.torn())
        text = self.plane("bottom", 0, self.bottom, 0, 1)
        if self.action == "throw":
            return text
        text += self.plane("top", 0, self.top, 0, -1)
        if self.action in ("crush in a die", "eject"):
            text += self.plane("left", self.left, 0, 1, 0) + self.plane("right", self.right, 0, -1, 0)
        return text

    def stage(self, name, kind, way, moves):
        duration = max(way, 0.02 * SIDE) / (self.speed * self.wave())
        return f'[[stage]]\nname = "{name}"\nkind = "{kind}"\nduration = "{duration:.9g} s"\n' + "".join(
            f'[[stage.move]]\ntool = "{tool}"\ndisplacement = {metres(x, y)}\n' for tool, x, y in moves)

    def wave(self):
        return min(math.sqrt(MATERIALS[m][1] / MATERIALS[m][0]) for m in self.used)

    def stages(self):
        height = self.top - self.bottom
        way = self.way * height
        if self.action.startswith("crush"):
            return self.stage("crush", "compact", way, [("top", 0, -way)]) + \
                self.stage("lift", "unload", 0.5 * way, [("top", 0, 0.5 * way)])
        if self.action == "shear":
            pressed = 0.02 * height
            return self.stage("press", "compact", pressed, [("top", 0, -pressed)]) + \
                self.stage("shear", "shear", way, [("top", way, 0)])
        if self.action == "tear":
            across = self.draw.choice([0, 0.5, 1])
            return self.stage("tear", "unload", way, [(f"above-{body}", across * way, way) for body in self.torn()])
        if self.action == "eject":
            return self.stage("press", "compact", 0.3 * way, [("top", 0, -0.3 * way)]) + \
                self.stage("open", "unload", way, [("top", 0, way), ("right", 0.3 * way, 0)]) + \
                self.stage("push", "eject", 0.5 * way, [("bottom", 0, 0.5 * way)])
        return self.stage("throw", "hold", height, [])

    def text(self):
        tools, stages = self.tools(), self.stages()
        materials = ""
        for name in self.used:
            materials += material(name)
            if self.mass_damping:
                materials += f'[material.damping]\nmass_proportional = "{self.mass_damping:.9g} 1/s"\n'
        falling = f'velocity = ["0 m/s", "{-2 * self.speed * self.wave():.9g} m/s"]\n' if self.action == "throw" else ""
        turned = 'angle = "30 deg"\n' if self.layout == "hexagons" else ""
        bodies = "".join(f'[[body]]\nparticle = "p{k}"\nposition = {metres(x, y)}\n{turned}{falling}'
                         for k, x, y in self.bodies)
        return f'family = "compaction"\ntitle = "{self.name}"\nthickness = "1 mm"\nseed = {self.seed + 1}\n' \
            + materials + self.particles + bodies + self.bonds + tools + stages \
            + f"[contact]\nfriction = {self.friction:.9g}\nstiffness = {self.contact:.9g}\ndamping = {self.damping:.9g}\n" \
            + "[output]\nsamples = 200\nframes = 2\n"

    def describe(self):
        return f"{self.columns} x {self.rows} {self.layout} of {', '.join(self.used)}: {', '.join(self.origins)}; " \
               f"{self.action} by {self.way:.2g} at {self.speed:.2g}; friction {self.friction:.2g}, " \
               f"contact {self.contact:.2g}, damping {self.damping:.2g}"


def figures(summary, last):
    return f", cracks {1e3 * float(last.get('bonds/crack_length', 'nan')):.2f} mm"


if __name__ == "__main__":
    sys.exit(try_all(__doc__, 100, Scene, LIMITS, figures))
