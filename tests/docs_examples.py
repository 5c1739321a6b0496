"""Runs the examples of docs/results.md that read results, on a small run.

usage: docs_examples.py PULVIS SOURCE_DIR
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

EXPECTED = {"h5py": r"largest force on the punch: \S+ N\nmean effective stress: \S+ Pa at 2e-05 s\n"
                    r"particle of the highest mean: \d+\n$",
            "meshio": r"^0 s: largest effective stress \S+ Pa\n(.+ s: largest effective stress \S+ Pa\n)+$"}


def main():
    program, source = sys.argv[1], Path(sys.argv[2])
    text = (source / "docs/results.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", text, re.S)
    with tempfile.TemporaryDirectory() as folder:
        run = Path(folder) / "run"
        subprocess.run([program, "run", source / "scenes/compaction/regular-25.toml", "-o", run, "--threads", "1",
                        "--set", "stage.press.duration=20 us", "--set", "output.frames=3", "--set",
                        'stage.press.move[0].displacement=["0 mm", "-0.4 mm"]'], check=True, stdout=subprocess.DEVNULL)
        for module, expected in EXPECTED.items():
            (example,) = [block for block in blocks if f"import {module}\n" in block]
            done = subprocess.run([sys.executable, "-c", example], cwd=run, capture_output=True, text=True)
            if done.returncode or not re.search(expected, done.stdout):
                sys.exit(f"the example of {module} went wrong:\n{done.stdout}{done.stderr}")
            print(f"ok: {module}\n{done.stdout}", end="")


if __name__ == "__main__":
    main()
