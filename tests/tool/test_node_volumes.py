# SPDX-License-Identifier: BSD-3-Clause
"""Tests --volumes: the volume of each node, in files, in the report and in the summary."""

import json
import math
import unittest

import meshio
import numpy

from command import NOT_CONFORMING, SQUARE_AREA, CommandTest
from readers import point_array, read_csv, read_with_vtk

CUBE = "box(0,0,0, 1,1,1)"

# A cube without its lid.
OPEN_BOX = """\
OFF
8 5 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 0 3 2 1
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""


class NodeVolumes(CommandTest):
    def place_with_volumes(self, domain, spacing, *arguments, **more):
        """Returns the table of nodes, the report, and the summary."""
        out, _ = self.run_command("--domain", domain, "--spacing", spacing, "--volumes",
                                  "-o", "a.csv", "--report", "a.json", *arguments, **more)
        report = json.loads((self.folder / "a.json").read_text())
        return read_csv(self.folder / "a.csv"), report, out.decode()

    def check_figures(self, table, report, dimension):
        """Checks the statistics. Sums are rounded once, from the exact sum."""
        ratios = table["volume"] / numpy.prod([table["spacing"]] * dimension, axis=0)
        self.assertEqual(report["volumes"], {
            "total": math.fsum(table["volume"]),
            "ratio": {"mean": math.fsum(ratios) / len(ratios), "min": ratios.min(),
                      "max": ratios.max()}})

    # There are more nodes than are written at a time.
    def test_in_the_plane(self):
        table, report, out = self.place_with_volumes(self.square, "0.003 + 0.01*x")
        self.assertGreater(len(table["id"]), 3 * 8192)
        self.assertEqual(list(table), ["id", "x", "y", "tag", "spacing", "volume"])
        self.assertAlmostEqual(math.fsum(table["volume"]), SQUARE_AREA, delta=1e-12)
        self.check_figures(table, report, 2)
        # Inner nodes have the area of a node of the triangular lattice.
        inside = table["tag"] == 0
        ratios = (table["volume"] / table["spacing"] ** 2)[inside]
        self.assertAlmostEqual(numpy.median(ratios), math.sqrt(3) / 2, delta=0.05)
        self.assertRegex(out, r"(?m)^volumes  0\.96 in all; of a node 0\.\d+ d\^2 in the mean, "
                              r"0\.\d+ to 1\.\d+ d\^2$")

    def test_in_space(self):
        table, report, out = self.place_with_volumes(CUBE, "0.1 + 0.05*x")
        self.assertAlmostEqual(math.fsum(table["volume"]), 1, delta=1e-12)
        self.check_figures(table, report, 3)
        self.assertRegex(out, r"(?m)^volumes  1 in all; of a node 0\.\d+ d\^3 in the mean, ")

    def test_on_surfaces(self):
        (self.folder / "open.off").write_text(OPEN_BOX)
        table, report, out = self.place_with_volumes("open.off", "0.1", "--surfaces-only")
        self.assertAlmostEqual(math.fsum(table["volume"]), 5, delta=1e-11)
        self.check_figures(table, report, 2)
        self.assertRegex(out, r"(?m)^volumes  5 in all; of a node 0\.\d+ d\^2 in the mean, ")

    def test_in_all_formats_that_have_fields(self):
        table, _, _ = self.place_with_volumes(self.square, "0.1", "-o", "a.vtu", "-o", "a.msh",
                                              "-o", "a.node", "--nodes-only")
        grid = read_with_vtk(self.folder / "a.vtu")
        numpy.testing.assert_array_equal(point_array(grid, "volume"), table["volume"])
        mesh = meshio.read(self.folder / "a.msh", "gmsh")
        found = {tuple(x): v for x, v in zip(mesh.points.tolist(), mesh.point_data["volume"])}
        for x, y, volume in zip(table["x"], table["y"], table["volume"]):
            self.assertEqual(found[x, y, 0], volume)
        nodes = (self.folder / "a.node").read_bytes()
        out, _ = self.place("-o", "a.node", "-o", "a.csv", "--report", "a.json", spacing="0.1")
        self.assertEqual((self.folder / "a.node").read_bytes(), nodes)
        # Volumes are written on request only.
        self.assertNotIn("volume", read_csv(self.folder / "a.csv"))
        self.assertNotIn("volumes", json.loads((self.folder / "a.json").read_text()))
        self.assertNotIn(b"volumes", out)

    # d is so large that there are neither elements nor nodes.
    def test_without_elements(self):
        out, _ = self.run_command("--domain", "ball(0,0,0, 1)", "--spacing", "5", "--volumes",
                                  "--set", "conforming_rounds=0", "-o", "a.csv", "--report",
                                  "a.json", code=NOT_CONFORMING)
        self.assertEqual((self.folder / "a.csv").read_text(), "id,x,y,z,tag,spacing,volume\n")
        self.assertEqual(json.loads((self.folder / "a.json").read_text())["volumes"],
                         {"total": 0, "ratio": {"mean": None, "min": None, "max": None}})
        self.assertRegex(out.decode(), r"(?m)^volumes  0 in all$")


if __name__ == "__main__":
    unittest.main()
