# SPDX-License-Identifier: BSD-3-Clause
"""Tests shores that are finer than d: corners by angle, and simplification."""

import json
import unittest

import meshio

from command import DATA, CommandTest

ISLANDS = DATA / "great_lakes_islands.poly"


class Shores(CommandTest):
    def report(self, *arguments, spacing="10"):
        self.run_command("--domain", ISLANDS, "--spacing", spacing, "--steps", "40", "--report",
                         "report.json", "--quiet", "--check", "--set", "tolerance_mean=1",
                         *arguments)
        report = json.loads((self.folder / "report.json").read_text())
        left_out = [text for text in report["warnings"] if text.startswith("simplified: ")]
        return report, left_out

    def test_simplify(self):
        given, none = self.report()
        self.assertEqual(none, [])
        simpler, told = self.report("--simplify", "0.25")
        self.assertRegex(told[0], r"simplified: [0-9]+ vertices were left out$")
        self.assertLess(simpler["boundary_nodes"], 0.75 * given["boundary_nodes"])
        bare, told = self.report("--simplify", "0.25,2", "--corner-angle", "40")
        self.assertRegex(told[0], "of [1-9][0-9]+ closed curves")
        self.assertLess(bare["boundary_nodes"], 0.75 * simpler["boundary_nodes"])

    def test_where_d_is_a_grid_or_asks_for_the_shape(self):
        grid = self.folder / "grid.asc"
        grid.write_text("ncols 2\nnrows 2\nxllcenter -900\nyllcenter -600\ndx 1800\ndy 1200\n"
                        "10 10\n10 10\n")
        by_number = self.report("--simplify", "0.25")
        self.run_command("--domain", ISLANDS, "--spacing-grid", grid, "--steps", "40", "--report",
                         "report.json", "--quiet", "--set", "tolerance_mean=1", "--simplify", "0.25")
        by_grid = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(by_grid["boundary_nodes"], by_number[0]["boundary_nodes"])
        self.assertIn(by_number[1][0], by_grid["warnings"])
        self.assertEqual(self.report("--simplify", "0.25", spacing="10 + 0*dist")[1], by_number[1])

    def test_where_d_is_from_a_file(self):
        """Checks that a mesh and scattered points with the same d simplify the shore like the
        formula."""
        by_formula = self.report("--simplify", "0.25,2", spacing="10 + 0.005*x")
        points = [(x, y) for y in (-600, 600) for x in (-900, 900)]
        (self.folder / "d.csv").write_text(
            "x,y,d\n" + "".join(f"{x},{y},{10 + 0.005 * x}\n" for x, y in points))
        self.assertRegex(self.report("--simplify", "0.25,2", spacing="d.csv")[1][0], "simplified")
        meshio.Mesh([(x, y, 0) for x, y in points], [("triangle", [(0, 1, 2), (1, 3, 2)])],
                    point_data={"d": [10 + 0.005 * x for x, y in points], "other": [1.0, 2.0, 3.0, 4.0]}
                    ).write(self.folder / "d.vtu")
        by_mesh = self.report("--simplify", "0.25,2", spacing="d.vtu:d")
        self.assertEqual(by_mesh[1], by_formula[1])
        self.assertEqual(by_mesh[0]["boundary_nodes"], by_formula[0]["boundary_nodes"])
        for spacing, words in (("d.vtu", "other"), ("none.csv", "none.csv")):
            self.assertIn(words, self.refuse("--domain", ISLANDS, "--spacing", spacing,
                                             "--simplify", "0.25"))

    def test_corner_angle(self):
        given, _ = self.report()
        smooth, _ = self.report("--corner-angle", "60")
        self.assertLess(smooth["boundary_nodes"], given["boundary_nodes"])

    def test_bad_arguments(self):
        ask = ("--domain", ISLANDS, "--spacing", "10")
        for wrong in ("-1", "x", "", "0.1,-2", "1,2,3", "nan"):
            with self.subTest(wrong):
                self.assertIn("--simplify: expected", self.refuse(*ask, "--simplify", wrong))
        self.assertIn("--corner-angle: expected", self.refuse(*ask, "--corner-angle", "181"))
        self.assertIn("--simplify needs d", self.refuse("--domain", ISLANDS, "--spacing", "auto",
                                                        "--simplify", "0.25"))
        self.assertIn("--nodes multiplies", self.refuse(*ask, "--nodes", "1000",
                                                        "--simplify", "0.25"))
        for bound in ("--min-spacing", "--max-spacing"):
            self.assertIn("would not hold", self.refuse("--domain", ISLANDS, "--spacing", "auto",
                                                        "--nodes", "1000", bound, "5"))
        body = ("--domain", "ball(0,0,0, 1)", "--spacing", "0.3")
        self.assertIn("plane", self.refuse(*body, "--simplify", "0.25"))
        self.assertIn("--feature-angle", self.refuse(*body, "--corner-angle", "30"))


if __name__ == "__main__":
    unittest.main()
