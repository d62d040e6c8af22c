# SPDX-License-Identifier: BSD-3-Clause
"""Tests the option that splits triangles with all nodes on the boundary, and their count."""

import json
import math
import os
import unittest

import meshio
import numpy

from builds import exists_if
from command import DATA, LAKE, MPIEXEC, CommandTest


def poly(rings, lines=()):
    """Returns the text of a .poly with these closed rings and open lines."""
    vertices, segments = [], []
    for points, closed in [*((ring, True) for ring in rings), *((line, False) for line in lines)]:
        first = len(vertices)
        for k, point in enumerate(points):
            if point not in vertices[:first]:
                vertices.append(point)
        index = [vertices.index(point) + 1 for point in points]
        segments += zip(index, index[1:] + index[:1] if closed else index[1:])
    return "".join(
        [f"{len(vertices)} 2 0 0\n", *(f"{k + 1} {x} {y}\n" for k, (x, y) in enumerate(vertices)),
         f"{len(segments)} 0\n", *(f"{k + 1} {a} {b}\n" for k, (a, b) in enumerate(segments)), "0\n"])


def channel():
    """Returns the outline of a bent channel that is 0.9 wide."""
    low = [(0.5 * k, 0.3 * math.sin(0.4 * k)) for k in range(61)]
    return low + [(x, y + 0.9) for x, y in reversed(low)]


class ElementsOnBoundary(CommandTest):
    def placed(self, domain, spacing, split, *arguments, ranks=None):
        """Runs the command. Returns the mesh and the report."""
        arguments = ("--domain", domain, "--spacing", spacing, "-o", "a.vtu", "--report", "a.json",
                     "--set", f"split_elements_on_boundary={split}", *arguments)
        if ranks:
            self.run_on_ranks(*arguments, ranks=ranks)
        else:
            self.run_command(*arguments, "-q", "--check")
        return meshio.read(self.folder / "a.vtu"), json.loads((self.folder / "a.json").read_text())

    def count(self, mesh):
        """Returns the number of triangles whose nodes all belong to an edge of one triangle."""
        triangles = mesh.cells_dict["triangle"]
        edges = numpy.sort(numpy.vstack([triangles[:, (k, (k + 1) % 3)] for k in range(3)]))
        edges, counts = numpy.unique(edges, axis=0, return_counts=True)
        on_boundary = numpy.zeros(len(mesh.points), bool)
        on_boundary[edges[counts == 1]] = True
        return int(on_boundary[triangles].all(axis=1).sum())

    def check(self, domain, spacing, *arguments, least=1, left=0):
        """Checks the counts with and without the option, and that nodes were only inserted."""
        before, report = self.placed(domain, spacing, 0, *arguments)
        self.assertEqual(self.count(before), report["quality"]["on_boundary"])
        self.assertGreaterEqual(self.count(before), least)
        after, report = self.placed(domain, spacing, 1, *arguments)
        self.assertEqual((self.count(after), report["quality"]["on_boundary"]), (left, left))
        self.assertGreater(len(after.points), len(before.points))
        on_boundary = [mesh.points[mesh.point_data["tag"] != 0] for mesh in (before, after)]
        self.assertEqual(*(set(map(tuple, points)) for points in on_boundary))
        return report

    def write(self, text):
        path = self.folder / "a.poly"
        path.write_text(text)
        return path

    def test_lakes(self):
        for spacing in ("20", "8", "1+0.1*dist"):
            self.check(LAKE, spacing, least=50)
        self.check(DATA / "great_lakes_islands.poly", "10", "--simplify", "0.25,2", least=100)

    def test_a_channel_one_element_across(self):
        report = self.check(self.write(poly([channel()])), "1", least=100)
        self.assertGreater(report["quality"]["min_angle"], 30)
        self.assertGreater(report["quality"]["mean"], 0.95)

    def test_corners(self):
        triangle = poly([[(0, 0), (5, 0), (2.5, 2.5 * 3**0.5)]])
        self.check(self.write(triangle), "1", least=3)

    def test_edges_on_inner_curves_stay(self):
        ring = [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1)]
        self.check(self.write(poly([ring], [[(1, 0), (1, 1)]])), "1", least=4)
        # The inner curve cuts off a corner, whose element has no inner edge.
        ring = [(0, 0), (1, 0), (2, 0), (2, 2), (0, 2), (0, 1)]
        self.check(self.write(poly([ring], [[(1, 0), (0, 1)]])), "1.3", least=2, left=1)

    def test_a_whole_sphere_has_no_boundary(self):
        self.run_command("--sphere", "1", "--spacing", "0.2", "-q", "--report", "a.json",
                         "--set", "split_elements_on_boundary=1", code=0)
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual(report["quality"]["on_boundary"], 0)

    @exists_if(os.environ["PNPBS_GEO"] == "1")
    def test_a_strait_on_a_sphere(self):
        path = self.folder / "strait.geojson"
        ring = [[20 + 0.5 * k, 50] for k in range(21)] + [[30 - 0.5 * k, 50.3] for k in range(21)]
        path.write_text(json.dumps({"type": "Polygon", "coordinates": [ring + ring[:1]]}))
        for split in (0, 1):
            _, report = self.placed(path, "36", split, "--sphere", "6371,0,-90")
            self.assertEqual(report["quality"]["on_boundary"] > 30, not split)
        self.assertEqual(report["quality"]["on_boundary"], 0)

    @unittest.skipUnless(MPIEXEC, "without MPI")
    def test_ranks_place_the_same_nodes(self):
        for domain, spacing in ((self.write(poly([channel()])), "1"), (LAKE, "8")):
            results = []
            for ranks in (1, 2, 3, 5):
                mesh, report = self.placed(domain, spacing, 1, ranks=ranks)
                results.append((report["hash"], len(mesh.points), report["quality"]))
            self.assertEqual(results[1:], results[:1] * 3)
            self.assertEqual(results[0][-1]["on_boundary"], 0)


if __name__ == "__main__":
    unittest.main()
