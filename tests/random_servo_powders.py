#!/usr/bin/env python3
"""Random powders pressed by a force or a stress: none may be passed, or missed at the end of its stage, without a word.

    random_servo_powders.py PROGRAM [--scenes N] [--seed S] [--first I] [--keep DIR]

In turn dies in two dimensions, dies in three, and periodic cells. Shapes, materials, sizes, friction, damping, bonds, force,
duration (20 to 300 passages of a wave through the powder), rise, response and the highest speed are drawn; half of the scenes
go on with a second force. A run may

  hold   its force: within the tolerance over the last tenth of every stage, and never passed by more
  tell   that it passed its force: exit code 0, and "overshoot" beyond its limit in the table of quality
  stop   since the force was not held at the end of a stage: exit code 3, with a message of the servo
  limit  by another physical limit, which is named: exit code 3
  slow   take more than ten minutes

Anything else is BAD: this script computes force errors from the history of the run, not from what the program says of them.
"""
import random
import sys

import numpy as np

from random_scenes import MATERIALS, TIMED_OUT, history_of, judge_all, keys, log_uniform, parser, run, summary_of, table, \
    wave_speed

KINDS = ("2D", "3D", "cell")
TOLERANCE = 0.05
OUTCOMES = ("hold", "tell", "stop", "limit", "slow", "BAD")
PLANES = {2: [("left", (0, 0), (1, 0)), ("right", (1, 0), (-1, 0)), ("bottom", (0, 0), (0, 1)), ("top", (0, 1), (0, -1))],
          3: [("left", (0, 0, 0), (1, 0, 0)), ("right", (1, 0, 0), (-1, 0, 0)), ("front", (0, 0, 0), (0, 1, 0)),
              ("back", (0, 1, 0), (0, -1, 0)), ("bottom", (0, 0, 0), (0, 0, 1)), ("top", (0, 0, 1), (0, 0, -1))]}


class Scene:
    """Everything that was drawn, and the text that says it."""

    def __init__(self, seed, number):
        draw = self.draw = random.Random(f"servo powders/{seed}/{number}")
        self.kind, self.name = KINDS[number % 3], f"servo-powder-{seed}-{number}"
        self.dimensions = 3 if self.kind == "3D" else 2
        self.material = draw.choice(list(MATERIALS))
        self.density, self.youngs, self.nu, self.strength, self.hardening = MATERIALS[self.material]
        self.size = log_uniform(draw, 1e-5, 1e-1)  # m, of a particle
        self.count = draw.randint(1, 2) if self.kind == "3D" else draw.randint(2, 4)  # of particles along a side
        self.shape = draw.choice(["round", "round", "flat", "sharp"])
        self.friction, self.damping = draw.choice([0, 0.1, 0.5, 1]), draw.choice([0, 0.1, 0.5, 1])
        self.stiffness = draw.choice([None, None, log_uniform(draw, 0.5, 10)])
        strength = self.strength or 0.003 * self.youngs
        self.pressure = strength * log_uniform(draw, 0.03, 2 if self.strength else 1)
        self.passages = log_uniform(draw, 20, 300)
        self.rise = draw.choice([None, 0.5, 1])
        self.response = draw.choice([None, None, log_uniform(draw, 0.02, 2)])
        self.second = draw.choice([None, 0.5, 1, 1.5])
        self.max_speed = draw.choice([None, 1e4])
        self.welds = draw.random() < 0.3

    def describe(self):
        return (f"{self.kind}, {self.count} a side, {self.shape}, {self.size:.3g} m, {self.material}, "
                f"{self.pressure / 1e6:.3g} MPa, {self.passages:.3g} passages, friction {self.friction}, damping {self.damping}, "
                f"response {self.response or 0.1:.2g}, then {self.second}")

    # ---- its text -------------------------------------------------------------------------------------
    def length(self, x):
        return f"{x:.12g} m"

    def particle(self):
        shape, at = self.shape, self.length
        if self.dimensions == 2:
            outline = {"round": dict(outline="disc", diameter=at(self.size)),
                       "flat": dict(outline="ellipse", width=at(self.size), height=at(0.7 * self.size)),
                       "sharp": dict(outline="rounded_rectangle", width=at(self.size), height=at(0.8 * self.size),
                                     radius=at(0.2 * self.size))}[shape]
        else:
            outline = {"round": dict(shape="sphere", diameter=at(self.size)),
                       "flat": dict(shape="ellipsoid", size=[at(self.size), at(self.size), at(0.7 * self.size)]),
                       "sharp": dict(shape="cylinder", diameter=at(self.size), height=at(0.9 * self.size),
                                     rounding=at(0.2 * self.size))}[shape]
        return table("particle", name="p", material="m", **outline)

    def side(self):
        return self.count * self.size

    def section(self):
        return self.side() * (self.side() if self.dimensions == 3 else self.size)  # the slice is as thick as a particle

    def walls(self):
        if self.kind == "cell":
            return f'[cell]\nwidth = "{self.length(self.side())}"\nheight = "{self.length(self.side())}"\n'
        return "".join(table("tool", name=name, shape="plane", point=[self.length(self.side() * x) for x in point],
                             normal=list(normal)) for name, point, normal in PLANES[self.dimensions])

    def packing(self):
        if self.dimensions == 3:
            return table("packing", kind="cubic", particle="p", cells=[self.count] * 3, spacing=self.length(self.size))
        return table("packing", kind="square", particle="p", rows=self.count, columns=self.count,
                     spacing=self.length(self.size))

    def duration(self):
        return self.passages * self.side() / wave_speed(self.density, self.youngs, self.nu)

    def stage(self, name, pressure):
        made = table("stage", name=name, kind="compact", duration=f"{self.duration():.12g} s")
        if self.kind == "cell":
            return made + "[stage.cell]\n" + keys(stress_xx=f"{-pressure:.12g} Pa", stress_yy=f"{-pressure:.12g} Pa",
                                                  rise=self.rise, response=self.response, tolerance=TOLERANCE)
        speed = None if self.max_speed is None else f"{self.max_speed:.12g} m/s"
        return made + table("stage.servo", tool="top", force=f"{pressure * self.section():.12g} N", rise=self.rise,
                            response=self.response, max_speed=speed, tolerance=TOLERANCE)

    def bond(self):
        if not self.welds or not self.strength:
            return ""
        return table("bond", between=["m", "m"], origin="pressed", threshold=f"{0.3 * self.strength:.12g} Pa", growth=0.3,
                     strength=f"{0.3 * self.strength:.12g} Pa",
                     fracture_energy=f"{0.3 * self.strength * 0.01 * self.size:.12g} J/m^2")

    def text(self):
        flow = dict(yield_stress=f"{self.strength:.12g} Pa", hardening_modulus=f"{self.hardening:.12g} Pa") if self.strength else {}
        third = "dimension = 3\n" if self.dimensions == 3 else f'thickness = "{self.length(self.size)}"\n'
        springs = "" if self.stiffness is None else f"stiffness = {self.stiffness:.6g}\n"
        second = "" if self.second is None else self.stage("second", self.second * self.pressure)
        return "".join([f'family = "compaction"\naccuracy = "draft"\n{third}',
                        table("material", name="m", density=f"{self.density} kg/m^3", youngs_modulus=f"{self.youngs} Pa",
                              poissons_ratio=self.nu, **flow),
                        self.particle(), self.packing(), self.walls(), self.stage("first", self.pressure), second, self.bond(),
                        f"[contact]\nfriction = {self.friction}\ndamping = {self.damping}\n{springs}"
                        "[output]\nsamples = 2000\nframes = 2\n"])

    # ---- what it was to hold --------------------------------------------------------------------------
    def targets(self):
        pressures = [self.pressure] + ([] if self.second is None else [self.second * self.pressure])
        return [p * (1 if self.kind == "cell" else self.section()) for p in pressures]

    def series(self):
        """Names in the history, and the sign of what is to be held."""
        return [("cell/stress_xx", -1), ("cell/stress_yy", -1)] if self.kind == "cell" else \
            [(f"tool/top/force_{'z' if self.dimensions == 3 else 'y'}", 1)]


def series_of(folder):
    return {name: np.array(series) for name, series in history_of(folder).items()}


def errors(scene, folder):
    """Largest excess over the target, and largest error in the last tenth of a stage, relative to the target."""
    history, excess, off = series_of(folder), 0.0, 0.0
    for name, sign in scene.series():
        force = sign * history[name]
        before = force[0]  # contact curves may overlap at the start
        for number, target in enumerate(scene.targets()):
            begin = number * scene.duration()
            within = (history["time"] > begin) & (history["time"] <= begin + scene.duration() * (1 + 1e-9))
            last = within & (history["time"] >= begin + 0.92 * scene.duration())
            if not np.any(last):
                continue
            excess = max(excess, np.max(force[within]) / max(before, target) - 1)
            if scene.rise != 1:
                off = max(off, np.max(np.abs(force[last] / target - 1)))
            before = target
    return excess, off


def judge(scene, code, message, folder):
    if code == TIMED_OUT:
        return "slow", message
    if code == 3:
        kind = "stop" if "tool_servo" in message or "mixed_control" in message else "limit"
        line = next(line for line in message.splitlines() if "the run failed" in line)
        return kind, line[:200]
    if code != 0:
        return "BAD", f"exit code {code}: {message.strip()[-300:]}"
    quality = {row["name"]: row for row in summary_of(folder).get("quality", [])}
    excess, off = errors(scene, folder)
    figures = f"passed by {excess:.3g}, off by {off:.3g} at the end"
    if off > TOLERANCE * 1.02:
        return "BAD", "in silence: " + figures
    if excess <= TOLERANCE:
        return "hold", figures
    told = quality.get("Overshoot", {})
    beyond = told.get("value", 0) >= 0.9 * excess and told["value"] > told["limit"]
    return ("tell" if beyond else "BAD"), figures


def main():
    options = parser(__doc__, scenes=102).parse_args()

    def judged(scene, file, folder):
        outcome, reason = judge(scene, *run(options.program, file, folder, 1, timeout=600), folder)
        return outcome, [reason]

    counts = judge_all(options, Scene, judged)
    print(f"{'':5}" + "".join(f"{outcome:>7}" for outcome in OUTCOMES))
    for kind in KINDS:
        print(f"{kind:5}" + "".join(f"{counts[kind, outcome]:7}" for outcome in OUTCOMES))
    return 1 if any(counts[kind, "BAD"] for kind in KINDS) else 0


if __name__ == "__main__":
    sys.exit(main())
