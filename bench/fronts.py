"""Error against run time for every benchmark problem, with families of settings.

  /usr/bin/python3 bench/fronts.py                    every standard problem, about ten minutes
  /usr/bin/python3 bench/fronts.py --all              all of them, an hour and a half
  /usr/bin/python3 bench/fronts.py unit-cell hertz    only these
  /usr/bin/python3 bench/fronts.py --list             list all problems

Writes <problem>.csv (every run), <problem>.png (error against CPU time, with the Pareto front) and
summary.md into build/fronts, or with --record into bench/results/fronts, which is part of the source. A run
already in the csv, with the same program, scene and overrides, is not repeated. Problems are declared in
bench/problems/; this file does not depend on them.
"""
import argparse
import concurrent.futures
import csv
import datetime
import hashlib
import importlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading

import h5py
import numpy as np

import fronts_report

ROOT = pathlib.Path(__file__).resolve().parent.parent
RECORDED = ROOT / "bench/results/fronts"
PROBLEM_FILES = ("unit_cell", "crushed_disc", "taylor_bar", "hertz", "matrix", "limit_load",
                 "shear_contact", "bar_wave", "thick_cylinder", "unloading", "spheres")
COLUMNS = ("family", "setting", "overrides", "cpu_s", "wall_s", "steps", "elements", "dt_s",
           "energy_balance", "errors", "note", "observed", "key")
REPEAT_BELOW = 0.5  # s of CPU time: shorter runs are repeated, the minimum time counts


class Run:
    """A finished run, passed to the `observe` function of the problem."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.summary = json.loads((self.folder / "summary.json").read_text())
        with open(self.folder / "history.csv", newline="") as file:
            rows = list(csv.reader(file))
        names = [re.sub(r" \[.*\]$", "", name) for name in rows[0]]
        self.columns = dict(zip(names, np.array(rows[1:], dtype=float).T))

    def history(self, name):
        return self.columns[name]

    def frame(self, field, which=-1):
        """A field in one frame: (time, values)."""
        with h5py.File(self.folder / "run.h5") as file:
            frame = file["frames"][sorted(file["frames"])[which]]
            return float(frame.attrs["time"]), frame[field][:]

    def mesh(self, name):
        with h5py.File(self.folder / "run.h5") as file:
            return file["mesh"][name][:]


class Program:
    """The built program: runs a scene with overrides and measures its cost."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.only_cached = False
        self.commit = self._commit()
        # Identifies the code, not the commit it was built from: commit name and linker build id are removed.
        data = re.sub(rb"GNU\0.{20}", b"", self.path.read_bytes(), count=1, flags=re.S)
        self.hash = hashlib.sha256(data.replace(self.commit.encode(), b"")).hexdigest()[:12]

    def _commit(self):
        text = subprocess.run([self.path, "--version"], capture_output=True, text=True, check=True)
        return re.search(r"\((.+)\)", text.stdout)[1]

    def key(self, scene, overrides):
        command = [self.path, "check", "--print", ROOT / "scenes" / scene]  # includes the base scenes
        whole = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        text = whole + json.dumps(overrides, sort_keys=True)
        return hashlib.sha256((self.hash + text).encode()).hexdigest()[:16]

    def once(self, scene, overrides, folder):
        command = [self.path, "run", ROOT / "scenes" / scene, "-o", folder, "--threads", "1",
                   "--overwrite"]
        for key, value in overrides.items():
            command += ["--set", f"{key}={value}"]
        with open(folder + ".log", "w+") as log:
            process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=log)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            log.seek(0)
            return process.returncode, usage.ru_utime + usage.ru_stime, log.read()

    def run(self, scene, overrides, observe):
        """A csv row without its names and errors."""
        row = {"overrides": json.dumps(overrides), "key": self.key(scene, overrides), "note": ""}
        with tempfile.TemporaryDirectory() as folder:
            code, cpu, log = self.once(scene, overrides, folder + "/run")
            if code and not missed_only_expectations(code, folder + "/run"):
                return row | {"note": ("refused: " if code == 2 else "failed: ") + last_line(log)}
            for _ in range(2 if cpu < REPEAT_BELOW else 0):
                cpu = min(cpu, self.once(scene, overrides, folder + "/run")[1])
            run = Run(folder + "/run")
            observed = {name: [float(f"{v:.9g}") for v in np.atleast_1d(values)]
                        for name, values in observe(run).items()}
        s = run.summary
        return row | {"cpu_s": f"{cpu:.4g}", "wall_s": f"{s['wall_seconds']:.4g}",
                      "steps": s["steps"], "elements": s["elements"],
                      "dt_s": f"{s['time'] / s['steps']:.4g}",
                      "energy_balance": f"{s['energy_balance_error']:.3g}",
                      "observed": json.dumps(observed)}


def missed_only_expectations(code, folder):
    """Whether the run finished and only missed its expectations: that deviation is what is measured here."""
    return code == 3 and json.loads((pathlib.Path(folder) / "summary.json").read_text())["outcome"] == "done"


def last_line(log):
    lines = [line for line in log.strip().splitlines() if line.strip()]
    text = next((line for line in lines if "error" in line or "pulvis:" in line), (lines or [""])[-1])
    return re.sub(r"\S*/", "", text)[:200]


class Series:
    """The runs of one problem: run once, kept in its csv."""

    def __init__(self, problem, program, folder, jobs):
        self.problem, self.program, self.jobs = problem, program, jobs
        self.path = folder / f"{problem.name}.csv"
        self.known, self.wanted, self.fresh = {}, {}, 0.0
        self.lock = threading.Lock()
        if self.path.exists():
            with open(self.path, newline="") as file:
                lines = [line for line in file if not line.startswith("#")]
            self.known = {row["key"]: row for row in csv.DictReader(lines)}

    def rows(self, settings):
        """Rows for [(family, Setting)]; runs those missing, `jobs` at a time."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            rows = list(pool.map(lambda s: self._row(*s), settings))
        return rows

    def _row(self, family, setting):
        overrides = {**self.problem.always, **setting.overrides}
        key = self.program.key(self.problem.scene, overrides)
        row = self.known.get(key)
        if row is None and self.program.only_cached:
            row = {"overrides": json.dumps(overrides), "key": key, "note": "not run yet"}
        elif row is None:
            row = self.program.run(self.problem.scene, overrides, self.problem.observe)
            print(f"{self.problem.name}: {family} {setting.label}: "
                  f"{row['note'] or row['cpu_s'] + ' s'}", flush=True)
            self.fresh += float(row.get("cpu_s") or 0)
        named = {**row, "family": family, "setting": setting.label}
        with self.lock:
            self.wanted[family, setting.label] = named
            if not self.program.only_cached:
                self.known[key] = row
                self._write(list(self.wanted.values()) + self._unused())
        return named

    def observed(self, overrides):
        label = ", ".join(f"{k.split('.')[-1]} {str(v).strip(chr(34))}" for k, v in overrides.items())
        from problems.problem import Setting
        row = self._row("reference", Setting(label or "as shipped", overrides))
        if row["note"]:
            raise RuntimeError(f"{self.problem.name}: no reference, a run of it is missing: {row['note']}")
        return {name: np.array(v) for name, v in json.loads(row["observed"]).items()}

    def finish(self, reference):
        for row in self.wanted.values():
            if not row["note"]:
                values = {n: np.array(v) for n, v in json.loads(row["observed"]).items()}
                row["errors"] = json.dumps({m: float(f"{e:.4g}") for m, e in
                                            self.problem.errors(values, reference.values).items()})
        rows = sorted(self.wanted.values(), key=lambda row: row["family"] == "reference")
        self._write([row for row in rows if row["note"] != "not run yet"])
        return rows

    def _unused(self):
        used = {row["key"] for row in self.wanted.values()}
        return [row for key, row in self.known.items() if key not in used]

    def _write(self, rows):
        temporary = self.path.with_suffix(".tmp")
        with open(temporary, "w", newline="") as file:
            for name, text in provenance(self.program).items():
                file.write(f"# {name}: {text}\n")
            writer = csv.DictWriter(file, COLUMNS, extrasaction="ignore", lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        temporary.replace(self.path)


def provenance(program):
    cpu = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text())
    return {"machine": f"{cpu[1] if cpu else 'unknown'}, {os.cpu_count()} cores, one thread a run",
            "compiler": compiler(program), "commit": program.commit, "program": program.hash,
            "date": datetime.date.today().isoformat()}


def compiler(program):
    cache = program.path.parent.parent / "CMakeCache.txt"
    if not cache.exists():
        return "unknown"
    path = re.search(r"CMAKE_CXX_COMPILER:\w+=(.*)", cache.read_text())[1]
    kind = re.search(r"CMAKE_BUILD_TYPE:\w+=(.*)", cache.read_text())[1]
    text = subprocess.run([path, "--version"], capture_output=True, text=True).stdout
    return text.splitlines()[0] + ", " + kind


def all_problems(quick):
    sys.path.insert(0, str(ROOT / "bench"))
    found = []
    for name in PROBLEM_FILES:
        if (ROOT / f"bench/problems/{name}.py").exists():
            found += importlib.import_module(f"problems.{name}").problems(quick)
    return found


def solve(problem, program, folder, jobs):
    from problems.problem import Setting
    series = Series(problem, program, folder, jobs)
    settings = [("as shipped", Setting("as shipped"))]
    settings += [(name, s) for name, family in problem.families.items() for s in family]
    shipped = series.rows(settings[:1])[0]
    if shipped["note"]:
        print(f"{problem.name}: skipped, {shipped['note']}")
        if not program.only_cached:
            series.path.unlink()
        return 0.0
    series.rows(settings[1:])
    try:
        reference = problem.reference(series.observed)
    except RuntimeError as missing:
        print(missing)
        return series.fresh
    rows = series.finish(reference)
    fronts_report.picture(problem, rows, reference, folder)
    fronts_report.section(problem, rows, reference, provenance(program), folder)
    return series.fresh


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problem", nargs="*", help="default: all standard ones")
    parser.add_argument("--all", action="store_true", help="those that take long, too")
    parser.add_argument("--jobs", type=int, default=1, help="runs side by side")
    parser.add_argument("--quick", action="store_true", help="coarse meshes: a check of this script")
    parser.add_argument("--cached", action="store_true", help="run nothing, show what is there")
    parser.add_argument("--list", action="store_true", help="name the problems and stop")
    parser.add_argument("--program", default=ROOT / "build/release/cli/pulvis")
    parser.add_argument("--record", action="store_true", help="into bench/results/fronts")
    parser.add_argument("--output", type=pathlib.Path,
                        help="default: build/fronts, which begins as a copy of bench/results/fronts; of "
                             "--quick build/fronts-quick")
    options = parser.parse_args()
    if not options.output:
        options.output = RECORDED if options.record else ROOT / (
            "build/fronts-quick" if options.quick else "build/fronts")
        if not options.quick and not options.output.exists():
            shutil.copytree(RECORDED, options.output)
    problems = {p.name: p for p in all_problems(options.quick)}
    if options.list:
        for p in problems.values():
            print(f"{p.name:<24}{'' if p.standard else '(by name only) '}{p.title}")
        return
    for name in set(options.problem) - set(problems):
        parser.error(f"no problem {name}; there are: {', '.join(problems)}")
    chosen = options.problem or [p.name for p in problems.values() if p.standard or options.all]
    options.output.mkdir(parents=True, exist_ok=True)
    program = Program(options.program)
    program.only_cached = options.cached
    spent = sum(solve(problems[name], program, options.output, options.jobs) for name in chosen)
    fronts_report.summary(list(problems), options.output)
    print(f"{spent:.0f} s of CPU time in new runs; {options.output}/summary.md")


if __name__ == "__main__":
    main()
