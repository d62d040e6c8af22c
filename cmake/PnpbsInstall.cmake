# SPDX-License-Identifier: BSD-3-Clause
# Installs the project, and the files by which other projects find it: CMake's find_package(pnpbs)
# and pkg-config. Users of the shared library need neither Kokkos nor MPI nor C++.

include(CMakePackageConfigHelpers)
set(doc_dir "${CMAKE_INSTALL_DATAROOTDIR}/doc/pnpbs")
set(data_dir "${CMAKE_INSTALL_DATAROOTDIR}/pnpbs")
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/pnpbs")

# ------------------------------------------------------------------ library, headers, command ---
set(headers_without_library "")
if(NOT PNPBS_HAVE_GEO)
  set(headers_without_library PATTERN "pnpbs_geo.h" EXCLUDE)
endif()
install(DIRECTORY include/pnpbs DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        FILES_MATCHING PATTERN "*.h" ${headers_without_library})
# The run path points to a shared Kokkos, or an MPI outside the system's folders, where it was
# linked.
foreach(library pnpbs ${PNPBS_LEVEL_LIBRARIES})
  set_target_properties(${library} PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON)
  if(PNPBS_KOKKOS_IS_SHARED)
    # Given explicitly, because CMake leaves out folders inside the source tree (.deps).
    set_target_properties(${library} PROPERTIES INSTALL_RPATH
                                                "$<TARGET_FILE_DIR:Kokkos::kokkoscore>")
  endif()
endforeach()
install(
  TARGETS pnpbs
  EXPORT pnpbsTargets
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
foreach(level IN LISTS PNPBS_LEVELS)
  install(TARGETS pnpbs_${level} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/${PNPBS_LEVELS_FOLDER}/${level}"
                                         NAMELINK_SKIP)
endforeach()
if(PNPBS_INSTALL_STATIC)
  install(TARGETS pnpbs_core ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
endif()

if(PNPBS_HAVE_GEO)
  # It finds libpnpbs in its own folder.
  set_target_properties(pnpbs_geo PROPERTIES INSTALL_RPATH "$ORIGIN"
                                             INSTALL_RPATH_USE_LINK_PATH ON)
  install(TARGETS pnpbs_geo EXPORT pnpbsGeoTargets LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(EXPORT pnpbsGeoTargets NAMESPACE pnpbs:: DESTINATION "${package_dir}")
endif()

file(RELATIVE_PATH bin_to_lib "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
if(TARGET pnpbs-cli)
  # Relative, so that an installed tree may be moved.
  set_target_properties(pnpbs-cli PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
  install(TARGETS pnpbs-cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(FILES "${PROJECT_SOURCE_DIR}/docs/pnpbs.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
endif()

# ------------------------------------------------------------------ Fortran module --------------
set(fortran_source_dir "${data_dir}/fortran")
foreach(source IN LISTS PNPBS_FORTRAN_SOURCES PNPBS_GEO_FORTRAN_SOURCES)
  install(FILES "bindings/fortran/${source}" DESTINATION "${fortran_source_dir}")
endforeach()
if(PNPBS_BUILD_FORTRAN)
  install(TARGETS pnpbs_fortran EXPORT pnpbsFortranTargets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(DIRECTORY "${PROJECT_BINARY_DIR}/fortran/"
          DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/pnpbs/fortran" FILES_MATCHING PATTERN "*.mod")
  install(EXPORT pnpbsFortranTargets NAMESPACE pnpbs:: DESTINATION "${package_dir}")
endif()
if(PNPBS_BUILD_FORTRAN AND PNPBS_HAVE_GEO)
  install(TARGETS pnpbs_geo_fortran EXPORT pnpbsGeoFortranTargets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(EXPORT pnpbsGeoFortranTargets NAMESPACE pnpbs:: DESTINATION "${package_dir}")
endif()

# ------------------------------------------------------------------ CMake package ---------------
configure_package_config_file(
  cmake/pnpbsConfig.cmake.in "${PROJECT_BINARY_DIR}/pnpbsConfig.cmake"
  INSTALL_DESTINATION "${package_dir}" NO_SET_AND_CHECK_MACRO
  PATH_VARS fortran_source_dir)
# In major version 0, a new minor version may change the interface.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/pnpbsConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/pnpbsConfig.cmake"
              "${PROJECT_BINARY_DIR}/pnpbsConfigVersion.cmake" DESTINATION "${package_dir}")
install(EXPORT pnpbsTargets NAMESPACE pnpbs:: DESTINATION "${package_dir}")

# ------------------------------------------------------------------ pkg-config ------------------
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  set(PNPBS_PC_PREFIX "${CMAKE_INSTALL_PREFIX}")
  set(PNPBS_PC_LIBDIR "${CMAKE_INSTALL_FULL_LIBDIR}")
  set(PNPBS_PC_INCLUDEDIR "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
else()
  # Relative to the file itself, so that an installed tree may be moved.
  file(RELATIVE_PATH up "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
  string(REGEX REPLACE "/$" "" up "${up}")
  set(PNPBS_PC_PREFIX "\${pcfiledir}/${up}")
  set(PNPBS_PC_LIBDIR "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
  set(PNPBS_PC_INCLUDEDIR "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
# Programs find the library in its folder. Not in the system's own folders, which the loader
# searches anyway and for which packagers reject a run path.
set(PNPBS_PC_RPATH " -Wl,-rpath,\${libdir}")
if("${CMAKE_INSTALL_FULL_LIBDIR}" IN_LIST CMAKE_PLATFORM_IMPLICIT_LINK_DIRECTORIES
   OR "${CMAKE_INSTALL_FULL_LIBDIR}" STREQUAL "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}")
  set(PNPBS_PC_RPATH "")
endif()
# Libraries that only `pkg-config --static` returns, if there is a static library.
set(PNPBS_PC_LIBS_PRIVATE "")
if(PNPBS_INSTALL_STATIC)
  foreach(part kokkossimd kokkosalgorithms kokkoscontainers kokkoscore)
    if(TARGET Kokkos::${part})
      get_target_property(part_type Kokkos::${part} TYPE)
      if(part_type MATCHES "^(STATIC|SHARED)_LIBRARY$")
        string(APPEND PNPBS_PC_LIBS_PRIVATE " $<TARGET_FILE:Kokkos::${part}>")
      endif()
    endif()
  endforeach()
  if(PNPBS_HAVE_MPI)
    string(REPLACE ";" " " mpi_libraries "${MPI_C_LIBRARIES}")
    string(REPLACE ";" " " metis_libraries "${PNPBS_METIS_STATIC_LIBRARIES}")
    string(APPEND PNPBS_PC_LIBS_PRIVATE " ${mpi_libraries} ${metis_libraries}")
  endif()
  string(APPEND PNPBS_PC_LIBS_PRIVATE " -fopenmp -lstdc++ -ldl -lm")
endif()
configure_file(pkgconfig/pnpbs.pc.in "${PROJECT_BINARY_DIR}/pnpbs.pc.configured" @ONLY)
file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/pkgconfig/pnpbs.pc"
     INPUT "${PROJECT_BINARY_DIR}/pnpbs.pc.configured")
install(FILES "${PROJECT_BINARY_DIR}/pkgconfig/pnpbs.pc"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

# The same for CMake.
if(PNPBS_INSTALL_STATIC)
  configure_file(cmake/pnpbsStatic.cmake.in "${PROJECT_BINARY_DIR}/pnpbsStatic.cmake.configured"
                 @ONLY)
  file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/pnpbsStatic.cmake"
       INPUT "${PROJECT_BINARY_DIR}/pnpbsStatic.cmake.configured")
  install(FILES "${PROJECT_BINARY_DIR}/pnpbsStatic.cmake" DESTINATION "${package_dir}")
endif()

# Installs a .pc file with the same prefix.
function(pnpbs_install_pc module)
  configure_file(pkgconfig/${module}.pc.in "${PROJECT_BINARY_DIR}/pkgconfig/${module}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/pkgconfig/${module}.pc"
          DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endfunction()
if(PNPBS_BUILD_FORTRAN)
  pnpbs_install_pc(pnpbs-fortran)
endif()
if(PNPBS_HAVE_GEO)
  pnpbs_install_pc(pnpbs-geo)
endif()
if(PNPBS_BUILD_FORTRAN AND PNPBS_HAVE_GEO)
  pnpbs_install_pc(pnpbs-geo-fortran)
endif()
if(PNPBS_HAVE_MPI)
  # Empty if the compiler finds MPI by itself.
  set(PNPBS_PC_MPI_CFLAGS "")
  foreach(folder IN LISTS MPI_C_INCLUDE_DIRS)
    string(APPEND PNPBS_PC_MPI_CFLAGS " -I${folder}")
  endforeach()
  foreach(definition IN LISTS MPI_C_COMPILE_DEFINITIONS)
    string(APPEND PNPBS_PC_MPI_CFLAGS " -D${definition}")
  endforeach()
  string(REPLACE ";" " " mpi_flags "${MPI_C_COMPILE_OPTIONS}")
  string(APPEND PNPBS_PC_MPI_CFLAGS " ${mpi_flags}")
  string(REPLACE ";" " " PNPBS_PC_MPI_LIBS " ${MPI_C_LINK_FLAGS} ${MPI_C_LIBRARIES}")
  pnpbs_install_pc(pnpbs-mpi)
endif()

# ------------------------------------------------------------------ texts, examples -------------
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff CONTRIBUTING.md DESTINATION "${doc_dir}")
# The folders are kept, because pages link to each other.
install(DIRECTORY docs DESTINATION "${doc_dir}" PATTERN "pnpbs.1" EXCLUDE)
install(DIRECTORY abi packaging DESTINATION "${doc_dir}" PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY examples DESTINATION "${data_dir}" PATTERN ".clang-format" EXCLUDE
        PATTERN "__pycache__" EXCLUDE)

# Creates symbolic links for targets of links in the pages that are installed elsewhere: `link` in
# one installed folder leads to `to` in another. Links are relative, so that an installed tree may
# be moved.
function(pnpbs_install_link folder link to)
  get_filename_component(destination "${folder}/${link}" DIRECTORY)
  get_filename_component(from "${destination}" ABSOLUTE BASE_DIR "${CMAKE_INSTALL_PREFIX}")
  get_filename_component(to "${to}" ABSOLUTE BASE_DIR "${CMAKE_INSTALL_PREFIX}")
  file(RELATIVE_PATH target "${from}" "${to}")
  set(made "${PROJECT_BINARY_DIR}/installed_links/${folder}/${link}")
  get_filename_component(made_in "${made}" DIRECTORY)
  file(MAKE_DIRECTORY "${made_in}")
  file(CREATE_LINK "${target}" "${made}" SYMBOLIC)
  install(FILES "${made}" DESTINATION "${destination}")
endfunction()
pnpbs_install_link("${doc_dir}" examples "${data_dir}/examples")
pnpbs_install_link("${doc_dir}" include/pnpbs "${CMAKE_INSTALL_INCLUDEDIR}/pnpbs")
pnpbs_install_link("${doc_dir}" bindings/fortran "${data_dir}/fortran")
pnpbs_install_link("${data_dir}" docs "${doc_dir}/docs")

# ------------------------------------------------------------------ Julia -----------------------
# Installed beside the library, which the package searches in its own prefix.
install(DIRECTORY bindings/julia/PNPBS.jl DESTINATION "${data_dir}/julia")

# ------------------------------------------------------------------ Python ----------------------
install(
  DIRECTORY bindings/python/pnpbs
  DESTINATION "${data_dir}/python"
  PATTERN __pycache__ EXCLUDE)
