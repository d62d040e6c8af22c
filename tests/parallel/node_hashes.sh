#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Are the nodes of node_hashes those of the recorded file, to the bit, on one and more ranks and
# threads? For changes of the code that are to change no result; not a test, as another version of
# a mathematical library may have other nodes, and so may a better method.
# usage: node_hashes.sh PROGRAM DATA RECORD [--record]        (--record: writes the file)
set -euo pipefail
program=$1 data=$2 record=$3
place() { # ranks, threads
  OMP_NUM_THREADS=$2 OMP_WAIT_POLICY=passive mpirun --oversubscribe --bind-to none \
    --mca mpi_yield_when_idle 1 -np "$1" "$program" "$data" < /dev/null
}

if [ "${4:-}" = --record ]; then
  place 1 1 > "$record"
  echo "recorded: $(wc -l < "$record") hashes"
fi
failed=0
for setting in "1 1" "1 2" "3 1" "8 1"; do
  read -r ranks threads <<< "$setting"
  if differing=$(diff "$record" <(place "$ranks" "$threads")); then
    echo "$ranks ranks, $threads threads: $(wc -l < "$record") hashes as recorded"
  else
    echo "$ranks ranks, $threads threads DIFFER (< recorded, > now):"
    echo "$differing"
    failed=1
  fi
done
exit $failed
