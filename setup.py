"""The compiled module is built by CMake; what else there is to say stands in pyproject.toml.

The environment variable PULVIS_CMAKE has further options of CMake, as -DPULVIS_INSTRUCTION_SETS=all.
"""
import os
import shlex
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent


class BuildByCMake(build_ext):
    def build_extension(self, ext):
        place = Path(self.get_ext_fullpath(ext.name)).resolve().parent  # .../pulvis
        build = Path(self.build_temp).resolve()
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DPULVIS_TESTS=OFF", "-DPULVIS_BENCH=OFF", "-DPULVIS_PYTHON=ON", "-DPULVIS_WERROR=OFF",
                   f"-DPython3_EXECUTABLE={sys.executable}", "-DPULVIS_PYTHON_DESTINATION=.",
                   "-DCMAKE_INSTALL_LIBDIR=pulvis/lib"]
        subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", *options,
                        *shlex.split(os.environ.get("PULVIS_CMAKE", ""))], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "pulvis_python"], check=True)
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", place.parent], check=True)


setup(ext_modules=[Extension("pulvis._core", sources=[])], cmdclass={"build_ext": BuildByCMake})
