#!/usr/bin/python3
"""A folder's files mean the same to the compiler one by one and as one file (PULVIS_UNITY).

usage: unity.py [ROOT]

Together, the helpers of all of a folder's anonymous namespaces are in sight of each of its files. Where two files have
one of the same name and other parameters, a call may find the other's without a word from the compiler: the check
refuses the second. (Two that are the same are an error of the compiler's.) Files that CMake's lists name as APART or as
readers are on their own, and so are the systems of a step. Exit code 1 then.
"""
import re
import sys
from pathlib import Path

import sizes

ON_THEIR_OWN = ("systems/body/", "systems/contact/", "systems/laws/", "systems/observe/", "systems/tools/",
                "components/", "bench/", "tests/keys/")
BY_ADL = ("TEST", "TYPED_TEST", "PrintTo", "operator", "lambda")  # PrintTo: of the type that is printed


def named_apart(root):
    """The files that CMake keeps out of their folder's one."""
    text = "".join(f.read_text(encoding="utf-8") for f in (*root.glob("*/CMakeLists.txt"), *root.glob("*/*.cmake")))
    apart = {word for some in re.findall(r"\bAPART\s([^)]*)\)", text) for word in some.split()}
    readers = {word for some in re.findall(r"\bset\(readers\s([^)]*)\)", text) for word in some.split()}
    return apart | {f"scenes/{reader}.cpp" for reader in readers}


def helpers_of(root):
    """By folder and name: the first function of each file."""
    found, apart = {}, named_apart(root)
    for source in sizes.sources_of(root):
        file = source.relative_to(root).as_posix()
        if source.suffix == ".cpp" and file not in apart and not file.startswith(ON_THEIR_OWN):
            for f in sizes.Walk(file, source.read_text(encoding="utf-8")).hidden:
                if not f.name.startswith(BY_ADL):
                    found.setdefault((source.parent, f.name), {}).setdefault(file, f)
    return found


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    found = helpers_of(root)
    if not found:
        sys.exit(f"unity: no helper under {root}: is this the root?")
    wrong = 0
    for functions in found.values():
        first, *others = functions.values()
        for other in others:
            wrong += 1
            print(f"{other.file}:{other.line}: {other.name} is the name of a helper in {first.file}, too: "
                  "give it another, or both one header")
    print(f"unity: {len(found)} helpers, {wrong} whose name another file of the folder has")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
