# SPDX-License-Identifier: BSD-3-Clause
"""Tests signals at random moments of writing, and ranks that are killed. The command must end soon
on all ranks, with either all files new or none. PNPBS_SHOTS is the number of random moments (a few
by default)."""

import os
import random
import signal
import subprocess
import time
import unittest

from command import INTERRUPTED
from ranks import end_soon
from shots import WRITTEN, ShotTest

SHOTS = int(os.environ.get("PNPBS_SHOTS", "4"))


class Signals(ShotTest):
    def run_once(self, shoot):
        """Runs the command while shoot(process) acts on it. Returns the exit code and the messages.
        """
        self.lay_old_files()
        process = self.start_ranks(self.RANKS, *self.arguments())
        try:
            shoot(process)
            _, err = process.communicate(timeout=300)
        except BaseException:
            process.kill()
            raise
        return process.returncode, err.decode(errors="replace")

    def duration(self):
        """Returns the time from the first byte of a file to the end of the command."""
        begin = []

        def watch(process):
            self.wait_aside(process)
            begin.append(time.monotonic())

        code, err = self.run_once(watch)
        self.assertIn(code, WRITTEN, err)
        return time.monotonic() - begin[0]

    def test_at_random_moments(self):
        seed = int(os.environ.get("PNPBS_SEED", "1"))
        chance = random.Random(seed)
        endings = {}
        for self.RANKS in (2, 3):
            duration = self.duration()
            for shot in range((SHOTS + 1) // 2):
                number = chance.choice((signal.SIGTERM, signal.SIGINT))
                at_mpirun = chance.random() < 0.2
                after, rank = chance.random() * duration, chance.randrange(self.RANKS)
                hint = f"seed {seed}, shot {shot}: {number!r} to {'mpirun' if at_mpirun else rank} " \
                       f"of {self.RANKS} after {after:.3f} s"

                def shoot(process):
                    ranks = self.ranks_of(process, self.RANKS)
                    self.wait_aside(process)
                    time.sleep(after)
                    try:
                        os.kill(process.pid if at_mpirun else ranks[rank], number)
                    except ProcessLookupError:
                        pass

                code, err = self.run_once(shoot)
                with self.subTest(hint):
                    if not at_mpirun:
                        self.assertIn(code, (*WRITTEN, INTERRUPTED), f"{hint}: {err}")
                    new = self.check_files(code, hint)
                    key = ("mpirun" if at_mpirun else "rank", code, "new" if new else "old")
                    endings[key] = endings.get(key, 0) + 1
        print(f"{sum(endings.values())} shots:",
              ", ".join(f"{count} x {key}" for key, count in sorted(endings.items())))


class Killed(ShotTest):
    RANKS = 3

    def kill_one(self, rank, wait):
        self.lay_old_files()
        process = self.start_ranks(self.RANKS, *self.arguments())
        try:
            ranks = self.ranks_of(process, self.RANKS)
            wait(process)
            os.kill(ranks[rank], signal.SIGKILL)
            self.assertTrue(end_soon(ranks))
            self.let_end(process)
        except BaseException:
            process.kill()
            raise
        self.assertNotIn(process.returncode, WRITTEN)
        self.assertFalse(self.are_new())  # leftovers have names of temporary files

    def let_end(self, process):
        """Waits for the end of mpirun. Open MPI 4.1 sometimes waits forever after all its ranks
        have ended, so it is killed then."""
        try:
            process.communicate(timeout=20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()

    def test_while_writing(self):
        for rank in (0, 2):
            with self.subTest(rank):
                self.kill_one(rank, self.wait_aside)

    def test_while_computing(self):
        self.SPACING = "0.002"
        for rank in (0, 1):
            with self.subTest(rank):
                self.kill_one(rank, lambda process: time.sleep(1))


if __name__ == "__main__":
    unittest.main()
