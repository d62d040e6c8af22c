# SPDX-License-Identifier: BSD-3-Clause
# Whether the Fortran module is built, and how our own Fortran is compiled.

if(NOT DEFINED PNPBS_BUILD_FORTRAN)
  set(build_fortran OFF)
  if(PROJECT_IS_TOP_LEVEL)
    include(CheckLanguage)
    check_language(Fortran)
    if(CMAKE_Fortran_COMPILER)
      set(build_fortran ON)
    endif()
  endif()
endif()
option(PNPBS_BUILD_FORTRAN "Build the Fortran module pnpbs" ${build_fortran})
if(NOT PNPBS_BUILD_FORTRAN)
  return()
endif()

enable_language(Fortran)
# Whose module files are installed: those of another major version may be unreadable.
string(REGEX MATCH "^[0-9]+" fortran_major "${CMAKE_Fortran_COMPILER_VERSION}")
set(PNPBS_FORTRAN_COMPILER "${CMAKE_Fortran_COMPILER_ID} ${fortran_major}")

# The language of the module and of its tests. Other compilers take their own defaults.
add_library(pnpbs_fortran_2003 INTERFACE)
if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
  set(fortran_flags -std=f2003 -fimplicit-none -Wall)
  if(PNPBS_WARNINGS_AS_ERRORS)
    list(APPEND fortran_flags -Werror)
  endif()
  target_compile_options(pnpbs_fortran_2003
                         INTERFACE "$<$<COMPILE_LANGUAGE:Fortran>:${fortran_flags}>")
endif()
