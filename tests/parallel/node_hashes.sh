#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tests that the nodes of all cases of node_hashes, or of volume_hashes, are the same to the bit on
# several numbers of ranks and threads, and that the comparison detects ghost layers that are too
# thin. It also reports whether the nodes are those of the recorded file, which a change of the code
# that does not change results must keep. Another mathematical library or instruction set may give
# other nodes, so a difference from the record is a failure only with --recorded.
# usage: node_hashes.sh PROGRAM MPIEXEC DATA RECORD THIN_HALO [--recorded | --record]
#   THIN_HALO   folder of the library whose ghost layers are too thin
#   --recorded  fails if the nodes differ from the recorded ones
#   --record    writes the record
set -euo pipefail
program=$1 mpiexec=$2 data=$3 record=$4 thin_halo=$5 option=${6:-}
export OMP_WAIT_POLICY=passive
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0

place() { # arguments: ranks, threads
  OMP_NUM_THREADS=$2 "$mpiexec" --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -np "$1" \
    "$program" "$data" < /dev/null
}

place 1 1 > "$folder/expected"
if [ "$option" = --record ]; then cp "$folder/expected" "$record"; fi
if ! diff <(cut -d ' ' -f 1 "$record") <(cut -d ' ' -f 1 "$folder/expected"); then
  echo "the cases are not those of $record"
  exit 1
fi
cases=$(wc -l < "$record")
if diff "$record" "$folder/expected" > "$folder/differing"; then
  echo "1 rank, 1 thread: $cases hashes as recorded"
else
  echo "1 rank, 1 thread: other hashes than recorded (< recorded, > now):"
  cat "$folder/differing"
  if [ "$option" = --recorded ]; then failed=1; fi
fi

for setting in "1 2" "3 1" "8 1"; do
  read -r ranks threads <<< "$setting"
  place "$ranks" "$threads" > "$folder/found"
  if diff "$folder/expected" "$folder/found" > "$folder/differing"; then
    echo "$ranks ranks, $threads threads: $cases hashes as on one"
  else
    echo "$ranks ranks, $threads threads DIFFER (< one rank, > now):"
    cat "$folder/differing"
    failed=1
  fi
done

LD_LIBRARY_PATH=$thin_halo${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} place 8 1 > "$folder/thin" || true
if [ "$(wc -l < "$folder/thin")" -ne "$cases" ]; then
  echo "the library with ghost layers too thin did not run"
  failed=1
elif cmp -s "$folder/expected" "$folder/thin"; then
  echo "ghost layers too thin changed nothing"
  failed=1
fi
exit $failed
