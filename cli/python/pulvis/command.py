"""The command `pulvis` that `pip install` brings: the program built with this package, which draws its pictures with this Python."""
import os
import sys
from pathlib import Path


def main() -> None:
    program = str(Path(__file__).with_name("bin") / "pulvis")
    os.environ.setdefault("PULVIS_PYTHON", sys.executable)
    os.execv(program, [program, *sys.argv[1:]])
