"""Dynamic relaxation against steady pressing: a matrix of 25 discs of 316L is pressed in increments, each followed by
relaxation with mass damping, or in one stage, as shipped. Prints the error of the punch force at the end of the
increments and the number of steps: the table in docs/accuracy.md.

  /usr/bin/python3 bench/relaxation.py      (a few minutes)

The reference is the same mesh, pressed steadily at a quarter of the shipped speed.
"""
import concurrent.futures
import csv
import json
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/cli/pulvis"
TEXT = (ROOT / "scenes/compaction/regular-25.toml").read_text()
COMPRESSION = 5.0  # mm
SHIPPED = 2.8      # ms
STAGES = re.compile(r"\[\[stage\]\].*?(?=\n\[contact\])", re.S)


def press(name, duration, way):
    return f'''[[stage]]
name = "{name}"
kind = "compact"
duration = "{duration:.9g} ms"
[[stage.move]]
tool = "top"
displacement = ["0 mm", "-{way:.9g} mm"]
'''


def relaxed(increments, moving, resting, rate):
    """Each increment takes `moving` and `resting` ms; damping rate in 1/s."""
    stages = "".join(press(f"press-{i}", moving, COMPRESSION / increments) +
                     f'[[stage]]\nname = "rest-{i}"\nkind = "hold"\nduration = "{resting:.9g} ms"\n'
                     for i in range(increments))
    text = STAGES.sub(lambda _: stages, TEXT, count=1)
    return text.replace(
        'hardening_modulus = "440 MPa"\n',
        f'hardening_modulus = "440 MPa"\n\n[material.damping]\nmass_proportional = "{rate:g} 1/s"\n', 1)


def run(text, samples):
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.toml"
        scene.write_text(text)
        subprocess.run([PROGRAM, "run", scene, "-o", folder + "/run", "--threads", "1", "--set",
                        f"output.samples={samples}", "--set", "output.frames=1", "--set",
                        "limits.energy_balance=1"], check=True, capture_output=True)
        with open(folder + "/run/history.csv", newline="") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        steps = json.loads((pathlib.Path(folder) / "run/summary.json").read_text())["steps"]
    column = {name.split(" ")[0]: name for name in rows[0]}
    at = [float(r[column["tool/top/position_y"]]) for r in rows]
    force = [float(r[column["tool/top/force_y"]]) for r in rows]
    return [1e3 * (at[0] - y) for y in at], force, steps


def at_way(curve, way):
    """Linear interpolation between samples."""
    xs, ys = curve
    i = next(i for i, x in enumerate(xs) if x >= way - 1e-9)
    if i == 0 or xs[i] == xs[i - 1]:
        return ys[i]
    return ys[i - 1] + (ys[i] - ys[i - 1]) * (way - xs[i - 1]) / (xs[i] - xs[i - 1])


def last_at(curve, way):
    """The residual value after the tool has come to rest there."""
    return [y for x, y in zip(*curve) if abs(x - way) < 1e-6][-1]


def error(force, reference, ways):
    squares = sum((force(w) - reference(w)) ** 2 for w in ways)
    return (squares / sum(reference(w) ** 2 for w in ways)) ** 0.5


def main():
    def timed(factor):
        return TEXT.replace('duration = "2.8 ms"', f'duration = "{SHIPPED * factor:.9g} ms"', 1)

    tries = [(10, m, r, a) for m, r in ((0.05, 0.05), (0.05, 0.1), (0.05, 0.2), (0.1, 0.1)) for a in (5e4, 2e5)]
    tries += [(20, m, r, a) for m, r in ((0.025, 0.025), (0.05, 0.05)) for a in (5e4, 2e5)]
    tries += [(10, m, 0.1, 2e5) for m in (0.28, 1.12)]  # slow: must approach the reference
    factors = [0.25, 0.5, 1]
    jobs = [(timed(4), 400)] + [(timed(f), 400) for f in factors] + [(relaxed(*t), 40 * t[0]) for t in tries]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        (*slow, slow_steps), *found = pool.map(lambda j: run(*j), jobs)
    print(f"reference: {slow_steps} steps")
    ways = {n: [COMPRESSION * (i + 1) / n for i in range(n)] for n in (10, 20)}

    def reference(way):
        return at_way(slow, way)

    for factor, (*curve, steps) in zip(factors, found):
        both = [error(lambda w: at_way(curve, w), reference, ways[n]) for n in (10, 20)]
        print(f"steady, {SHIPPED * factor:g} ms: {steps} steps, {100 * both[0]:.1f}%, {100 * both[1]:.1f}%")
    for (n, moving, resting, rate), (*curve, steps) in zip(tries, found[len(factors):]):
        e = error(lambda w: last_at(curve, w), reference, ways[n])
        print(f"{n} increments of {moving:g} + {resting:g} ms, {rate:g}/s: {steps} steps, {100 * e:.1f}%")


if __name__ == "__main__":
    main()
