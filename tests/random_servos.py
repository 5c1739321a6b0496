#!/usr/bin/env python3
"""Random scenes with a force servo: each must end with its force held, its energy in balance and no swing.

    random_servos.py PROGRAM [--scenes N] [--seed S] [--first I] [--keep DIR] [--set KEY=VALUE ...]

Contact stiffness and damping are drawn from all that a scene may say, compacts from one particle to many (discs,
rounded squares, blocks; metals, hard and soft elastic ones), forces from gentle to far beyond first yield. The
punch settles, loads, holds and, in some scenes, holds on while the plane below is drawn along or a wall is
held at a force of its own. Nothing of the servo is tuned. All that is asked of a scene is in `faults`.
"""
import random
import sys

import numpy as np

from random_scenes import MATERIALS, history_of, judge_all, log_uniform, material, parser, run, summary_of, table, \
    wave_speed

MATERIAL_NAMES = ("316L", "Cu", "glass", "polymer")


class Scene:
    """Everything that was drawn, and the text that says it."""

    def __init__(self, seed, number):
        draw = random.Random(f"{seed}/{number}")
        self.name = f"servo-{seed}-{number}"
        self.material = draw.choice(MATERIAL_NAMES)
        self.outline = draw.choice(["disc", "disc", "rounded", "block", "flat block"])
        side = log_uniform(draw, 1e-5, 1e-1)
        self.size = {"disc": (side, side), "rounded": (side, side), "block": (side, side),
                     "flat block": (4 * side, side)}[self.outline]
        most = 3 if self.outline == "disc" else 2
        self.columns, self.rows = draw.choice([(1, 1), (draw.randint(1, most), draw.randint(1, most))])
        self.edges = draw.choice([16, 24, 40])  # around a particle
        self.stiffness = draw.choice([0.5, log_uniform(draw, 0.35, 100)])
        self.damping = draw.choice([0, 1, draw.random(), draw.random()])
        self.friction = draw.choice([0, draw.uniform(0, 0.5)])
        self.pressure = log_uniform(draw, *self.pressures())
        self.after = draw.choice(["hold", "hold", "shear", "wall"])
        if self.outline == "flat block" and self.columns > 1:
            self.after = "hold"
        if self.outline == "rounded":  # they fall through a gap, and undamped elastic ones ring for long
            self.damping = max(self.damping, 0.2)
        if self.after == "shear":
            self.friction = min(self.friction, 0.2)  # elastic blocks that are dragged along squeal with more
        self.settles = draw.random() < 0.3
        if self.after == "wall" and self.outline == "disc":
            self.friction = max(self.friction, 0.05)  # or they roll from one point of their mesh to the next
        # The contact curve of a coarse rounded corner stands out a little.
        self.apart = 1.005 if self.outline == "rounded" else 1
        self.width = self.columns * self.apart * self.size[0]
        self.height = self.rows * self.apart * self.size[1]

    def pressures(self):
        _, youngs, _, strength, _ = MATERIALS[self.material]
        if self.outline in ("disc", "rounded"):  # which have a way to go until they bear something
            least = 0.1 if self.outline == "disc" else 0.3
            return (least * strength, 1.5 * strength) if strength else (1e-3 * youngs, 1e-2 * youngs)
        return (0.01 * strength, 1.5 * strength) if strength else (1e-5 * youngs, 5e-3 * youngs)

    def wave_time(self):
        return max(self.width, self.height) / wave_speed(*MATERIALS[self.material][:3])

    def force(self, share=1.0, across=None):
        return share * self.pressure * (across or self.width) * self.size[0]  # as thick as wide

    def describe(self):
        return (f"{self.columns} x {self.rows} {self.outline} of {self.size[0]:.3g} m {self.material}, "
                f"{self.edges} edges, stiffness {self.stiffness:.3g}, damping {self.damping:.3g}, friction "
                f"{self.friction:.2g}, {self.pressure / 1e6:.3g} MPa, {self.after}")

    # ---- its text -------------------------------------------------------------------------------------
    def particle(self):
        wide, high = self.size
        across = max(1, self.edges // 4)
        if self.outline == "disc":
            return f'outline = "disc"\ndiameter = "{wide:.17g} m"\n[particle.mesh]\n' \
                   f'boundary_edges = {self.edges}\nrings = 1\n'
        if self.outline == "rounded":
            return f'outline = "rounded_rectangle"\nwidth = "{wide:.17g} m"\nheight = "{high:.17g} m"\n' \
                   f'radius = "{0.25 * wide:.17g} m"\n[particle.mesh]\nboundary_edges = {max(40, self.edges)}\n'
        columns = across * (4 if self.outline == "flat block" else 1)
        return f'outline = "rectangle"\nwidth = "{wide:.17g} m"\nheight = "{high:.17g} m"\n' \
               f'[particle.mesh]\ncolumns = {columns}\nrows = {across}\n'

    def tool(self, name, x, y, nx, ny):
        return table("tool", name=name, shape="plane", point=[f"{x:.17g} m", f"{y:.17g} m"], normal=[nx, ny])

    def servo(self, tool, force, more=""):
        return table("stage.servo", tool=tool, force=f"{force:.17g} N") + more

    def stage(self, name, kind, duration):
        return table("stage", name=name, kind=kind, duration=f"{duration:.17g} s")

    def stages(self):
        wave, rise = self.wave_time(), "rise = 0.8\n"
        self.load, self.hold = (600 if self.outline == "rounded" else 300) * wave, 100 * wave
        text = self.stage("settle", "settle", 5 * wave) if self.settles else ""
        wall = self.after == "wall"
        side = 0.4 * self.pressure * self.height * self.size[0]
        text += self.stage("load", "compact", self.load) + self.servo("top", self.force(), rise)
        text += self.servo("right", side, rise) if wall else ""
        text += self.stage("hold", "hold", self.hold) + self.servo("top", self.force())
        text += self.servo("right", side) if wall else ""
        if self.after == "shear":
            text += self.stage("shear", "shear", self.load) + self.servo("top", self.force())
            text += f'[[stage.move]]\ntool = "bottom"\ndisplacement = ["{0.02 * self.size[0]:.17g} m", "0 m"]\n'
        return text

    def text(self):
        bodies = "".join(
            f'[[body]]\nparticle = "p"\nposition = ["{(i + 0.5) * self.apart * self.size[0]:.17g} m", '
            f'"{(k + 0.5) * self.apart * self.size[1]:.17g} m"]\n'
            for k in range(self.rows) for i in range(self.columns))
        return "".join([
            f'family = "compaction"\ntitle = "{self.name}"\nthickness = "{self.size[0]:.17g} m"\n'
            + material("m", self.material), '[[particle]]\nname = "p"\nmaterial = "m"\n', self.particle(),
            bodies, self.tool("left", 0, 0, 1, 0), self.tool("right", self.width, 0, -1, 0),
            self.tool("bottom", 0, 0, 0, 1), self.tool("top", 0, self.height, 0, -1), self.stages(),
            f"[contact]\nfriction = {self.friction}\nstiffness = {self.stiffness}\n"
            f"damping = {self.damping}\n[output]\nsamples = 1200\nframes = 2\n"])


# ---- what is asked of a run ---------------------------------------------------------------------------
def force_errors(history, tool, axis):
    return np.abs(history[f"tool/{tool}/force_{axis}"]) - history[f"tool/{tool}/force_asked"]


def faults(scene, code, message, folder):
    if code != 0:
        return [f"exit code {code}: {message.strip()}"], {}
    summary = summary_of(folder)
    history = {name: np.array(series) for name, series in history_of(folder).items()}
    begin = history["time"][-1] - scene.hold if scene.after != "shear" else \
        history["time"][-1] - scene.hold - scene.load
    held = (history["time"] > begin + 0.25 * scene.hold) & (history["time"] <= begin + scene.hold)
    figures = {"balance": summary["energy_balance_error"], "steps": summary["steps"]}
    found = []
    if figures["balance"] > 0.02:
        found.append(f"energy balance {figures['balance']:.3g}")
    tools = [("top", "y", scene.force())]
    if scene.after == "wall":
        tools.append(("right", "x", 0.4 * scene.pressure * scene.height * scene.size[0]))
    for tool, axis, force in tools:
        error = force_errors(history, tool, axis) / force
        rising = history[f"tool/{tool}/force_asked"] > 0.5 * force
        figures[f"{tool} most"] = np.max(error[rising])
        figures[f"{tool} held"] = np.max(np.abs(error[held]))
        early, late = np.array_split(error[held], 2)
        figures[f"{tool} swing"] = (np.std(early), np.std(late))
        if figures[f"{tool} most"] > 0.1:
            found.append(f"{tool} passes its force by {figures[f'{tool} most']:.3g}")
        if figures[f"{tool} held"] > 0.02:
            found.append(f"{tool} is off by {figures[f'{tool} held']:.3g} while it holds")
        if np.std(late) > 1.2 * np.std(early) + 1e-3:
            found.append(f"{tool} swings up: {np.std(early):.3g}, then {np.std(late):.3g}")
    return found, figures


def told(figures):
    return ", ".join(f"{name} " + ("/".join(f"{v:.2g}" for v in value) if isinstance(value, tuple) else
                                    f"{value:.3g}") for name, value in figures.items())


def arguments():
    made = parser(__doc__, scenes=50)
    made.add_argument("--set", action="append", default=[], help="handed on to the program")
    return made.parse_args()


def main():
    options = arguments()
    changes = [word for change in options.set for word in ("--set", change)]

    def judged(scene, file, folder):
        found, figures = faults(scene, *run(options.program, file, folder, 1, changes, timeout=None), folder)
        return "NOT" if found else "ok", [told(figures), *found]

    bad = judge_all(options, Scene, judged)["", "NOT"]
    print(f"{options.scenes - bad} of {options.scenes} scenes held their force")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
