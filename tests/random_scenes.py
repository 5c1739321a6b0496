"""What the random scenes of random_servos.py, random_breakage.py and random_space.py share."""
import argparse
import collections
import json
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


# ---- what is asked of a run ---------------------------------------------------------------------------
def run(program, file, folder, threads):
    try:
        done = subprocess.run([program, "run", file, "-o", folder, "--overwrite", "--quiet", "--threads", str(threads)],
                              capture_output=True, text=True, timeout=900)
    except subprocess.TimeoutExpired:
        return 1000, "it takes longer than 15 minutes"
    return done.returncode, done.stderr.strip()


def faults(outcomes, folders, limits):
    """(kind, text): "ok", "refused", "stopped" or "BAD". limits: what the message of a physical limit matches."""
    (code, message), (again, _) = outcomes
    if code == 2:
        return "refused", message
    if code not in (0, 3):
        return "BAD", f"exit code {code}: {message}"
    if again != code:
        return "BAD", f"exit code {code} on one thread, {again} on two"
    one, two = (json.loads((folder / "summary.json").read_text()) for folder in folders)
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
    summary = json.loads((folder / "summary.json").read_text())
    lines = (folder / "history.csv").read_text().splitlines()
    last = dict(zip((name.split(" [")[0] for name in lines[0].split(",")), lines[-1].split(",")))
    return f"{summary['steps']} steps in {summary['wall_seconds']:.1f} s, energy balance error " \
           f"{summary['energy_balance_error']:.1e}{more(summary, last)}"


def try_all(description, scenes, scene_of, limits, more):
    """Runs scene_of(seed, number) for all numbers, each on one and two threads; the exit code of the whole."""
    options = parser(description, scenes).parse_args()
    options.program = options.program.resolve()
    ends = collections.Counter()
    with tempfile.TemporaryDirectory() as scratch:
        place = options.keep or pathlib.Path(scratch)
        place.mkdir(parents=True, exist_ok=True)
        for number in range(options.first, options.first + options.scenes):
            scene = scene_of(options.seed, number)
            file = place / f"{scene.name}.toml"
            file.write_text(scene.text())
            folders = [place / f"{scene.name}-{threads}" for threads in (1, 2)]
            outcomes = [run(options.program, file, folder, threads) for threads, folder in zip((1, 2), folders)]
            end, what = faults(outcomes, folders, limits)
            ends[end] += 1
            told = outcome_of(folders[0], more) if end in ("ok", "stopped") else ""
            print(f"{end:8}{number}: {scene.describe()}" + "".join(f"\n        {line}" for line in (told, what) if line),
                  flush=True)
    print(f"{options.scenes} scenes: " + ", ".join(f"{count} {end}" for end, count in sorted(ends.items())))
    return 1 if ends["BAD"] or ends["refused"] > 0.1 * options.scenes else 0
