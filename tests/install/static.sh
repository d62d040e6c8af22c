#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests programs that link the static library with the flags of pkg-config --static: one with all
# libraries static, if static versions of all required libraries exist, and one with only PNPBS
# static.
# usage: static.sh <settings>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"
if [ "$with_static" != ON ]; then
  [ "$(pkg-config --static --libs pnpbs)" = "$(pkg-config --libs pnpbs)" ] ||
    fail "pnpbs.pc tells how to link a static library that is not there"
  nothing_to_test "this build installs no static library"
fi
export OMP_NUM_THREADS=2
program=$prefix/$datadir/pnpbs/examples/c/smallest/smallest.c
flags=$(pkg-config --static --cflags pnpbs)

say "PNPBS static"
# The static library is copied, because the compiler prefers a shared library in the same folder.
mkdir "$work/lib"
cp "$prefix/$libdir/libpnpbs.a" "$work/lib"
# shellcheck disable=SC2046,SC2086  # words on purpose
"$cc" -std=c99 $flags "$program" -o "$work/smallest" -L "$work/lib" \
  $(pkg-config --static --libs-only-l pnpbs) $(pkg-config --static --libs-only-other pnpbs)
if readelf -d "$work/smallest" | grep libpnpbs; then
  fail "the shared library was taken"
fi
if [ "$kokkos_is_shared" = TRUE ]; then # pkg-config does not provide its folder to the loader
  export LD_LIBRARY_PATH="$kokkos_folder${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
fi
run_and_compare "$work/smallest"

if [ "$with_mpi" = 0 ] && [ "$kokkos_is_shared" = FALSE ]; then
  say "all static"
  # shellcheck disable=SC2046,SC2086  # words on purpose
  "$cc" -static -std=c99 $flags "$program" -o "$work/all_static" $(pkg-config --static --libs pnpbs)
  if readelf -d "$work/all_static" | grep NEEDED; then
    fail "not all static"
  fi
  run_and_compare "$work/all_static"
fi
