"""Spack recipe, for Spack 1.0 and later. In a clone: spack repo add cli/packaging/spack/spack_repo/pulvis. See docs/installing.md."""
import os

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator

from spack.package import *


class Pulvis(CMakePackage):
    """Combined discrete/finite element method for powders whose particles deform, on CPUs."""

    license("GPL-3.0-or-later")

    version("main")  # of the clone: dev-build. A release adds url and sha256

    variant("python", default=True, description="Python module")
    variant("mpi", default=False, description="Runs of several processes")
    variant("portable", default=False, description="Core library for any x86-64, AVX2 and AVX-512, chosen when it is loaded")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("eigen@3.4")
    depends_on("tbb")
    depends_on("hdf5@1.10: ~mpi")
    depends_on("fcl@0.7:")
    depends_on("boost@1.74:")
    depends_on("fmt@9:")
    depends_on("spdlog@1.10:")
    depends_on("cli11@2.1:")
    depends_on("nlohmann-json@3.11:")
    depends_on("tomlplusplus@3.3:")
    depends_on("xxhash@0.8:")
    depends_on("cpp-httplib@0.11:")
    depends_on("pugixml@1.12:")
    depends_on("re2 +shared")  # the static one needs the libraries of Abseil, too
    depends_on("udunits")
    depends_on("zlib-api")
    depends_on("mpi", when="+mpi")
    depends_on("python@3.9:", type=("build", "link", "run"))
    depends_on("py-pybind11@2.9:", when="+python", type="build")
    depends_on("py-numpy", when="+python", type=("build", "run"))
    depends_on("py-matplotlib", type="run")  # pulvis figure
    depends_on("py-h5py ~mpi", type="run")

    extends("python", when="+python")
    generator("ninja")

    def cmake_args(self):
        return [
            self.define("PULVIS_TESTS", False),
            self.define("PULVIS_BENCH", False),
            self.define("PULVIS_INSTRUCTION_SETS", "all" if self.spec.satisfies("+portable") else "native"),
            self.define("PULVIS_PYTHON", "ON" if self.spec.satisfies("+python") else "OFF"),
            self.define("PULVIS_PYTHON_DESTINATION", os.path.relpath(python_platlib, self.prefix)),
            self.define("Python3_EXECUTABLE", python.path),
            self.define_from_variant("PULVIS_MPI", "mpi"),
        ]

    def setup_run_environment(self, env):
        env.set("PULVIS_PYTHON", self.spec["python"].command.path)
