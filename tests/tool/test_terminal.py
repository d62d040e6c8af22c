# SPDX-License-Identifier: BSD-3-Clause
"""Tests the progress bar: it appears on terminals only."""

import fcntl
import os
import pty
import struct
import subprocess
import termios
import unittest

from command import LAKE, CommandTest

RUN = ("--domain", LAKE, "--spacing", "2", "--threads", "1", "--output", "a.csv")


class Terminal(CommandTest):
    def on_terminal(self, *arguments, columns=100, environment=None, stdout=subprocess.PIPE):
        """Runs the command with standard error on a terminal. Returns the text that appears there.
        """
        ours, theirs = pty.openpty()
        fcntl.ioctl(ours, termios.TIOCSWINSZ, struct.pack("HHHH", 25, columns, 0, 0))
        process = self.start(*arguments, stderr=theirs, stdout=theirs if stdout is None else stdout,
                             environment={"TERM": "xterm", **(environment or {})})
        os.close(theirs)
        shown = b""
        while True:
            try:
                part = os.read(ours, 65536)
            except OSError:  # on Linux, the other side is closed
                break
            if not part:
                break
            shown += part
        os.close(ours)
        process.communicate()
        self.code = process.returncode
        return shown.decode()

    def test_bar(self):
        shown = self.on_terminal(*RUN)
        self.assertEqual(self.code, 0)
        lines = [line for line in shown.split("\r") if " nodes, speed " in line]
        self.assertGreater(len(lines), 0)
        for line in lines:
            self.assertRegex(line, r"^ *\d+ % (\[=*>? *\] )?step \d+, [\d ]+ nodes, speed ")
            self.assertLess(len(line.replace("\033[K", "")), 100)
        self.assertTrue(any("[" in line for line in lines))
        # Warnings remain on the screen, and the bar is removed.
        self.assertTrue(shown.endswith("\r\033[K"))

    def test_narrow_terminal(self):
        for line in self.on_terminal(*RUN, columns=30).split("\r"):
            if "warning" not in line:
                self.assertLess(len(line.replace("\033[K", "")), 30)

    def test_quiet(self):
        self.assertEqual(self.on_terminal(*RUN, "--quiet"), "")

    def test_dumb_terminal(self):
        self.assertNotIn("\033", self.on_terminal(*RUN, environment={"TERM": "dumb"}))

    def test_pipe(self):
        _, err = self.run_command(*RUN)
        for line in err.decode().splitlines():
            self.assertTrue(line.startswith("pnpbs: warning: "), line)

    def test_no_binary_on_the_terminal(self):
        shown = self.on_terminal("--domain", self.square, "--spacing", "0.1", "--output", "-",
                                 "--format", "png", stdout=None)
        self.assertEqual(self.code, 2)
        self.assertNotIn("IHDR", shown)


if __name__ == "__main__":
    unittest.main()
