# SPDX-License-Identifier: BSD-3-Clause
# Finds METIS, which has no CMake package of its own in most distributions: METIS::METIS. Only a
# build with MPI partitions anything. 32- and 64-bit METIS export the same symbols; the width is the
# one of the metis.h found beside the library, and idx_t stays out of our interface.
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
add_library(METIS::METIS UNKNOWN IMPORTED)
set_target_properties(
  METIS::METIS PROPERTIES IMPORTED_LOCATION "${PNPBS_METIS_LIBRARY}"
                          INTERFACE_INCLUDE_DIRECTORIES "${PNPBS_METIS_INCLUDE_DIR}")
