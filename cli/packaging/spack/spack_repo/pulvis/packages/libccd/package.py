"""Spack recipe of what fcl needs; Spack has none."""
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Libccd(CMakePackage):
    """Collision detection between two convex shapes."""

    homepage = "https://github.com/danfis/libccd"
    url = "https://github.com/danfis/libccd/archive/v2.1.tar.gz"

    license("BSD-3-Clause")

    version("2.1", sha256="542b6c47f522d581fbf39e51df32c7d1256ac0c626e7c2b41f1040d4b9d50d1e")

    depends_on("c", type="build")
    depends_on("cxx", type="build")

    def cmake_args(self):
        return [
            self.define("BUILD_SHARED_LIBS", True),
            self.define("BUILD_TESTING", False),
            self.define("ENABLE_DOUBLE_PRECISION", True),
            self.define("CMAKE_POLICY_VERSION_MINIMUM", "3.5"),  # it asks for an older one, which CMake 4 refuses
        ]
