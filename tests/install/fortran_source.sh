#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests that the CMake package compiles the installed Fortran source if the project's compiler is
# not the one that built the module.
# usage: fortran_source.sh <settings>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"

# This copy of the package states that another compiler has built its module.
cp -r "$prefix" "$work/copy"
config=$work/copy/$libdir/cmake/pnpbs/pnpbsConfig.cmake
sed -i 's/set(pnpbs_fortran_built_by .*/set(pnpbs_fortran_built_by "Another 1")/' "$config"
grep -q 'Another 1' "$config"
prefix=$work/copy
build_with_cmake "$prefix/$datadir/pnpbs/examples/fortran/smallest" "$work/smallest" \
  -DCMAKE_Fortran_COMPILER="$fc"
[ -e "$work/smallest/pnpbs_fortran/pnpbs.mod" ] || fail "the module was not compiled"
run_and_compare "$work/smallest/smallest"

if [ "$with_geo" = 1 ]; then
  mkdir "$work/shapes"
  cat > "$work/shapes/CMakeLists.txt" << 'PROJECT'
cmake_minimum_required(VERSION 3.22)
project(shapes LANGUAGES Fortran)
find_package(pnpbs REQUIRED COMPONENTS Fortran Geo)
add_executable(shapes shapes.f90)
target_link_libraries(shapes PRIVATE pnpbs::geo_fortran)
PROJECT
  cat > "$work/shapes/shapes.f90" << 'PROGRAM'
program shapes
  use pnpbs_geo
  print '(a, i0, a)', 'place of GDAL in the versions: ', index(pnpbs_geo_build_info(), 'GDAL'), ', expected 1'
end program
PROGRAM
  build_with_cmake "$work/shapes" "$work/shapes_built" -DCMAKE_Fortran_COMPILER="$fc"
  [ -e "$work/shapes_built/pnpbs_fortran/pnpbs_geo.mod" ] || fail "the module was not compiled"
  rm -f "$work/check_lines_before"
  run_and_compare "$work/shapes_built/shapes"
fi
