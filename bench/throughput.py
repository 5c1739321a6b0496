"""Throughput: measures every case several times, saves the results, and compares them with the targets.

  /usr/bin/python3 bench/throughput.py                      everything, 15 minutes: keep the machine idle
  /usr/bin/python3 bench/throughput.py --cases 100,1683     these cases, and the thesis run
  /usr/bin/python3 bench/throughput.py --quick              smoke test, a few seconds; times are meaningless
  /usr/bin/python3 bench/throughput.py --cases= --runs run-1683,run-10000 --rounds 1    the long runs, half an hour

Adds rows to build/throughput/<machine>.csv, or with --record to bench/results/throughput/<machine>.csv, which is part of
the source. If the final state of a case is not bitwise identical to the one in bench/results/throughput/hashes.csv, its
times are rejected and the exit code is 1, unless --accept-hash confirms an intended change of the
physics. docs/performance.md explains the lines.
"""
import argparse
import csv
import datetime
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

import counts
import throughput_report

ROOT = pathlib.Path(__file__).resolve().parent.parent
RECORDED = ROOT / "bench/results/throughput"
CASES = ("100", "1683", "10000", "100-dense", "100-four-point")
COLUMNS = ("case", "threads", "line", "unit", "best", "median", "rounds", "updates_per_s", "share",
           "steps", "hash", "version", "commit", "compiler", "instruction_set", "date")
HASH_COLUMNS = ("case", "steps", "version", "hash", "commit", "date")
# Complete runs of the program, from command line to report: scene and overrides.
RUNS = {
    "thesis": ("regular-100.toml", ("stage.press.duration=7.45 ms",)),  # about 94,000 steps
    "run-1683": ("hexagonal-1683.toml", ()),  # to a relative density of 0.95
    "run-10000": ("regular-100.toml", (  # pressed 2.9% in about 20,000 steps: 18 heights per second, as the others
        "packing[0].rows=100", "packing[0].columns=100",
        'tool.right.point=["1000 mm", "0 mm"]', 'tool.top.point=["0 mm", "1000 mm"]',
        "stage.press.duration=1.65 ms", 'stage.press.move[0].displacement=["0 mm", "-29.5 mm"]')),
}
QUICK_CHANGES = ("stage.press.duration=20 us", 'stage.press.move[0].displacement=["0 mm", "-0.1 mm"]')
RATES = ("GFLOP/s", "GB/s")  # higher is better


class Refused(Exception):
    pass


class Failed(Exception):
    pass


def run(command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


# ---- measuring ------------------------------------------------------------------------------------
class Line:
    """All values of a line, in its unit."""

    def __init__(self, unit):
        self.unit, self.values, self.shares = unit, [], []

    def add(self, value, share=None):
        self.values.append(value)
        if share is not None:
            self.shares.append(share)
        return self

    @property
    def best(self):
        return (max if self.unit in RATES else min)(self.values)

    @property
    def median(self):
        return statistics.median(self.values)


class Measured:
    """The measurements: lines by (case, name, threads), final states by case, and the program context."""

    def __init__(self):
        self.lines, self.states, self.context = {}, {}, {}

    def line(self, case, name, threads, unit):
        return self.lines.setdefault((case, name, threads), Line(unit))

    def add(self, benchmark):
        path = [part for part in benchmark["name"].split("/")
                if part != "manual_time" and not part.startswith("iterations:")]
        threads = int(path.pop().split(":")[1]) if path[-1].startswith("threads:") else 1
        case, name = path[0], "/".join(path[1:])
        if name == "hash":
            self.states[case] = (int(benchmark["value"]), benchmark["label"])
        else:
            self.line(case, name, threads, benchmark["label"]).add(benchmark["value"],
                                                                   benchmark.get("share"))


def measure_case(measured, build, case, rounds, lines="."):
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        run([build / "bench/throughput", f"--cases={case}", f"--rounds={rounds}",
             f"--benchmark_filter={lines}",
             "--benchmark_out_format=json", f"--benchmark_out={file.name}"])
        output = json.load(file)
    measured.context = output["context"]
    for benchmark in output["benchmarks"]:
        measured.add(benchmark)


def measure_run(measured, build, name, rounds, quick):
    scene, changes = RUNS[name]
    changes = QUICK_CHANGES if quick else changes
    for _ in range(rounds):
        with tempfile.TemporaryDirectory() as folder:
            start = time.perf_counter()
            run([build / "cli/pulvis", "run", ROOT / "scenes/compaction" / scene, "-o", f"{folder}/run",
                 "--threads", "2", *(word for c in changes for word in ("--set", c))])
            measured.line(name, "run", 2, "s").add(time.perf_counter() - start)
            summary = json.loads(pathlib.Path(f"{folder}/run/summary.json").read_text())
        keep_state(measured, name, (summary["steps"], summary["state_hash"]))
        per_element = 1 / summary["elements"]
        measured.line(name, "run/step", 2, "ns/element-step").add(
            1e9 * summary["wall_seconds"] / summary["steps"] * per_element)
        measured.line(name, "memory/peak", 2, "B/element").add(summary["peak_memory_bytes"] * per_element)


def keep_state(measured, case, state):
    if measured.states.setdefault(case, state) != state:
        raise Refused(f"{case}: two runs ended differently: {measured.states[case]}, {state}")


def measure_counts(measured, build, case):
    for name, value in counts.count(build / "bench/throughput", case, 40).items():
        measured.line(case, name, 1, "1/element-update").add(value)


# ---- final states ---------------------------------------------------------------------------------
def read_rows(file):
    if not file.exists():
        return []
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def checked_states(measured, file, accept, stamp):
    """Rows for hashes.csv; rejects states that differ from the recorded ones."""
    known = {(r["case"], r["steps"], r["version"]): r for r in read_rows(file)}
    for case, (steps, state) in measured.states.items():
        key = (case, str(steps), measured.context["version"])
        old = known.get(key)
        if old and old["hash"] != state and not accept:
            raise Refused(f"{case}: after {steps} steps the state is {state}, recorded is "
                          f"{old['hash']} (commit {old['commit']}, {old['date']}): not the same "
                          "computation, its times are refused; --accept-hash if that is meant")
        if not old or old["hash"] != state:
            known[key] = dict(zip(HASH_COLUMNS, (*key, state, measured.context["commit"], stamp)))
    return list(known.values())


# ---- saving ---------------------------------------------------------------------------------------
def machine():
    """Name of the results file: processor and core count."""
    info = pathlib.Path("/proc/cpuinfo").read_text()
    value = {name: re.search(rf"^{name}\s*: (.*)$", info, re.M) for name in
             ("model name", "cpu family", "model")}
    name, family, model = (m.group(1) if m else "unknown" for m in value.values())
    text = f"{name} family {family} model {model} {os.cpu_count()} cores"
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")


def rows_of(measured, stamp):
    for (case, name, threads), line in measured.lines.items():
        steps, state = measured.states.get(case, ("", ""))
        context = {key: measured.context[key]
                   for key in ("version", "commit", "compiler", "instruction_set")}
        yield {"case": case, "threads": threads, "line": name, "unit": line.unit,
               "best": f"{line.best:.6g}", "median": f"{line.median:.6g}",
               "rounds": len(line.values),
               "updates_per_s": f"{1e9 / line.median:.4g}" if name in throughput_report.UPDATES else "",
               "share": f"{statistics.median(line.shares):.4g}" if line.shares else "",
               "steps": steps, "hash": state, **context, "date": stamp}


def write_rows(file, columns, rows):
    new = file.with_suffix(".new")
    with open(new, "w", newline="") as stream:
        writer = csv.DictWriter(stream, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    new.replace(file)


def keep(measured, folder, hashes, accept):
    """Checks everything before writing. Hashes in another folder are only read."""
    stamp = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%MZ")
    states = checked_states(measured, hashes, accept, stamp)
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{machine()}.csv"
    write_rows(file, COLUMNS, read_rows(file) + list(rows_of(measured, stamp)))
    if hashes.parent == folder:
        write_rows(hashes, HASH_COLUMNS, states)
    return file


# ---- the command line -----------------------------------------------------------------------------
def parsed(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", default=",".join(CASES), help="default: %(default)s")
    parser.add_argument("--runs", default="thesis", help=f"of {', '.join(RUNS)}; default: %(default)s")
    parser.add_argument("--rounds", type=int, default=5, help="default: %(default)s")
    parser.add_argument("--quick", action="store_true", help="one round of one case, nothing counted")
    parser.add_argument("--no-counts", action="store_true", help="leave callgrind out")
    parser.add_argument("--accept-hash", action="store_true", help="record other final states")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--record", action="store_true", help="keep rows and states in bench/results/throughput")
    parser.add_argument("--output", type=pathlib.Path,
                        help="a folder with rows and states of its own; default: build/throughput")
    options = parser.parse_args(arguments)
    options.hashes = (options.output or RECORDED) / "hashes.csv"
    options.output = options.output or (RECORDED if options.record else ROOT / "build/throughput")
    if options.quick:
        options.cases, options.rounds, options.no_counts = "100", 1, True
    return options


def measure(options):
    if not options.no_counts:
        counts.require_tools()  # fail early, before minutes of measuring
    measured = Measured()
    for case in filter(None, options.cases.split(",")):
        print(f"{case}: {options.rounds} rounds, load {os.getloadavg()[0]:.2f}", file=sys.stderr)
        measure_case(measured, options.build, case, options.rounds)
    if not measured.context:
        measure_case(measured, options.build, "100", 1, "^machine/")
    for name in filter(None, options.runs.split(",")):
        measure_run(measured, options.build, name, options.rounds, options.quick)
    if not options.no_counts:
        measure_counts(measured, options.build, throughput_report.COUNTED)
    return measured


def main(arguments):
    options = parsed(arguments)
    try:
        measured = measure(options)
        throughput_report.derive(measured)
        file = keep(measured, options.output, options.hashes, options.accept_hash)
    except (Refused, Failed, counts.CannotCount) as error:
        print(f"throughput.py: {error}", file=sys.stderr)
        return 1
    throughput_report.show(measured)
    print(f"\nrows added to {file}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
