#!/usr/bin/python3
"""Every header starts with a comment and has #pragma once; no source is longer than 450 lines.

usage: headers.py [ROOT]

Exit code 1 when a file breaks one of the rules.
"""
import re
import sys
from pathlib import Path

FOLDERS = ("engine", "components", "systems", "scenes", "cli", "tests", "bench")
HEADERS = {".hpp", ".h", ".ipp", ".inl"}
SOURCES = HEADERS | {".cpp", ".py"}
MOST_LINES = 450
PRAGMA_ONCE = re.compile(r"^\s*#\s*pragma\s+once\s*$", re.MULTILINE)


def faults(source):
    text = source.read_text(encoding="utf-8")
    lines = len(text.splitlines())
    if lines > MOST_LINES:
        yield f"{lines} lines, at most {MOST_LINES}: split it by what its parts do"
    if source.suffix in HEADERS:
        if not text.lstrip().startswith(("//", "/*")):
            yield "starts without a comment that says what it is"
        if not PRAGMA_ONCE.search(text):
            yield "has no #pragma once"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    sources = [root / "pulvis"] if (root / "pulvis").is_file() else []
    for folder in FOLDERS:
        sources += [f for f in sorted((root / folder).rglob("*")) if f.suffix in SOURCES]
    wrong = [f"{source.relative_to(root)}: {fault}" for source in sources for fault in faults(source)]
    print(*wrong, sep="\n", end="\n" if wrong else "")
    if not sources:
        sys.exit(f"headers: no source under {root}: is this the root?")
    print(f"headers: {len(sources)} files, {len(wrong)} faults")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
