# SPDX-License-Identifier: BSD-3-Clause
"""Base class of the tests that run the command, each test in an empty folder of its own."""

import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

COMMAND = os.environ["PNPBS_COMMAND"]
MPIEXEC = os.environ.get("PNPBS_MPIEXEC")  # None without MPI
SOURCE = pathlib.Path(os.environ["PNPBS_SOURCE_DIR"])
DATA = SOURCE / "examples" / "data"
LAKE = DATA / "lake_victoria.poly"

DONE, FAILED, BAD_INPUT, NOT_CONVERGED, SPACING_MISSED, LEFT_OUT, NOT_CONFORMING = range(7)
INTERRUPTED = 130

# A unit square with a square hole. The marker of the outer side is 1, that of the hole is 2.
SQUARE = """\
8 2 0 0
1 0 0
2 1 0
3 1 1
4 0 1
5 0.4 0.4
6 0.6 0.4
7 0.6 0.6
8 0.4 0.6
8 1
1 1 2 1
2 2 3 1
3 3 4 1
4 4 1 1
5 5 6 2
6 6 7 2
7 7 8 2
8 8 5 2
1
1 0.5 0.5
"""
SQUARE_AREA = 0.96


def receive_signals():
    """Restores the default handlers of signals in a child process. A background process ignores
    these signals, and its children inherit that."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)


class CommandTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.square = self.folder / "square.poly"
        self.square.write_text(SQUARE)

    def start(self, *arguments, environment=None, **streams):
        streams.setdefault("stdout", subprocess.PIPE)
        streams.setdefault("stderr", subprocess.PIPE)
        return subprocess.Popen(
            [COMMAND, *map(str, arguments)],
            cwd=self.folder,
            env=dict(os.environ, **(environment or {})),
            preexec_fn=receive_signals,
            **streams,
        )

    def run_command(self, *arguments, code=DONE, stdin=b"", **more):
        """Runs the command to its end, and checks its exit code. Returns its output and messages as
        bytes."""
        process = self.start(*arguments, stdin=subprocess.PIPE, **more)
        out, err = process.communicate(stdin)
        self.assertEqual(process.returncode, code, err.decode(errors="replace"))
        return out, err

    def run_on_ranks(self, *arguments, ranks=1):
        """Runs the command quietly on this number of ranks, with one thread each. One rank is
        started without a launcher."""
        launcher = [MPIEXEC, "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle",
                    "1", "-np", str(ranks)]
        process = subprocess.run(
            [*(launcher if ranks > 1 else []), COMMAND, *map(str, arguments), "-q"],
            cwd=self.folder, env=dict(os.environ, OMP_NUM_THREADS="1"), capture_output=True,
            timeout=300, check=False)
        self.assertEqual(process.returncode, 0, process.stderr.decode())

    def place(self, *arguments, domain=None, spacing="0.06", **more):
        """Runs the command on the square, unless other arguments replace it."""
        return self.run_command(
            "--domain", domain or self.square, "--spacing", spacing, "--check", *arguments, **more
        )

    def place_body(self, domain, spacing, *arguments, **more):
        """Runs the command in space. The bubbles may come to rest or not. Returns its output and
        messages."""
        process = self.start("--domain", domain, "--spacing", spacing, *arguments, **more)
        out, err = process.communicate()
        self.assertIn(process.returncode, (DONE, NOT_CONVERGED, SPACING_MISSED), err.decode())
        return out.decode(), err.decode()

    def refuse(self, *arguments, code=BAD_INPUT, **more):
        """Runs the command, which must fail, write no file and give a reason. Returns the message.
        """
        before = self.files()
        out, err = self.run_command(*arguments, code=code, **more)
        self.assertEqual(out, b"")
        self.assertEqual(self.files(), before)
        message = err.decode()
        self.assertTrue(message.startswith("pnpbs: "), message)
        return message

    def files(self):
        """Returns the names of all files in the folder, including hidden ones."""
        return sorted(os.listdir(self.folder))
