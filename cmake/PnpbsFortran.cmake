# SPDX-License-Identifier: BSD-3-Clause
# Decides whether the Fortran modules are built, and sets how the project's Fortran is compiled.

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
# The compiler of the installed module files, which another major version may be unable to read.
string(REGEX MATCH "^[0-9]+" fortran_major "${CMAKE_Fortran_COMPILER_VERSION}")
set(PNPBS_FORTRAN_COMPILER "${CMAKE_Fortran_COMPILER_ID} ${fortran_major}")

# The language standard and warnings of the modules and their tests. Other compilers use their
# defaults.
add_library(pnpbs_fortran_2003 INTERFACE)
if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
  set(fortran_flags -std=f2003 -fimplicit-none -Wall)
  if(PNPBS_WARNINGS_AS_ERRORS)
    list(APPEND fortran_flags -Werror)
  endif()
  target_compile_options(pnpbs_fortran_2003
                         INTERFACE "$<$<COMPILE_LANGUAGE:Fortran>:${fortran_flags}>")
endif()
