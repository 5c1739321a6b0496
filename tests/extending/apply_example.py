#!/usr/bin/python3
"""Puts an example of docs/extending.md into copies of the sources that it changes.

usage: apply_example.py ROOT SECTION FOLDER [--at-most FILES]

The example is the ```diff block below the heading SECTION. Copies the files that it names from ROOT into FOLDER, applies
it there, and prints their names. Exit code 1 where it does not fit, or changes more than FILES files.
"""
import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path


def example_below(text, section):
    start = text.index(f"\n## {section}\n")
    end = text.find("\n## ", start + 1)
    blocks = re.findall(r"```diff\n(.*?)```", text[start:end], re.S)
    if len(blocks) != 1:
        sys.exit(f"docs/extending.md: {section}: {len(blocks)} examples, expected one")
    return blocks[0]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=Path)
    parser.add_argument("section")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--at-most", type=int, default=0)
    given = parser.parse_args()
    patch = example_below((given.root / "docs/extending.md").read_text(encoding="utf-8"), given.section)
    files = re.findall(r"^\+\+\+ b/(\S+)$", patch, re.M)
    shutil.rmtree(given.folder, ignore_errors=True)
    for file in files:
        (given.folder / file).parent.mkdir(parents=True, exist_ok=True)
        if (given.root / file).exists():
            shutil.copy(given.root / file, given.folder / file)
    applied = subprocess.run(["patch", "-p1", "--fuzz=0", "--force", "--reject-file=-"], input=patch, text=True,
                             cwd=given.folder, capture_output=True)
    if applied.returncode != 0:
        sys.exit(f"{applied.stdout}{applied.stderr}\n"
                 f"The sources have changed where the example of docs/extending.md, \"{given.section}\", does: update its\n"
                 "diff there. The hunks that no longer fit are named above.")
    print("\n".join(files))
    if given.at_most and len(files) > given.at_most:
        sys.exit(f"{given.section}: {len(files)} files, expected at most {given.at_most}")


main()
