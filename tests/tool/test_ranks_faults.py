# SPDX-License-Identifier: BSD-3-Clause
"""Tests that every file call may fail. The command then ends with an error and leaves the previous
files, or it succeeds without the call. On ranks, every n-th call fails, where n is
PNPBS_FAULT_STRIDE."""

import os
import unittest

from command import BAD_INPUT, COMMAND, FAILED
from shots import WRITTEN, ShotTest

STRIDE = int(os.environ.get("PNPBS_FAULT_STRIDE", "20"))


class Faults(ShotTest):
    SPACING = "0.2"
    NAMES = ("a.vtu", "d.pvtu", "e.png")

    def one_fault(self, at, rank, ranks):
        """Makes the call number `at` fail. Returns the name of this call, or None if there were
        fewer calls."""
        self.RANKS = ranks
        self.lay_old_files()
        log = self.folder / "log"
        log.unlink(missing_ok=True)
        arm = {"PNPBS_FAULT_AT": str(at), "PNPBS_FAULT_LOG": str(log),
               "LD_PRELOAD": os.environ["PNPBS_FAULT_CALLS"]}
        if ranks == 1:
            process = self.start(*self.arguments(), environment=arm)
        else:
            arm["PNPBS_FAULT_RANK"] = str(rank)
            settings = [f"{name}={value}" for name, value in arm.items()]
            process = self.start_ranks(ranks, *self.arguments(),
                                       command=("env", *settings, COMMAND))
        _, err = process.communicate(timeout=300)
        call = log.read_text().strip() if log.exists() else None
        hint = f"call {at} on rank {rank} of {ranks}, {call}: {err.decode(errors='replace')}"
        new = self.are_new()
        self.assertEqual(new, process.returncode in WRITTEN, hint)
        if not new:
            self.assertIn(process.returncode, (FAILED, BAD_INPUT), hint)
            self.assertIn(b"pnpbs: ", err)
        left = self.left_aside()
        self.assertLessEqual(len(left), call == "unlink", hint)
        for name in left:
            (self.folder / name).unlink()
        return call

    def all_faults(self, rank, ranks, stride):
        at, calls = rank % stride, []
        while (call := self.one_fault(at, rank, ranks)) is not None:
            calls.append(call)
            at += stride
        return calls

    def test_alone(self):
        calls = self.all_faults(0, 1, 1)
        self.assertLessEqual({"open", "write", "close", "link", "rename", "unlink"}, set(calls))

    def test_on_ranks(self):
        calls = [len(self.all_faults(rank, 3, STRIDE)) for rank in range(3)]
        self.assertGreater(calls[0], 50 // STRIDE)


if __name__ == "__main__":
    unittest.main()
