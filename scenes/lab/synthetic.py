#!/usr/bin/python3
"""Generates synthetic records of sliding-plate tests from known parameters: no measured data.

usage: synthetic.py [--out FOLDER] [--seed N] [--noise FACTOR]

Three runs of a 316L compact under 1 kN on the press of the thesis (section 3.2), in the formats of
its instruments: the press with semicolons, decimal commas and a line of units, the data logger with
commas. Also writes truth.json, the reference for the tests of the reduction.

The sampling rate is from the thesis (logger 10 Hz) or assumed (press 20 Hz). The thesis states
sensitivities but no noise; assumed are 1 um/m of strain (0.73 N), 0.02 mV of LVDT (6 um), 1 N of
force and 0.5 um of punch displacement, one standard deviation each.
"""
import argparse
import json
import math
import random
from pathlib import Path

GAIN, OFFSET = 0.7257, 1.3795        # N per um/m, N (3.2.4)
SENSITIVITY = 3.58                   # mV/mm (3.2.5)
DIAMETER, LENGTH, POISSON = 15.0, 10.0, 0.3  # mm, mm, - (Table 3.2)
FORCE, RATE = 1000.0, 500.0          # N, N/s (3.2.3)
SPEED, DISTANCE = 1.3, 50.0          # mm/s, mm
LOADED_AT = 1.5                      # s on the press's clock
STOP_AFTER = 4.0                     # s, logger recording time after sliding
PRESS_INTERVAL, PRESS_AFTER = 0.05, 9.0  # s: sampling interval of the press; time after sliding
TAKE_UP, SETTLED = 0.52, 4.0         # mm: position of the static peak, start of the dynamic level
SLIP_FROM, SLIP_PERIOD, SLIP_HEIGHT = 8.0, 2.4, 0.012  # mm, mm, - (a sawtooth about the level)
NOISE = {"strain": 1.0, "lvdt": 0.02, "force": 1.0, "displacement": 5e-4}  # um/m, mV, N, mm
MAKER = "synthetic.py"
RUNS = [  # mu static, mu dynamic; start of sliding on each clock, s; drift of the press's clock
    {"static": 0.231, "dynamic": 0.184, "press": 23.37, "logger": 6.21, "drift": 3e-4},
    {"static": 0.225, "dynamic": 0.179, "press": 19.82, "logger": 5.04, "drift": -2e-4},
    {"static": 0.236, "dynamic": 0.187, "press": 25.55, "logger": 7.73, "drift": 0.0},
]


def friction(run, x):
    """Coefficient after x mm: up to the static peak, down to the dynamic level, then a sawtooth."""
    if x <= TAKE_UP:
        return run["static"] * x / TAKE_UP
    down = min(1.0, (x - TAKE_UP) / (SETTLED - TAKE_UP))
    mu = run["static"] + (run["dynamic"] - run["static"]) * down
    if x > SLIP_FROM:
        mu += SLIP_HEIGHT * (math.fmod(x - SLIP_FROM, SLIP_PERIOD) / SLIP_PERIOD - 0.5)
    return mu


def plate(run, t):
    """Distance in mm at time t on the logger's clock."""
    return min(max(0.0, SPEED * (t - run["logger"])), DISTANCE)


def on_logger(run, t):
    return run["logger"] + (t - run["press"]) / (1 + run["drift"])


def normal_force(t):
    """Punch force at time t on the press's clock: a ramp, then the held force with a ripple."""
    ramp = min(FORCE, max(0.0, RATE * (t - LOADED_AT)))
    return ramp + (2.0 * math.sin(2 * math.pi * 0.31 * t) if ramp == FORCE else 0.0)


def punch(run, t):
    """Punch displacement in mm: loading, creep, and settling while the plate slides."""
    loading = 1.8 * math.sqrt(max(0.0, min(1.0, RATE * (t - LOADED_AT) / FORCE)))
    held = max(0.0, t - LOADED_AT - FORCE / RATE)
    x = plate(run, on_logger(run, t))
    return loading + 0.004 * math.log1p(held) + 0.0022 * x + 0.02 * (1 - math.exp(-x / 12))


def shear_force(run, t):
    """F_l = mu F_b, F_b from (3.1) with the compact length given by the punch."""
    t_press = run["press"] + (t - run["logger"]) * (1 + run["drift"])
    mu = friction(run, plate(run, t))
    if t > run["logger"] + DISTANCE / SPEED:
        mu *= 0.8  # the motor stops: part of the shear force remains
    length = LENGTH - (punch(run, t_press) - punch(run, run["press"]))
    exponent = 4 * POISSON * length / (DIAMETER * (1 - POISSON))
    return mu * normal_force(t_press) * math.exp(-exponent * mu)


def write_press(path, run, noisy):
    end = run["press"] + DISTANCE / SPEED + PRESS_AFTER
    lines = [f"# Synthetic record, made by scenes/lab/{MAKER}: not measured",
             "Time;Force;Displacement", "s;N;mm"]
    for i in range(int(end / PRESS_INTERVAL)):
        t = i * PRESS_INTERVAL
        row = [f"{t:.2f}", f"{normal_force(t) + noisy('force'):.3f}",
               f"{punch(run, t) + noisy('displacement'):.5f}"]
        lines.append(";".join(row).replace(".", ","))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_logger(path, run, noisy):
    end = run["logger"] + DISTANCE / SPEED + STOP_AFTER
    lines = [f"# Synthetic record, made by scenes/lab/{MAKER}: not measured",
             "time [s],strain [um/m],lvdt [mV]"]
    for i in range(int(end * 10)):
        t = i * 0.1
        strain = (shear_force(run, t) - OFFSET) / GAIN + noisy("strain")
        lvdt = 12.0 + SENSITIVITY * plate(run, t) + noisy("lvdt")
        lines.append(f"{t:.1f},{strain:.3f},{lvdt:.4f}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--noise", type=float, default=1.0, help="times the assumed noise")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    source = random.Random(options.seed)
    def noisy(channel):
        return source.gauss(0.0, NOISE[channel] * options.noise)
    for number, run in enumerate(RUNS, 1):
        write_press(options.out / f"synthetic-press-{number}.csv", run, noisy)
        write_logger(options.out / f"synthetic-logger-{number}.csv", run, noisy)
    truth = {"runs": RUNS, "slip_period_mm": SLIP_PERIOD, "slip_height": SLIP_HEIGHT,
             "speed_mm_s": SPEED, "distance_mm": DISTANCE, "seed": options.seed,
             "noise_factor": options.noise, "noise": NOISE}
    (options.out / "truth.json").write_text(json.dumps(truth, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
