# SPDX-License-Identifier: BSD-3-Clause
"""Tests --field: values of formulas at nodes, in files, against numpy at the same points."""

import json
import unittest

import numpy as np

from command import CommandTest
from readers import point_array, read_csv, read_with_vtk

QUIET = "--quiet"
RAMP = """ncols 4
nrows 2
xllcorner -1.5
yllcorner -0.5
cellsize 1
{0} {1} {2} {3}
{0} {1} {2} {3}
"""


class NodeFields(CommandTest):
    def table(self, *arguments, domain=None, spacing="0.1"):
        where = ("--domain", domain or self.square) if domain != "" else ()
        self.run_command(*where, "--spacing", spacing, "-o", "a.csv", QUIET, *arguments)
        return read_csv(self.folder / "a.csv")

    def lines_of(self, name):
        lines = (self.folder / name).read_text().splitlines()
        return [line.split() for line in lines]

    def test_in_files(self):
        table = self.table("--field", "depth=20 + 3*x*y", "--field", "u = sin(x)", "-o", "a.vtu",
                           "-o", "a.gr3", "-o", "a.2dm", "--report", "a.json")
        depth = 20 + 3 * table["x"] * table["y"]
        self.assertEqual(list(table)[-2:], ["depth", "u"])
        np.testing.assert_array_equal(table["depth"], depth)
        np.testing.assert_allclose(table["u"], np.sin(table["x"]), rtol=1e-15)
        np.testing.assert_array_equal(point_array(read_with_vtk(self.folder / "a.vtu"), "depth"),
                                      depth)
        gr3 = self.lines_of("a.gr3")[2:2 + len(depth)]
        np.testing.assert_array_equal([float(line[3]) for line in gr3], depth)
        nodes = [line for line in self.lines_of("a.2dm") if line[0] == "ND"]
        np.testing.assert_array_equal([float(line[4]) for line in nodes], -depth)
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual(report["fields"], ["depth=20 + 3*x*y", "u = sin(x)"])

    def test_of_the_shape_and_of_grids(self):
        (self.folder / "h.asc").write_text(RAMP.format(3, 5, 7, 9))
        grid = ("--spacing-grid", "h=h.asc")
        # The spacing may be given in any way. A grid that only the formula of a field uses counts
        # as used.
        for spacing in ("0.1", "auto", "0.09 + 0.001*h"):
            more = ("--max-spacing", "0.1") if spacing == "auto" else ()
            table = self.table(*grid, "--field", "b=-h", "--field", "slope=h_slope", "--field",
                               "off=dist", *more, spacing=spacing)
            np.testing.assert_allclose(table["b"], -5 - 2 * table["x"], rtol=1e-14)
            np.testing.assert_allclose(table["slope"], 2, rtol=1e-9)
            boundary = table["tag"] != 0
            self.assertLess(abs(table["off"][boundary]).max(), 1e-14)
            self.assertGreater(table["off"][~boundary].min(), 0.01)
        # A grid can be the spacing itself and still be used by its name in formulas.
        (self.folder / "d.asc").write_text(RAMP.format(0.08, 0.1, 0.12, 0.14))
        self.run_command("--domain", self.square, "--spacing-grid", "d.asc", "--field", "g=2*grid",
                         "-o", "a.csv", QUIET)
        table = read_csv(self.folder / "a.csv")
        np.testing.assert_allclose(table["g"], 0.2 + 0.04 * table["x"], rtol=1e-14)

    def test_of_the_shape_in_a_branch(self):
        """Checks a formula that needs the shape in one branch only. Points in the other branch,
        such as the origin, do not evaluate it."""
        table = self.table("--field", "a=x > 0.5 ? dist(1) : -1", "--field",
                           "b=x > 0.5 && gap(2) < 0.215 ? 1 : 0", "--field", "gap=gap(2)")
        x, y = table["x"], table["y"]
        outside = np.minimum.reduce([x, 1 - x, y, 1 - y])
        np.testing.assert_allclose(table["a"], np.where(x > 0.5, outside, -1), atol=1e-14)
        np.testing.assert_array_equal(table["b"], (x > 0.5) & (table["gap"] < 0.215))
        self.assertTrue(0 < sum(table["b"]) < sum(x > 0.5))

    def test_on_a_sphere(self):
        table = self.table("--sphere", "2", "--field", "a=lat", "--field", "b=lon", domain="",
                           spacing="0.3")
        x, y, z = (table[name] for name in "xyz")
        np.testing.assert_allclose(table["a"], np.degrees(np.arcsin(z / 2)), atol=1e-9)
        np.testing.assert_allclose(table["b"], np.degrees(np.arctan2(y, x)), atol=1e-9)

    def test_of_particles(self):
        table = self.table("--nodes-at", "centers", "--field", "t=300 + x")
        np.testing.assert_array_equal(table["t"], 300 + table["x"])
        table = self.table("--field", "t=x*z", domain="box(0,0,0, 1,1,1)", spacing="0.3")
        np.testing.assert_array_equal(table["t"], table["x"] * table["z"])

    def test_what_is_refused(self):
        (self.folder / "h.asc").write_text(RAMP.format(3, 5, 7, 9))
        for more, words in (
                (("--field", "x"), "expected NAME=FORMULA, found 'x'"),
                (("--field", "=x"), "expected NAME=FORMULA"),
                (("--field", "a=x", "--field", "a=y"), "--field: 'a' is given twice"),
                (("--field", "mesh_edge=x"), "--field: files have 'mesh_edge' already"),
                (("--field", "-a=x"), "--field: '-a' begins with no letter"),
                (("--field", "x=y"), "--field: files have 'x' already"),
                (("--field", "volume=y", "--volumes"), "--field: files have 'volume' already"),
                (("--field", "mass=y", "--density", "2"), "--field: files have 'mass' already"),
                (("--field", "spacing=x"), '--field spacing: argument name = "spacing"'),
                (("--field", "a b=x"), "--field a b: argument name"),
                (("--field", "a=x + q"), "--field a, position 5: unknown name 'q'"),
                (("--field", "a=dist(0.5)"), "--field a: dist(0.5): expected a tag"),
                (("--field", "a=dist(hole)"), "--field a: dist(hole): the domain has no group"),
                (("--field", "a=1/dist"), "--field a: expected finite values, found inf at (0, 0)"),
                (("--spacing-grid", "h=h.asc", "--field", "a=x"),
                 "--spacing-grid: no formula of --spacing, --field and --open-boundary uses 'h'")):
            with self.subTest(more):
                # The error comes before the run, which would take long.
                message = self.refuse("--domain", self.square, "--spacing", "0.004", *more)
                self.assertIn(words, message)


if __name__ == "__main__":
    unittest.main()
