#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tests that the hash of the nodes and the statistics of the elements are the same for any number of
# ranks and threads, any exchange interval and any partition. The sizes are small, and every pair of
# values of two parameters occurs at least once. tests/bench/invariance_grid.py runs the whole grid
# at any size.
# usage: invariance.sh PROGRAM MPIEXEC DATA THIN_HALO
#   THIN_HALO  folder of the library whose ghost layers are too thin
set -euo pipefail
program=$1 mpiexec=$2 data=$3 thin_halo=$4${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
failed=0

place() { # arguments: ranks, threads, arguments of the program
  local ranks=$1 threads=$2
  shift 2
  OMP_NUM_THREADS=$threads OMP_WAIT_POLICY=passive timeout 900 \
    "$mpiexec" --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -np "$ranks" "$program" "$@" < /dev/null
}
# Prints the value of a key in a line. Fails if the line has no such key: assigned to a variable,
# the failure ends the test.
field() {
  awk -v key="$2" '{ for (k = 1; k < NF; ++k) if ($k == key) { print $(k + 1); found = 1 } }
                   END { exit !found }' <<< "$1"
}

begin() { # case, factor of d, other options
  subject=("$@")
  expected=$(place 1 1 "$@")
  expected_hash=$(field "$expected" hash)
  expected_elements=$(field "$expected" elements)
  echo "$(basename "$1") ${*:2}: $expected"
}
compare() { # arguments: ranks, threads, exchange interval, seed
  local line hash elements
  line=$(place "$1" "$2" "${subject[@]}" "exchange_interval=$3" "metis_seed=$4")
  hash=$(field "$line" hash)
  elements=$(field "$line" elements)
  if [ "$hash" != "$expected_hash" ] || [ "$elements" != "$expected_elements" ]; then
    echo "DIFFERS at $1 ranks, $2 threads, exchange every $3, seed $4: $line"
    failed=1
  fi
}

require_at_least() { # least value, key in the line of the reference, message if it is smaller
  local count
  count=$(field "$expected" "$2")
  if ! [ "$count" -ge "$1" ]; then
    echo "$3: $expected"
    failed=1
  fi
}

# Four cases run on eight numbers of ranks. Intervals and seeds are two orthogonal Latin squares of
# order four over cases and ranks: sums and products of the field with four elements.
cases=("graded-square 8" "$data/great_lakes.poly 8" "uniform-square 8"
       "$data/lake_victoria.poly 10")
ranks=(1 2 3 4 5 7 8 16)
intervals=(1 2 4 8)
times_two=(0 2 3 1)
for c in 0 1 2 3; do
  # shellcheck disable=SC2086  # words on purpose
  begin ${cases[c]}
  for r in 0 1 2 3 4 5 6 7; do
    threads=$((1 + ((c ^ (r / 4)) & 1)))
    compare "${ranks[r]}" "$threads" "${intervals[c ^ (r % 4)]}" $((1 + (times_two[c] ^ (r % 4))))
  done
done

begin graded-square 8 method=paper
compare 2 2 4 1
compare 5 1 1 2
begin uniform-square 40 # about as many ranks as inner nodes
compare 16 1 4 1
# The vertices of these boundaries are far closer than d. Leaves are small compared with the
# bubbles, and nearly all nodes are boundary nodes.
begin "$data/lake_victoria.poly" 60
compare 3 1 8 1
compare 8 1 4 1
compare 16 1 2 2
begin "$data/great_lakes_islands.poly" 4
compare 8 1 4 1
# These options cause many events with many insertions and deletions.
begin graded-square 8 event_interval=3 population_tolerance=0 delete_above=6.3 insert_below=5.7 first_row=0
compare 4 1 2 1
compare 7 1 8 2
require_at_least 50 inserted "population control had little to do"
require_at_least 50 deleted "population control had little to do"
# Nodes are compressed at a jump of d after the last population event. The finish must delete some.
begin jump-square 1 steps=40 sweeps=0 growth_limit=0
compare 2 1 4 1
compare 3 2 1 2
compare 8 1 5 1
require_at_least 20 deleted "no crowd had to go at the end"
# The same jump has the default limit of the growth of d.
begin jump-square 1
compare 2 1 4 1
compare 3 2 1 2
compare 8 1 5 1
# Since d grows by a fifth of the distance, the first nodes are filled in cell by cell, and the
# population is calibrated by octaves of d.
begin steep-square 1
compare 2 1 4 1
compare 3 2 1 2
compare 8 1 5 1
compare 16 1 2 1
# The nodes hardly move. Many have four neighbours or fewer and are removed, and many triangles are
# bad.
begin graded-square 8 steps=0 levels=0 first_row=0
compare 2 1 4 1
compare 5 2 1 2
compare 8 1 5 1
compare 16 1 2 1
require_at_least 20 deleted "no surplus node had to go"
# These cases sweep nodes to the centroids of their cells, in more than one block of sweeps on the
# same stars. In the second one the nodes are far from rest and have many obtuse triangles.
begin graded-square 8 centroidal_sweeps=12
compare 2 1 4 1
compare 3 2 1 2
compare 5 1 5 1
compare 16 1 2 1
begin "$data/great_lakes.poly" 8 steps=0 levels=0 centroidal_sweeps=7 obtuse_rounds=20
compare 2 1 4 1
compare 5 2 1 2
compare 8 1 5 1
# The nodes are far from rest and have many defects, so many repairs are tried, and they often
# exclude each other.
begin graded-square 8 steps=0 levels=0 topology_repairs=6 sweeps=0 smoothing_rounds=0
compare 2 1 4 1
compare 3 2 1 2
compare 5 1 5 1
compare 16 1 2 1
require_at_least 10 inserted "no defect asked for one more node"
require_at_least 20 deleted "no defect asked for one node less"
# The finish replaces the first row of nodes at curved boundaries, and on both sides of inner
# curves. Nothing else inserts or deletes nodes.
begin ring 0.5 steps=0 levels=0
compare 2 1 4 1
compare 3 2 1 2
compare 5 1 2 3
compare 8 1 8 1
require_at_least 100 inserted "the first row had few new nodes"
require_at_least 100 deleted "the first row displaced few nodes"
# The finish splits triangles with all nodes on the boundary. Nothing else inserts nodes.
begin "$data/great_lakes.poly" 8 steps=0 levels=0 first_row=0 split_elements_on_boundary=1
compare 2 1 4 1
compare 3 2 1 2
compare 8 1 5 1
require_at_least 50 inserted "few triangles had all nodes on the boundary"
begin ring 1 levels=0 effort=best
compare 4 1 1 1
compare 16 1 4 2
begin "$data/great_lakes.poly" 8 effort=best
compare 3 1 4 1
compare 8 2 2 2

# This test can fail: no rank has half of the nodes, and ghost layers that are too thin give other
# nodes.
line=$(place 8 1 graded-square 2 exchange_interval=2 sweeps=0)
held=$(field "$line" held)
nodes=$(field "$line" nodes)
if ! [ $((2 * held)) -lt "$nodes" ]; then
  echo "some rank holds half of the nodes: $line"
  failed=1
fi
thin=$(LD_LIBRARY_PATH=$thin_halo place 8 1 graded-square 2 exchange_interval=8 sweeps=0)
hash=$(field "$line" hash)
thin_hash=$(field "$thin" hash)
if [ "$hash" = "$thin_hash" ]; then
  echo "a halo too thin changed nothing: $thin"
  failed=1
fi
exit $failed
