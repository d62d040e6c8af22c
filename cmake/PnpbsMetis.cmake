# SPDX-License-Identifier: BSD-3-Clause
# Finds METIS, which has no CMake package in most distributions, and defines METIS::METIS. Only
# builds with MPI use it. 32- and 64-bit METIS export the same symbols. The width is that of the
# metis.h found beside the library, and idx_t does not occur in the interface of PNPBS.
#
# A program that uses PNPBS may have a METIS of its own, which must not be mixed with this one. A
# static METIS that can be linked into a shared library is hidden inside libpnpbs.so. A shared one
# is not linked but opened by its path at run time (src/partition/metis_functions.cpp).
#
# Sets PNPBS_METIS_STATIC_LIBRARIES, which a program with libpnpbs.a must link as well, and
# PNPBS_METIS_DEFINITIONS for metis_functions.cpp.
set(PNPBS_METIS_STATIC_LIBRARIES "")
set(PNPBS_METIS_DEFINITIONS "")
if(NOT PNPBS_HAVE_MPI)
  return()
endif()

find_path(PNPBS_METIS_INCLUDE_DIR metis.h HINTS ${METIS_ROOT} ENV METIS_ROOT PATH_SUFFIXES include)
find_library(PNPBS_METIS_LIBRARY metis HINTS ${METIS_ROOT} ENV METIS_ROOT PATH_SUFFIXES lib)
mark_as_advanced(PNPBS_METIS_INCLUDE_DIR PNPBS_METIS_LIBRARY)
if(NOT PNPBS_METIS_INCLUDE_DIR OR NOT PNPBS_METIS_LIBRARY)
  message(FATAL_ERROR "No METIS was found. Run scripts/setup.sh, or name one with "
                      "-DMETIS_ROOT=<prefix>, or build without MPI: -DPNPBS_ENABLE_MPI=OFF.")
endif()
file(STRINGS "${PNPBS_METIS_INCLUDE_DIR}/metis.h" width
     REGEX "^[ \t]*#[ \t]*define[ \t]+IDXTYPEWIDTH[ \t]+(32|64)")
if(NOT width)
  message(FATAL_ERROR "${PNPBS_METIS_INCLUDE_DIR}/metis.h does not say how wide idx_t is "
                      "(IDXTYPEWIDTH 32 or 64): not a METIS 5 that we know.")
endif()

# Tests whether the static library beside it can be used. It must be position-independent, and since
# version 5.2 a part of METIS is in a separate library, GKlib.
find_library(PNPBS_METIS_STATIC_LIBRARY libmetis.a HINTS ${METIS_ROOT} ENV METIS_ROOT
             PATH_SUFFIXES lib)
find_library(PNPBS_GKLIB_STATIC_LIBRARY libGKlib.a HINTS ${METIS_ROOT} ENV METIS_ROOT
             PATH_SUFFIXES lib)
mark_as_advanced(PNPBS_METIS_STATIC_LIBRARY PNPBS_GKLIB_STATIC_LIBRARY)
get_filename_component(metis_dir "${PNPBS_METIS_LIBRARY}" DIRECTORY)
get_filename_component(metis_static_dir "${PNPBS_METIS_STATIC_LIBRARY}" DIRECTORY)
if(PNPBS_METIS_STATIC_LIBRARY AND metis_dir STREQUAL metis_static_dir)
  set(metis_static_libraries "${PNPBS_METIS_STATIC_LIBRARY}")
  if(PNPBS_GKLIB_STATIC_LIBRARY)
    list(APPEND metis_static_libraries "${PNPBS_GKLIB_STATIC_LIBRARY}")
  endif()
  set(metis_check "${PROJECT_BINARY_DIR}/metis_check")
  file(WRITE "${metis_check}/CMakeLists.txt"
       "cmake_minimum_required(VERSION 3.22)
project(metis_check LANGUAGES C)
add_library(metis_check MODULE check.c)
target_include_directories(metis_check PRIVATE [[${PNPBS_METIS_INCLUDE_DIR}]])
target_link_libraries(metis_check PRIVATE [[${metis_static_libraries}]] m)
target_link_options(metis_check PRIVATE LINKER:-z,defs)
")
  file(WRITE "${metis_check}/check.c"
       "#include <metis.h>
void *check(void) { return (void *)&METIS_PartGraphKway; }
")
  try_compile(PNPBS_METIS_STATIC_WORKS "${metis_check}/build" "${metis_check}" metis_check)
endif()

add_library(METIS::METIS INTERFACE IMPORTED)
target_include_directories(METIS::METIS INTERFACE "${PNPBS_METIS_INCLUDE_DIR}")
if(PNPBS_METIS_STATIC_WORKS)
  set(PNPBS_METIS_STATIC_LIBRARIES ${metis_static_libraries})
  target_link_libraries(METIS::METIS INTERFACE ${metis_static_libraries} m)
  message(STATUS "METIS: static, hidden inside the library")
elseif(PNPBS_METIS_LIBRARY MATCHES "\\.a$")
  message(FATAL_ERROR "${PNPBS_METIS_LIBRARY} cannot be linked into a shared library: build METIS "
                      "with -DCMAKE_POSITION_INDEPENDENT_CODE=ON, or as a shared library; METIS 5.2 "
                      "and later need GKlib beside it, built likewise.")
else()
  # Uses the name stored in the library, which is stable over updates of the package.
  get_filename_component(metis_file "${PNPBS_METIS_LIBRARY}" REALPATH)
  get_filename_component(metis_name "${metis_file}" NAME)
  if(CMAKE_READELF)
    execute_process(COMMAND "${CMAKE_READELF}" -d "${metis_file}" OUTPUT_VARIABLE dynamic
                    ERROR_QUIET)
    if(dynamic MATCHES "\\(SONAME\\)[^[]*\\[([^]]+)\\]")
      set(metis_name "${CMAKE_MATCH_1}")
    endif()
  endif()
  if(EXISTS "${metis_dir}/${metis_name}")
    set(metis_file "${metis_dir}/${metis_name}")
  endif()
  set(PNPBS_METIS_DEFINITIONS "PNPBS_METIS_PATH=\"${metis_file}\""
                              "PNPBS_METIS_NAME=\"${metis_name}\"")
  target_link_libraries(METIS::METIS INTERFACE ${CMAKE_DL_LIBS})
  message(STATUS "METIS: ${metis_file}, opened at run time")
endif()
