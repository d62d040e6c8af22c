# SPDX-License-Identifier: BSD-3-Clause
"""Base class of the tests that run the command under mpirun."""

import os
import pathlib
import signal
import subprocess
import time

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

    def ranks_of(self, process, count):
        """Returns the process ids of the ranks, once they have installed the signal handlers of the
        command."""
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
        end = time.monotonic() + 100
        while time.monotonic() < end and process.poll() is None:
            found = [int(child) for child in children.read_text().split()]
            if len(found) >= count and all(map(catches_signals, found)):
                return found
            time.sleep(0.01)
        self.fail("mpirun starts no ranks")

    def run_ranks(self, ranks, *arguments, code=DONE, stdin=None, **more):
        process = self.start_ranks(
            ranks, *arguments, stdin=subprocess.DEVNULL if stdin is None else subprocess.PIPE, **more
        )
        out, err = process.communicate(stdin, timeout=300)
        self.assertEqual(process.returncode, code, err.decode(errors="replace"))
        return out, err.decode()

    def refuse_ranks(self, ranks, *arguments, code=BAD_INPUT, **more):
        """Runs the command, which must fail, leave no file and give one reason. Returns the
        message."""
        before = self.files()
        out, err = self.run_ranks(ranks, *arguments, code=code, **more)
        self.assertEqual(out, b"")
        self.assertEqual(self.files(), before)
        told = errors(err)
        self.assertEqual(len(told), 1, err)
        return told[0]


def state_of(process):
    """Returns the text that the system reports about a process, or "" if the process does not
    exist."""
    try:
        return pathlib.Path(f"/proc/{process}/status").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return ""


def is_running(process):
    """Returns whether a process runs. A process that has ended may still be listed until its parent
    waits for it."""
    state = state_of(process)
    return bool(state) and "\nState:\tZ" not in state


def catches_signals(process):
    """Returns whether the process handles both signals that interrupt the command."""
    caught = state_of(process).partition("\nSigCgt:\t")[2].partition("\n")[0] or "0"
    return all(int(caught, 16) >> (number - 1) & 1 for number in (signal.SIGINT, signal.SIGTERM))


def end_soon(processes, patience=100):
    end = time.monotonic() + patience
    while any(map(is_running, processes)) and time.monotonic() < end:
        time.sleep(0.05)
    return not any(map(is_running, processes))


def errors(err):
    """Returns the lines with the reason of a failure. Warnings may precede them."""
    return [line for line in err.splitlines()
            if line.startswith("pnpbs: ") and not line.startswith("pnpbs: warning: ")]
