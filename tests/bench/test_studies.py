#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the studies with small node sets: the schedule study's page, the output of pnpbs-bench
for bodies, the invariance grid's report of differing and failing runs, the study of speedup with a
fake command, and the study of particles. PNPBS_BENCH is the program pnpbs-bench, and PNPBS_LIBRARY
the library for Python, if there is one. mpirun is a fake."""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
BENCH = os.environ["PNPBS_BENCH"]


def run(script, *words):
    return subprocess.run([sys.executable, "-B", HERE / script, *(str(word) for word in words)],
                          stdin=subprocess.DEVNULL, capture_output=True, text=True)


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def program(self, text):
        path = self.folder / "program"
        path.write_text("#!/bin/sh\n" + text)
        path.chmod(0o755)
        return path


class Schedule(InFolder):
    def study(self, *words):
        return run("schedule_study.py", "--nodes", 1000, "--program", BENCH, *words)

    def rows(self, page):
        """Returns the rows of the table by heading, with cells without bold marks."""
        tables, heading = {}, None
        for line in page.splitlines():
            if line.startswith("#"):
                heading = line.strip("# ")
            elif line.startswith("| ") and "---" not in line:
                tables.setdefault(heading, []).append([c.strip(" *") for c in line.split("|")[1:-1]])
        return {name: rows[1:] for name, rows in tables.items()}

    def test_page(self):
        output, figures = self.folder / "page.md", self.folder / "figures.json"
        words = ["--scales", 2, "--options", "sweeps", "--presets", "default",
                 "--output", output, "--figures", figures]
        done = self.study(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        page = output.read_text()
        rows = self.rows(page)["sweeps"]
        self.assertEqual([row[0] for row in rows], ["0", "2", "4", "6", "10"])
        self.assertIn("| **6** |", page)
        quality = [float(row[4]) for row in rows]
        self.assertLess(quality[0], quality[2])  # the purpose of the sweeps
        self.assertEqual(rows[3][2], "1.00")
        for row in rows:
            self.assertGreater(float(row[1].replace(" ", "")), 1000)
        self.assertNotIn(str(self.folder), page)
        # Existing measurements are not repeated.
        kept = json.loads(figures.read_text())
        self.assertEqual(len(kept), 2 * 5)
        for runs in kept.values():
            runs["mean"] = 0.5
        figures.write_text(json.dumps(kept))
        self.study(*words)
        self.assertEqual({row[4] for row in self.rows(output.read_text())["sweeps"]}, {"0.50000"})

    def test_default_of_a_preset(self):
        done = self.study("--scales", 1, "--options", "damping")
        self.assertEqual(done.returncode, 0, done.stderr)
        default, best = done.stdout.split("## effort=best")
        self.assertIn("| **0.2** |", default)
        self.assertIn("| **0.1** |", best)

    def test_a_run_that_fails(self):
        failing = self.program("echo 'no more paper' >&2\nexit 3\n")
        done = self.study("--scales", 1, "--options", "levels", "--program", failing)
        self.assertEqual(done.returncode, 1)
        self.assertIn("failed: status 3: no more paper", done.stdout)

    def test_bad_arguments(self):
        for words, told in ((("--options", "colour"), "unknown option colour"),
                            (("--presets", "worst"), "unknown preset worst"),
                            (("--scales", 0), "--scales")):
            done = self.study(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(told, done.stderr)


class Volumes(unittest.TestCase):
    def bench(self, *words):
        return subprocess.run([BENCH, *words], stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, env={**os.environ, "OMP_NUM_THREADS": "1"}, check=False)

    def test_cube(self):
        done = self.bench("--nodes", "3000", "--repeat", "2", "volume-cube")
        self.assertEqual(done.returncode, 0, done.stderr)

        def number(pattern):
            return float(re.search(pattern, done.stdout)[1])

        self.assertAlmostEqual(number(r"volume-cube: (\d+) nodes") / 3000, 1, delta=0.3)
        self.assertGreater(number(r"all +\d+ tetrahedra: mean ([\d.]+)"), 0.92)
        self.assertGreater(number(r"least [\d.]+  angle ([\d.]+)"), 25)
        self.assertEqual(number(r"below 20 degrees (\d+)"), 0)
        self.assertAlmostEqual(number(r"edge/d ([\d.]+)"), 1, 1)
        self.assertAlmostEqual(number(r"covered ([\d.]+)"), 1, 6)
        self.assertNotIn("none in the reference", done.stdout)
        counts = [int(re.search(rf"{label} +(\d+) tetrahedra", done.stdout)[1])
                  for label in ("all", "inside", "boundary")]
        self.assertEqual(counts[0], sum(counts[1:]))

    def test_bad_arguments(self):
        for words in (("--nodes", "3"), ("--nodes",), ("--scale", "0"), ("--set", "sweeps"),
                      ("--colour", "red")):
            done = self.bench(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn("usage", done.stderr)


class Grid(InFolder):
    """Tests with a fake mpirun, which reads the number of ranks after -np."""

    def grid(self, mpirun):
        return run("invariance_grid.py", "--program", mpirun, "--mpiexec", mpirun, "--cases",
                   "graded-square", "--ranks", "1,2", "--threads", 1, "--intervals", 5, "--seeds", 1)

    LINE = "echo hash $hash nodes 7 held 7 seconds 0.1\n"
    RANKS = "while [ \"$1\" != -np ]; do shift; done\nranks=$2\n"

    def test_same(self):
        done = self.grid(self.program("hash=abc\n" + self.LINE))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| graded-square | 7 | abc | 0.1 | 2 | 0 | 0 |", done.stdout)

    def test_differs(self):
        done = self.grid(self.program(self.RANKS + "hash=$ranks\n" + self.LINE))
        self.assertEqual(done.returncode, 1)
        self.assertIn("| graded-square | 7 | 1 | 0.1 | 2 | 1 | 0 |", done.stdout)
        self.assertIn("| graded-square | 2 | 1 | 5 | 1 | 2 | 0.1 | 7 | **differs** |", done.stdout)

    def test_a_run_that_fails_does_not_differ(self):
        fails = "[ $ranks = 2 ] && { echo no room >&2; exit 4; }\nhash=abc\n"
        done = self.grid(self.program(self.RANKS + fails + self.LINE))
        self.assertEqual(done.returncode, 1)
        self.assertIn("| graded-square | 7 | abc | 0.1 | 2 | 0 | 1 |", done.stdout)
        self.assertIn("**failed**: status 4: no room", done.stdout)
        self.assertNotIn("**differs**", done.stdout)

    def test_mpirun_that_refuses(self):
        done = self.grid(self.program(
            "{ echo -----; echo mpirun has detected an attempt; echo to run as root.; echo;"
            " echo Running as root is discouraged; echo -----; } >&2\nexit 1\n"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("**failed**: status 1: mpirun has detected an attempt to run as root. |",
                      done.stdout)
        self.assertNotIn("differs", done.stdout)


# A fake of the command and of mpirun. A case takes 1, 2 and 6 s alone in its rounds. The first of the
# SINGLE runs of a round on one rank with one thread is alone. The others are side by side and wait
# until all of them have started.
PLAYED = f"""#!{sys.executable}
import json, os, sys, time
from math import hypot
from pathlib import Path
words = sys.argv[1:]
def after(option, default=None):
    return words[words.index(option) + 1] if option in words else default
def single_runs():
    return log.read_text().split()
ranks, threads = int(after("-np", 1)), int(os.environ["OMP_NUM_THREADS"])
way, cube = (ranks, threads), after("--domain") == "box(0,0,0, 1,1,1)"
assert os.environ["OMP_PROC_BIND"] == "false"
assert cube or Path(after("--domain")).suffix == ".poly" and Path(after("--domain")).exists()
x = y = 0.5
assert abs(eval(after("--spacing")) / (3 * (0.0185 if cube else 0.000213)) - 1) < 1e-9
log = Path("FOLDER") / ("cube" if cube else "square")
if way == (1, 1):
    token = f"{{os.getpid()}}-{{time.time_ns()}}"
    with log.open("a") as file:
        file.write(token + "\\n")
    round, index = divmod(single_runs().index(token), SINGLE)
    seconds = (1, 2, 6)[round] * (1, 1.25, 1.75)[index]
    given_up = time.monotonic() + 20
    while index and len(single_runs()) < SINGLE * (round + 1):
        assert time.monotonic() < given_up, "the other runs have not started"
        time.sleep(0.01)
else:
    round = len(single_runs()) // SINGLE - 1
    quotients = dict([((2, 1), (1.6, 1.8, 1.5)), ((1, 2), (1.25, 1.25, 2))])[way]
    seconds = (1, 2, 6)[round] / quotients[round]
shares = dict(tree=0.004, lists=0.5, exchange=0.25 if ranks > 1 else 0, total=1)
waits = dict(tree=0, lists=0, exchange=0.5, total=0.25) if ranks > 1 else dict.fromkeys(shares, 0)
report = dict(hash="abc", nodes=7000, ranks=ranks, threads=threads,
              seconds=dict((phase, share * seconds) for phase, share in shares.items()),
              waiting=dict((phase, share * shares[phase] * seconds) for phase, share in waits.items()))
CHANGES
Path(after("--report")).write_text(json.dumps(report))
"""


class Speedup(InFolder):
    def study(self, changes="", *words, cores=2):
        text, played = PLAYED, self.folder / "played"
        for name, value in (("FOLDER", self.folder), ("CHANGES", changes), ("SINGLE", 1 + cores)):
            text = text.replace(name, str(value))
        played.write_text(text)
        played.chmod(0o755)
        return run("speedup_study.py", "--program", played, "--mpiexec", played, "--cases",
                   "graded-square,even-cube", "--ways", "2x1,1x2", "--pairs", 3, "--scale", 3,
                   "--cores", cores, *words)

    def test_tables(self):
        output = self.folder / "page.md"
        done = self.study("", "--output", output)
        self.assertEqual(done.returncode, 0, done.stderr)
        _, *sections = output.read_text().split("### ")
        self.assertEqual(len(sections), 2)
        for case, section in zip(("graded-square", "even-cube"), sections):
            rows = [[cell.strip() for cell in line.split("|")[1:-1]]
                    for line in section.splitlines() if line.startswith("| ")]
            self.assertTrue(section.startswith(f"{case}, 7 000 nodes\n"))
            # The median of quotients, 1.6, is not the quotient of medians, 2 / (2 / 1.8).
            self.assertEqual(rows, [
                ["way", "seconds", "speedup", "limit of the machine"], ["---"] * 4,
                ["alone", "2.000", "1", "1"],
                ["2x1", "1.111", "1.60", "1.33"],
                ["1x2", "1.600", "1.25", "1.33"],
                ["phase", "alone", "2x1: seconds / waiting", "1x2: seconds / waiting"], ["---"] * 4,
                ["lists", "1.000", "0.556 / 0.000", "0.800 / 0.000"],
                ["exchange", "0.000", "0.278 / 0.139", "0.000 / 0.000"],
                ["total", "2.000", "1.111 / 0.278", "1.600 / 0.000"]])

    def test_more_workers_than_cores(self):
        done = self.study(cores=1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| 2x1 | 1.111 | 1.60 | 0.80 |", done.stdout)  # 1 over 1.25

    def test_hashes_differ(self):
        done = self.study("if cube and ranks == 2: report['hash'] = 'def'")
        self.assertEqual(done.returncode, 1)
        self.assertIn("even-cube: the nodes differ: hash abc in 1x2, 2 side by side, alone; "
                      "hash def in 2x1", done.stderr)
        self.assertEqual(done.stdout, "")

    def test_runs_that_do_not_count(self):
        for changes, told in (("if ranks == 2: report['ranks'] = 1",
                               "graded-square, 2x1: the run had 1 ranks with 1 threads"),
                              ("if threads == 2: sys.exit('no room')",
                               "graded-square, 1x2: status 1: no room")):
            done = self.study(changes)
            self.assertEqual(done.returncode, 1)
            self.assertIn(told, done.stderr)
            (self.folder / "square").unlink()

    def test_bad_arguments(self):
        for words, told in ((("--cases", "sphere"), "unknown case sphere"), (("--ways", "2x"), "--ways"),
                            (("--ways", "0x1"), "RANKSxTHREADS"), (("--pairs", 0), "--pairs")):
            done = self.study("", *words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(told, done.stderr)


@unittest.skipUnless("PNPBS_LIBRARY" in os.environ, "no library that Python can load")
class Particles(unittest.TestCase):
    def study(self, *words):
        return run("particles_study.py", "--library", os.environ["PNPBS_LIBRARY"], *words)

    def test_tables(self):
        done = self.study("--cases", "square,eros", "--scale", 2)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [[cell.strip() for cell in line.split("|")[1:-1]]
                for line in done.stdout.splitlines() if line.startswith("| ")]
        places = {row[0]: row for row in rows if len(row) == 12}
        for name, below in (("square", 0.03), ("square, lattice", 0.001), ("eros", 0.1),
                            ("eros, lattice", 0.01)):
            self.assertAlmostEqual(float(places[name][3]), 1, delta=below)
        for name in "square", "eros":
            self.assertLess(abs(float(places[name][4])), 1e-12)
            self.assertGreater(float(places[name][6]), 0.4)
        sums = {tuple(row[:2]): row for row in rows if len(row) == 11}
        # The endless lattice's sum is computed by hand: neighbours at 0, 1, sqrt(2), 2, sqrt(5),
        # sqrt(8) within 3 d.
        by_hand = 7 / (9 * math.pi) * sum(
            count * (1 - r / 3) ** 4 * (1 + 4 * r / 3)
            for count, r in ((1, 0), (4, 1), (4, 2 ** 0.5), (4, 2), (8, 5 ** 0.5), (4, 8 ** 0.5)))
        self.assertAlmostEqual(float(sums["square lattice", "1.5"][3]), by_hand, 4)
        self.assertAlmostEqual(float(sums["square", "1.5"][3]), by_hand, 2)
        self.assertLess(float(sums["square", "2"][10]), 0.01)

    def test_kernels(self):
        sys.path.insert(0, str(HERE))
        import numpy as np
        import particles_study
        s = (np.arange(10000) + 0.5) / 10000
        for kernel in particles_study.KERNELS.values():
            for dim, sphere in (2, 2 * math.pi), (3, 4 * math.pi):
                integral = kernel.factors[dim] * np.mean(kernel.value(s) * sphere * s ** (dim - 1))
                self.assertAlmostEqual(integral, 1, 6)
            by_differences = (kernel.value(s + 1e-6) - kernel.value(s - 1e-6)) / 2e-6
            np.testing.assert_allclose(kernel.slope(s), by_differences, atol=1e-6)

    def test_bad_arguments(self):
        for words, told in ((("--cases", "sphere"), "unknown case sphere"), (("--scale", 0), "--scale")):
            done = self.study(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(told, done.stderr)


if __name__ == "__main__":
    unittest.main()
