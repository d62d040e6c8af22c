# SPDX-License-Identifier: BSD-3-Clause
"""Tests interruptions, such as by Ctrl-C: exit code 130, and no complete, partial or temporary
file."""

import os
import pathlib
import signal
import subprocess
import time
import unittest

from command import INTERRUPTED, LAKE, CommandTest

# The run has two million nodes, which takes long enough to be interrupted in any stage.
LONG_RUN = ("--domain", LAKE, "--spacing", "0.2 + 0*x", "--set", "steps=100000",
            "--output", "a.vtu", "--output", "a.png", "--report", "a.json")


def cpu_seconds(process):
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Stopping(CommandTest):
    def signal_and_wait(self, process, *numbers):
        """Sends signals and waits for the end. Returns the output and the CPU seconds used after
        the signals. CPU time is used because the machine may be busy."""
        before = cpu_seconds(process)
        for number in numbers:
            os.kill(process.pid, number)
            time.sleep(0.05)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out, err = process.communicate()
        self.assertEqual(process.returncode, INTERRUPTED, err)
        self.assertIn(b"pnpbs: interrupted, nothing was written\n", err)
        return out, used.ru_utime + used.ru_stime - before

    def stop(self, number, after, *, times=1, most=60):
        process = self.start(*LONG_RUN)
        time.sleep(after)
        self.assertIsNone(process.poll(), "it should still be running")
        out, taken = self.signal_and_wait(process, *times * [number])
        self.assertLess(taken, most)
        self.assertEqual(out, b"")
        self.assertEqual(self.files(), ["square.poly"])

    def test_at_several_moments(self):
        for after in (0.3, 1.0, 3.0):
            with self.subTest(after):
                self.stop(signal.SIGINT, after)

    def test_terminate(self):
        self.stop(signal.SIGTERM, 0.6)

    def test_second_signal_ends_at_once(self):
        self.stop(signal.SIGINT, 0.6, times=2, most=2)

    def test_between_steps(self):
        # The spacing from the shape of a ball with 81 920 triangles takes longer than the limit
        # below.
        process = self.start("--domain", "ball(0,0,0,1)", "--spacing", "auto", "-o", "a.csv",
                             environment={"OMP_NUM_THREADS": "1"})
        time.sleep(1)
        _, taken = self.signal_and_wait(process, signal.SIGTERM)
        self.assertLess(taken, 7)
        self.assertEqual(self.files(), ["square.poly"])

    def test_while_reading_standard_input(self):
        process = self.start("--domain", "-", "--spacing", "1", "-o", "a.csv",
                             stdin=subprocess.PIPE)
        time.sleep(0.3)
        self.signal_and_wait(process, signal.SIGINT)
        self.assertEqual(self.files(), ["square.poly"])

    def test_while_writing(self):
        # A pipe that is not read stops the command in the middle of its output.
        process = self.start("--domain", self.square, "--spacing", "0.01", "-o", "a.csv",
                             "-o", "-", "--format", "csv")
        first = process.stdout.read(1)
        self.assertEqual(first, b"i")
        time.sleep(0.3)
        self.assertNotIn("a.csv", self.files())
        self.assertEqual(len(self.files()), 2)  # a.csv exists under a temporary name
        self.signal_and_wait(process, signal.SIGINT)
        self.assertEqual(self.files(), ["square.poly"])


if __name__ == "__main__":
    unittest.main()
