#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tests that the adaptive sequence of adapt_on_ranks has the same nodes after every stage, for any
# number of ranks, any partition and any exchange interval.
# usage: adapting.sh PROGRAM MPIEXEC
set -euo pipefail
program=$1 mpiexec=$2
failed=0

adapt() { # arguments: ranks, threads, arguments of the program
  local ranks=$1 threads=$2
  shift 2
  OMP_NUM_THREADS=$threads OMP_WAIT_POLICY=passive timeout 900 \
    "$mpiexec" --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -np "$ranks" "$program" "$@" < /dev/null
}

expected=$(adapt 1 1)
[ -n "$expected" ] || { echo "no stages"; exit 1; }
echo "$expected"
while read -r ranks threads interval seed; do
  stages=$(adapt "$ranks" "$threads" "exchange_interval=$interval" "metis_seed=$seed")
  if [ "$stages" != "$expected" ]; then
    echo "DIFFERS at $ranks ranks, $threads threads, exchange every $interval, seed $seed:"
    diff <(echo "$expected") <(echo "$stages") || true
    failed=1
  fi
done << 'END'
2 2 5 1
3 1 2 2
5 1 4 3
8 1 5 4
END
exit $failed
