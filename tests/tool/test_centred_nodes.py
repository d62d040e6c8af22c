# SPDX-License-Identifier: BSD-3-Clause
"""Tests --nodes-at centers: particles that fill the domain."""

import json
import math
import unittest

import numpy

from command import BAD_INPUT, DATA, SQUARE_AREA, CommandTest
from readers import read_csv, read_with_vtk


def gap_to_square(x, y):
    """Returns the distance from inner points to the boundary of the square with its hole."""
    outside = numpy.minimum.reduce([x, 1 - x, y, 1 - y])
    hole = numpy.hypot(numpy.maximum(abs(x - 0.5) - 0.1, 0), numpy.maximum(abs(y - 0.5) - 0.1, 0))
    return numpy.minimum(outside, hole)


class CentredNodes(CommandTest):
    def place_at_centres(self, *arguments, domain=None, spacing, **more):
        out, _ = self.run_command("--domain", domain or self.square, "--spacing", spacing,
                                  "--nodes-at", "centers", "-o", "a.csv", "--report", "a.json",
                                  *arguments, **more)
        return (read_csv(self.folder / "a.csv"),
                json.loads((self.folder / "a.json").read_text()), out.decode())

    def test_in_the_plane(self):
        for spacing in ("0.03", "0.015 + 0.03*hypot(x, y)", "0.02 + 0.1*dist"):
            table, report, _ = self.place_at_centres(spacing=spacing)
            d = table["spacing"] / 1.076
            self.assertAlmostEqual(sum(d ** 2), SQUARE_AREA, delta=0.02 * SQUARE_AREA)
            self.assertAlmostEqual(math.fsum(table["volume"]), SQUARE_AREA, delta=1e-12)
            gap = gap_to_square(table["x"], table["y"]) / d
            # The chords of the arcs about the corners of the hole cut off a little.
            self.assertAlmostEqual(gap.min(), 0.42, delta=0.01)
            ratios = table["volume"] / d ** 2
            self.assertAlmostEqual(report["volumes"]["ratio"]["mean"], ratios.mean(), delta=1e-12)
            self.assertLess(abs(ratios.mean() - 1), 0.02)

    def test_in_space(self):
        table, report, out = self.place_at_centres(domain="box(0,0,0, 2,1,1)", spacing="0.1")
        d = 0.1
        self.assertAlmostEqual(len(table["id"]) * d ** 3, 2, delta=0.06)
        self.assertAlmostEqual(math.fsum(table["volume"]), 2, delta=1e-12)
        gaps = [table["x"], 2 - table["x"], table["y"], 1 - table["y"], table["z"], 1 - table["z"]]
        self.assertAlmostEqual(numpy.min(gaps), 0.46 * d, delta=1e-6)
        self.assertRegex(out, r"(?m)^body     2 x 1 x 1, volume 2$")
        outermost = f"{numpy.count_nonzero(table['tag']):,} of them outermost".replace(",", " ")
        self.assertIn(outermost, out)
        self.assertNotRegex(out, "(?m)^(edges|quality) ")
        self.assertLess(abs(report["volumes"]["ratio"]["mean"] - 1), 0.03)

    # At this d the elements of the bracket have small angles. They matter only for nodes at the
    # boundary.
    def test_in_a_bracket(self):
        for nodes_at, warned in (("centers", False), ("boundary", True)):
            _, err = self.run_command("--domain", DATA / "bracket.stl", "--spacing", "7",
                                      "--nodes-at", nodes_at, "-o", "a.csv", "--set",
                                      "conforming_rounds=0", "--set", "min_angle=10")
            self.assertEqual("dihedral angles below" in err.decode(), warned)

    def test_no_elements_are_written(self):
        self.place_at_centres("-o", "a.vtu", spacing="0.1")
        grid = read_with_vtk(self.folder / "a.vtu")
        self.assertTrue(all(grid.GetCell(c).GetNumberOfPoints() == 1
                            for c in range(grid.GetNumberOfCells())))
        self.assertFalse((self.folder / "a_facets.vtu").exists())

    def test_on_a_grid(self):
        (self.folder / "d.asc").write_text("ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\n"
                                           "cellsize 1\n0.02 0.04\n0.02 0.04\n")
        out, _ = self.run_command("--domain", self.square, "--spacing-grid", "d.asc", "--nodes-at",
                                  "centers", "-o", "a.csv")
        table = read_csv(self.folder / "a.csv")
        d = 0.02 + 0.02 * table["x"]
        # d of the nodes, some of which were pushed to where d differs.
        numpy.testing.assert_allclose(table["spacing"], 1.076 * d, rtol=0.01)
        self.assertAlmostEqual(sum(d ** 2), SQUARE_AREA, delta=0.03 * SQUARE_AREA)

    def test_repairs_are_reported(self):
        rows = (DATA / "kleopatra.obj").read_text().splitlines()
        (self.folder / "open.obj").write_text("\n".join(rows[:-40]) + "\n")
        _, report, _ = self.place_at_centres("--repair", "8", domain="open.obj", spacing="16")
        self.assertEqual(report["repaired"]["resolution"], 8)
        self.assertGreater(report["repaired"]["hole_distance"], 0)
        self.assertEqual(sum("repaired, with a resolution of 8" in text
                             for text in report["warnings"]), 1)

    def test_what_does_not_go_with_it(self):
        def refused(words, *arguments, code=BAD_INPUT):
            _, err = self.run_command(*arguments, "--nodes-at", "centers", "-o", "a.csv", code=code)
            self.assertIn(words, err.decode())

        plane = ("--domain", self.square)
        ball = ("--domain", "ball(0,0,0, 1)", "--spacing", "0.3")
        refused("needs d as a formula", *plane, "--spacing", "auto")
        refused("--nodes cannot scale it", *plane, "--spacing", "0.1", "--nodes", "100")
        refused("--surfaces-only", *ball, "--surfaces-only")
        refused("give the resolution", *ball, "--repair", "auto")
        refused("--region", *plane, "--spacing", "0.1", "--region", "0.1,0.1:3")
        refused("cannot contain particles", *plane, "--spacing", "0.1", "-o", "a.pvtu")
        refused("negative at none", *plane, "--spacing", "3")
        _, err = self.run_command(*plane, "--spacing", "1", "--nodes-at", "corners", code=BAD_INPUT)
        self.assertIn("known: boundary, centers, walls", err.decode())


if __name__ == "__main__":
    unittest.main()
