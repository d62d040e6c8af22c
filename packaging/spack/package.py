# SPDX-License-Identifier: BSD-3-Clause
"""Spack's recipe. Not run yet: packaging/README.md tells its state."""

from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Pnpbs(CMakePackage):
    """Places the nodes of finite element meshes and meshless methods in parallel, by bubble
    simulation, behind a C interface with a Fortran module."""

    # To be filled in for the first release: no address and no archive exists yet.
    homepage = "https://pnpbs.invalid"
    url = "https://pnpbs.invalid/releases/pnpbs-0.2.0.tar.gz"
    git = "https://pnpbs.invalid/pnpbs.git"

    license("BSD-3-Clause")

    version("main", branch="main")
    version("0.2.0", sha256="0000000000000000000000000000000000000000000000000000000000000000")

    variant("mpi", default=True, description="Contexts on an MPI communicator")
    variant("openmp", default=True, description="Threads")
    variant("fortran", default=True, description="The Fortran module")
    variant("cli", default=True, description="The command pnpbs")
    variant("hdf5", default=True, description="Checkpoints, by HDF5")
    variant("geo", default=False, description="GeoJSON and shapefiles, by GDAL and PROJ")
    variant("static", default=False, description="The static library, beside the shared one")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("fortran", type="build", when="+fortran")
    depends_on("cmake@3.22:", type="build")
    depends_on("pkgconfig", type="build", when="+cli")

    # A shared Kokkos is the process's own; a static one is hidden inside, and must be
    # position-independent for that.
    depends_on("kokkos@4.5:5 cxxstd=20")
    depends_on("kokkos+openmp", when="+openmp")
    depends_on("kokkos+serial", when="~openmp")
    conflicts("^kokkos~shared~pic", msg="A static Kokkos must be position-independent: kokkos+pic")
    for device in ("cuda", "rocm", "sycl"):
        conflicts(f"^kokkos+{device}", msg="PNPBS computes on the host")

    depends_on("mpi@3:", when="+mpi")
    depends_on("metis@5:", when="+mpi")

    # Neither is linked, but opened at run time: as link dependencies they are in the library's run
    # path. A build without MPI takes no parallel HDF5; zlib unpacks .vtu files of background meshes.
    depends_on("hdf5@1.10:+shared", when="+hdf5 +mpi")
    depends_on("hdf5@1.10:+shared~mpi", when="+hdf5 ~mpi")
    depends_on("zlib-api")

    # PROJ comes with GDAL, which projects by it.
    depends_on("gdal@3.2:", when="+geo")

    with when("+cli"):
        depends_on("cli11", type="build")
        depends_on("nlohmann-json@3:", type="build")
        depends_on("muparser")
        depends_on("cairo")

    def cmake_args(self):
        # Spack's compiler wrappers choose the processor, so PNPBS_ARCH stays empty.
        return [
            self.define("PNPBS_PROCESSOR_LEVELS", False),
            self.define("Kokkos_ROOT", self.spec["kokkos"].prefix),
            self.define("PNPBS_BUILD_TESTS", False),
            self.define_from_variant("PNPBS_ENABLE_MPI", "mpi"),
            self.define_from_variant("PNPBS_BUILD_FORTRAN", "fortran"),
            self.define_from_variant("PNPBS_BUILD_CLI", "cli"),
            self.define_from_variant("PNPBS_WITH_HDF5", "hdf5"),
            self.define_from_variant("PNPBS_ENABLE_GEO", "geo"),
            self.define_from_variant("PNPBS_INSTALL_STATIC", "static"),
        ]
