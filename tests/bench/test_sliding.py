#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the small study of sliding boundary nodes: its tables, and that nodes slide along their
curve while corners do not. PNPBS_COMMAND is the command."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROGRAM = Path(os.environ["PNPBS_COMMAND"])
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE))

import numpy as np  # noqa: E402
import sliding_study as sliding  # noqa: E402


def study(*words):
    return subprocess.run([sys.executable, "-B", HERE / "sliding_study.py", "--pnpbs", PROGRAM, *words],
                          stdin=subprocess.DEVNULL, capture_output=True, text=True)


class Tables(unittest.TestCase):
    def test_sliding(self):
        done = study("--nodes", "1500", "--cases", "gear", "--settings", "default")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [[cell.strip() for cell in line.split("|")[1:-1]]
                for line in done.stdout.splitlines() if line.startswith("| gear")]
        by_variant = {row[2]: row for row in rows if len(row) == len(sliding.TITLES)}
        self.assertEqual(set(by_variant), {"as placed", *sliding.VARIANTS})
        for variant, row in by_variant.items():
            mean, low, least = map(float, row[3].split(" / "))
            self.assertTrue(0.6 < least <= low <= mean < 1, row)
            share, slides, _ = sliding.VARIANTS.get(variant, (None, False, False))
            # Distance that nodes slid.
            self.assertEqual(row[-1] != "0", share is not None or slides, row)
        worst = [row for row in rows if len(row) == len(sliding.WORST_TITLES)]
        self.assertEqual([row[5] for row in worst], ["worst 1 %", "worst 50"])

    def test_first_row(self):
        make, angle = sliding.CASES["annulus"]
        case = make(1500)
        low = {}
        for name in "default", "bubbles":
            placed = sliding.placed(PROGRAM, case, angle, sliding.SETTINGS[name])
            nodes = sliding.Set(*placed, case, angle)
            beside = ~nodes.inner[nodes.mesh.triangles].all(1)
            low[name] = sliding.shape(nodes.points, nodes.mesh.triangles)[0][beside].min()
        self.assertGreater(low["default"], low["bubbles"] + 0.05)

    def test_bad_arguments(self):
        for option in "--cases", "--settings":
            done = study(option, "gear,none")
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"{option}: of ", done.stderr)


class Nodes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        make, cls.angle = sliding.CASES["gear"]
        cls.case = make(1500)
        cls.start = sliding.placed(PROGRAM, cls.case, cls.angle, [])

    def nodes(self):
        points, on_boundary = self.start
        return sliding.Set(points.copy(), on_boundary, self.case, self.angle)

    def test_sliding_stays_on_the_curve(self):
        nodes = self.nodes()
        before, slides = nodes.points.copy(), nodes.rim.slides
        sliding.improve(nodes, 0.5, True, False)
        held = ~nodes.inner & ~slides
        self.assertEqual(held.sum(), 6)
        np.testing.assert_array_equal(nodes.points[held], before[held])
        moved = np.hypot(*(nodes.points - before)[slides].T)
        self.assertGreater(moved.max(), 0.01 * nodes.d.min())
        x, y = nodes.points[slides].T
        radius = 0.6 + 0.4 * abs(np.cos(3 * np.arctan2(y, x)))
        np.testing.assert_allclose(np.hypot(x, y), radius, atol=1e-5)

    def test_equal_steps(self):
        """Sliding to equal steps alone moves back nodes that were pushed along the curve."""
        nodes = self.nodes()
        slid = np.flatnonzero(nodes.rim.slides)[::3]
        ways = 0.2 * nodes.d[slid]
        nodes.points[slid] = nodes.rim.places(slid, ways)
        nodes.rim.station[slid] = nodes.rim.wrapped(slid, nodes.rim.station[slid] + ways)
        on = np.flatnonzero(~nodes.inner)
        pushed = nodes.over_d(on, nodes.rim.beside[on, 1]).std()
        for _ in range(20):
            moved, to = nodes.slid(np.zeros_like(nodes.points), 1)
            nodes.points[moved] = nodes.rim.places(moved, to)
            nodes.rim.station[moved] = nodes.rim.wrapped(moved, nodes.rim.station[moved] + to)
        self.assertLess(nodes.over_d(on, nodes.rim.beside[on, 1]).std(), pushed / 5)

    def test_quality(self):
        a, b, c = np.array([[0, 0], [1, 0], [0.5, 3 ** 0.5 / 2]])
        self.assertAlmostEqual(sliding.quality(a, b, c), 1)
        self.assertAlmostEqual(sliding.quality(a, c, b), -1)
        # The right triangle has r_in = (2 - sqrt(2)) / 2, R = sqrt(2) / 2.
        self.assertAlmostEqual(sliding.quality(a, b, np.array([0, 1])), 2 * (2 ** 0.5 - 1))


if __name__ == "__main__":
    unittest.main()
