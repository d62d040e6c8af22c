# SPDX-License-Identifier: BSD-3-Clause
"""Tests --density: masses of nodes and particles, in files, in the report and in the summary."""

import json
import math
import unittest

import numpy

from command import SQUARE_AREA, CommandTest
from readers import point_array, read_csv, read_with_vtk


class Masses(CommandTest):
    def masses(self, density, *arguments, domain=None, spacing="0.05", **more):
        """Returns the table of nodes, the report, and the summary."""
        out, _ = self.run_command("--domain", domain or self.square, "--spacing", spacing,
                                  "--density", density, "-o", "a.csv", "--report", "a.json",
                                  *arguments, **more)
        report = json.loads((self.folder / "a.json").read_text())
        return read_csv(self.folder / "a.csv"), report, out.decode()

    def test_of_particles(self):
        table, report, out = self.masses("1000 + 500*x", "--nodes-at", "centers", "-o", "a.vtu")
        self.assertEqual(list(table), ["id", "x", "y", "tag", "spacing", "volume", "density",
                                       "mass"])
        numpy.testing.assert_array_equal(table["density"], 1000 + 500 * table["x"])
        numpy.testing.assert_array_equal(table["mass"], table["density"] * table["volume"])
        self.assertEqual(report["density"], "1000 + 500*x")
        self.assertEqual(report["mass"], math.fsum(table["mass"]))
        # By symmetry the mean density is that at the centre.
        self.assertAlmostEqual(report["mass"], 1250 * SQUARE_AREA, delta=0.5)
        self.assertRegex(out, r"(?m)^mass     1200 in all$")
        grid = read_with_vtk(self.folder / "a.vtu")
        for name in ("density", "mass"):
            numpy.testing.assert_array_equal(point_array(grid, name), table[name])

    def test_of_nodes(self):
        table, report, _ = self.masses("2.5")
        self.assertEqual(set(table["density"]), {2.5})
        self.assertAlmostEqual(report["mass"], 2.5 * SQUARE_AREA, delta=1e-12)
        self.assertEqual(report["volumes"]["total"], math.fsum(table["volume"]))

    def test_in_space(self):
        for places in ((), ("--nodes-at", "centers"), ("--nodes-at", "walls")):
            table, report, _ = self.masses("1 + z", *places, domain="box(0,0,0, 1,1,1)",
                                           spacing="0.25")
            numpy.testing.assert_array_equal(table["density"], 1 + table["z"])
            self.assertEqual(report["mass"], math.fsum((1 + table["z"]) * table["volume"]))

    def test_on_surfaces(self):
        _, report, _ = self.masses("3", "--surfaces-only", domain="box(0,0,0, 1,1,1)",
                                   spacing="0.25")
        self.assertAlmostEqual(report["mass"], 18, delta=1e-11)

    def test_none_without_it(self):
        out, _ = self.run_command("--domain", self.square, "--spacing", "0.1", "--volumes",
                                  "--report", "a.json")
        report = json.loads((self.folder / "a.json").read_text())
        self.assertFalse({"mass", "density"} & set(report))
        self.assertNotIn(b"mass", out)

    def refused(self, density, *arguments, spacing="0.1"):
        return self.refuse("--domain", self.square, "--spacing", spacing, "--density", density,
                           "-o", "a.csv", *arguments)

    # Invalid numbers are rejected before the run, which would take hours.
    def test_numbers_that_are_no_densities(self):
        for density, found in (("-3", "-3"), ("0", "0"), ("0/0", "-?nan"), ("1/0", "inf")):
            for nodes_at in ("boundary", "centers"):
                message = self.refused(density, "--nodes-at", nodes_at, spacing="1e-5")
                self.assertRegex(message, "--density: expected a number greater than 0, found "
                                          rf"{found}$")

    def test_formulas_that_are_no_densities(self):
        for density, found in (("x - 0.5", r"(-[\d.e-]+|0)"), ("sqrt(y - 0.1)", "-?nan")):
            message = self.refused(density)
            self.assertRegex(message, rf"found {found} at \([\d.e-]+, [\d.e-]+\)$")
        # This formula is invalid only at the final nodes, not at the initial ones.
        self.assertIn(" at (", self.refused("x < 1e-6 ? 1 : (rint(1e4*x) == 1e4*x ? 1 : 0)"))

    def test_what_is_no_formula(self):
        self.assertIn("--density, position 3: unknown name 'q'", self.refused("2*q"))
        self.assertIn("--density, position 1: unknown name 'z'", self.refused("z"))
        self.assertIn("--density", self.refused(""))


if __name__ == "__main__":
    unittest.main()
