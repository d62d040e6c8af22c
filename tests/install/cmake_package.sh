#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests the targets and variables that find_package(pnpbs) defines, and its messages on errors.
# usage: cmake_package.sh <settings>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"
cases=0

# Configures a project with these languages (C, CXX, Fortran, separated by blanks) and these lines.
project() {
  cases=$((cases + 1))
  folder=$work/project_$cases
  mkdir "$folder"
  {
    echo "cmake_minimum_required(VERSION 3.22)"
    echo "project(asks LANGUAGES $1)"
    printf '%s\n' "$2"
  } > "$folder/CMakeLists.txt"
  "$cmake" -S "$folder" -B "$folder/build" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_C_COMPILER="$cc" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_Fortran_COMPILER="$fc" \
    > "$work/log" 2>&1
}

works() {
  say "works: $1: $2"
  project "$1" "$2" || { cat "$work/log"; fail "should work"; }
}

# Requires that a project fails. Arguments: languages, lines, and a part of the message. CMake's
# line breaks do not matter.
is_refused() {
  say "is refused: $1: $2"
  if project "$1" "$2"; then
    fail "should be refused"
  fi
  tr -s ' \n' '  ' < "$work/log" > "$work/message"
  grep -qF -e "$3" "$work/message" || { cat "$work/log"; fail "should say: $3"; }
}

# Prints CMake code that requires a condition.
require() { echo "if(NOT ($1))"; echo "message(FATAL_ERROR \"$2\")"; echo "endif()"; }

minor=${version%.*}
major=${version%%.*}
next="$major.$((${minor#*.} + 1))"

works C "find_package(pnpbs $minor REQUIRED)
$(require "pnpbs_VERSION VERSION_EQUAL $version AND TARGET pnpbs::pnpbs" "wrong version or no target")
$(require "NOT TARGET pnpbs::fortran AND NOT TARGET pnpbs::mpi" "targets that nobody asked for")
get_target_property(needs pnpbs::pnpbs INTERFACE_LINK_LIBRARIES)
$(require "NOT needs" "pnpbs::pnpbs brings others")"
works C "find_package(pnpbs $version EXACT REQUIRED)"
works C "find_package(pnpbs REQUIRED)
find_package(pnpbs REQUIRED)"
is_refused C "find_package(pnpbs $next REQUIRED)" "version: $version"
is_refused C "find_package(pnpbs $next REQUIRED)" "compatible with requested version \"$next\""
is_refused C "find_package(pnpbs $((major + 1)) REQUIRED)" "version: $version"
is_refused C "find_package(pnpbs REQUIRED COMPONENTS Pascal)" \
  "pnpbs has no component Pascal; there are Fortran, Geo, MPI and Static"
works C "find_package(pnpbs REQUIRED OPTIONAL_COMPONENTS Pascal)
$(require "NOT pnpbs_Pascal_FOUND AND pnpbs_FOUND" "an optional component is not optional")"

# ------------------------------------------------------------------ MPI -------------------------
uses_mpi="file(WRITE \"\${CMAKE_BINARY_DIR}/a.c\" \"#include <pnpbs/pnpbs_mpi.h>
int main(void) { return (int)sizeof(&pnpbs_context_create_mpi) == 0; }\")
add_executable(a \"\${CMAKE_BINARY_DIR}/a.c\")
target_link_libraries(a PRIVATE pnpbs::mpi)"
if [ "$with_mpi" = 1 ]; then
  for languages in C CXX "C CXX"; do
    works "$languages" "find_package(pnpbs REQUIRED COMPONENTS MPI)
$(require "pnpbs_MPI_FOUND AND TARGET pnpbs::mpi AND TARGET pnpbs::pnpbs" "no component MPI")
set(CMAKE_CXX_STANDARD 11)
$(case $languages in CXX) echo "$uses_mpi" | sed 's/a\.c/a.cpp/' ;; *) echo "$uses_mpi" ;; esac)"
    quietly "$cmake" --build "$folder/build"
  done
  works C "find_package(pnpbs REQUIRED COMPONENTS MPI)
find_package(pnpbs REQUIRED COMPONENTS MPI)"
  is_refused C "set(CMAKE_DISABLE_FIND_PACKAGE_MPI ON)
find_package(pnpbs REQUIRED COMPONENTS MPI)" "The component MPI found no MPI"
else
  is_refused C "find_package(pnpbs REQUIRED COMPONENTS MPI)" "was built without MPI"
fi

# Builds and runs the program of the last project, whose output is not compared with others.
build_and_run_alone() {
  quietly "$cmake" --build "$folder/build"
  rm -f "$work/check_lines_before"
  run_and_compare "$folder/build/a"
  rm -f "$work/check_lines_before"
}

# ------------------------------------------------------------------ shapes ----------------------
if [ "$with_geo" = 1 ]; then
  works C "find_package(pnpbs REQUIRED COMPONENTS Geo)
find_package(pnpbs REQUIRED COMPONENTS Geo)
file(WRITE \"\${CMAKE_BINARY_DIR}/a.c\" \"#include <pnpbs/pnpbs_geo.h>
#include <stdio.h>
int main(void) {
  printf(\\\"status: %d, expected 0\\\\n\\\", pnpbs_geo_destroy(NULL));
  return pnpbs_geo_build_info() == NULL;
}\")
add_executable(a \"\${CMAKE_BINARY_DIR}/a.c\")
target_link_libraries(a PRIVATE pnpbs::geo)"
  build_and_run_alone
else
  is_refused C "find_package(pnpbs REQUIRED COMPONENTS Geo)" "was built without GDAL"
fi

# ------------------------------------------------------------------ the static library ----------
if [ "$with_static" = ON ]; then
  works C "find_package(pnpbs REQUIRED COMPONENTS Static)
find_package(pnpbs REQUIRED COMPONENTS Static)
add_executable(a \"$prefix/$datadir/pnpbs/examples/c/smallest/smallest.c\")
target_link_libraries(a PRIVATE pnpbs::static m)"
  quietly "$cmake" --build "$folder/build"
  if readelf -d "$folder/build/a" | grep libpnpbs; then
    fail "the shared library was taken"
  fi
  OMP_NUM_THREADS=2 run_and_compare "$folder/build/a"
else
  is_refused C "find_package(pnpbs REQUIRED COMPONENTS Static)" \
    "This PNPBS was installed without its static library"
fi

# ------------------------------------------------------------------ Fortran ---------------------
is_refused C "find_package(pnpbs REQUIRED COMPONENTS Fortran)" \
  "The component Fortran needs a Fortran compiler: enable_language(Fortran) first."
works C "find_package(pnpbs REQUIRED OPTIONAL_COMPONENTS Fortran)
$(require "NOT pnpbs_Fortran_FOUND" "a module without a compiler")"
if [ -n "$fc" ]; then
  works Fortran "find_package(pnpbs $minor REQUIRED COMPONENTS Fortran)
$(require "pnpbs_Fortran_FOUND AND TARGET pnpbs::fortran" "no component Fortran")"
  is_refused Fortran "find_package(pnpbs REQUIRED COMPONENTS Fortran MPI)" \
    "$([ "$with_mpi" = 1 ] && echo "enable_language(C) or enable_language(CXX) first" || echo "was built without MPI")"
  if [ "$with_geo" = 1 ]; then
    works Fortran "find_package(pnpbs REQUIRED COMPONENTS Geo Fortran)
find_package(pnpbs REQUIRED COMPONENTS Fortran Geo)
file(WRITE \"\${CMAKE_BINARY_DIR}/a.f90\" \"program a
  use pnpbs_geo
  type(pnpbs_geo_shapes) :: shapes
  character(len=200) :: errmsg
  integer :: stat
  call shapes%read('nowhere.geojson', stat=stat, errmsg=errmsg)
  print '(a, i0, a)', 'status: ', stat, ', expected -8'
end program\")
add_executable(a \"\${CMAKE_BINARY_DIR}/a.f90\")
target_link_libraries(a PRIVATE pnpbs::geo_fortran)"
    build_and_run_alone
  fi
fi
