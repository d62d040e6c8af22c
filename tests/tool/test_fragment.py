# SPDX-License-Identifier: BSD-3-Clause
"""Tests --fragment: groups of a file that cross and touch become regions of one body."""

import itertools
import json
import os
import unittest

import meshio
import numpy

from command import DONE, LEFT_OUT, SPACING_MISSED, CommandTest


def box(low, high):
    """Returns the twelve triangles of a box, counter-clockwise as seen from outside."""
    triangles = []
    for axis, side in itertools.product(range(3), range(2)):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        corners = []
        for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
            x = [0, 0, 0]
            x[axis] = (low, high)[side][axis]
            x[u] = (low, high)[s][u]
            x[v] = (low, high)[t][v]
            corners.append(x)
        for a, b, c in ((0, 1, 2), (0, 2, 3)):
            triangles.append([corners[a], corners[b] if side else corners[c],
                              corners[c] if side else corners[b]])
    return triangles


def solid(name, triangles):
    facets = "".join("facet normal 0 0 0\nouter loop\n"
                     + "".join("vertex {} {} {}\n".format(*x) for x in triangle)
                     + "endloop\nendfacet\n" for triangle in triangles)
    return f"solid {name}\n{facets}endsolid {name}\n"


# Two blocks side by side, a third one across both, and a sheet through all that ends outside.
MODEL = (solid("left", box((0, 0, 0), (1, 1, 1))) + solid("right", box((1, 0.2, 0.1), (2, 1, 0.9)))
         + solid("bar", box((0.4, 0.5, 0.3), (1.7, 0.8, 0.6)))
         + solid("sheet", [[(-1, -1, 0.45), (3, -1, 0.45), (1, 4, 0.45)]]))
VOLUMES = {"left": 1 - 0.6 * 0.3 * 0.3, "right": 0.64 - 0.7 * 0.3 * 0.3, "bar": 1.3 * 0.3 * 0.3}


def volumes_by_region(path):
    """Returns the volume of the tetrahedra of each region of a .vtu file."""
    mesh = meshio.read(path)
    corners = mesh.points[mesh.cells_dict["tetra"]]
    volumes = numpy.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    regions = mesh.cell_data_dict["region"]["tetra"]
    return {int(tag): volumes[regions == tag].sum() for tag in numpy.unique(regions)}


class Fragment(CommandTest):
    def setUp(self):
        super().setUp()
        self.model = self.folder / "model.stl"
        self.model.write_text(MODEL)

    def test_regions_have_their_volumes(self):
        self.run_command("--domain", self.model, "--fragment", "--spacing", 0.07,
                         "--output", "a.vtu", "--check")
        found = volumes_by_region(self.folder / "a.vtu")
        self.assertEqual(sorted(found), [1, 2, 3])
        for tag, name in enumerate(VOLUMES, 1):
            self.assertAlmostEqual(found[tag], VOLUMES[name], 12, name)

    def test_figures_of_regions(self):
        out, _ = self.run_command("--domain", self.model, "--fragment", "--spacing", 0.1,
                                  "--output", "a.vtu", "--report", "a.json")
        rows = json.loads((self.folder / "a.json").read_text())["by_region"]
        mesh = meshio.read(self.folder / "a.vtu")
        volumes = volumes_by_region(self.folder / "a.vtu")
        tetrahedra, of = mesh.cells_dict["tetra"], mesh.cell_data_dict["region"]["tetra"]
        self.assertEqual([(row["tag"], row["name"]) for row in rows],
                         [(1, "left"), (2, "right"), (3, "bar")])
        for row in rows:
            inside = tetrahedra[of == row["tag"]]
            self.assertEqual(row["elements"], len(inside))
            self.assertEqual(row["nodes"], len(numpy.unique(inside)))
            self.assertAlmostEqual(row["volume"], volumes[row["tag"]], 12)
        lines = [line for line in out.decode().splitlines() if line.startswith("region ")]
        self.assertEqual(len(lines), 3)
        self.assertRegex(lines[2], r"region   3 'bar': [\d ]+ nodes, [\d ]+ elements, volume 0.11")

    def test_spacing_by_region(self):
        """In the bar and on its surface d is small. From there it grows by 0.3 per unit of distance
        at most, from samples that are up to 0.15 apart."""
        run = self.start("--domain", self.model, "--fragment", "--spacing",
                         "region == 3 ? 0.05 : 0.15", "--output", "a.vtu", "--check")
        run.communicate()
        self.assertIn(run.returncode, (DONE, SPACING_MISSED))
        mesh = meshio.read(self.folder / "a.vtu")
        d, x = mesh.point_data["spacing"], mesh.points
        low, high = numpy.array((0.4, 0.5, 0.3)), numpy.array((1.7, 0.8, 0.6))
        away = numpy.linalg.norm(numpy.maximum(0, numpy.maximum(low - x, x - high)), axis=1)
        self.assertGreater((away < 1e-9).sum(), 1000)
        self.assertLess(abs(d[away < 1e-9] - 0.05).max(), 1e-9)
        self.assertTrue((d <= 0.05 + 0.3 * (away + 0.15)).all())
        self.assertGreater(d.max(), 0.14)

    def test_spacing_by_region_needs_regions(self):
        message = self.refuse("--domain", "box(0,0,0, 1,1,1)", "--spacing", "0.1 + 0*region")
        self.assertIn("--spacing: region: no region of the domain has a tag", message)
        self.assertIn("--region", message)

    def test_regions_have_the_names_of_groups(self):
        self.run_command("--domain", self.model, "--fragment", "--spacing", 0.1,
                         "--output", "a.msh")
        names = meshio.read(self.folder / "a.msh").field_data
        volumes = {int(tag): name for name, (tag, dimension) in names.items() if dimension == 3}
        self.assertEqual({tag: volumes[tag] for tag in (1, 2, 3)},
                         {1: "left", 2: "right", 3: "bar"})

    @unittest.skipUnless(os.environ.get("PNPBS_MPIEXEC"), "no MPI")
    def test_nodes_are_the_same_on_any_ranks(self):
        hashes = set()
        for ranks in (1, 2, 3):
            self.run_on_ranks("--domain", self.model, "--fragment", "own", "--spacing",
                              "region == 3 ? 0.08 : 0.12", "--report", "report.json", ranks=ranks)
            report = json.loads((self.folder / "report.json").read_text())
            hashes.add((report["hash"], json.dumps(report["by_region"])))
        self.assertEqual(len(hashes), 1)

    @unittest.skipUnless(os.environ.get("PNPBS_MPIEXEC"), "no MPI")
    def test_nodes_at_coarse_inner_surfaces_are_the_same_on_any_ranks(self):
        bars = self.folder / "bars.stl"
        bars.write_text(solid("along", box((0, 0.4, 0.4), (1, 0.6, 0.6)))
                        + solid("across", box((0.4, 0, 0.5), (0.6, 1, 0.7))))
        for model, spacing, reduced in ((bars, 0.2, False), (self.model, 0.4, True)):
            reports = []
            for ranks in (1, 2, 3):
                self.run_on_ranks("--domain", model, "--fragment", "own", "--spacing", spacing,
                                  "--report", "report.json", "--output", "a.vtu", ranks=ranks)
                reports.append(json.loads((self.folder / "report.json").read_text()))
            self.assertEqual(len({report["hash"] for report in reports}), 1)
            self.assertEqual("is reduced there" in json.dumps(reports[0]["warnings"]), reduced)
            found = volumes_by_region(self.folder / "a.vtu")
            for tag, volume in enumerate((0.036, 0.036, 0.004) if model is bars else (), 1):
                self.assertAlmostEqual(found[tag], volume, 12)

    def test_messages_name_the_option(self):
        self.assertIn("--fragment", self.refuse("--domain", self.model, "--spacing", 0.12))
        for options, words in ((["--fragment", "all"], "expected last, first or own"),
                               (["--fragment", "--repair"], "excludes --repair"),
                               (["--fragment", "--surfaces-only"], "exclude each other")):
            message = self.refuse("--domain", self.model, "--spacing", 0.12, *options)
            self.assertIn(words, message)

    def test_overlapping_parts_of_a_group_are_one(self):
        model = self.folder / "cross.stl"
        model.write_text(solid("block", box((0, 0, 0), (1, 1, 1)))
                         + solid("cross", box((0.2, 0.4, 0.4), (0.8, 0.6, 0.6))
                                 + box((0.4, 0.2, 0.4), (0.6, 0.8, 0.6))))
        self.run_command("--domain", model, "--fragment", "--spacing", 0.1, "--output", "a.vtu",
                         "--output", "a.msh", "--check")
        found = volumes_by_region(self.folder / "a.vtu")
        self.assertAlmostEqual(found[2], 0.04 * (2 * 0.6 - 0.2), 12)
        mesh = meshio.read(self.folder / "a.msh")
        middles = mesh.points[mesh.cells_dict["triangle"]].mean(axis=1)
        self.assertTrue((abs(middles - 0.5) < 0.3 + 1e-9).all(axis=1).any())
        in_cross = (abs(middles - 0.5) < 0.1 + 1e-9).all(axis=1)
        self.assertTrue((abs(middles[in_cross, 2] - 0.5) > 0.1 - 1e-9).all())

    def test_gaps_within_a_length_are_closed(self):
        model = self.folder / "gap.stl"
        model.write_text(solid("lower", box((0, 0, 0), (1, 1, 1)))
                         + solid("upper", box((0.25, -0.5, 1 + 1e-6), (1.5, 0.75, 2))))
        self.run_command("--domain", model, "--fragment", "--snap", 2e-6, "--spacing", 0.15,
                         "--output", "gap.vtu", "--report", "report.json", "--check")
        report = json.loads((self.folder / "report.json").read_text())
        self.assertIn("within 2e-06 of each other became one", str(report["warnings"]))
        found = volumes_by_region(self.folder / "gap.vtu")
        self.assertAlmostEqual(found[1], 1, 5)
        self.assertAlmostEqual(found[2], 1.25 * 1.25, 5)
        self.assertIn("with --fragment",
                      self.refuse("--domain", model, "--spacing", 0.15, "--snap", 1e-6))


# A square with two fractures that cross, a circle of segments across its side, and a line outside.
PLANE = """14 2 0 0
1 0 0
2 4 0
3 4 4
4 0 4
5 1 1
6 3 3
7 1 3
8 3 1
9 3.5 1.5
10 5 1.5
11 5 2.5
12 3.5 2.5
13 -1 0.5
14 5 0.5
11 1
1 1 2 1
2 2 3 1
3 3 4 1
4 4 1 1
5 5 6 7
6 7 8 7
7 9 10 2
8 10 11 2
9 11 12 2
10 12 9 2
11 13 14 8
0
"""


def areas_by_region(path):
    """Returns the area of the triangles of each region of a .vtu file."""
    mesh = meshio.read(path)
    a, b, c = (mesh.points[mesh.cells_dict["triangle"][:, k], :2] for k in range(3))
    areas = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    regions = mesh.cell_data_dict["region"]["triangle"]
    return {int(tag): areas[regions == tag].sum() for tag in numpy.unique(regions)}


class PlaneFragment(CommandTest):
    def setUp(self):
        super().setUp()
        self.model = self.folder / "model.poly"
        self.model.write_text(PLANE)

    def test_closed_groups_are_regions(self):
        for rule, areas in (("last", {1: 15.5, 2: 1.5}), ("first", {1: 16, 2: 1}),
                            ("own", {1: 15.5, 2: 1, 3: 0.5})):
            self.run_command("--domain", self.model, "--fragment", rule, "--spacing", 0.2,
                             "--output", "a.vtu", "--check")
            found = areas_by_region(self.folder / "a.vtu")
            self.assertEqual(sorted(found), sorted(areas), rule)
            for tag, area in areas.items():
                self.assertAlmostEqual(found[tag], area, 12, rule)

    def test_nodes_lie_on_crossings_and_lines(self):
        self.run_command("--domain", self.model, "--fragment", "--spacing", 0.2,
                         "--output", "a.vtu")
        points = meshio.read(self.folder / "a.vtu").points
        for place in ((2, 2), (4, 1.5), (4, 2.5), (0, 0.5), (4, 0.5)):
            self.assertLess(numpy.abs(points[:, :2] - place).max(axis=1).min(), 1e-12, place)

    def test_polygons_and_lines_of_geojson(self):
        def feature(kind, coordinates, **properties):
            return {"type": "Feature", "properties": properties,
                    "geometry": {"type": kind, "coordinates": coordinates}}

        def ring(x, y, width):
            return [[x, y], [x + width, y], [x + width, y + width], [x, y + width], [x, y]]

        layer = self.folder / "layer.geojson"
        features = [feature("Polygon", [ring(0, 0, 6), ring(4, 4, 1)[::-1]], unit=30),
                    feature("Polygon", [ring(6, 0, 3)], unit=40),
                    feature("LineString", [[-1, 1], [10, 1]]),
                    feature("LineString", [[3, -1], [3, 7]])]
        layer.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        options = ["--domain", layer, "--projection", "none", "--spacing", 0.4]
        self.assertIn("--fragment", self.refuse(*options))
        self.run_command(*options, "--fragment", "--output", "a.vtu", "--check", code=LEFT_OUT)
        self.assertAlmostEqual(sum(areas_by_region(self.folder / "a.vtu").values()), 36 - 1 + 9, 9)
        self.run_command(*options, "--fragment", "--region-field", "unit", "--output", "b.vtu",
                         code=LEFT_OUT)
        found = areas_by_region(self.folder / "b.vtu")
        self.assertEqual(sorted(found), [30, 40])
        self.assertAlmostEqual(found[30], 35, 9)

    @unittest.skipUnless(os.environ.get("PNPBS_MPIEXEC"), "no MPI")
    def test_nodes_are_the_same_on_any_ranks(self):
        hashes = set()
        for ranks in (1, 2, 3):
            self.run_on_ranks("--domain", self.model, "--fragment", "own", "--spacing", 0.1,
                              "--report", "report.json", ranks=ranks)
            hashes.add(json.loads((self.folder / "report.json").read_text())["hash"])
        self.assertEqual(len(hashes), 1)

    def test_messages_name_the_option(self):
        message = self.refuse("--domain", self.model, "--spacing", 0.2)
        self.assertIn("cross at", message)
        self.assertIn("--fragment", message)


if __name__ == "__main__":
    unittest.main()
