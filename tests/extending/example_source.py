#!/usr/bin/python3
"""Makes a source file of the system that docs/extending.md shows, with its column, and of its test.

usage: example_source.py ROOT FILE

Takes the C++ of "A system, with a column of its own" up to where it is put into the step's list.
"""
import sys
from pathlib import Path

root, target = Path(sys.argv[1]), Path(sys.argv[2])
text = (root / "docs/extending.md").read_text(encoding="utf-8")
section = text[text.index("\n## A system, with a column of its own\n"):]
begin = section.index("```cpp\n") + len("```cpp\n")
code = section[begin:section.index("// systems/step.cpp\n", begin)]
target.write_text(f'''#include "systems/body/systems.hpp"
#include "tests/helpers/experiment.hpp"
namespace pulvis {{
{code}
}}  // namespace pulvis
#include "tests/extending/particle_spin.hpp"
''', encoding="utf-8")
