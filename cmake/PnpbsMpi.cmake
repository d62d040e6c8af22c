# SPDX-License-Identifier: BSD-3-Clause
# Finds MPI's C bindings. Sets PNPBS_HAVE_MPI (0 or 1) and PNPBS_MPI_LIBRARY_TEXT.

set(PNPBS_HAVE_MPI 0)
set(PNPBS_MPI_LIBRARY_TEXT "")
if(NOT PNPBS_ENABLE_MPI)
  return()
endif()

find_package(MPI COMPONENTS C)
if(NOT MPI_C_FOUND)
  message(FATAL_ERROR "No MPI was found. Run scripts/setup.sh, name one with -DMPI_HOME=<prefix>, "
                      "or build without it: -DPNPBS_ENABLE_MPI=OFF.")
endif()
set(PNPBS_HAVE_MPI 1)

# Determines name and version of the implementation from macros in its mpi.h. Running a program
# would not work when cross-compiling.
find_file(PNPBS_MPI_HEADER mpi.h HINTS ${MPI_C_INCLUDE_DIRS} NO_DEFAULT_PATH)
find_file(PNPBS_MPI_HEADER mpi.h)
mark_as_advanced(PNPBS_MPI_HEADER)

function(pnpbs_mpi_macro name output)
  set(value "")
  if(PNPBS_MPI_HEADER)
    file(STRINGS "${PNPBS_MPI_HEADER}" lines REGEX "^[ \t]*#[ \t]*define[ \t]+${name}[ \t]")
    if(lines MATCHES "${name}[ \t]+\"?([^\"; \t]+)")
      set(value "${CMAKE_MATCH_1}")
    endif()
  endif()
  set(${output} "${value}" PARENT_SCOPE)
endfunction()

pnpbs_mpi_macro(OMPI_MAJOR_VERSION ompi_major)
pnpbs_mpi_macro(OMPI_MINOR_VERSION ompi_minor)
pnpbs_mpi_macro(OMPI_RELEASE_VERSION ompi_release)
pnpbs_mpi_macro(I_MPI_VERSION intel_version)
pnpbs_mpi_macro(MVAPICH2_VERSION mvapich_version)
pnpbs_mpi_macro(MPICH_VERSION mpich_version)
if(ompi_major)
  set(PNPBS_MPI_LIBRARY_TEXT "Open MPI ${ompi_major}.${ompi_minor}.${ompi_release}")
elseif(intel_version)
  set(PNPBS_MPI_LIBRARY_TEXT "Intel MPI ${intel_version}")
elseif(mvapich_version)
  set(PNPBS_MPI_LIBRARY_TEXT "MVAPICH2 ${mvapich_version}")
elseif(mpich_version)
  set(PNPBS_MPI_LIBRARY_TEXT "MPICH ${mpich_version}")
else()
  set(PNPBS_MPI_LIBRARY_TEXT "MPI ${MPI_C_VERSION}")
endif()
message(STATUS "MPI: ${PNPBS_MPI_LIBRARY_TEXT}")
