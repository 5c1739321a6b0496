"""What the random scenes of random_servos.py, random_servo_powders.py, random_breakage.py and random_space.py share."""
import argparse
import collections
import contextlib
import csv
import json
import math
import pathlib
import subprocess
import tempfile

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


def metres(*numbers):
    return "[" + ", ".join(f'"{x:.12g} m"' for x in numbers) + "]"


# ---- their text ---------------------------------------------------------------------------------------
def value(of):
    return json.dumps(of) if isinstance(of, str | list | tuple | bool) else f"{of:.12g}"


def keys(**values):
    """Lines of TOML, without what is None."""
    return "".join(f"{key} = {value(of)}\n" for key, of in values.items() if of is not None)


def table(header, /, **values):
    """An element of an array of tables."""
    return f"[[{header}]]\n" + keys(**values)


def material(name, of=None):
    """One of MATERIALS, under its own name or another."""
    density, youngs, nu, strength, hardening = MATERIALS[of or name]
    flow = {"yield_stress": f"{strength} Pa", "hardening_modulus": f"{hardening} Pa"} if strength else {}
    return table("material", name=name, density=f"{density} kg/m^3", youngs_modulus=f"{youngs} Pa", poissons_ratio=nu, **flow)


def wave_speed(density, youngs, nu):
    """m/s, of plane elastic waves."""
    return math.sqrt(youngs * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / density)


# ---- their runs ---------------------------------------------------------------------------------------
TIMED_OUT = 1000


def run(program, file, folder, threads, more=(), timeout=900):
    """Exit code and standard error."""
    words = [program, "run", file, "-o", folder, "--overwrite", "--quiet", "--threads", str(threads), *more]
    try:
        done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=timeout)
    except subprocess.TimeoutExpired:
        return TIMED_OUT, f"it takes longer than {timeout / 60:g} minutes"
    return done.returncode, done.stderr.strip()


def history_of(folder):
    """Series by name, as tuples of numbers."""
    with open(folder / "history.csv", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    columns = zip(*([float(cell or "nan") for cell in row] for row in rows))
    return dict(zip((name.split(" [")[0] for name in names), columns))


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text())


@contextlib.contextmanager
def place_of(options):
    """Where scenes and runs are written: kept if that was asked for."""
    with tempfile.TemporaryDirectory() as scratch:
        place = options.keep or pathlib.Path(scratch)
        place.mkdir(parents=True, exist_ok=True)
        yield place


def written(scene, place):
    file = place / f"{scene.name}.toml"
    file.write_text(scene.text())
    return file


def judge_all(options, scene_of, judge):
    """Counts the outcomes of scenes. judge(scene, its file, its folder): outcome, and lines of what is to be printed."""
    options.program, counts = options.program.resolve(), collections.Counter()
    with place_of(options) as place:
        for number in range(options.first, options.first + options.scenes):
            scene = scene_of(options.seed, number)
            outcome, lines = judge(scene, written(scene, place), place / scene.name)
            counts[getattr(scene, "kind", ""), outcome] += 1
            print(f"{outcome:8}{number}: {scene.describe()}" + "".join(f"\n        {line}" for line in lines if line),
                  flush=True)
    return counts


# ---- what is asked of a run on one and on two threads -------------------------------------------------

def faults(outcomes, folders, limits):
    """(kind, text): "ok", "refused", "stopped" or "BAD". limits: what the message of a physical limit matches."""
    (code, message), (again, _) = outcomes
    if code == 2:
        return "refused", message
    if code not in (0, 3):
        return "BAD", f"exit code {code}: {message}"
    if again != code:
        return "BAD", f"exit code {code} on one thread, {again} on two"
    one, two = (summary_of(folder) for folder in folders)
    # A step that a limit ends is not finished by every thread.
    if one["steps"] != two["steps"] or (code == 0 and one["state_hash"] != two["state_hash"]):
        return "BAD", "two threads give other bits"
    if (folders[0] / "history.csv").read_bytes() != (folders[1] / "history.csv").read_bytes():
        return "BAD", "two threads give another history"
    if not one["energy_balance_error"] <= 0.01:
        return "BAD", f"energy balance {one['energy_balance_error']:.3g}: {message}"
    if code == 3:
        return ("stopped" if limits.search(message) else "BAD"), message.splitlines()[0]
    return "ok", ""


def outcome_of(folder, more):
    """What a run came to. more(summary, last row of the history): what else is to be printed."""
    summary = summary_of(folder)
    last = {name: series[-1] for name, series in history_of(folder).items()}
    return f"{summary['steps']} steps in {summary['wall_seconds']:.1f} s, energy balance error " \
           f"{summary['energy_balance_error']:.1e}{more(summary, last)}"


def try_all(description, scenes, scene_of, limits, more):
    """Runs scene_of(seed, number) for all numbers, each on one and two threads; the exit code of the whole."""
    options = parser(description, scenes).parse_args()

    def judge(_, file, folder):
        folders = [folder.with_name(f"{folder.name}-{threads}") for threads in (1, 2)]
        outcomes = [run(options.program, file, of, threads) for threads, of in zip((1, 2), folders)]
        end, what = faults(outcomes, folders, limits)
        return end, [outcome_of(folders[0], more) if end in ("ok", "stopped") else "", what]

    ends = collections.Counter()
    for (_, end), count in judge_all(options, scene_of, judge).items():
        ends[end] += count
    print(f"{options.scenes} scenes: " + ", ".join(f"{count} {end}" for end, count in sorted(ends.items())))
    return 1 if ends["BAD"] or ends["refused"] > 0.1 * options.scenes else 0
