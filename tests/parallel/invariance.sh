#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The promise: one hash for any number of ranks and threads, any exchange interval, any partition.
# The configurations cover the grid pairwise. usage: invariance.sh PROGRAM MPIEXEC DATA
set -euo pipefail
program=$1 mpiexec=$2 data=$3
failed=0

place() { # ranks, threads, arguments of the program
  local ranks=$1 threads=$2
  shift 2
  OMP_NUM_THREADS=$threads OMP_WAIT_POLICY=passive timeout 120 \
    "$mpiexec" --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -np "$ranks" "$program" "$@" < /dev/null
}
field() { awk -v key="$2" '{ for (k = 1; k < NF; ++k) if ($k == key) print $(k + 1) }' <<< "$1"; }

# case, scale of d, other options
compare() {
  local name=$1 scale=$2
  shift 2
  local expected line ranks threads interval seed
  expected=$(place 1 1 "$name" "$scale" "$@")
  echo "$(basename "$name") $scale $*: $expected"
  while read -r ranks threads interval seed; do
    line=$(place "$ranks" "$threads" "$name" "$scale" "$@" "exchange_interval=$interval" \
      "metis_seed=$seed")
    if [ "$(field "$line" hash)" != "$(field "$expected" hash)" ]; then
      echo "DIFFERS at $ranks ranks, $threads threads, exchange every $interval, seed $seed: $line"
      failed=1
    fi
  done
}

configurations='1 2 4 1
2 1 1 2
2 2 8 3
3 1 4 4
4 2 2 1
5 1 8 2
7 1 1 3
8 1 4 1
16 1 2 4'
few='2 1 4 1
3 2 2 2
8 1 8 3'
compare graded-square 4 <<< "$configurations"
compare "$data/great_lakes_islands.poly" 5 <<< "$configurations"
compare uniform-square 4 <<< "$few"
compare "$data/lake_victoria.poly" 4 <<< "$few"
compare graded-square 6 method=paper <<< "$few"
compare uniform-square 40 <<< '16 1 4 1' # about as many ranks as nodes inside

# It can fail: no rank sees half of the nodes, and ghost layers too thin give another set.
line=$(place 8 1 graded-square 2 exchange_interval=2 sweeps=0)
if [ $((2 * $(field "$line" held))) -ge "$(field "$line" nodes)" ]; then
  echo "some rank holds half of the nodes: $line"
  failed=1
fi
thin=$(place 8 1 graded-square 2 exchange_interval=8 sweeps=0 halo_deficit=3)
if [ "$(field "$line" hash)" = "$(field "$thin" hash)" ]; then
  echo "a halo too thin changed nothing: $thin"
  failed=1
fi
exit $failed
