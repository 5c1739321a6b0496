"""Files and names that docs/extending.md sends a reader to must be there, and the names of a table in the files of their row.

usage: extending.py SOURCE_DIR
"""
import re
import sys
from pathlib import Path

from links import FENCE

LAYERS = ("cli", "scenes", "systems", "components", "engine", "tests", "docs", "bench")
ENDINGS = {".cpp", ".hpp", ".py", ".js", ".toml", ".sh", ".txt", ".md"}
RESULTS = {".csv", ".json", ".h5", ".html"}  # written by runs
PLACEHOLDER = re.compile(r"<\w+>")
NAME = re.compile(r"[A-Za-z_]\w*(?:(?:::|\.)[A-Za-z_]\w*)*(?:\([^()]*\))?$")
EXAMPLES = re.compile(r"```.*?^```", re.M | re.S)


def quoted(text):
    return re.findall(r"`([^`\n]+)`", text)


def is_path(word):
    return word.startswith(tuple(layer + "/" for layer in LAYERS)) and " " not in word


def found(root, word):
    """Files of a path; one with a placeholder, such as systems/<room>/systems.hpp, stands for any."""
    if PLACEHOLDER.search(word) or "*" in word:
        return [one for one in root.glob(PLACEHOLDER.sub("*", word))]
    one = root / word
    return [one] if one.exists() else []


def files_of_row(root, cell):
    """The files of a row's first column: `a/b.cpp`, `.hpp` and `c.cpp` stand for those beside the one before."""
    files, missing, last = [], [], None
    for word in quoted(cell):
        if not is_path(word):
            if last is None or Path(word).suffix not in ENDINGS and word not in ENDINGS:
                continue
            if not (root / word).is_file():
                word = str(Path(last).with_suffix(word) if word in ENDINGS else Path(last).parent / word)
        last = word
        here = found(root, word)
        files += here
        if not here and not PLACEHOLDER.search(word):
            missing.append(word)
    return files, missing


def text_of(file):
    inside = sorted(file.rglob("*")) if file.is_dir() else [file]
    return "\n".join(one.read_text(encoding="utf-8", errors="replace") for one in inside if one.is_file())


def last_name(word):
    return re.split(r"::|\.", word.split("(")[0])[-1]


def names_in(text):
    return {word for word in quoted(text) if NAME.match(word) and not is_path(word) and Path(word).suffix not in ENDINGS | RESULTS}


def all_words(root):
    words = set()
    for layer in LAYERS:
        for file in (root / layer).rglob("*"):
            if file.suffix in ENDINGS and file.name != "extending.md" and "extending" not in file.parts and file.is_file():
                words |= set(re.findall(r"\w+", file.read_text(encoding="utf-8", errors="replace")))
    for file in root.iterdir():
        if file.is_file() and file.suffix in {".txt", ".md", ".json", ".toml"}:
            words |= set(re.findall(r"\w+", file.read_text(encoding="utf-8", errors="replace")))
    return words


def faults_of(root, page):
    text = page.read_text(encoding="utf-8")
    prose, examples = FENCE.sub("", text), " ".join(EXAMPLES.findall(text))
    own = set(re.findall(r"\w+", examples))
    known, faults = all_words(root) | own, []
    for line in prose.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split(" | ")] if line.startswith("| ") else []
        files, missing = files_of_row(root, cells[0]) if len(cells) == 2 else ([], [])
        faults += [f"{word}: no such file" for word in missing]
        for word in quoted(line):
            if is_path(word) and word not in missing and not found(root, word):
                faults.append(f"{word}: no such file")
        for word in names_in(line):
            if last_name(word) not in known:
                faults.append(f"{word}: no such name")
        if files and all(one.is_file() for one in files):
            inside = set(re.findall(r"\w+", " ".join(map(text_of, files)))) | own
            faults += [f"{word}: is not in {cells[0]}" for word in names_in(cells[1]) if last_name(word) not in inside]
    return faults


def main():
    root = Path(sys.argv[1])
    page = root / "docs/extending.md"
    faults = faults_of(root, page)
    for one in faults:
        print(f"{page.relative_to(root)}: {one}")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
