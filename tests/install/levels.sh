#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests the libraries for levels of processors. The loader selects the best one that this machine
# supports, and so do Python and Julia. All of them place the same nodes.
# usage: levels.sh <settings>
# shellcheck disable=SC1090,SC1091,SC2154  # what settings.sh and common.sh define
set -eu
. "$1"
. "$scripts/common.sh"
unset PNPBS_LIBRARY
export OMP_NUM_THREADS=2
[ -n "$levels" ] || nothing_to_test "this build has one library for all processors"
[ "$with_command" = ON ] || nothing_to_test "this build has no command"
[ "$levels" = x86-64-v3 ] || nothing_to_test "written for x86-64-v3 alone, not for $levels"
/lib64/ld-linux-x86-64.so.2 --help | grep -q "x86-64-v3 (supported, searched)" ||
  nothing_to_test "this machine runs no x86-64-v3, or its loader knows no levels"

common=$prefix/$libdir/libpnpbs.so.$soversion
best=$prefix/$libdir/glibc-hwcaps/x86-64-v3/libpnpbs.so.$soversion
command=$prefix/$bindir/pnpbs

say "the same interface"
for library in "$common" "$best"; do
  nm -D --defined-only "$library" | cut -d ' ' -f 2- | sort > "$work/$(basename "$(dirname "$library")")"
done
cmp "$work/$(basename "$libdir")" "$work/x86-64-v3" || fail "the libraries export different names"

# Runs a command as on a processor without AVX2, as far as the loader can detect.
older() { GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2 "$@"; }

say "the one that the loader takes"
"$command" --version | grep "^build: $build_type, x86-64-v3$" || fail "not the library for x86-64-v3"
older "$command" --version | grep "^build: $build_type$" || fail "not the library for all processors"

say "the same nodes"
data=$prefix/$datadir/pnpbs/examples/data
for job in "$data/lake_victoria.poly 3+0.02*hypot(x,y)" "$data/bracket.stl 3"; do
  for run in "" older; do
    # The exit status 3 means that the step limit was reached and nodes were written.
    $run "$command" --quiet --domain "${job% *}" --spacing "${job##* }" \
      --output "$work/nodes$run.csv" || [ $? = 3 ]
  done
  [ "$(wc -l < "$work/nodes.csv")" -gt 1000 ] || fail "hardly any nodes: $job"
  cmp "$work/nodes.csv" "$work/nodesolder.csv" || fail "other nodes: $job"
done

if [ -n "$python" ] && "$python" -c 'import numpy' 2> /dev/null; then
  say "Python"
  PYTHONPATH=$prefix/$datadir/pnpbs/python "$python" -B -c "
import pnpbs
assert pnpbs.library_path() == '$best', pnpbs.library_path()"
fi
if [ -n "$julia" ]; then
  say "Julia"
  JULIA_LOAD_PATH="@stdlib:$prefix/$datadir/pnpbs/julia" JULIA_DEPOT_PATH="$work/depot" \
    "$julia" --startup-file=no --compiled-modules=no -O0 -e '
      using PNPBS
      found = PNPBS.LibPNPBS.library_path()
      found == ARGS[1] || error("found $found")' "$best"
fi
