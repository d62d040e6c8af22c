#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests that each installed header compiles alone, in C99 and in C++11. pnpbs.h, which does not need
# MPI, must also compile in C89 and C++98.
# usage: headers.sh <settings>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"

# These definitions exclude MPI's old C++ classes, whose headers cause warnings.
no_mpi_classes="-DOMPI_SKIP_MPICXX -DMPICH_SKIP_MPICXX"
for header in "$prefix/$includedir"/pnpbs/*.h; do
  module=pnpbs
  case $header in
    *pnpbs_mpi.h)
      [ "$with_mpi" = 1 ] || continue
      module=pnpbs-mpi
      ;;
  esac
  say "$(basename "$header")"
  flags=$(pkg-config --cflags $module)
  echo "#include <pnpbs/$(basename "$header")>" > "$work/header.c"
  # shellcheck disable=SC2086  # words on purpose
  "$cc" -std=c99 -Wall -Wextra -pedantic-errors -Werror $flags -fsyntax-only "$work/header.c"
  # shellcheck disable=SC2086
  "$cxx" -std=c++11 -Wall -Wextra -pedantic-errors -Werror $flags $no_mpi_classes -fsyntax-only \
    -x c++ "$work/header.c"
  [ $module = pnpbs ] || continue
  # shellcheck disable=SC2086
  "$cc" -std=c89 -Wall -Wextra -pedantic -Werror $flags -fsyntax-only "$work/header.c"
  # shellcheck disable=SC2086
  "$cxx" -std=c++98 -Wall -Wextra -pedantic -Werror $flags -fsyntax-only -x c++ "$work/header.c"
done
