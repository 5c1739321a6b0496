"""Runs every shipped study and scene in sequence and checks its expectations: for overnight runs.

  /usr/bin/python3 bench/nightly.py                      (all of scenes/studies, then the scenes, into runs/nightly; hours)
  /usr/bin/python3 bench/nightly.py time-step wall-friction --jobs 1
  /usr/bin/python3 bench/nightly.py brittle/crushed-bed

Scenes are run to the end (the tests run only the beginning of long ones, and of the AFM scenes one of each kind).
Besides its own expectations, each must conserve energy. Finished runs in the output folder are
kept, as in `pulvis study`, so an interrupted night can be continued: give the same command again. After each run the
log is rewritten: OUTPUT/nightly.md has one line per study or scene (runs, expectations met, run time in seconds, exit code),
followed by every expectation, met or not; all other output is in OUTPUT/NAME.log. Exit code: 0 if all returned 0, 1
if one did not, 2 if a name does not exist, 130 if interrupted.
"""
import argparse
import csv
import datetime
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes"
STUDIES = SCENES / "studies"
# All folders except these, so that new ones are found automatically.
ELSEWHERE = {"studies", "probes", "lab", "parts", "materials", "extreme"}  # bench/stability.py; the tests run all
LIMITS = {"energy_balance_error": 0.01, "penetration": 0.1}
MEANING = {0: "good", 2: "refused", 3: "a run failed, or an expectation is not met", 4: "disk or memory"}


def expectations(text):
    """The expectation lines, as printed by `pulvis study`."""
    return [line.strip() for line in text.splitlines() if line.startswith(("  met ", "  NOT met"))]


def seconds_of_runs(folder):
    """Number of successful runs and their total time, including earlier nights."""
    table = folder / "study.csv"
    if not table.exists():
        return 0, 0.0
    with open(table, encoding="utf-8", newline="") as file:
        times = [row.get("wall_seconds [s]") for row in csv.DictReader(file) if row.get("outcome") == "done"]
    return len(times), sum(float(time) for time in times if time)


def logged(command, log):
    with open(log, "w", encoding="utf-8") as file:
        return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT).returncode


def run_study(program, study, output, options):
    folder, log = output / study.stem, output / f"{study.stem}.log"
    code = logged([program, "study", study, "-o", folder, *options], log)
    said = log.read_text(encoding="utf-8", errors="replace")
    runs, seconds = seconds_of_runs(folder)
    return {"name": study.stem, "code": code, "expected": expectations(said), "runs": runs, "seconds": seconds}


def summary_of(folder):
    file = folder / "summary.json"
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}


def run_scene(program, scene, output):
    """Starts a run or resumes it from its checkpoint; finished runs are not repeated."""
    name = f"{scene.parent.name}/{scene.stem}"
    folder, log = output / "scenes" / name, output / f"{name.replace('/', '-')}.log"
    folder.parent.mkdir(parents=True, exist_ok=True)
    code = 0
    if summary_of(folder).get("outcome") != "done":
        again = any(folder.glob("checkpoint-*.h5"))
        code = logged([program, "resume", folder] if again else [program, "run", scene, "-o", folder, "--overwrite"], log)
    summary = summary_of(folder)
    expected = [f"{'met' if one['met'] else 'NOT met'} {one['what']}: {one['measured']}"
                for one in summary.get("expectations", [])]
    for key, limit in LIMITS.items():
        if key in summary:
            expected.append(f"{'met' if summary[key] < limit else 'NOT met'} {key}: {summary[key]:.2g}, below {limit}")
    if code == 0 and any(line.startswith("NOT") for line in expected):
        code = 3
    return {"name": name, "code": code, "expected": expected, "runs": int(summary.get("outcome") == "done"),
            "seconds": summary.get("wall_seconds", 0)}


def write_log(output, version, results):
    lines = ["# Shipped studies and scenes", "", f"{version}, {datetime.datetime.now().astimezone():%Y-%m-%d %H:%M %z}", "",
             "| study or scene | runs | expectations met | seconds of its runs | exit code |", "|---|---|---|---|---|"]
    for result in results:
        met = sum(line.startswith("met") for line in result["expected"])
        lines.append(f"| {result['name']} | {result['runs']} | {met} of {len(result['expected'])} | "
                     f"{result['seconds']:.0f} | {result['code']}: {MEANING.get(result['code'], 'see its log')} |")
    for result in results:
        lines += ["", f"## {result['name']}", ""]
        lines += ["- " + line for line in result["expected"]] or ["- expects nothing"]
    (output / "nightly.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def shipped_scenes():
    scenes = [file for folder in sorted(SCENES.iterdir()) if folder.is_dir() and folder.name not in ELSEWHERE
              for file in sorted(folder.glob("*.toml"))]
    return {f"{file.parent.name}/{file.stem}": file for file in scenes}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", nargs="*", help="names of scenes/studies, FOLDER/NAME of scenes, or files of studies; without any: all")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "runs/nightly")
    for option in ("--jobs", "--threads-per-run"):
        parser.add_argument(option, help="as of `pulvis study`")
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/cli/pulvis")
    args = parser.parse_args()
    scenes = shipped_scenes()
    shipped = {file.stem: file for file in sorted(STUDIES.glob("*.toml"))} | scenes
    chosen = [shipped.get(name, Path(name)) for name in args.study] or list(shipped.values())
    missing = [str(study) for study in chosen if not study.is_file()]
    if missing:
        print(f"nightly: no such study or scene: {', '.join(missing)}; allowed: a file, {', '.join(shipped)}", file=sys.stderr)
        return 2
    if not args.program.is_file():
        print(f"nightly: {args.program} is not built yet: ./pulvis --version builds it", file=sys.stderr)
        return 2
    version = subprocess.run([args.program, "--version"], capture_output=True, text=True).stdout.strip().splitlines()
    args.output.mkdir(parents=True, exist_ok=True)
    options = [word for name in ("jobs", "threads_per_run") if (value := getattr(args, name))
               for word in ("--" + name.replace("_", "-"), value)]
    results = []
    for study in chosen:
        results.append(run_scene(args.program, study, args.output) if study in scenes.values()
                       else run_study(args.program, study, args.output, options))
        write_log(args.output, version[0] if version else "unknown version", results)
        if results[-1]["code"] in (130, -2):
            return 130
    bad = [result["name"] for result in results if result["code"]]
    print(f"{len(results) - len(bad)} of {len(results)} good; {args.output / 'nightly.md'}")
    if bad:
        print(f"not good: {', '.join(bad)}")
    return 1 if bad else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
