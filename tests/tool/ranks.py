# SPDX-License-Identifier: BSD-3-Clause
"""How the tests run the command under mpirun."""

import os
import subprocess

from command import BAD_INPUT, COMMAND, DONE, CommandTest, receive_signals

MPIRUN = [os.environ["PNPBS_MPIEXEC"], "--oversubscribe", "--bind-to", "none",
          "--mca", "mpi_yield_when_idle", "1"]


class RanksTest(CommandTest):
    def start_ranks(self, ranks, *arguments, command=(COMMAND,), stdin=subprocess.DEVNULL):
        return subprocess.Popen(
            [*MPIRUN, "-np", str(ranks), *command, *map(str, arguments)],
            cwd=self.folder,
            env=dict(os.environ, OMP_NUM_THREADS="1"),
            preexec_fn=receive_signals,
            stdin=stdin,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )

    def run_ranks(self, ranks, *arguments, code=DONE, stdin=None, **more):
        process = self.start_ranks(
            ranks, *arguments, stdin=subprocess.DEVNULL if stdin is None else subprocess.PIPE, **more
        )
        out, err = process.communicate(stdin, timeout=300)
        self.assertEqual(process.returncode, code, err.decode(errors="replace"))
        return out, err.decode()

    def refuse_ranks(self, ranks, *arguments, code=BAD_INPUT, **more):
        """A run that must fail, leave no file and say why once; returns what it says."""
        before = self.files()
        out, err = self.run_ranks(ranks, *arguments, code=code, **more)
        self.assertEqual(out, b"")
        self.assertEqual(self.files(), before)
        told = errors(err)
        self.assertEqual(len(told), 1, err)
        return told[0]


def errors(err):
    """The lines that say why a run failed; warnings may come before them."""
    return [line for line in err.splitlines()
            if line.startswith("pnpbs: ") and not line.startswith("pnpbs: warning: ")]
