"""Runs scenes/extreme and prints docs/stability.md's table; exit code 1 if an expectation is not met.

  /usr/bin/python3 bench/stability.py [--fast] [part of a name ...]

--fast leaves out the scenes with `slow` in their name. What each scene asks stands in its own [[expect]]
tables, with the law behind it in its first comment.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/cli/pulvis"
# Asked of every scene that runs to its end: they have columns of their own.
COMMON = ("outcome", "energy_balance_error", "penetration, at the end", "min_jacobian, at the end")


def run(scene):
    """Runs a scene on one core; returns its summary."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PROGRAM, "run", scene, "-o", f"{folder}/run", "--threads", "1"],
                       capture_output=True, check=False)
        summary = pathlib.Path(f"{folder}/run/summary.json")
        if not summary.exists():
            sys.exit(f"{scene}: no summary: is {PROGRAM} built, and the scene right?")
        return json.loads(summary.read_text())


def cell(text):
    return text.replace("|", "\\|")


def asked(summary):
    """The law's part of the expectations; for scenes without one, that they hold at all."""
    own = [f"{e['what']}: {e['expected']}" for e in summary["expectations"] if e["what"] not in COMMON]
    if not own:
        own = [summary["expectations"][0]["expected"]]
    return "; ".join(own)


def outcome(summary):
    missed = [e for e in summary["expectations"] if not e["met"]]
    if not missed:
        return "met"
    return "**NOT met**: " + "; ".join(f"{e['what']}: {e['measured']}, not {e['expected']}" for e in missed)


def row(scene, summary):
    figures = [f"{summary[key]:.2g}" if key in summary else "-"
               for key in ("energy_balance_error", "penetration", "min_jacobian")]
    cells = [scene.stem, asked(summary), outcome(summary), *figures, str(summary["steps"]),
             f"{summary['wall_seconds']:.1f}"]
    return "| " + " | ".join(cell(c) for c in cells) + " |"


def main(words):
    fast = "--fast" in words
    parts = [w for w in words if not w.startswith("--")]
    print("| case | what is asked | outcome | energy balance error | penetration / edge | least det F | "
          "steps | wall s |\n|---|---|---|---|---|---|---|---|")
    failed = []
    for scene in sorted((ROOT / "scenes/extreme").glob("*.toml")):
        if (fast and "slow" in scene.stem) or (parts and not any(p in scene.stem for p in parts)):
            continue
        summary = run(scene)
        print(row(scene, summary), flush=True)
        if not all(e["met"] for e in summary["expectations"]):
            failed.append(scene.stem)
    print(f"\n{len(failed)} not met{': ' if failed else ''}{', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
