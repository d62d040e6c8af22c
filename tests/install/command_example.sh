#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests an installed example of the command by running its script with the installed command. Every
# number that the example checks must be right.
# usage: command_example.sh <settings> <name>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"
[ "$with_command" = ON ] || nothing_to_test "this build has no command"
[ "$with_geo" = 1 ] || nothing_to_test "$2 needs GDAL, and this build has none"
export OMP_NUM_THREADS=1
PATH=$prefix/$bindir:$PATH
run_and_compare sh "$prefix/$datadir/pnpbs/examples/command/$2/$2.sh" "$work"
