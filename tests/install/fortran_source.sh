#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Where another compiler than ours asks for the Fortran module, the CMake package compiles the
# installed source.
# usage: fortran_source.sh <settings>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"

# A package that says another compiler has built it, beside the real one's files.
cp -r "$prefix" "$work/copy"
config=$work/copy/$libdir/cmake/pnpbs/pnpbsConfig.cmake
sed -i 's/set(pnpbs_fortran_built_by .*/set(pnpbs_fortran_built_by "Another 1")/' "$config"
grep -q 'Another 1' "$config"
prefix=$work/copy
build_with_cmake "$prefix/$datadir/pnpbs/examples/fortran/smallest" "$work/smallest" \
  -DCMAKE_Fortran_COMPILER="$fc"
[ -e "$work/smallest/pnpbs_fortran/pnpbs.mod" ] || fail "the module was not compiled"
run_and_compare "$work/smallest/smallest"
