#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the laws of surface and volume against counted points in cubes, and of the study's page
with a fake mpirun, whose figures follow known laws."""
import itertools
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import space_law  # noqa: E402

# The layers of the fake ranks in spacings.
LISTS, STARS, SWEEPS, SECONDS = 0.5, 1.5, 1.0, 3.0
PLAYED = f"""#!{sys.executable}
import sys
words = sys.argv[1:]
if "space" in words or words[0].isdigit():
    for ranks in words[1:]:
        print("ranks", ranks, "table 0.5 cut 0.25")
    sys.exit()
ranks = int(words[words.index("-np") + 1])
case, scale, told = words[-3:]
assert told == "run" and case == "even-cube"
if ranks == FAILS:
    sys.exit("no room")
nodes = round(255649 / float(scale) ** 3) + (1 if ranks == DIFFERS else 0)
owned = nodes / ranks
side = (0.62 * owned) ** (1 / 3)
def growth(layer):
    return ((side + 2 * layer * (1 - ranks ** (-1 / 3))) / side) ** 3
ghosts = owned * (growth(2 * 1.6 + 1.5) - 1)
line = dict(ranks=ranks, nodes=nodes, steps=100)
def over_ranks(name, mean, largest=None):
    line[name + ".mean"], line[name + ".largest"] = mean, largest or mean
over_ranks("owned", owned)
over_ranks("ghosts", 2 * ghosts)
over_ranks("neighbours", ranks - 1)
over_ranks("messages", 300 * (ranks - 1))
over_ranks("sent", 80 * 52 * ghosts)
over_ranks("collectives", 2000)
over_ranks("gathered", 1000 * ranks)
over_ranks("memory.empty", 2e7)
own = 2e7 + 500 * owned * (1 if ranks == 1 else 2.6)
over_ranks("memory", own + 3e6)
over_ranks("memory.own", own)
over_ranks("computed", 1e-5 * owned * growth({SECONDS}))
over_ranks("total", 4e-5 * owned)  # a machine that is not idle
for phase in "boundary tree fill spacing population conformity rest".split():
    over_ranks(phase, 0)
for phase in "motion lists stars sweeps".split():
    over_ranks(phase, 1e-5 * owned)
for phase, layer in ("lists", {LISTS}), ("motion", 0), ("stars", {STARS}), ("sweeps", {SWEEPS}):
    line["redundancy." + phase] = growth(layer)
print(*(word for pair in line.items() for word in pair))
"""


class Law(unittest.TestCase):
    def test_growth_of_counted_cubes(self):
        """Each of 27 parts has 12^3 points. The layer has the points of the whole cube within 3
        points of a part."""
        side, per_row, layer = 12, 3, 3
        held = 0
        for part in itertools.product(range(per_row), repeat=3):
            spans = [range(max(0, p * side - layer), min(per_row * side, (p + 1) * side + layer))
                     for p in part]
            held += sum(1 for _ in itertools.product(*spans))
        owned = side ** 3
        spacings = space_law.width(owned) / side  # width of a point in spacings
        # The mean over the parts is the product of the mean widths along each axis.
        self.assertAlmostEqual(space_law.growth(layer * spacings, owned, per_row ** 3),
                               held / (per_row ** 3 * owned), 12)
        # Not more than all other nodes.
        self.assertEqual(space_law.ghosts(1000, owned, 27), 26 * owned)

    def test_fit_finds_the_layer(self):
        points = [(owned, ranks, space_law.growth(0.7, owned, ranks))
                  for owned, ranks in ((4000, 8), (44000, 8), (2000, 216))]
        self.assertAlmostEqual(space_law.fitted_layer(points), 0.7, 12)


class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def study(self, *words, fails=0, differs=0):
        played = self.folder / "played"
        played.write_text(PLAYED.replace("FAILS", str(fails)).replace("DIFFERS", str(differs)))
        played.chmod(0o755)
        command = [sys.executable, "-B", HERE / "space_scaling_study.py", "--program", played,
                   "--cost-program", played, "--mpiexec", played, *words]
        return subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, check=False)

    def rows(self, text):
        """Returns the rows of the tables by heading."""
        tables, heading = {}, None
        for line in text.splitlines():
            if line.startswith("#"):
                heading = line.strip("# ")
            elif line.startswith("| ") and "---" not in line:
                tables.setdefault(heading, []).append([c.strip() for c in line.split("|")[1:-1]])
        return tables

    def test_page(self):
        figures, output = self.folder / "figures.json", self.folder / "page.md"
        words = ["--runs", "even/8/4000,even/64/2000", "--nodes-per-rank", 44000, "--model-ranks",
                 "8,64", "--figures", figures, "--output", output]
        done = self.study(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        tables = self.rows(output.read_text())
        work = tables["What ranks compute for nodes of others"]
        self.assertEqual(work[1][:5], ["even", "8", "32 000", "4 000", "1.000"])
        side = (0.62 * 4000) ** (1 / 3)
        for cell, layer in zip(work[1][5:], (LISTS, STARS, SWEEPS)):
            expected = f"{((side + layer) / side) ** 3:.3f}"
            self.assertEqual(cell, f"{expected} / {expected}")
        self.assertEqual(work[1][8:], [f"{((side + SECONDS) / side) ** 3:.2f}"])
        for row, layer in zip(work[4:], (LISTS, STARS, SWEEPS)):
            inner = (1 + 2 * layer / (0.62 * 44000) ** (1 / 3)) ** 3
            self.assertEqual(row[1:], [f"{layer:.2f}", "0 %", f"{inner:.2f}"])
        held = tables["What ranks hold and send"][1]
        self.assertEqual(held[8], "300")
        self.assertEqual(held[10], "80")
        self.assertEqual(held[4], f"{4000 * ((1 + 6.3 / side) ** 3 - 1):,.0f}".replace(",", " "))
        self.assertEqual(tables["Memory"][1][6:], ["1 300", "500", "2.00"])
        model = tables["Parallel efficiency in space by the model, seconds of a whole run"][2]
        side = (0.62 * 44000) ** (1 / 3)
        own, rise = 0.44, lambda layer: (1 + 2 * layer * 0.75 / side) ** 3 - 1
        counted = own / 4 * (rise(LISTS) + rise(STARS) + rise(SWEEPS))
        # On 64 ranks 2 log2 of the ranks is 12 stages.
        messages = (300 * 63 * 2e-6 + 80 * 52 * 44000 * rise(4.7) / 1e10)
        collectives = 2000 * 12 * 2e-6 + 64000 / 1e10
        expected = [own, counted, messages, collectives, 0.5, 0.25]
        self.assertEqual(model[2:], [*(f"{value:.3f}" for value in expected),
                                     f"{own / sum(expected):.2f}"])
        # Existing measurements are not repeated.
        kept = json.loads(figures.read_text())
        self.assertEqual(len(kept), 4 + 2)  # the partition for 8 and 64 ranks
        kept["even-cube 8 4000"]["ghosts.largest"] = 12345
        figures.write_text(json.dumps(kept))
        self.assertEqual(self.study(*words).returncode, 0)
        self.assertIn(" / 12 345 |", output.read_text())

    def test_runs_that_fail_or_differ(self):
        runs = "--runs", "even/8/4000,even/27/4000,even/64/4000"
        done = self.study(*runs, fails=27)
        self.assertEqual(done.returncode, 1)
        self.assertIn("even cube on 27 ranks: status 1: no room", done.stderr)
        self.assertIn("| even | 64 |", done.stdout)
        done = self.study(*runs, differs=64)
        self.assertEqual(done.returncode, 1)
        self.assertIn("even cube on 64 ranks: 256001 nodes, but 256000 on one rank", done.stderr)
        self.assertNotIn("| even | 64 |", done.stdout)
        done = self.study(*runs[:1], "even/8/4000")
        self.assertIn("the laws need two runs", done.stderr)

    def test_bad_arguments(self):
        for runs in "even/1/4000", "odd/8/4000", "even/8", "even/8/0":
            done = self.study("--runs", runs)
            self.assertEqual(done.returncode, 2)
            self.assertIn("--runs", done.stderr)
        done = self.study("--program", self.folder / "nothing")
        self.assertEqual(done.returncode, 2)
        self.assertIn("build it", done.stderr)


if __name__ == "__main__":
    unittest.main()
