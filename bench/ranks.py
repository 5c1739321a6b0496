#!/usr/bin/python3
"""Runs on several ranks: cost compared with threads, communication volume, and a scaling model for many nodes.

usage: ranks.py [--pulvis PROGRAM] [--folder DIR] [--repeats N] WHAT...

WHAT  strong   a square packing on 1 and 2 threads and on 1 and 2 ranks, interleaved: wall seconds of the steps, minimum
               and median; and two independent processes with half of it each, run concurrently: measures how uneven the
               cores are
      weak     N discs on one rank, 2 N on two
      bytes    data exchanged between ranks per step, by number of ranks and of discs
      model    seconds per step on 1 to 1,024 nodes for 10^4 to 10^7 discs, from the cost per disc and the bytes measured
               by `strong` and `bytes`, with the stated latency and bandwidth
      many     100,000 discs for 500 steps on two ranks: memory per rank
      balance  a loose powder pushed together by a fast punch, on two and four ranks, with and without rebalancing (by the
               tests' rebalanced_run): cost per rank, wall seconds
"""
import argparse
import json
import math
import pathlib
import shutil
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
LATENCY, BANDWIDTH = 2e-6, 10e9  # s, byte/s: a typical cluster interconnect, assumed and not measured
CORES = 64  # per node of the model, one rank each
COLLECTIVES = 5  # per step: contact sums, depth, tool forces, time step, whether the root continues

SCENE = """extends = "{base}"
title = "{title}"

packing = [{packing}]
stage = [{{ name = "press", duration = "{duration} us", move = [{move}] }}]

[[particle]]
name = "disc"
mesh = {{ boundary_edges = {edges}, rings = 1 }}

[[tool]]
name = "right"
point = ["{width} mm", "0 mm"]

[[tool]]
name = "top"
point = ["0 mm", "{height} mm"]

[output]
frames = 1
samples = 1
"""


def write_scene(options, name, title, packing, move, width, height, duration, edges=40):
    """Discs of regular-25.toml in a die of another size; packing and move are inline tables."""
    options.folder.mkdir(parents=True, exist_ok=True)
    file = options.folder / f"{name}.toml"
    file.write_text(SCENE.format(base=ROOT / "scenes/compaction/regular-25.toml", title=title, packing=packing, move=move,
                                 width=width, height=height, duration=duration, edges=edges))
    return file


def start(options, name, words):
    return subprocess.Popen([options.pulvis, "run", *map(str, words), "-o", options.folder / name, "--overwrite", "--quiet",
                             "--checkpoint-steps", str(10**9)])


def summary_of(options, name):
    return json.loads((options.folder / name / "summary.json").read_text())


def run(options, name, words):
    start(options, name, words).wait()
    return summary_of(options, name)


def block(options, columns, rows, edges=40):
    """Discs of regular-25.toml, pressed at the same speed."""
    return write_scene(
        options, f"discs-{columns * rows}", f"{columns} x {rows} discs, 316L",
        f'{{ kind = "square", particle = "disc", rows = {rows}, columns = {columns}, corner = ["0 mm", "0 mm"] }}',
        f'{{ tool = "top", displacement = ["0 mm", "-{rows} mm"] }}', 10 * columns, 10 * rows, 560 * rows, edges)


def scene_of(options, discs, edges=40):
    """A square packing of about this many discs."""
    side = max(2, round(math.sqrt(discs)))
    return block(options, side, side, edges), side * side


def side_by_side(options, scene, steps, ways, also=dict):
    """Wall seconds of `steps` steps in each configuration, run interleaved; and those of `also`. A run of a tenth of the
    steps is subtracted, since files of the start and of the end take ranks longer than one process."""
    seconds = {name: [] for name in ways}
    summaries = {}
    for _ in range(options.repeats):
        for name, words in ways.items():
            first, last = (run(options, name.replace(" ", "-"), [scene, "--stop-after", stop, *words])
                           for stop in (steps // 10, steps // 10 + steps))
            seconds[name].append(last["wall_seconds"] - first["wall_seconds"])
            summaries[name] = last
        for name, time in also().items():
            seconds.setdefault(name, []).append(time)
    return seconds, summaries


def halves(options, discs):
    """Two independent processes with half of the discs each: wall seconds of the slower and of the faster."""
    side = round(math.sqrt(discs))
    half = block(options, side, side // 2)
    names = ("lower", "upper")
    seconds = [0, 0]
    for sign, stop in ((-1, options.steps // 10), (1, options.steps // 10 + options.steps)):
        for process in [start(options, name, [half, "--stop-after", stop, "--threads", 1]) for name in names]:
            process.wait()
        seconds = [s + sign * summary_of(options, name)["wall_seconds"] for s, name in zip(seconds, names)]
    return {"two halves alone, the slower": max(seconds), "two halves alone, the faster": min(seconds)}


def strong(options):
    scene, discs = scene_of(options, options.discs)
    ways = {"1 thread": ["--threads", 1], "1 rank": ["--ranks", 1, "--threads", 1], "2 threads": ["--threads", 2],
            "2 ranks": ["--ranks", 2, "--threads", 1]}
    seconds, summaries = side_by_side(options, scene, options.steps, ways, lambda: halves(options, discs))
    if len({summary["state_hash"] for summary in summaries.values()}) != 1:
        raise SystemExit("the ways do not end in the same state")
    base = min(seconds["1 thread"])
    print(f"strong scaling: {discs} discs, {options.steps} steps, wall seconds of {options.repeats} runs in turns")
    print("| way | least | median | 1 thread over it, least |\n|---|---|---|---|")
    for name, times in seconds.items():
        print(f"| {name} | {min(times):.2f} | {statistics.median(times):.2f} | {base / min(times):.2f} |")


def weak(options):
    one, few = scene_of(options, options.discs)
    two, many = scene_of(options, 2 * options.discs)
    seconds, _ = side_by_side(options, one, options.steps, {"1 thread": ["--threads", 1]})
    twice, _ = side_by_side(options, two, options.steps, {"2 ranks": ["--ranks", 2, "--threads", 1],
                                                          "2 threads": ["--threads", 2]})
    print(f"weak scaling: {options.steps} steps, microseconds a step and disc of a core, least and median")
    print("| way | discs | least | median |\n|---|---|---|---|")
    for name, discs, times in (("1 thread", few, seconds["1 thread"]), ("2 ranks", many, twice["2 ranks"]),
                               ("2 threads", many, twice["2 threads"])):
        cores = int(name[0])
        each = [t / options.steps / discs * cores * 1e6 for t in times]
        print(f"| {name} | {discs} | {min(each):.3f} | {statistics.median(each):.3f} |")


def told(options, discs, ranks):
    scene, count = scene_of(options, discs)
    summary = run(options, f"bytes-{count}-{ranks}",
                  [scene, "--stop-after", options.steps, "--ranks", ranks, "--threads", 1])
    return count, summary["ranks"]["bytes_a_step"], summary


def bytes_told(options):
    print(f"bytes that all ranks together tell each other in a step, mean of {options.steps} steps")
    print("| discs | ranks | bytes a step | a step and disc |\n|---|---|---|---|")
    for discs in (400, 1600, 6400):
        for ranks in (2, 3, 4):
            count, bytes_a_step, _ = told(options, discs, ranks)
            print(f"| {count} | {ranks} | {bytes_a_step:.0f} | {bytes_a_step / count:.1f} |")


def model(options):
    """t = a N/(64 P) + 4 messages + collectives log2 P, with the bytes for a border of the length of a square subdomain."""
    scene, discs = scene_of(options, options.discs)
    seconds, _ = side_by_side(options, scene, options.steps, {"1 thread": ["--threads", 1]})
    a_disc = min(seconds["1 thread"]) / options.steps / discs
    count, bytes_a_step, _ = told(options, 6400, 2)
    of_border = bytes_a_step / 2 / math.sqrt(count)  # sent by each of two ranks along a side of sqrt(count) discs
    print(f"measured: {a_disc * 1e6:.2f} us a step and disc on one core, {of_border:.0f} bytes a disc of the border; "
          f"stated: latency {LATENCY * 1e6:.0f} us, {BANDWIDTH / 1e9:.0f} GB/s, {CORES} cores a node, one rank each")
    print("| discs | " + " | ".join(f"{nodes} nodes" for nodes in (1, 4, 16, 64, 256, 1024)) + " |")
    print("|---|" + "---|" * 6)
    for size in (10**4, 10**5, 10**6, 10**7):
        cells = []
        for nodes in (1, 4, 16, 64, 256, 1024):
            ranks = nodes * CORES
            bodies = a_disc * max(size / ranks, 8)  # a chunk holds eight
            border = 4 * of_border * math.sqrt(size / ranks) / BANDWIDTH + 2 * 4 * LATENCY
            cells.append(f"{(bodies + border + COLLECTIVES * math.log2(ranks) * LATENCY) * 1e6:.0f}")
        print(f"| 10^{round(math.log10(size))} | " + " | ".join(cells) + " |")
    print("microseconds a step")


def many(options):
    scene, discs = scene_of(options, 100000, edges=16)
    steps = 500
    summary = run(options, "many", [scene, "--stop-after", steps, "--ranks", 2, "--threads", 1])
    memory = ", ".join(f"{m / 2**20:.0f} MB" for m in summary["ranks"]["peak_memory_bytes"])
    print(f"{discs} discs, {summary['elements']} elements, {summary['steps']} steps on 2 ranks: "
          f"{summary['wall_seconds']:.0f} s, at most {memory}, state {summary['state_hash']}")


def loose_scene(options, columns=16, rows=64, speed=100):
    height = 10.5 * rows
    travel = round(0.4 * height, 1)
    return write_scene(
        options, "loose", f"{columns} x {rows} loose discs and a fast punch, 316L",
        f'{{ kind = "square", particle = "disc", rows = {rows}, columns = {columns}, spacing = "10.5 mm" }}',
        f'{{ tool = "top", displacement = ["0 mm", "-{travel} mm"], ramp = 0.005 }}',
        10.5 * columns, height, round(travel * 1000 / speed))


def longer(seconds):
    """Load imbalance: by how much the slowest rank exceeds the mean."""
    return f"{100 * (max(seconds) / statistics.mean(seconds) - 1):.0f}%"


def loose_run(options, name, ranks, every):
    """Runs the test program; it never rebalances if `every` exceeds the number of steps."""
    folder = options.folder / name
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run(["mpirun", "--quiet", "--oversubscribe", "--bind-to", "none", "--allow-run-as-root", "-np", str(ranks),
                    options.pulvis.parent.parent / "tests/rebalanced_run", str(every), "run", loose_scene(options), folder,
                    str(options.steps), "1"], check=False)
    return json.loads((folder / "summary.json").read_text())


def balance(options):
    scene = loose_scene(options)
    for ranks in (2, 4):
        seconds = {"rebalanced": [], "as divided at the start": []}
        told = {}
        for _ in range(options.repeats):
            told["rebalanced"] = run(options, f"rebalanced-{ranks}", [scene, "--stop-after", options.steps, "--ranks", ranks,
                                                                      "--threads", 1])
            told["as divided at the start"] = loose_run(options, f"divided-{ranks}", ranks, 10**9)
            for name, times in seconds.items():
                times.append(told[name]["wall_seconds"])
        if len({summary["state_hash"] for summary in told.values()}) != 1:
            raise SystemExit("the two do not end in the same state")
        print(f"balance: {told['rebalanced']['particles']} discs, {options.steps} steps on {ranks} ranks, "
              f"{options.repeats} runs in turns")
        print("| way | wall seconds, least | median | slowest rank of late, over the mean by |\n|---|---|---|---|")
        for name, times in seconds.items():
            print(f"| {name} | {min(times):.2f} | {statistics.median(times):.2f} "
                  f"| {longer(told[name]['ranks']['seconds_a_step'])} |")
        print("| after step | chunks | ms | slowest rank over the mean by | afterwards |\n|---|---|---|---|---|")
        for one in told["rebalanced"]["ranks"]["rebalancings"]:
            after = longer(one["seconds_a_step_after"]) if one["seconds_a_step_after"] else ""
            print(f"| {one['step']} | {one['chunks']} | {1000 * one['seconds']:.0f} "
                  f"| {longer(one['seconds_a_step_before'])} | {after} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pulvis", default=ROOT / "build/release/cli/pulvis", type=pathlib.Path)
    parser.add_argument("--folder", default=pathlib.Path("runs/ranks"), type=pathlib.Path)
    parser.add_argument("--repeats", default=5, type=int)
    parser.add_argument("--discs", default=1600, type=int)
    parser.add_argument("--steps", default=200, type=int)
    parser.add_argument("what", nargs="+", choices=("strong", "weak", "bytes", "model", "many", "balance"))
    options = parser.parse_args()
    for what in options.what:
        {"strong": strong, "weak": weak, "bytes": bytes_told, "model": model, "many": many, "balance": balance}[what](options)


if __name__ == "__main__":
    main()
