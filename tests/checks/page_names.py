#!/usr/bin/python3
"""No two scripts of a page declare the same top-level name: the later one would replace the earlier.

usage: page_names.py [ROOT]

The scripts of a page are those named in the source file that writes it. One that calls main() is the last of its page
and stands for it; panels are in every page whose source asks for `panel_`. Exit code 1 if a name is declared twice.
"""
import re
import sys
from pathlib import Path

NAMED = re.compile(r'"(\w+\.js)"')
DECLARED = re.compile(r"^(?:async )?(?:function\*?|class|const|let|var)\s+(?:(\w+)|\{([^}]*)\}|\[([^\]]*)\])", re.M)
MORE = re.compile(r"(\w+) = [^,]+(?:,\s|;)")
STARTS = re.compile(r"^main\(\)", re.M)


def names_in(text):
    """Top-level names: of declarations that begin a line."""
    for match in DECLARED.finditer(text):
        yield from [match[1]] if match[1] else re.findall(r"\w+", match[2] or match[3])
        if match[0].startswith(("const", "let", "var")) and match[1]:  # const A = 1, B = 2;
            line = text[match.start(1):text.index("\n", match.start())]
            if re.fullmatch(r"(?:\w+ = [^,()=]+(?:, |;.*))+", line):
                yield from MORE.findall(line)[1:]


def pages_of(source, scripts):
    """(name, script names) of every page that a source file writes."""
    text = source.read_text(encoding="utf-8")
    named = list(dict.fromkeys(NAMED.findall(text)))
    if not any(name in scripts for name in named):
        return
    parts = [name for name in named if name in scripts and not STARTS.search(scripts[name])]
    if '"panel_"' in text:
        parts += sorted(name for name in scripts if name.startswith("panel_"))
    for last in named:
        if last in scripts and STARTS.search(scripts[last]):
            yield last, [*parts, last]


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    scripts = {path.name: path.read_text(encoding="utf-8") for path in (root / "cli/report/page").rglob("*.js")}
    pages = [page for source in sorted((root / "cli").rglob("*.cpp")) for page in pages_of(source, scripts)]
    wrong, loaded = [], set()
    for page, parts in pages:
        loaded.update(parts)
        declared = {}
        for part in parts:
            for name in names_in(scripts[part]):
                if name in declared and declared[name] != part:
                    wrong.append(f"{page}: {name} is declared by {declared[name]} and {part}")
                declared.setdefault(name, part)
    wrong += [f"{name} is in no page" for name in sorted(set(scripts) - loaded)]
    print("\n".join(wrong) or f"{len(pages)} pages, {len(loaded)} scripts: every name is declared once")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
