#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests that a host program with a METIS of its own gets the same nodes as one without, in one
# process and on several ranks.
# usage: host_metis.sh <mpiexec> <nm> <host with METIS> <host without>
set -eu
mpiexec=$1 nm=$2 with=$3 without=$4
export OMP_NUM_THREADS=1

# The host's functions must be visible to all loaded libraries, or the test is pointless.
"$nm" -D --defined-only "$with" | grep -q ' T METIS_PartGraphKway$'
"$nm" -D --defined-only "$with" | grep -q ' T METIS_PartGraphRecursive$'

on_ranks() {
  ranks=$1
  shift
  "$mpiexec" --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -np "$ranks" "$@" < /dev/null
}

expected=$("$without" serial < /dev/null)
echo "without a METIS of the host's: $expected"
[ -n "$expected" ]
wrong=0
compare() { # arguments: label, output
  echo "$1: $2"
  [ "$2" = "$expected" ] || wrong=1
}
# The output is assigned first, so that a host that fails after its output ends the test.
found=$("$with" serial < /dev/null)
compare "with one, serial" "$found"
# On more than 32 ranks the library would call the other METIS function, which comes from the same
# library and is loaded only once.
for ranks in 2 3; do
  found=$(on_ranks $ranks "$with")
  compare "with one, $ranks ranks" "$found"
done
exit $wrong
