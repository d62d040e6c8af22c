#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that threads sleep while they wait for each other: after a short time, or at once if there
are more threads than cores."""

import os
import pathlib
import subprocess
import unittest

from command import COMMAND

CORES = len(os.sched_getaffinity(0))


def wait_policy(*arguments, **variables):
    """Returns the wait policy in the environment of the command, while it waits for a domain on
    standard input."""
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("OMP_", "GOMP_", "OMPI_", "KOKKOS_"))}
    process = subprocess.Popen([COMMAND, "--domain", "-", "--spacing", "1", *arguments],
                               stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, env={**environment, **variables})
    try:
        process.stdin.write(20000 * b"# nothing\n")  # more than a pipe can hold
        process.stdin.flush()
        found = pathlib.Path(f"/proc/{process.pid}/environ").read_bytes().split(b"\0")
    finally:
        process.stdin.close()
        process.wait()
    return [one.decode() for one in found if one.startswith((b"OMP_WAIT_POLICY=", b"GOMP_SPINCOUNT="))]


class WaitingThreads(unittest.TestCase):
    def test_more_than_cores(self):
        self.assertEqual(wait_policy(OMP_NUM_THREADS=str(CORES + 1)), ["OMP_WAIT_POLICY=passive"])
        self.assertEqual(wait_policy("--threads", str(CORES + 1)), ["OMP_WAIT_POLICY=passive"])

    def test_of_all_ranks_here(self):
        two = {"OMP_NUM_THREADS": "2", "PNPBS_MPI": "0"}
        self.assertEqual(wait_policy(**two, OMPI_COMM_WORLD_LOCAL_SIZE=str(CORES)),
                         ["OMP_WAIT_POLICY=passive"])

    @unittest.skipIf(CORES < 2, "one core")
    def test_enough_cores(self):
        self.assertEqual(wait_policy(OMP_NUM_THREADS=str(CORES)), ["GOMP_SPINCOUNT=1000"])
        self.assertEqual(wait_policy(), ["GOMP_SPINCOUNT=1000"])
        self.assertEqual(wait_policy(OMPI_COMM_WORLD_LOCAL_SIZE=str(CORES), PNPBS_MPI="0"), [])

    def test_one_thread(self):
        self.assertEqual(wait_policy("--threads", "1"), [])

    def test_what_is_set_stays(self):
        self.assertEqual(wait_policy(OMP_NUM_THREADS=str(CORES + 1), OMP_WAIT_POLICY="active"),
                         ["OMP_WAIT_POLICY=active"])
        self.assertEqual(wait_policy(GOMP_SPINCOUNT="7"), ["GOMP_SPINCOUNT=7"])


if __name__ == "__main__":
    unittest.main()
