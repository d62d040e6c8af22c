# SPDX-License-Identifier: BSD-3-Clause
"""Tests that a failure or an interruption of one rank under mpirun ends all ranks and leaves no
file."""

import os
import signal
import time
import unittest

from command import COMMAND, DONE, FAILED, INTERRUPTED, LAKE
from ranks import RanksTest, end_soon, errors


class Failing(RanksTest):
    ASK = ("--domain", LAKE, "--spacing", "4", "--steps", "12", "--set", "sweeps=0")

    def test_no_such_folder(self):
        self.assertIn("nowhere", self.refuse_ranks(3, *self.ASK, "-o", "nowhere/a.vtu"))

    def test_full_device(self):
        message = self.refuse_ranks(3, *self.ASK, "-o", "a.vtu", "-o", "/dev/full", "--format",
                                    "csv", code=FAILED)
        self.assertIn("/dev/full", message)
        self.assertIn("/dev/full", self.refuse_ranks(2, *self.ASK, "-o", "a.vtu", "--report",
                                                     "/dev/full", code=FAILED))

    def test_disk_full_for_one_rank(self):
        (self.folder / "a.csv").write_text("old")
        # The limit is in KiB. MPI must still be able to create its own files of 4 MiB. Rank 1
        # writes the middle part of 14 MB.
        limited = ("bash", "-c", "test $OMPI_COMM_WORLD_RANK != 1 || ulimit -f 5000; "
                   'exec "$0" "$@"', COMMAND)
        message = self.refuse_ranks(3, "--domain", LAKE, "--spacing", "0.6", "--steps", "12",
                                    "--set", "sweeps=0", "-o", "a.csv", "-o", "b.pvtu",
                                    code=FAILED, command=limited)
        self.assertIn("rank 1: cannot write 'a.csv'", message)
        self.assertEqual((self.folder / "a.csv").read_text(), "old")


class Interrupting(RanksTest):
    ASK = ("--domain", LAKE, "--spacing", "1 + 0*x", "--set", "steps=100000",
           "--set", "tolerance_mean=1e-9", "-o", "a.vtu", "-o", "a.pvtu", "-o", "a.png")

    def test_one_rank(self):
        process = self.start_ranks(3, *self.ASK)
        ranks = self.ranks_of(process, 3)
        time.sleep(1.5)
        os.kill(ranks[1], signal.SIGINT)
        _, err = process.communicate(timeout=300)
        self.assertEqual(process.returncode, INTERRUPTED, err)
        self.assertEqual(len(errors(err.decode())), 1, err)
        self.assertEqual(self.files(), ["square.poly"])

    def test_mpirun(self):
        process = self.start_ranks(2, *self.ASK)
        ranks = self.ranks_of(process, 2)
        time.sleep(1.5)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=300)
        self.assertNotEqual(process.returncode, DONE)
        self.assertEqual(self.files(), ["square.poly"])
        self.assertTrue(end_soon(ranks))


if __name__ == "__main__":
    unittest.main()
