#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tests in space that the hash of the nodes and that of the statistics of the elements are the same
# for any number of ranks and threads, any exchange interval and any partition. node_hashes.sh runs
# all cases of the program on more ranks.
# usage: volume_invariance.sh PROGRAM MPIEXEC DATA THIN_HALO
#   THIN_HALO  folder of the library whose ghost layers are too thin
set -euo pipefail
program=$1 mpiexec=$2 data=$3 thin_halo=$4${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
failed=0

place() { # arguments: ranks, threads, case, options
  local ranks=$1 threads=$2
  shift 2
  OMP_NUM_THREADS=$threads OMP_WAIT_POLICY=passive timeout 900 \
    "$mpiexec" --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -np "$ranks" \
    "$program" "$data" "$@" < /dev/null
}
require_output() { # the program prints nothing for an unknown case
  [ -n "$expected" ] || { echo "$subject: no output"; exit 1; }
}
compare() { # arguments: ranks, threads, options
  local line
  line=$(place "$1" "$2" "$subject" "${@:3}")
  if [ "$line" != "$expected" ]; then
    printf 'DIFFERS at %s ranks, %s threads, %s:\n%s\n' "$1" "$2" "${*:3}" "$line"
    failed=1
  fi
}

for subject in box-graded globe ring-graded two-halves kleopatra-graded slotted adapt given-nodes \
  by-steps small-angles surface-halves surface-terrain; do
  expected=$(place 1 1 "$subject")
  require_output
  echo "$expected"
  compare 1 2 exchange_interval=1
  compare 5 1 exchange_interval=5 metis_seed=7
done

# This test can fail: ghost layers that are too thin give other nodes.
subject=box-graded
expected=$(place 1 1 "$subject")
require_output
thin=$(LD_LIBRARY_PATH=$thin_halo place 8 1 "$subject" exchange_interval=5)
if [ "$thin" = "$expected" ]; then
  echo "a halo too thin changed nothing"
  failed=1
fi
exit $failed
