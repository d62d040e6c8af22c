# SPDX-License-Identifier: BSD-3-Clause
# Finds Kokkos 4.5 to 5.x: first the user's own, then the one built by scripts/setup.sh. Sets
# PNPBS_KOKKOS_IS_SHARED and PNPBS_KOKKOS_LINKAGE.

# If the cache has Kokkos_DIR from an earlier configure, the first search finds the same one again.
find_package(Kokkos 4.5 QUIET CONFIG)
if(NOT Kokkos_FOUND)
  set(PNPBS_DEPS_DIR "${PROJECT_SOURCE_DIR}/.deps")
  find_package(Kokkos 4.5 QUIET CONFIG PATHS "${PNPBS_DEPS_DIR}/kokkos" NO_DEFAULT_PATH)
endif()

if(NOT Kokkos_FOUND AND PNPBS_FETCH_KOKKOS)
  include(FetchContent)
  if(POLICY CMP0135)
    cmake_policy(SET CMP0135 NEW)
  endif()
  set(Kokkos_ENABLE_OPENMP ON CACHE BOOL "")
  set(Kokkos_ENABLE_SERIAL ON CACHE BOOL "")
  set(pnpbs_saved_pic "${CMAKE_POSITION_INDEPENDENT_CODE}")
  set(pnpbs_saved_shared "${BUILD_SHARED_LIBS}")
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  set(BUILD_SHARED_LIBS OFF)
  FetchContent_Declare(
    Kokkos
    URL https://github.com/kokkos/kokkos/releases/download/4.7.00/kokkos-4.7.00.tar.gz)
  # FetchContent_MakeAvailable would add Kokkos to the installation.
  FetchContent_GetProperties(Kokkos)
  if(NOT kokkos_POPULATED)
    FetchContent_Populate(Kokkos)
    add_subdirectory("${kokkos_SOURCE_DIR}" "${kokkos_BINARY_DIR}" EXCLUDE_FROM_ALL)
  endif()
  set(CMAKE_POSITION_INDEPENDENT_CODE "${pnpbs_saved_pic}")
  set(BUILD_SHARED_LIBS "${pnpbs_saved_shared}")
  set(Kokkos_FOUND TRUE)
  set(Kokkos_VERSION 4.7.0)
  set(Kokkos_DIR "${kokkos_SOURCE_DIR}")
endif()

if(NOT Kokkos_FOUND)
  message(
    FATAL_ERROR
      "No Kokkos from 4.5 to 5.x was found. Do one of these:\n"
      "  - run scripts/setup.sh, which builds one for this project only;\n"
      "  - say where yours is: -DKokkos_ROOT=<prefix> or -DCMAKE_PREFIX_PATH=<prefix>;\n"
      "  - let CMake download the official release: -DPNPBS_FETCH_KOKKOS=ON.")
endif()
if(Kokkos_VERSION VERSION_GREATER_EQUAL 6)
  message(FATAL_ERROR "Kokkos ${Kokkos_VERSION} in ${Kokkos_DIR} is newer than PNPBS knows; "
                      "name one from 4.5 to 5.x with -DKokkos_ROOT=<prefix>.")
endif()

# A static Kokkos is hidden inside the library. A shared one belongs to the process, and a host
# program may have started it already.
get_target_property(pnpbs_kokkos_type Kokkos::kokkoscore TYPE)
if(pnpbs_kokkos_type STREQUAL "SHARED_LIBRARY")
  set(PNPBS_KOKKOS_IS_SHARED TRUE)
  set(PNPBS_KOKKOS_LINKAGE "shared")
else()
  set(PNPBS_KOKKOS_IS_SHARED FALSE)
  set(PNPBS_KOKKOS_LINKAGE "static, hidden")
endif()
message(STATUS "Kokkos ${Kokkos_VERSION} (${PNPBS_KOKKOS_LINKAGE}): ${Kokkos_DIR}")
