"""The compiled module and the program are built by CMake; what else there is to say stands in pyproject.toml.

The environment variable PULVIS_CMAKE has further options of CMake, as -DPULVIS_INSTRUCTION_SETS=all.
"""
import contextlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent
BETWEEN_LINES = 20  # s


def compile_with_progress(build):
    """pip hides what a build prints; lines of progress go to the terminal itself, if there is one."""
    with contextlib.ExitStack() as opened:
        try:
            terminal = opened.enter_context(open("/dev/tty", "w", encoding="utf-8"))
        except OSError:
            terminal = sys.stderr
        ninja = subprocess.Popen(["cmake", "--build", build, "--target", "pulvis_python", "pulvis"], stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, text=True, env={**os.environ, "NINJA_STATUS": "[%f/%t] "})
        began = told = time.monotonic()
        for line in ninja.stdout:
            print(line, end="", flush=True)
            count = re.match(r"\[(\d+)/(\d+)\]", line)
            if count and time.monotonic() - told > BETWEEN_LINES:
                told = time.monotonic()
                print(f"\npulvis: {count[1]} of {count[2]} steps of the build, {(told - began) / 60:.1f} min", file=terminal, flush=True)
        if ninja.wait():
            raise subprocess.CalledProcessError(ninja.returncode, ninja.args)


class BuildByCMake(build_ext):
    def build_extension(self, ext):
        place = Path(self.get_ext_fullpath(ext.name)).resolve().parent  # .../pulvis
        build = Path(self.build_temp).resolve()
        # Without ccache, the headers of the libraries are parsed once per target.
        faster = "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache" if shutil.which("ccache") else "-DPULVIS_PRECOMPILED=ON"
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DPULVIS_TESTS=OFF", "-DPULVIS_BENCH=OFF", "-DPULVIS_PYTHON=ON", "-DPULVIS_WERROR=OFF",
                   f"-DPython3_EXECUTABLE={sys.executable}", "-DPULVIS_PYTHON_DESTINATION=.",
                   "-DCMAKE_INSTALL_LIBDIR=pulvis/lib", "-DCMAKE_INSTALL_BINDIR=pulvis/bin", faster]
        subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", *options,
                        *shlex.split(os.environ.get("PULVIS_CMAKE", ""))], check=True)
        compile_with_progress(build)
        for component in ("python", "program"):
            subprocess.run(["cmake", "--install", build, "--strip", "--component", component, "--prefix", place.parent], check=True)


setup(ext_modules=[Extension("pulvis._core", sources=[])], cmdclass={"build_ext": BuildByCMake})
