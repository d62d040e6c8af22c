# SPDX-License-Identifier: BSD-3-Clause
"""Base class of the tests of runs that end early, over files that existed before. Afterwards either
all of the files are new or none of them, and no other file is left."""

import os
import time

from command import DONE, INTERRUPTED, NOT_CONVERGED
from ranks import RanksTest


WRITTEN = (DONE, NOT_CONVERGED)  # the run stops after a few steps


class ShotTest(RanksTest):
    # The run is short and writes much.
    SPACING = "0.007"
    NAMES = ("a.vtu", "b.msh", "c.csv", "d.pvtu", "e.png")
    RANKS = 2

    def arguments(self):
        outputs = [word for name in self.NAMES for word in ("-o", name)]
        return ("--domain", self.square, "--spacing", self.SPACING, "--set", "steps=4",
                "--set", "sweeps=0", *outputs, "--report", "f.json", "--quiet")

    def targets(self):
        pieces = (f"{name}_{rank}.vtu" for name in ("d", "d_facets") for rank in range(self.RANKS))
        return [*self.NAMES, "a_facets.vtu", "d_facets.pvtu", *pieces, "f.json"]

    def lay_old_files(self):
        for name in self.targets():
            (self.folder / name).write_text("old")

    def are_new(self):
        """Returns whether the files are new. Fails if some are new and some are old."""
        new = {name: (self.folder / name).read_bytes() != b"old" for name in self.targets()}
        self.assertEqual(len(set(new.values())), 1, f"a mixture: {new}")
        return all(new.values())

    def left_aside(self):
        return [name for name in self.files() if name.startswith(".pnpbs-")]

    def check_files(self, code, hint):
        """Checks the files after a run that may have been interrupted. Returns whether they are
        new."""
        new = self.are_new()
        self.assertEqual(self.left_aside(), [], hint)
        if code in WRITTEN:
            self.assertTrue(new, hint)
        if code == INTERRUPTED:
            self.assertFalse(new, hint)
        return new

    def wait_aside(self, process, patience=300):
        """Waits until a temporary file contains data."""
        end = time.monotonic() + patience
        while time.monotonic() < end and process.poll() is None:
            for name in self.left_aside():
                try:
                    if os.stat(self.folder / name).st_size > 0:
                        return
                except FileNotFoundError:
                    pass
            time.sleep(0.002)
        self.fail("nothing is written")
