#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests that a host program with a METIS of its own gets the same nodes as one without, in one
# process and on ranks.
# usage: host_metis.sh <mpiexec> <nm> <host with METIS> <host without>
set -eu
mpiexec=$1 nm=$2 with=$3 without=$4
export OMP_NUM_THREADS=1

# The host must export the names of METIS, otherwise the test would be void.
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
compare() { # description, output
  echo "$1: $2"
  [ "$2" = "$expected" ] || wrong=1
}
# The output is assigned first, so that a host that fails after its output ends the test.
found=$("$with" serial < /dev/null)
compare "with one, serial" "$found"
# More than 32 ranks would use the other partitioning function of the same library, which is opened
# in the same way.
for ranks in 2 3; do
  found=$(on_ranks $ranks "$with")
  compare "with one, $ranks ranks" "$found"
done
exit $wrong
