# SPDX-License-Identifier: BSD-3-Clause
"""Tests --spacing-grid with grids that cover the domain or a part of it, and in formulas."""

import json
import re
import unittest

import numpy as np

from command import BAD_INPUT, DONE, NOT_CONVERGED, CommandTest

QUICK = ("--set", "steps=3")

# A grid with d from 0.05 in the west to 0.1 in the east of the unit square, and beyond it.
GRID = """\
ncols 4
nrows 4
xllcorner {x}
yllcorner {y}
cellsize {step}
0.05 0.06 0.08 0.1
0.05 0.06 0.08 0.1
0.05 0.06 0.08 0.1
0.05 0.06 0.08 0.1
"""


def grid(x=-0.1, y=-0.1, step=0.3):
    return GRID.format(x=x, y=y, step=step)


class GridsTest(CommandTest):
    def table(self, *arguments, codes=(DONE, NOT_CONVERGED, 4)):
        """Returns the nodes of a run, its report and its messages."""
        process = self.start(*arguments, *QUICK, "-o", "nodes.csv", "--report", "report.json")
        _, err = process.communicate()
        self.assertIn(process.returncode, codes, err.decode())
        table = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
        return table, json.loads((self.folder / "report.json").read_text()), err.decode()

    def on_square(self, *arguments):
        return self.table("--domain", self.square, *arguments)


class Coverage(GridsTest):
    def write(self, text, name="g.asc"):
        (self.folder / name).write_text(text)
        return name

    def test_formula_on_threads(self):
        """Each thread evaluates the formula with variables of its own."""
        (self.folder / "d.asc").write_text(grid())
        hashes, nodes = set(), 0
        for threads in 1, 4:
            _, report, _ = self.table("--domain", self.square, "--spacing-grid", "wide=d.asc",
                                      "--spacing", "0.05*wide + 0.01*hypot(x-0.5, y-0.5)",
                                      "--threads", threads)
            hashes.add(report["hash"])
            nodes = report["nodes"]
        self.assertGreater(nodes, 8000)  # so that batches are divided
        self.assertEqual(len(hashes), 1)

    def test_all_of_the_domain(self):
        _, report, err = self.on_square("--spacing-grid", self.write(grid()))
        self.assertNotIn("covers only", err)
        # The cells of this grid end at the boundary of the domain, which their centres therefore do
        # not reach.
        _, _, err = self.on_square("--spacing-grid", self.write(grid(0, 0, 0.25)))
        self.assertNotIn("covers only", err)
        self.assertFalse([w for w in report["warnings"] if "grid" in w])

    def test_spots_between_samples(self):
        """Checks that low values at single points of a fine grid have nodes around them, however
        few these points are."""
        size = 161
        values = np.full((size, size), 0.05)
        spots = [(37, 22), (90, 131), (121, 68)]
        for row, column in spots:
            values[row, column] = 0.002
        header = "ncols %d\nnrows %d\nxllcenter 0\nyllcenter 0\ncellsize %.9g\n" % (
            size, size, 1 / (size - 1))
        rows = "\n".join(" ".join("%g" % value for value in row) for row in values[::-1])
        table, _, err = self.on_square("--spacing-grid", self.write(header + rows + "\n"))
        self.assertIn("its growth is limited", err)
        for row, column in spots:
            away = np.hypot(table["x"] - column / (size - 1), table["y"] - row / (size - 1))
            self.assertGreater(np.count_nonzero(away < 0.01), 10)

    def test_a_part_of_the_domain(self):
        _, report, err = self.on_square("--spacing-grid", self.write(grid(-0.7, -0.1)))
        self.assertRegex(err, r"the grid of the spacing covers only a part of the domain: of [0-9]+ "
                              r"nodes, [0-9]+ are farther than d from it, one of them at \(.*The grid "
                              r"reaches from \(-0.7, -0.1\) to \(0.5, 1.1\), the domain from \(0, 0\) "
                              r"to \(1, 1\)")
        self.assertEqual(len([w for w in report["warnings"] if "covers only" in w]), 1)

    def test_gaps_of_a_grid_alone(self):
        """The library takes the grid with filled gaps, so it has no information about gaps."""
        gap = grid().replace("cellsize", "nodata_value -1\ncellsize").replace("0.06 0.08", "0.06 -1", 2)
        name = self.write(gap)
        for more in ((), ("--field", "g=2*grid")):
            _, _, err = self.on_square("--spacing-grid", name, *more)
            self.assertNotIn("gaps", err)  # each cell without data has a neighbour with data
        name = self.write(gap.replace("-1 0.1", "-1 -1"))
        for more in ((), ("--field", "g=2*grid")):
            table, report, err = self.on_square("--spacing-grid", name, *more)
            found = re.search(r"has gaps in the domain: of [0-9]+ nodes, ([0-9]+) lie", err)
            # Centres of cells are at -0.1 + 0.15 + 0.3 k. In the upper rows the last two have no
            # data.
            without = (table["x"] > 0.65) & (table["y"] > 0.65)
            self.assertEqual(int(found[1]), np.sum(without))
            self.assertIn(found[0], report["warnings"][-1])

    def test_none_of_the_domain(self):
        ask = ("--domain", self.square, "-o", "a.csv", "--spacing-grid")
        message = self.refuse(*ask, self.write(grid(5, 5)), code=BAD_INPUT)
        self.assertIn("--spacing-grid g.asc", message)
        self.assertIn("from (5, 5) to (6.2, 6.2)", message)
        self.assertIn("from (0, 0) to (1, 1): are they in its unit?", message)

    def test_degrees(self):
        (self.folder / "far.poly").write_text(
            "4 2 0 0\n1 500000 6000000\n2 510000 6000000\n3 510000 6010000\n4 500000 6010000\n"
            "4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n")
        message = self.refuse("--domain", "far.poly", "-o", "a.csv", "--spacing-grid",
                              self.write(grid(18, 54)))
        self.assertIn("look like longitude and latitude", message)
        message = self.refuse("--domain", "far.poly", "-o", "a.csv", "--spacing-grid",
                              "deep=" + self.write(grid(18, 54)), "--spacing", "deep")
        self.assertIn("look like longitude and latitude", message)


class Formulas(GridsTest):
    def setUp(self):
        super().setUp()
        (self.folder / "g.asc").write_text(grid())
        (self.folder / "two.asc").write_text("ncols 1\nnrows 1\nxllcenter 0\nyllcenter 0\n"
                                             "cellsize 1\n2\n")

    def test_one_grid(self):
        # d by a formula may differ in the last bit, which can decide the repair of symmetric
        # triangles. So repairs are off.
        plain = "--set", "smoothing_rounds=0"
        alone, *_ = self.on_square("--spacing-grid", "g.asc", *plain)
        for arguments in (("--spacing-grid", "g.asc", "--spacing", "grid"),
                          ("--spacing-grid", "h=g.asc", "--spacing", "h")):
            same, report, _ = self.on_square(*arguments, *plain)
            np.testing.assert_allclose(same["x"], alone["x"], atol=1e-9)
            self.assertEqual(report["spacing_grid"], arguments[1])

    def test_several_grids_with_the_shape(self):
        table, report, _ = self.on_square("--spacing-grid", "h=g.asc", "--spacing-grid",
                                          "k=two.asc", "--spacing", "min(h, 0.03*k + 0.1*dist(2))")
        self.assertEqual(report["spacing_grid"], ["h=g.asc", "k=two.asc"])
        x, y = table["x"], table["y"]
        at = np.clip((x + 0.1) / 0.3 - 0.5, 0, 3)
        h = np.interp(at, range(4), [0.05, 0.06, 0.08, 0.1])
        # The distance to the hole, which is 0.4 .. 0.6 in the square and has tag 2.
        dist = np.hypot(np.maximum(abs(x - 0.5) - 0.1, 0), np.maximum(abs(y - 0.5) - 0.1, 0))
        np.testing.assert_allclose(table["spacing"], np.minimum(h, 0.06 + 0.1 * dist), rtol=0.03)

    def test_slopes(self):
        """Checks slopes of 3 x - 4 y and of squares, which are interpolated linearly between cell
        centres."""
        x, y = np.meshgrid(np.arange(-0.05, 1.06, 0.1), np.arange(1.05, -0.06, -0.1))
        self.write_values("plane.asc", 3 * x - 4 * y)
        self.write_values("squares.asc", x**2)
        table, *_ = self.on_square("--spacing-grid", "h=plane.asc", "--spacing", "h_slope * 0.01")
        np.testing.assert_allclose(table["spacing"], 0.05, rtol=1e-6)
        table, *_ = self.on_square("--spacing-grid", "h=squares.asc", "--spacing-grid", "k=plane.asc", "--spacing",
                                   "0.05 + 0.02*h_slope + 0*k + 0*k_slope", "--set", "growth_limit=0")
        middle = 0.1 * np.floor((table["x"] + 0.05) / 0.1)  # middle between two cell centres
        inside = abs(table["x"] - middle) < 0.04
        np.testing.assert_allclose(table["spacing"][inside], 0.05 + 0.04 * middle[inside], rtol=1e-6)
        message = self.refuse("--domain", self.square, "-o", "a.csv", "--spacing-grid", "h=plane.asc", "--spacing",
                              "h_slopes + h")
        self.assertIn("unknown name 'h_slopes'", message)

    def write_values(self, name, values, west=-0.1, south=-0.1, step=0.1):
        rows = "\n".join(" ".join(repr(float(value)) for value in row) for row in values)
        (self.folder / name).write_text(f"ncols {values.shape[1]}\nnrows {values.shape[0]}\nxllcorner {west}\n"
                                        f"yllcorner {south}\ncellsize {step}\n{rows}\n")

    def test_slopes_along_a_sphere(self):
        lon, lat = np.meshgrid(np.arange(-179, 180, 2.0), np.arange(89, -90, -2.0))
        self.write_values("north.asc", 5 * lat, -179, -89, 2)
        self.write_values("east.asc", np.abs(lon), -179, -89, 2)
        degree = 10 * np.pi / 180  # length of a degree
        ask = ("--sphere", "10,20,-30", "--set", "growth_limit=0", "--spacing-grid")
        table, *_ = self.table(*ask, "a=north.asc", "--spacing", "abs(lat) > 88 ? 1 : 0.035*a_slope")
        inside = abs(table["z"]) < 10 * np.sin(np.radians(87))
        np.testing.assert_allclose(table["spacing"][inside], 0.035 * 5 / degree, rtol=1e-6)
        table, *_ = self.table(*ask, "b=east.asc", "--spacing",
                               "abs(lat) > 60 ? 0.9 : max(0.9, 0.17*b_slope*cos(pi*lat/180))")
        lat, lon = np.degrees(np.arcsin(table["z"] / 10)), np.degrees(np.arctan2(table["y"], table["x"]))
        inside = (abs(lat) < 59) & (abs(lon) > 2) & (abs(lon) < 178)
        self.assertGreater(inside.sum(), 100)
        np.testing.assert_allclose(table["spacing"][inside], 0.17 / degree, rtol=1e-6)

    def test_warns_of_a_part(self):
        (self.folder / "part.asc").write_text(grid(-0.7, -0.1))
        _, report, err = self.on_square("--spacing-grid", "h=part.asc", "--spacing", "h + 0")
        self.assertRegex(err, r"the grid 'h' \(part.asc\) covers only a part of the domain: of "
                              r"[0-9]+ nodes, [0-9]+ lie beyond its edge")
        self.assertIn(report["warnings"][-1], err)

    def test_what_is_refused(self):
        ask = ("--domain", self.square, "-o", "a.csv", "--spacing-grid")
        for more, word in (
                (("g.asc", "--spacing", "0.1"), "does not use 'grid'"),
                (("x=g.asc", "--spacing", "x"), "'x' means something else"),
                (("g.asc", "--spacing-grid", "two.asc", "--spacing", "grid"), "given twice"),
                (("g.asc", "--spacing-grid", "h=two.asc"), "--spacing"),
                (("g.asc", "--spacing", "auto"), "exclude"),
                (("h=", "--spacing", "h"), "NAME=FILE"),
                (("h=none.asc", "--spacing", "h"), "none.asc")):
            self.assertIn(word, self.refuse(*ask, *more))
        self.assertIn("would overwrite", self.refuse("--domain", self.square, "--spacing-grid",
                                                   "h=g.asc", "--spacing", "h", "-o", "g.asc",
                                                   "--format", "csv"))

    def test_in_space(self):
        (self.folder / "l.asc").write_text("ncols 1\nnrows 1\nnlayers 2\nxllcenter 0\nyllcenter 0\n"
                                           "zllcenter 0\ncellsize 1\n0.2\n0.4\n")
        table, *_ = self.table("--domain", "box(0,0,0, 1,1,1)", "--spacing-grid", "l.asc",
                               "--spacing", "grid + 0*x")
        np.testing.assert_allclose(table["spacing"], 0.2 + 0.2 * table["z"], rtol=0.05)


class Groups(GridsTest):
    def test_distances_by_name(self):
        ask = ("--name", "2=the hole", "--name", "1=outside", "--nodes-only")
        first, *_ = self.on_square(*ask, "--spacing", "0.05 + 0.2*dist(2)")
        for name in ("'the hole'", '"the hole"'):
            same, *_ = self.on_square(*ask, "--spacing", f"0.05 + 0.2*dist({name})")
            np.testing.assert_array_equal(first["x"], same["x"])
        outside, *_ = self.on_square(*ask, "--spacing", "0.05 + 0.2*dist(outside)")
        self.assertGreater(np.mean(outside["spacing"] > 0.1), 0.05)
        self.assertNotEqual(len(outside), len(first))

    def test_distances_to_several_groups(self):
        """Compares dist(A, B) with the least of dist(A) and dist(B), and with dist, because the two
        groups are the whole boundary."""
        ask = ("--name", "2=the hole", "--name", "1=outside", "--nodes-only")
        both, *_ = self.on_square(*ask, "--spacing", "0.05 + 0.2*min(dist(1), dist(2))")
        for several in ("dist(1, 2)", "dist('the hole', outside)", "dist( outside ,2 )", "dist(2, 1, 2)", "dist"):
            with self.subTest(several):
                same, *_ = self.on_square(*ask, "--spacing", f"0.05 + 0.2*{several}")
                np.testing.assert_array_equal(both["x"], same["x"])

    def test_names_that_are_none(self):
        ask = ("--domain", self.square, "-o", "a.csv", "--name", "2=hole", "--spacing")
        for call in ("dist(hle, hole)", "dist(hole, 'hle')"):
            self.assertIn("dist(hle): the domain has no group of that name", self.refuse(*ask, f"0.1 + {call}"))
        self.refuse(*ask, "0.1 + dist()")
        message = self.refuse(*ask, "0.1 + dist(hle)")
        self.assertIn("dist(hle): the domain has no group of that name; did you mean hole?", message)
        self.assertIn("unknown name 'hole'", self.refuse(*ask, "0.1 + hole"))


if __name__ == "__main__":
    unittest.main()
