#!/usr/bin/python3
"""The house: which folder, and which room in it, may look at which; how full a room may be.

usage: layers.py [ROOT] [--tree]

Reads every #include of the product folders, resolves it as the compiler does (beside the including file, then from the
root), and refuses each one that points against an arrow: from a floor to one above it, or from a room to one that ROOMS
does not list for it. Refuses headers that include each other in a circle, a folder of more than 40 files of code, and a
source file of a room that is neither declared in a header of its own name nor a system, nor a part of another (PARTS).
Exit code 1 then. --tree prints the rooms with their files and lines.
"""
import os
import re
import sys
from pathlib import Path

FLOORS = ("engine", "components", "systems", "scenes", "cli")  # each looks at those before it
# The rooms of a floor and the rooms of it that they look at. "": the floor's own files.
ROOMS = {
    "engine": {
        "ranks": "",
        "files": "/",
        "": "",
    },
    "components": {
        "": "space",  # both dimensions
        "space": "/",  # three dimensions, here and below
    },
    "systems": {
        "laws": "",
        "ranks": "",
        "body": "laws",
        "contact": "laws ranks",
        "tools": "contact laws ranks",
        "cell": "space/contact tools ranks",
        "observe": "contact tools ranks",
        "sparse": "",
        "lever": "sparse body laws",
        "space/body": "body laws",
        "space/contact": "contact laws ranks",
        "space/tools": "space/contact contact tools laws ranks",
        "space/observe": "space/contact space/tools contact observe",
        "": "body cell contact tools observe ranks space/body space/contact space/observe space/tools",
    },
    "scenes": {
        "language": "",
        "ranks": "results/parts spec language",
        "spec": "language",
        "keys": "materials spec language",
        "let": "language",
        "materials": "language",
        "drawings": "language",
        "outlines": "drawings spec language",
        "meshes": "outlines spec",
        "meshes/hexahedra": "meshes spec language",
        "packing/outlines": "outlines spec language",
        "packing/solids": "meshes/hexahedra outlines spec language",
        "packing": "packing/outlines packing/solids outlines spec language",
        "grains": "meshes packing outlines spec language",
        "tools": "drawings packing outlines spec language",
        "tools/surfaces": "packing/solids tools spec language",
        "results/parts": "",
        "results/solids": "tools/surfaces meshes/hexahedra results/parts tools spec language",
        "solve": "",
        "results/observables": "results/parts results/solids tools/surfaces tools spec language",
        "results": "results/parts results/observables solve results/solids tools/surfaces tools spec language",
        "lever/mesh": "spec language",
        "wedge": "solve",
        "lever": "solve wedge lever/mesh results/parts spec language",
        "checks/solids": "meshes/hexahedra packing packing/solids tools/surfaces spec language",
        "checks": "checks/solids packing/outlines lever meshes packing packing/solids tools results results/parts outlines spec language",
        "": "checks checks/solids meshes/hexahedra results/solids tools/surfaces ranks packing/solids grains keys let lever lever/mesh materials meshes packing tools results outlines spec language",
    },
    "cli": {
        "report": "",
        "slurm": "/",
        "laboratory/volts": "/",
        "laboratory": "laboratory/volts /",
        "laboratory/output": "laboratory laboratory/volts report /",
        "campaigns/study/analysis": "",
        "campaigns/study": "campaigns/study/analysis report slurm /",
        "campaigns/probe": "campaigns/study laboratory report /",
        "campaigns/fit": "campaigns/study laboratory/output laboratory report /",
        "kinds": "campaigns/study campaigns/probe campaigns/fit laboratory",
        "python_scripts": "report /",
        "preview": "python_scripts /",
        "ranks": "/",
        "mpi": "ranks /",
        "live": "report /",
        "session": "ranks report /",
        "python/module": "session report /",
        "": "python_scripts report laboratory/output",
    },
}
ABOVE = {"cli": {"main.cpp"}}  # files of a floor that stand on top of all of its rooms
# Sources of one kind that a header of another name declares.
PARTS = ("engine/files/hdf5_change", "engine/files/hdf5_checksum", "engine/files/hdf5_view", "scenes/keys/declare_",
         "cli/laboratory/declare_", "scenes/meshes/mesh_", "scenes/results/observables/", "cli/python/module/bind_")
MOST_FILES = 40
SUFFIXES = {".hpp", ".cpp", ".h", ".ipp", ".inl"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]')


def includes(file):
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1]


def target_of(root, source, target):
    """The product file that an include leads to, or None: a library's header, or one not found."""
    for place in (source.parent / target, root / target):
        inside = Path(os.path.relpath(os.path.normpath(place), root))
        # A folder's name alone decides when the file is missing: the arrow would be wrong anyway.
        if inside.parts[0] in (*FLOORS, "tests", "bench") and (place.exists() or place == root / target):
            return inside
    return None


def room_of(inside):
    """Floor and room of a product file."""
    floor, room = inside.parts[0], "/".join(inside.parts[1:-1])
    return floor, room


def may_look(source, target):
    floor, room = room_of(source)
    other, there = room_of(target)
    if other not in FLOORS:
        return False
    if floor != other:
        return FLOORS.index(other) < FLOORS.index(floor)
    if room == there or source.name in ABOVE.get(floor, ()) and not room:
        return True
    allowed = ROOMS.get(floor, {}).get(room)
    return allowed is not None and (there or "/") in allowed.split()


def circles(arrows):
    """Headers that include themselves by way of others."""
    state, found = {}, []

    def visit(header, way):
        state[header] = "open"
        for following in arrows.get(header, ()):
            if state.get(following) == "open":
                found.append(" -> ".join(map(str, [*way[way.index(following):], following])))
            elif following not in state:
                visit(following, [*way, following])
        state[header] = "done"

    for header in sorted(arrows):
        if header not in state:
            visit(header, [header])
    return found


def is_declared(root, source, systems):
    inside = source.relative_to(root)
    if source.with_suffix(".hpp").exists() or inside.name == "main.cpp" or str(inside).startswith(PARTS):
        return True
    if inside.parts[0] == "systems":  # a system, or several of one kind
        text = source.read_text(encoding="utf-8")
        return any(re.search(rf"\bvoid {name}(<\w+>)?(::operator\(\))?\(", text) for name in systems)
    return False


def names_of_systems(root):
    text = "".join(f.read_text(encoding="utf-8") for f in sorted((root / "systems").rglob("*systems.hpp")))
    return set(re.findall(r"^(?:void|struct) ([a-z]\w+)[( ]", text, re.M))


def print_tree(root, folders):
    print(f"{'room':24} files  lines")
    for floor in FLOORS:
        rooms = [folder for folder in folders if folder.parts[0] == floor]
        lines = {room: sum(len((root / f).read_text(encoding="utf-8").splitlines()) for f in folders[room])
                 for room in rooms}
        print(f"{floor + '/':24} {sum(len(folders[room]) for room in rooms):5} {sum(lines.values()):6}")
        for room in sorted(rooms, key=lambda room: (len(room.parts) > 1, room)):
            name = "/".join(room.parts[1:]) or "(its own)"
            print(f"  {name:22} {len(folders[room]):5} {lines[room]:6}")


def main():
    words = [word for word in sys.argv[1:] if word != "--tree"]
    root = Path(words[0] if words else Path(__file__).parents[2]).resolve()
    files = [f for floor in FLOORS for f in sorted((root / floor).rglob("*")) if f.suffix in SUFFIXES]
    if not files:
        sys.exit(f"layers: no source under {root}: is this the root?")
    wrong, arrows, folders = [], {}, {}
    systems = names_of_systems(root)
    for source in files:
        inside = source.relative_to(root)
        folders.setdefault(inside.parent, []).append(inside)
        floor, room = room_of(inside)
        if floor in ROOMS and room not in ROOMS[floor]:
            wrong.append(f"{inside}: {floor}/{room} is no room of the house: {__file__} lists them")
        if inside.suffix == ".cpp" and not is_declared(root, source, systems):
            wrong.append(f"{inside}: neither has a header of its own nor is a system")
        for number, name in includes(source):
            target = target_of(root, source, name)
            if target is None:
                continue
            if inside.suffix == ".hpp":
                arrows.setdefault(inside, set()).add(target)
            if not may_look(inside, target):
                wrong.append(f"{inside}:{number}: must not include {name}")
    wrong += [f"headers include each other: {circle}" for circle in circles(arrows)]
    wrong += [f"{folder}: {len(inside)} files of code, at most {MOST_FILES}" for folder, inside in
              sorted(folders.items()) if len(inside) > MOST_FILES]
    if "--tree" in sys.argv:
        print_tree(root, folders)
    print(*wrong, sep="\n", end="\n" if wrong else "")
    print(f"layers: {len(files)} files in {len(folders)} folders, {len(wrong)} against the plan")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
