# SPDX-License-Identifier: BSD-3-Clause
# Options of the build, and the compiler flags that follow from them.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug, RelWithDebInfo" FORCE)
endif()

option(PNPBS_ENABLE_MPI "Let contexts be made on an MPI communicator" ON)
option(PNPBS_BUILD_CLI "Build the command pnpbs" ON)
option(PNPBS_STATIC_CAIRO "Link the command with a static cairo, so that it runs where there is none"
       OFF)
option(PNPBS_BUILD_TESTS "Build the tests" OFF)
option(PNPBS_INSTALL_STATIC "Install libpnpbs.a as well; its users link Kokkos and C++ themselves"
       OFF)
option(PNPBS_FETCH_KOKKOS "Download and build the official Kokkos release if none is found" OFF)
option(PNPBS_COUNT_UNKNOWN_USES
       "Count what a rank decides by data that it does not know exactly (slow; statistic unknown_uses)"
       OFF)
option(PNPBS_WARNINGS_AS_ERRORS "Stop at the first compiler warning" OFF)
set(PNPBS_ARCH
    ""
    CACHE STRING "Processor to compile for: empty for the compiler's default, native, x86-64-v3, ...")
set(PNPBS_TEST_FOLDERS
    ""
    CACHE STRING "Folders of tests to build; empty: all")
set(PNPBS_SANITIZE
    ""
    CACHE STRING "Sanitizers to build with, as -fsanitize takes them, e.g. address,undefined")

set(CMAKE_C_STANDARD 99)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# Warnings for the project's own code.
add_library(pnpbs_warnings INTERFACE)
target_compile_options(pnpbs_warnings INTERFACE -Wall -Wextra -Wpedantic)
if(CMAKE_UNITY_BUILD)
  # In unity builds, names of one file may shadow those of another, and captures of a lambda may
  # have types that are local to their file.
  target_compile_options(pnpbs_warnings
                         INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
else()
  target_compile_options(pnpbs_warnings INTERFACE -Wshadow)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 14)
  # Loops to be vectorised combine conditions by | and &, which do not branch. They are not
  # vectorised without optimisation.
  target_compile_options(
    pnpbs_warnings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-bitwise-instead-of-logical>
                             $<$<COMPILE_LANGUAGE:CXX>:-Wno-pass-failed>)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC bug 105651: false alarms inside std::string. With a precompiled header all but the first are
  # reported.
  target_compile_options(
    pnpbs_warnings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict> $<$<COMPILE_LANGUAGE:CXX>:-Wno-array-bounds>
                             $<$<COMPILE_LANGUAGE:CXX>:-Wno-stringop-overflow>
                             $<$<COMPILE_LANGUAGE:CXX>:-Wno-stringop-overread>)
endif()
if(PNPBS_WARNINGS_AS_ERRORS)
  target_compile_options(pnpbs_warnings INTERFACE -Werror)
endif()

# Compiler flags of the library's own code. Results must not depend on where a node lies in memory,
# so -ffast-math and contraction into fused multiply-adds are excluded: a vector loop and its
# remainder then give the same bits. The two flags about mathematical functions change no value, but
# without them square roots and comparisons prevent vectorisation.
add_library(pnpbs_arithmetic INTERFACE)
target_compile_options(pnpbs_arithmetic INTERFACE -ffp-contract=off -fno-math-errno
                                                  -fno-trapping-math -fopenmp-simd)
if(PNPBS_ARCH)
  target_compile_options(pnpbs_arithmetic INTERFACE -march=${PNPBS_ARCH})
endif()

# Optimised builds compile the kernels with -O3, which their vector loops need, even if a project or
# distribution sets CMAKE_CXX_FLAGS_RELEASE to -O2. All other code is compiled with -O1, which
# halves the compile time of -O3 and makes runs about one per cent longer. A level below -O2 in
# CMAKE_CXX_FLAGS_RELEASE is kept.
add_library(pnpbs_kernel_optimisation INTERFACE)
add_library(pnpbs_other_optimisation INTERFACE)
foreach(build_type Release RelWithDebInfo)
  string(TOUPPER ${build_type} name)
  if(NOT CMAKE_CXX_FLAGS_${name} MATCHES "-O[^23]")
    target_compile_options(pnpbs_kernel_optimisation INTERFACE $<$<CONFIG:${build_type}>:-O3>)
    target_compile_options(pnpbs_other_optimisation
                           INTERFACE $<$<CONFIG:${build_type}>:-O1;-finline-small-functions>)
  endif()
endforeach()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC collects its garbage only above 512 MiB, which saves a twelfth of its time.
  foreach(optimisation kernel other)
    target_compile_options(pnpbs_${optimisation}_optimisation INTERFACE --param=ggc-min-heapsize=524288)
  endforeach()
endif()

# Sanitizers apply to every target, including the tests.
if(PNPBS_SANITIZE)
  add_compile_options(-fsanitize=${PNPBS_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${PNPBS_SANITIZE})
  # C programs link with the library, but Clang does not give them the run-time library of these two
  # checks, which exist for C++ only.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND PNPBS_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize=vptr,function)
  endif()
endif()
