"""Runs the examples of docs/results.md that read results, on a small run, and those of docs/writing-scenes.md; and
every file that a page of docs/ or the README names must be there.

usage: docs_examples.py PULVIS SOURCE_DIR
"""
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

EXPECTED = {"h5py": r"largest force on the punch: \S+ N\nmean effective stress: \S+ Pa at 2e-05 s\n"
                    r"particle of the highest mean: \d+\n$",
            "meshio": r"^0 s: largest effective stress \S+ Pa\n(.+ s: largest effective stress \S+ Pa\n)+$"}


# `systems/body/j2_kernel.hpp`, `scenes/afm`; not patterns (`mesh_<outline>.cpp`), nor what a build or a run makes.
NAMED = re.compile(r"`(?:\./)?((?:cli|scenes|systems|components|engine|tests|bench|docs)/[\w./+-]+)`")
LINKED = re.compile(r"\]\(([\w./-]+\.(?:md|png|json))[#)]")


def check_names(source):
    missing, found = [], 0
    for page in [source / "README.md", *sorted((source / "docs").glob("*.md"))]:
        text = page.read_text(encoding="utf-8")
        files = [source / name for name in NAMED.findall(text)] + [page.parent / name for name in LINKED.findall(text)]
        # A name without its ending stands for a header and its source.
        missing += [f"{page.name}: {file.relative_to(source)}" for file in files
                    if not file.exists() and not list(file.parent.glob(file.name + ".*"))]
        found += len(files)
    if missing or found < 100:
        sys.exit(f"named in the docs, but not there ({found} names in all):\n" + "\n".join(missing))
    print(f"ok: {found} files named in the docs")


def pattern_of(lines):
    """What a page shows of an output: "..." stands for anything, alone for any number of lines."""
    parts = [r"(?:.*\n)*" if line == "..." else ".*".join(map(re.escape, line.split("..."))) + r"\n" for line in lines]
    return re.compile("".join(parts))


def run_page(program, page):
    """Writes the files that a page shows, and runs its commands: each must say what stands below it."""
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        for kind, block in re.findall(r"```(toml|svg|console)\n(.*?)```", page.read_text(encoding="utf-8"), re.S):
            if kind != "console":  # named by the comment in its first line
                (Path(folder) / block.split("\n", 1)[0].strip("#<!-> ")).write_text(block, encoding="utf-8")
                continue
            for command, shown in re.findall(r"^\$ pulvis (.*)\n((?:(?!\$ ).*\n)*)", block, re.M):
                done = subprocess.run([program, *shlex.split(command)], cwd=folder, text=True,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                said = done.stdout if done.stdout.endswith("\n") else done.stdout + "\n"
                if not pattern_of(shown.splitlines()).fullmatch(said):
                    sys.exit(f"{page.name}: pulvis {command} says\n{said}\ninstead of\n{shown}")
                count += 1
    if count < 5:
        sys.exit(f"{page.name}: only {count} examples were found")
    print(f"ok: {count} examples of {page.name}")


def main():
    program, source = sys.argv[1], Path(sys.argv[2])
    check_names(source)
    run_page(program, source / "docs/writing-scenes.md")
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
