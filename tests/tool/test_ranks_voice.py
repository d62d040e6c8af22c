# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the command under mpirun prints each message once and has one exit code."""

import unittest

from command import COMMAND, DONE, FAILED, LAKE, NOT_CONVERGED
from ranks import RanksTest


class OneVoice(RanksTest):
    def test_help(self):
        self.assertEqual(self.run_ranks(3, "--help")[0], self.run_command("--help")[0])

    def test_usage(self):
        self.assertIn("--xyz", self.refuse_ranks(3, "--xyz"))

    def test_bad_domain(self):
        self.square.write_text("4 2 0 0\n1 0 zero\n")
        message = self.refuse_ranks(2, "--domain", self.square, "--spacing", "1", "-o", "a.csv")
        self.assertIn("square.poly:2", message)

    def test_input_that_one_rank_cannot_read(self):
        one_elsewhere = ("bash", "-c", 'test $OMPI_COMM_WORLD_RANK != 1 || cd elsewhere; '
                         'exec "$0" "$@"', COMMAND)
        (self.folder / "elsewhere").mkdir()
        message = self.refuse_ranks(3, "--domain", "square.poly", "--spacing", "0.1",
                                    "-o", self.folder / "a.csv", command=one_elsewhere)
        self.assertIn("rank 1", message)

    def test_bad_option(self):
        ask = ("--domain", self.square, "--spacing", "0.1", "-o", "a.csv", "--set", "steps=x")
        self.assertIn("steps", self.refuse_ranks(2, *ask))

    def test_dry_run(self):
        out, _ = self.run_ranks(2, "--domain", self.square, "--spacing", "0.02", "--dry-run",
                                "-o", "a.csv")
        self.assertEqual(len(out.splitlines()), 3)
        self.assertIn(b"processes", out)
        self.assertEqual(self.files(), ["square.poly"])

    def test_not_converged(self):
        out, _ = self.run_ranks(2, "--domain", self.square, "--spacing", "0.1", "--steps", "1",
                                "-o", "a.csv", code=NOT_CONVERGED)
        self.assertEqual(len(out.splitlines()), 7)
        self.assertIn("a.csv", self.files())

    def test_warnings(self):
        _, err = self.run_ranks(2, "--domain", LAKE, "--spacing", "30")
        _, alone = self.run_command("--domain", LAKE, "--spacing", "30")
        self.assertEqual(err, alone.decode())

    def test_progress(self):
        ask = ("--domain", LAKE, "--spacing", "2", "--progress")
        err = self.run_ranks(2, *ask)[1]
        self.assertIn(" nodes, speed ", err)
        self.assertEqual(err.count("laying the first nodes"), 1)

    def test_another_launcher(self):
        message = self.refuse("--domain", self.square, "--spacing", "0.1", code=FAILED,
                              environment={"PMI_SIZE": "4", "PMI_RANK": "0"})
        self.assertIn("mpirun", message)

    def test_alone_there_is_no_mpi(self):
        # This variable prevents MPI from starting. The command alone must not start it.
        broken = {"OMPI_MCA_pml": "none_of_these"}
        self.place(environment=broken)
        process = self.start("--help", environment={"PNPBS_MPI": "1", **broken})
        process.communicate()
        self.assertNotEqual(process.returncode, DONE)


if __name__ == "__main__":
    unittest.main()
