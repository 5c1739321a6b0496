"""Runs scenes/extreme and prints the table in bench/results/stability.csv (docs/stability.md); exit code 1 if an expectation is not met.

  /usr/bin/python3 bench/stability.py [--fast] [part of a name ...]

--fast skips the scenes with `slow` in their name. The criteria of each scene are in its [[expect]]
tables, with the underlying law in its first comment; an unmet expectation is reported with its value.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/cli/pulvis"


def run(scene):
    """Runs a scene on one core; returns its summary."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PROGRAM, "run", scene, "-o", f"{folder}/run", "--threads", "1"],
                       capture_output=True, check=False)
        summary = pathlib.Path(f"{folder}/run/summary.json")
        if not summary.exists():
            sys.exit(f"{scene}: no summary: is {PROGRAM} built, and the scene right?")
        return json.loads(summary.read_text())


def missed(summary):
    """The unmet expectations with the measured values."""
    return [f"{e['what']}: {e['measured']}, not {e['expected']}" for e in summary["expectations"] if not e["met"]]


def row(scene, summary):
    figures = [f"{summary[key]:.2g}" if key in summary else "-"
               for key in ("energy_balance_error", "penetration", "min_jacobian")]
    cells = [scene.stem, *figures, str(summary["steps"]), f"{summary['wall_seconds']:.1f}"]
    return ",".join(cells)


def main(words):
    fast = "--fast" in words
    parts = [w for w in words if not w.startswith("--")]
    print("case,energy balance error,penetration / edge,min det F,steps,wall s")
    failed = []
    for scene in sorted((ROOT / "scenes/extreme").glob("*.toml")):
        if (fast and "slow" in scene.stem) or (parts and not any(p in scene.stem for p in parts)):
            continue
        summary = run(scene)
        print(row(scene, summary), flush=True)
        failed += [f"{scene.stem}: {text}" for text in missed(summary)]
    print(f"\n{len(failed)} expectations not met", *failed, sep="\n", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
