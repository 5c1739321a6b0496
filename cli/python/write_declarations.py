"""Writes pulvis/declarations.py: dataclasses of the scene language, from the declarations in its reader.

usage: write_declarations.py FILE, with the compiled module on PYTHONPATH; the build runs it.
"""
import keyword
import sys
import textwrap

sys.path.pop(0)  # this folder: its package lacks the compiled module
from pulvis import _core  # noqa: E402

HEAD = '''"""The scene language as dataclasses: one a table, a field a key. Made by cli/python/write_declarations.py.

`pulvis.Scene` takes a `Document`. What is None is not given, and gets its default; every value is checked by the reader
of scenes. Quantities are strings with their unit, "10 um", or pint quantities.
"""

from dataclasses import dataclass, field
from typing import Any
'''


def class_name(path):
    """particle.mesh: ParticleMesh."""
    return "".join(word.capitalize() for word in path.replace(".", "_").split("_")) or "Document"


def field_name(key):
    return key + "_" if keyword.iskeyword(key) else key


def wrapped(text, indent):
    lines = textwrap.wrap(" ".join(text.split()), 118 - len(indent))
    return f"\n{indent}".join(lines)


def text_of(key):
    unit = f", {key['unit']}" if key["unit"] else ""
    return f"{key['doc']} (allowed: {key['allowed']}{unit})"


def fields_of(table, tables):
    """Key names and their descriptions. A key declared twice has another meaning in three dimensions."""
    prefix = table["path"] + "." if table["path"] else ""
    texts = {}
    for key in table["keys"]:
        texts.setdefault(key["name"], []).append(text_of(key))
    for name, own in texts.items():
        yield name, own[0] if len(set(own)) == 1 else f"In two dimensions: {own[0]} In three dimensions: {own[-1]}"
    for child in tables:
        if child["path"].startswith(prefix) and child["path"] and "." not in child["path"][len(prefix):]:
            if child["path"] != table["path"]:
                kind = "list of " if child["repeated"] else ""
                yield child["path"][len(prefix):], f"{kind}`{class_name(child['path'])}`"


def class_text(table, tables):
    brackets = f"[[{table['path']}]]" if table["repeated"] else f"[{table['path']}]" if table["path"] else "The whole file"
    lines = ["@dataclass", f"class {class_name(table['path'])}:"]
    doc = ['    """' + wrapped(f"{brackets}: {table['doc']}" if table["doc"] else brackets + ".", "    "), "",
           "    Attributes", "    ----------"]
    body, seen = [], set()
    for key, text in fields_of(table, tables):
        if key in seen:
            continue
        seen.add(key)
        name = field_name(key)
        doc += [f"    {name}", "        " + wrapped(text, " " * 8)]
        default = "None" if name == key else f'field(default=None, metadata={{"key": "{key}"}})'
        body.append(f"    {name}: Any = {default}")
    return "\n".join([*lines, *doc, '    """', "", *body])


def main():
    tables = _core.declarations()
    text = "\n\n\n".join(class_text(table, tables) for table in tables)
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(HEAD + "\n\n" + text.replace("\\", "\\\\") + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
