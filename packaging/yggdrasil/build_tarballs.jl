# SPDX-License-Identifier: BSD-3-Clause
# Yggdrasil's recipe for PNPBS_jll. Not run yet: packaging/README.md tells its state.
# In Yggdrasil this file lies in P/PNPBS; `julia build_tarballs.jl --help` tells its arguments.
using BinaryBuilder, Pkg

const YGGDRASIL_DIR = "../.."
include(joinpath(YGGDRASIL_DIR, "platforms", "mpi.jl"))

name = "PNPBS"
version = v"0.2.0"

# Kokkos_jll is older than PNPBS needs (4.5), so Kokkos is built here and hidden inside the library.
sources = [
    # To be filled in for the first release: no address and no archive exists yet.
    ArchiveSource("https://pnpbs.invalid/releases/pnpbs-$(version).tar.gz",
                  "0000000000000000000000000000000000000000000000000000000000000000"),
    ArchiveSource("https://github.com/kokkos/kokkos/releases/download/4.7.00/kokkos-4.7.00.tar.gz",
                  "126b774a24dde8c1085c4aede7564c0b7492d6a07d85380f2b387a712cea1ff5"),
]

script = raw"""
cd ${WORKSPACE}/srcdir
kokkos=${WORKSPACE}/kokkos

cmake -S kokkos-* -B build-kokkos \
    -DCMAKE_TOOLCHAIN_FILE=${CMAKE_TARGET_TOOLCHAIN} \
    -DCMAKE_INSTALL_PREFIX=${kokkos} \
    -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_STANDARD=20 \
    -DCMAKE_POSITION_INDEPENDENT_CODE=ON \
    -DBUILD_SHARED_LIBS=OFF \
    -DKokkos_ENABLE_OPENMP=ON \
    -DKokkos_ENABLE_SERIAL=ON
cmake --build build-kokkos --parallel ${nproc}
cmake --install build-kokkos

# Its folder is named: it is in none that the toolchain looks into. No checkpoints yet: HDF5_jll would have
# to be the one of the same MPI. No shapes: GDAL_jll brings more libraries than all else together.
cmake -S pnpbs-* -B build-pnpbs \
    -DCMAKE_TOOLCHAIN_FILE=${CMAKE_TARGET_TOOLCHAIN} \
    -DCMAKE_INSTALL_PREFIX=${prefix} \
    -DCMAKE_BUILD_TYPE=Release \
    -DPNPBS_PROCESSOR_LEVELS=OFF \
    -DKokkos_DIR=$(dirname ${kokkos}/lib*/cmake/Kokkos/KokkosConfig.cmake) \
    -DMETIS_ROOT=${prefix} \
    -DPNPBS_ENABLE_MPI=ON \
    -DPNPBS_WITH_HDF5=OFF \
    -DPNPBS_ENABLE_GEO=OFF \
    -DPNPBS_BUILD_CLI=OFF \
    -DPNPBS_BUILD_FORTRAN=OFF \
    -DPNPBS_BUILD_TESTS=OFF
cmake --build build-pnpbs --parallel ${nproc}
cmake --install build-pnpbs
install_license pnpbs-*/LICENSE
"""

augment_platform_block = """
    using Base.BinaryPlatforms
    $(MPI.augment)
    augment_platform!(platform::Platform) = augment_mpi!(platform)
"""

# Linux is what PNPBS is built and tested on; Kokkos wants 64 bits. No two builds for C++'s two
# kinds of strings: the interface is C, and the C++ library is inside.
platforms = filter(p -> Sys.islinux(p) && nbits(p) == 64 && libc(p) == "glibc",
                   supported_platforms())
platforms, platform_dependencies = MPI.augment_platforms(platforms)

products = [LibraryProduct("libpnpbs", :libpnpbs)]

dependencies = [
    # libgomp, for Kokkos' threads
    Dependency(PackageSpec(; name="CompilerSupportLibraries_jll",
                           uuid="e66e0078-7015-5450-92f7-15fbd957f2ae")),
    Dependency(PackageSpec(; name="METIS_jll", uuid="d00139f3-1899-568f-a2f0-47f597d42d70");
               compat="5.1.2"),
    # Opened by its name when a .vtu file is packed.
    Dependency(PackageSpec(; name="Zlib_jll", uuid="83775a58-1f1d-513f-b197-d71354ab007a")),
]
append!(dependencies, platform_dependencies)

# MPItrampoline must not look for an MPI while the library is only opened to be looked at.
ENV["MPITRAMPOLINE_DELAY_INIT"] = "1"

build_tarballs(ARGS, name, version, sources, script, platforms, products, dependencies;
               augment_platform_block, julia_compat="1.6", preferred_gcc_version=v"12")
