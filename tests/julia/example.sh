#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests an example from the installed copy, in one process and on several ranks. The example checks
# itself by the lines that it prints. It prints the same on any number of ranks, and all ranks
# together write every triangle or tetrahedron once.
# usage: example.sh <build folder> <cmake> <rules> <example> '<numbers of ranks, 0 for no MPI>'
#                   <mpiexec, or ''> <julia> [its options]
set -eu
build=$1 cmake=$2 rules=$3 example=$4 rank_counts=$5 mpiexec=$6
shift 6
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset DESTDIR PNPBS_LIBRARY
"$cmake" --install "$build" --prefix "$work/copy" > "$work/install.log"
packages=$work/copy/share/pnpbs/julia
script=$work/copy/share/pnpbs/examples/julia/$example/$example.jl
export JULIA_DEPOT_PATH="$work/depot" OMP_NUM_THREADS=1

# start <ranks> <julia and its options>
# Runs the example. The stand-in replaces MPI.jl.
start() {
  ranks=$1
  shift
  if [ "$ranks" = 0 ]; then
    JULIA_LOAD_PATH="@stdlib:$packages" "$@" "$script" "$work/pieces" < /dev/null
  else
    JULIA_LOAD_PATH="@stdlib:$packages:$packages/PNPBS.jl/test/stand_in" \
      "$mpiexec" --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -np "$ranks" \
      "$@" "$script" "$work/pieces" < /dev/null
  fi
}

for ranks in $rank_counts; do
  echo "== $example, ranks: $ranks"
  rm -rf "$work/pieces"
  mkdir "$work/pieces"
  start "$ranks" "$@" > "$work/output"
  cat "$work/output"
  awk -f "$rules" "$work/output"
  if [ "$example" != smallest ]; then
    written=$(find "$work/pieces" -name "${example}_*.vtk" | wc -l)
    [ "$written" -eq "$((ranks > 0 ? ranks : 1))" ] || { echo "$written pieces written"; exit 1; }
    awk '$1 == "CELLS" { n += $2 } END { print "elements in the pieces: " n; exit !n }' \
      "$work"/pieces/*.vtk >> "$work/output"
  fi
  [ -e "$work/first" ] || cp "$work/output" "$work/first"
  cmp "$work/first" "$work/output"
done
