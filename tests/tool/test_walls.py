# SPDX-License-Identifier: BSD-3-Clause
"""Tests --nodes-at walls: particles in layers around the domain, in addition to those inside."""

import json
import math
import unittest

import numpy
from scipy.spatial import cKDTree

from command import BAD_INPUT, CommandTest
from readers import read_csv

DEPTH = {2: 0.42, 3: 0.46}  # in units of d
BUBBLES = {2: 1.076, 3: 1.147}


def points_of(table):
    return numpy.column_stack([table[axis] for axis in "xyz" if axis in table])


def gap_to_square(x):
    """Returns the distance from outer points to the unit square."""
    return numpy.linalg.norm(x - numpy.clip(x, 0, 1), axis=1)


class Walls(CommandTest):
    def setUp(self):
        super().setUp()
        self.square.write_text("4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n"
                               "1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n")

    def particles(self, domain, spacing, *arguments):
        out, _ = self.run_command("--domain", domain, "--spacing", spacing, "-o", "a.csv",
                                  "--report", "a.json", *arguments)
        self.out = out.decode()
        self.report = json.loads((self.folder / "a.json").read_text())
        return read_csv(self.folder / "a.csv")

    def check_apart(self, inside, wall):
        """Checks that no pair across the wall is closer than twice the depth, in units of the mean
        d of both."""
        x, y = points_of(inside), points_of(wall)
        dim = x.shape[1]
        d, e = inside["spacing"] / BUBBLES[dim], wall["spacing"] / BUBBLES[dim]
        near = cKDTree(x).query_ball_point(y, 2 * max(d.max(), e.max()))
        closest = min((numpy.linalg.norm(x[of] - y[i], axis=1) / ((d[of] + e[i]) / 2)).min()
                      for i, of in enumerate(near) if of)
        self.assertGreater(closest, 2 * DEPTH[dim] - 0.005)
        self.assertLess(closest, 2 * DEPTH[dim] + 0.1)

    def test_in_the_plane(self):
        d = 0.04
        for layers, asked in ((2, ("--wall-layers", "2")), (3, ()), (5, ("--wall-layers", "5"))):
            wall = self.particles(self.square, d, "--nodes-at", "walls", *asked)
            gap = gap_to_square(points_of(wall)) / d
            self.assertAlmostEqual(gap.min(), 0.42, delta=0.01)
            self.assertAlmostEqual(gap.max(), layers - 1 + 0.42, delta=0.01)
            # Particles of the first and of the last layer have the tag. A few were pushed off the
            # wall.
            below = numpy.minimum(gap - 0.42, layers - 1 + 0.42 - gap)
            tagged = wall["tag"] == 1
            self.assertTrue(tagged[below < 0.01].all())
            self.assertLess(below[tagged].max(), 0.15)
            self.assertLess(numpy.count_nonzero(below[tagged] > 0.01), 0.05 * len(gap))
            # The area consists of strips along straight sides and of quarters of a disc at the
            # corners.
            thickness = (layers - 1 + 0.84) * d
            area = 4 * thickness + math.pi * thickness ** 2
            self.assertAlmostEqual(math.fsum(wall["volume"]), area, delta=1e-3 * area)
            self.assertAlmostEqual(sum((wall["spacing"] / 1.076) ** 2), area, delta=0.05 * area)
            ratios = wall["volume"] / d ** 2
            self.assertAlmostEqual(self.report["volumes"]["ratio"]["mean"], ratios.mean(),
                                   delta=1e-9)
        tagged = int(wall["tag"].sum())
        self.assertRegex(self.out, rf"(?m)^nodes +{len(gap)} particles, {tagged} of them in the "
                                   "first or last layer, in ")
        self.assertNotRegex(self.out, "(?m)^(edges|quality) ")

    def test_around_particles(self):
        for spacing in ("0.04", "0.02 + 0.05*hypot(x, y)", "0.02 + 0.02*dist"):
            inside = self.particles(self.square, spacing, "--nodes-at", "centers")
            self.check_apart(inside, self.particles(self.square, spacing, "--nodes-at", "walls"))

    def test_in_space(self):
        ask = "box(0,0,0, 1,0.8,0.6)", 0.15
        inside = self.particles(*ask, "--nodes-at", "centers")
        wall = self.particles(*ask, "--nodes-at", "walls", "--wall-layers", "2")
        self.check_apart(inside, wall)
        thickness = 1.92 * 0.15
        volume = (2 * (0.8 + 0.6 + 0.48) * thickness + math.pi * 2.4 * thickness ** 2
                  + 4 / 3 * math.pi * thickness ** 3)
        self.assertAlmostEqual(math.fsum(wall["volume"]), volume, delta=0.02 * volume)
        self.assertEqual(set(wall["tag"]), {1})

    def test_what_does_not_go_with_it(self):
        def refused(words, *arguments):
            message = self.refuse("--domain", self.square, *arguments, "-o", "a.csv")
            self.assertIn(words, message)

        walls = ("--spacing", "0.1", "--nodes-at", "walls")
        refused("--nodes-at walls needs d as a formula", *walls[2:], "--spacing", "auto")
        refused("--nodes-at walls takes d as given", *walls, "--nodes", "100")
        refused("--region", *walls, "--region", "0.5,0.5:3")
        for layers in ("1", "0", "-3", "2.5", "3x", "", "1001"):
            refused("--wall-layers: expected a number of layers from 2 to 1000", *walls,
                    "--wall-layers", layers)
        for others in ((), ("--nodes-at", "centers"), ("--nodes-at", "boundary")):
            refused("--wall-layers needs --nodes-at walls", "--spacing", "0.1", *others,
                    "--wall-layers", "3")
        _, err = self.run_command("--domain", "ball(0,0,0, 1)", *walls, "--surfaces-only",
                                  code=BAD_INPUT)
        self.assertIn("--nodes-at walls is for bodies", err.decode())


if __name__ == "__main__":
    unittest.main()
