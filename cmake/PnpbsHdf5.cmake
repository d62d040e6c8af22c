# SPDX-License-Identifier: BSD-3-Clause
# Finds HDF5, which is used for checkpoints and for .vtkhdf and .xdmf files. One rank calls it to
# create or to inspect the layout of a file; the ranks then write and read their rows themselves. So
# a serial HDF5 suffices. A parallel one requires a build with MPI, because of its header.
#
# It is not linked but opened by its path at run time (src/io/hdf5_library.cpp). A program that uses
# PNPBS may have an HDF5 of its own, which must not be mixed with this one, and neither the shared
# nor the static library then adds a dependency for its users.
#
# Sets PNPBS_HAVE_HDF5 (0 or 1), PNPBS_HDF5_INCLUDE_DIR, PNPBS_HDF5_DEFINITIONS (for
# hdf5_library.cpp) and PNPBS_HDF5_TEXT (for the description of the build).

set(PNPBS_WITH_HDF5
    AUTO
    CACHE STRING "Checkpoints, .vtkhdf and .xdmf by HDF5: ON, OFF, or AUTO: where it is found")
set_property(CACHE PNPBS_WITH_HDF5 PROPERTY STRINGS AUTO ON OFF)
set(PNPBS_HAVE_HDF5 0)
set(PNPBS_HDF5_DEFINITIONS "")
set(PNPBS_HDF5_TEXT "")
if(NOT PNPBS_WITH_HDF5)
  message(STATUS "HDF5: none, no checkpoints, .vtkhdf, .xdmf (PNPBS_WITH_HDF5=${PNPBS_WITH_HDF5})")
  return()
endif()

# Sets `output` to the value of a macro in a header of HDF5.
function(pnpbs_hdf5_macro header name output)
  set(value "")
  if(EXISTS "${header}")
    file(STRINGS "${header}" lines REGEX "^[ \t]*#[ \t]*define[ \t]+${name}[ \t]+[0-9]+")
    if(lines MATCHES "${name}[ \t]+([0-9]+)")
      set(value "${CMAKE_MATCH_1}")
    endif()
  endif()
  set(${output} "${value}" PARENT_SCOPE)
endfunction()

# Debian installs several variants side by side, in folders of their own.
set(why_not "no hdf5.h with a shared library")
foreach(flavour plain serial openmpi mpich)
  set(folder "hdf5/${flavour}")
  set(names hdf5 hdf5_${flavour})
  if(flavour STREQUAL "plain")
    set(folder "")
    set(names hdf5)
  endif()
  find_path(PNPBS_HDF5_${flavour}_INCLUDE_DIR hdf5.h
            HINTS ${HDF5_ROOT} ENV HDF5_ROOT PATH_SUFFIXES include/${folder} ${folder})
  find_library(PNPBS_HDF5_${flavour}_LIBRARY NAMES ${names}
               HINTS ${HDF5_ROOT} ENV HDF5_ROOT PATH_SUFFIXES lib/${folder} ${folder})
  mark_as_advanced(PNPBS_HDF5_${flavour}_INCLUDE_DIR PNPBS_HDF5_${flavour}_LIBRARY)
  set(include_dir "${PNPBS_HDF5_${flavour}_INCLUDE_DIR}")
  set(library "${PNPBS_HDF5_${flavour}_LIBRARY}")
  if(NOT include_dir OR NOT library OR library MATCHES "\\.a$")
    continue()
  endif()
  pnpbs_hdf5_macro("${include_dir}/H5pubconf.h" H5_HAVE_PARALLEL parallel)
  pnpbs_hdf5_macro("${include_dir}/H5public.h" H5_VERS_MAJOR major)
  pnpbs_hdf5_macro("${include_dir}/H5public.h" H5_VERS_MINOR minor)
  pnpbs_hdf5_macro("${include_dir}/H5public.h" H5_VERS_RELEASE release)
  if(parallel AND NOT PNPBS_HAVE_MPI)
    set(why_not "${library} is a parallel HDF5, and this is a build without MPI")
  elseif("${major}.${minor}" VERSION_LESS 1.10)
    set(why_not "${library} is older than 1.10")
  else()
    set(PNPBS_HAVE_HDF5 1)
    break()
  endif()
endforeach()

if(NOT PNPBS_HAVE_HDF5)
  set(advice "scripts/setup.sh --tests installs one, -DHDF5_ROOT=<prefix> names one")
  if(PNPBS_WITH_HDF5 STREQUAL "AUTO")
    message(STATUS "HDF5: none, no checkpoints, .vtkhdf, .xdmf (${why_not}; ${advice})")
  else()
    message(FATAL_ERROR "No HDF5 was found: ${why_not}. ${advice}; -DPNPBS_WITH_HDF5=OFF builds "
                        "without.")
  endif()
  return()
endif()

# Uses the name stored in the library, which is stable over updates of the package.
get_filename_component(hdf5_dir "${library}" DIRECTORY)
get_filename_component(hdf5_file "${library}" REALPATH)
get_filename_component(hdf5_name "${hdf5_file}" NAME)
if(CMAKE_READELF)
  execute_process(COMMAND "${CMAKE_READELF}" -d "${hdf5_file}" OUTPUT_VARIABLE dynamic ERROR_QUIET)
  if(dynamic MATCHES "\\(SONAME\\)[^[]*\\[([^]]+)\\]")
    set(hdf5_name "${CMAKE_MATCH_1}")
  endif()
endif()
get_filename_component(hdf5_real_dir "${hdf5_file}" DIRECTORY)
foreach(dir "${hdf5_dir}" "${hdf5_real_dir}")
  if(EXISTS "${dir}/${hdf5_name}")
    set(hdf5_file "${dir}/${hdf5_name}")
    break()
  endif()
endforeach()
set(PNPBS_HDF5_INCLUDE_DIR "${include_dir}")
set(PNPBS_HDF5_DEFINITIONS "PNPBS_HDF5_PATH=\"${hdf5_file}\"" "PNPBS_HDF5_NAME=\"${hdf5_name}\"")
set(PNPBS_HDF5_TEXT "${major}.${minor}.${release}")
message(STATUS "HDF5 ${PNPBS_HDF5_TEXT}: ${hdf5_file}, opened at run time")
