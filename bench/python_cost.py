#!/usr/bin/python3
"""Overhead of a run from Python over the same run from the command line, without and with a callback every 100 steps.

usage: PYTHONPATH=build/release/python bench/python_cost.py [--program PATH] [--rounds N] [--scene FILE] [--json FILE]

All kinds of run are interleaved, each in a separate process, on one thread. If `perf` can count instructions, user
instructions are compared, which are insensitive to machine load; otherwise the minimum CPU time of all rounds.
Interpreter start-up and package import are measured separately, since they are not negligible for a run of one second.
Exit code 1 if Python costs 1% more or the callback 5%.
"""
import argparse
import json
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
IMPORT = "import numpy, pulvis, pulvis.scene, pulvis.simulation"
RUN = f"""
import sys
{IMPORT}
sim = pulvis.Scene(sys.argv[1]).simulation(threads=1, folder=sys.argv[2], overwrite=True)
if sys.argv[3] == "callback":
    velocity = sim.column("velocity")
    sim.every(100, lambda sim: velocity[0].mean())
sim.run()
"""
LIMITS = {"python": 0.01, "callback": 0.05}


def has_perf():
    if shutil.which("perf") is None:
        return False
    done = subprocess.run(["perf", "stat", "-x,", "-e", "instructions:u", "true"], capture_output=True, text=True)
    return done.returncode == 0 and "<not " not in done.stderr  # a virtual machine may lack hardware counters


def instructions(command):
    done = subprocess.run(["perf", "stat", "-x,", "-e", "instructions:u", *command], capture_output=True, text=True,
                          check=True)
    return float(next(line for line in done.stderr.splitlines() if "instructions" in line).split(",")[0])


def processor_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=Path, default=SOURCE / "build/release/cli/pulvis")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--scene", type=Path, default=SOURCE / "scenes/compaction/regular-25.toml")
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    measure, unit = (instructions, "instructions") if has_perf() else (processor_seconds, "s of processor")
    with tempfile.TemporaryDirectory() as place:
        kinds = {
            "program": [given.program, "run", given.scene, "-o", f"{place}/program", "--overwrite", "--quiet",
                        "--threads", "1"],
            "python": [sys.executable, "-c", RUN, given.scene, f"{place}/python", "plain"],
            "callback": [sys.executable, "-c", RUN, given.scene, f"{place}/callback", "callback"],
            "import": [sys.executable, "-c", IMPORT],
        }
        least = {}
        for _ in range(given.rounds):
            for kind, command in kinds.items():
                cost = measure([str(word) for word in command])
                least[kind] = min(cost, least.get(kind, cost))
        hashes = {json.loads(Path(place, kind, "summary.json").read_text())["state_hash"] for kind in kinds
                  if kind != "import"}
    if len(hashes) != 1:
        sys.exit("python_cost: the runs differ in their bits")
    base = least["program"]
    result = {"unit": unit, "rounds": given.rounds, "scene": given.scene.name, **least}
    failed = False
    print(f"{given.scene.name}: {base:.4g} {unit}, import of the package {least['import']:.4g}")
    for kind, limit in LIMITS.items():
        share = (least[kind] - least["import"]) / base - 1
        result[f"{kind}_share"] = share
        failed |= share > limit
        print(f"{kind:10} {100 * share:+.2f} % beside the import (allowed {100 * limit:.0f} %)")
    if given.json:
        given.json.write_text(json.dumps(result, indent=2) + "\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
