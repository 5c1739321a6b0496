"""Spack recipe of the flexible collision library; Spack has none."""
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Fcl(CMakePackage):
    """Proximity queries on pairs of geometric models: collision, distance, tolerance."""

    homepage = "https://github.com/flexible-collision-library/fcl"
    url = "https://github.com/flexible-collision-library/fcl/archive/0.7.0.tar.gz"

    license("BSD-3-Clause")

    version("0.7.0", sha256="90409e940b24045987506a6b239424a4222e2daf648c86dd146cbcb692ebdcbc")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("eigen@3.4")
    depends_on("libccd")

    def cmake_args(self):
        return [
            self.define("BUILD_TESTING", False),
            self.define("FCL_WITH_OCTOMAP", False),
            self.define("CMAKE_POLICY_VERSION_MINIMUM", "3.5"),  # it asks for an older one, which CMake 4 refuses
        ]
