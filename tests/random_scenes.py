"""What the random scenes of random_servos.py and random_breakage.py share."""
import argparse
import pathlib

# density kg/m^3, Young's modulus Pa, Poisson's ratio, yield stress Pa or none, hardening Pa
MATERIALS = {"316L": (7990, 200e9, 0.30, 240e6, 440e6), "Cu": (8940, 115e9, 0.35, 50e6, 440e6),
             "salt": (2160, 20e9, 0.25, None, 0), "glass": (2500, 70e9, 0.22, None, 0),
             "polymer": (1100, 2e9, 0.40, None, 0), "lactose": (1500, 3e9, 0.3, 60e6, 20e6)}


def parser(description, scenes):
    made = argparse.ArgumentParser(description=description.splitlines()[0])
    made.add_argument("program", type=pathlib.Path)
    made.add_argument("--scenes", type=int, default=scenes)
    made.add_argument("--seed", type=int, default=1)
    made.add_argument("--first", type=int, default=0, help="number of the first scene")
    made.add_argument("--keep", type=pathlib.Path, help="folder for scenes and runs")
    return made


def log_uniform(draw, low, high):
    return low * (high / low) ** draw.random()
