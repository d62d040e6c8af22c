# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C and its kin: exit code 130, and no file, whole, half or temporary."""

import signal
import subprocess
import time
import unittest

from command import INTERRUPTED, LAKE, CommandTest

# Two million nodes: long enough to be interrupted anywhere.
LONG_RUN = ("--domain", LAKE, "--spacing", "0.2 + 0*x", "--set", "steps=100000",
            "--output", "a.vtu", "--output", "a.png", "--report", "a.json")


class Stopping(CommandTest):
    def stop(self, number, after, *, times=1, patience=60):
        process = self.start(*LONG_RUN)
        time.sleep(after)
        self.assertIsNone(process.poll(), "it should still be running")
        for _ in range(times):
            process.send_signal(number)
            time.sleep(0.05)
        try:
            out, err = process.communicate(timeout=patience)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
        self.assertEqual(process.returncode, INTERRUPTED, err)
        self.assertEqual(out, b"")
        self.assertEqual(self.files(), ["square.poly"])

    def test_at_several_moments(self):
        for after in (0.3, 1.0, 3.0):
            with self.subTest(after):
                self.stop(signal.SIGINT, after)

    def test_terminate(self):
        self.stop(signal.SIGTERM, 0.6)

    def test_second_signal_ends_at_once(self):
        self.stop(signal.SIGINT, 0.6, times=2, patience=2)

    def test_between_steps(self):
        # What the shape asks for in a ball of 81 920 triangles takes longer than the patience.
        process = self.start("--domain", "ball(0,0,0,1)", "--spacing", "auto", "-o", "a.csv",
                             environment={"OMP_NUM_THREADS": "1"})
        time.sleep(1)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=7), INTERRUPTED)
        process.communicate()
        self.assertEqual(self.files(), ["square.poly"])

    def test_while_reading_standard_input(self):
        process = self.start("--domain", "-", "--spacing", "1", "-o", "a.csv",
                             stdin=subprocess.PIPE)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=5), INTERRUPTED)
        process.communicate()
        self.assertEqual(self.files(), ["square.poly"])

    def test_while_writing(self):
        # A pipe that nobody empties holds the command in the middle of its output.
        process = self.start("--domain", self.square, "--spacing", "0.01", "-o", "a.csv",
                             "-o", "-", "--format", "csv")
        first = process.stdout.read(1)
        self.assertEqual(first, b"i")
        time.sleep(0.3)
        self.assertNotIn("a.csv", self.files())
        self.assertEqual(len(self.files()), 2)  # a.csv is there, under a temporary name
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=10), INTERRUPTED)
        process.communicate()
        self.assertEqual(self.files(), ["square.poly"])


if __name__ == "__main__":
    unittest.main()
