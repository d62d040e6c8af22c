#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests the flags that pkg-config prints. They contain nothing that users do not need.
# usage: pkg_config.sh <settings>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"

modules=pnpbs
[ -z "$fc" ] || modules="$modules pnpbs-fortran"
[ "$with_geo" != 1 ] || modules="$modules pnpbs-geo"
[ "$with_geo" != 1 ] || [ -z "$fc" ] || modules="$modules pnpbs-geo-fortran"
[ "$with_mpi" != 1 ] || modules="$modules pnpbs-mpi"

for module in $modules; do
  say "$module"
  pkg-config --validate "$module"
  [ "$(pkg-config --modversion "$module")" = "$version" ] || fail "version"
  # The folders must be in the tree at its new location.
  words=$(pkg-config --cflags-only-I --libs-only-L "$module")
  [ -n "$words" ] || fail "no folders"
  for word in $words; do
    folder=${word#-?}
    [ -d "$folder" ] || fail "no folder $folder"
    case $module:$(cd "$folder" && pwd -P) in
      pnpbs-mpi:* | *:"$(cd "$prefix" && pwd -P)"/*) ;;
      *) fail "$folder is not in the tree" ;;
    esac
  done
done

say "pnpbs alone brings one folder, where the loader shall look as well, and one library"
[ "$(pkg-config --libs-only-L pnpbs | wc -w)" = 1 ] || fail "$(pkg-config --libs-only-L pnpbs)"
[ "$(pkg-config --libs-only-l pnpbs | xargs)" = -lpnpbs ] || fail "$(pkg-config --libs-only-l pnpbs)"
[ "$(pkg-config --libs-only-other pnpbs | xargs)" = \
  "-Wl,-rpath,$(pkg-config --variable=libdir pnpbs)" ] || fail "$(pkg-config --libs-only-other pnpbs)"
[ "$(pkg-config --cflags pnpbs | wc -w)" = 1 ] || fail "$(pkg-config --cflags pnpbs)"
if pkg-config --exists 'pnpbs >= 99'; then
  fail "takes itself for version 99"
fi

if [ "$with_mpi" = 1 ]; then
  say "with pnpbs-mpi, a program on MPI needs no mpicc"
  cat > "$work/ranks.c" << 'PROGRAM'
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
int main(int argc, char **argv) {
  pnpbs_context context;
  int status, rank;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  status = pnpbs_context_create_mpi(MPI_COMM_WORLD, &context);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  if (rank == 0) printf("status: %d, expected 0\n", status);
  return 0;
}
PROGRAM
  # shellcheck disable=SC2046  # words on purpose
  "$cc" "$work/ranks.c" $(pkg-config --cflags --libs pnpbs-mpi) -o "$work/ranks"
  run_and_compare on_ranks 2 "$work/ranks"
fi
