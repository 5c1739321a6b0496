#!/usr/bin/python3
"""The arrows between the folders point one way: cli -> scenes -> systems -> components -> engine.

usage: layers.py [ROOT]

Reads every #include of the product folders, resolves it as the compiler does (beside the including
file, then from the root) and refuses each one that points against an arrow. Exit code 1 then.
"""
import os
import re
import sys
from pathlib import Path

MAY_INCLUDE = {
    "engine": set(),
    "components": {"engine"},
    "systems": {"engine", "components"},
    "scenes": {"engine", "components", "systems"},
    "cli": {"engine", "components", "systems", "scenes"},
}
# No product folder includes these two, which stand on top of all of them.
FOLDERS = set(MAY_INCLUDE) | {"tests", "bench"}
SUFFIXES = {".hpp", ".cpp", ".h", ".ipp", ".inl"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]')


def target_folder(root, source, target):
    """The product folder an include leads into, or None: a library's header, or one not found."""
    for place in (source.parent / target, root / target):
        inside = Path(os.path.relpath(os.path.normpath(place), root)).parts
        # A folder's name alone decides when the file is missing: the arrow would be wrong anyway.
        if inside[0] in FOLDERS and (place.exists() or place == root / target):
            return inside[0]
    return None


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    files, wrong = 0, []
    for folder, allowed in MAY_INCLUDE.items():
        sources = [f for f in sorted((root / folder).rglob("*")) if f.suffix in SUFFIXES]
        files += len(sources)
        for source in sources:
            for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                target = match and target_folder(root, source, match[1])
                if target and target != folder and target not in allowed:
                    wrong.append(f"{source.relative_to(root)}:{number}: {folder}/ must not include "
                                 f"{match[1]}: allowed are {', '.join(sorted(allowed)) or 'none'}")
    print(*wrong, sep="\n", end="\n" if wrong else "")
    if files == 0:
        sys.exit(f"layers: no source under {root}: is this the root?")
    print(f"layers: {files} files, {len(wrong)} includes against the arrows")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
