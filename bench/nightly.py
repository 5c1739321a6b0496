"""Every shipped study, one after the other, with what it expects: for a machine that is free at night.

  /usr/bin/python3 bench/nightly.py                      (all of scenes/studies into runs/nightly; hours)
  /usr/bin/python3 bench/nightly.py time-step wall-friction --jobs 1

What is finished in the output folder is kept, as `pulvis study` does, so a night that was broken off goes on where it was:
give the same command again. After each study the log is written anew: OUTPUT/nightly.md has one line a study (runs,
expectations met, seconds of its runs, exit code) and below them every expectation, met or not; what a study said besides
is in OUTPUT/NAME.log. Exit code: 0 if every study ended with 0, 1 if one did not, 2 for a study that does not exist, 130
if interrupted.
"""
import argparse
import csv
import datetime
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STUDIES = ROOT / "scenes/studies"
MEANING = {0: "good", 2: "refused", 3: "a run failed, or an expectation is not met", 4: "disk or memory"}


def expectations(text):
    """Lines of the report on expectations, as `pulvis study` prints them."""
    return [line.strip() for line in text.splitlines() if line.startswith(("  met ", "  NOT met"))]


def seconds_of_runs(folder):
    """Number of runs that ended well, and their time, of earlier nights too."""
    table = folder / "study.csv"
    if not table.exists():
        return 0, 0.0
    with open(table, encoding="utf-8", newline="") as file:
        times = [row.get("wall_seconds [s]") for row in csv.DictReader(file) if row.get("outcome") == "done"]
    return len(times), sum(float(time) for time in times if time)


def run(program, study, output, options):
    folder = output / study.stem
    command = [program, "study", study, "-o", folder, *options]
    print(f"{study.stem} ...", flush=True)
    with open(output / f"{study.stem}.log", "w", encoding="utf-8") as log:
        code = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT).returncode
    said = (output / f"{study.stem}.log").read_text(encoding="utf-8", errors="replace")
    runs, seconds = seconds_of_runs(folder)
    return {"name": study.stem, "code": code, "expected": expectations(said), "runs": runs, "seconds": seconds}


def write_log(output, version, results):
    lines = ["# Shipped studies", "", f"{version}, {datetime.datetime.now().astimezone():%Y-%m-%d %H:%M %z}", "",
             "| study | runs | expectations met | seconds of its runs | exit code |", "|---|---|---|---|---|"]
    for result in results:
        met = sum(line.startswith("met") for line in result["expected"])
        lines.append(f"| {result['name']} | {result['runs']} | {met} of {len(result['expected'])} | "
                     f"{result['seconds']:.0f} | {result['code']}: {MEANING.get(result['code'], 'see its log')} |")
    for result in results:
        lines += ["", f"## {result['name']}", ""]
        lines += ["- " + line for line in result["expected"]] or ["- expects nothing"]
    (output / "nightly.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", nargs="*", help="names of scenes/studies, or files; without any: all")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "runs/nightly")
    for option in ("--jobs", "--threads-per-run"):
        parser.add_argument(option, help="as of `pulvis study`")
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/cli/pulvis")
    args = parser.parse_args()
    shipped = {file.stem: file for file in sorted(STUDIES.glob("*.toml"))}
    chosen = [shipped.get(name, Path(name)) for name in args.study] or list(shipped.values())
    missing = [str(study) for study in chosen if not study.is_file()]
    if missing:
        print(f"nightly: no such study: {', '.join(missing)}; allowed: a file, {', '.join(shipped)}", file=sys.stderr)
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
        results.append(run(args.program, study, args.output, options))
        write_log(args.output, version[0] if version else "unknown version", results)
        if results[-1]["code"] in (130, -2):
            return 130
    bad = [result["name"] for result in results if result["code"]]
    print(f"{len(results) - len(bad)} of {len(results)} studies good; {args.output / 'nightly.md'}")
    if bad:
        print(f"not good: {', '.join(bad)}")
    return 1 if bad else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
