# SPDX-License-Identifier: BSD-3-Clause
"""Tests polygons that are regions: grains of a tessellation and parcels of a map."""

import json
import os
import unittest

import meshio
import numpy
from scipy.spatial import Voronoi

from builds import exists_if
from command import MPIEXEC, CommandTest

BUILT = os.environ["PNPBS_GEO"] == "1"
GRAINS = 120


def area(ring):
    """Returns the area that a ring of distinct vertices encloses. Differences of coordinates avoid
    cancellation."""
    x, y = (numpy.asarray(ring) - ring[0]).T
    return abs(numpy.sum(x * numpy.roll(y, -1) - numpy.roll(x, -1) * y)) / 2


def grains():
    """Returns the rings of a Voronoi tessellation of the unit square. Seeds that are mirrored in
    its sides make these edges of the cells."""
    seeds = numpy.random.default_rng(58).random((GRAINS, 2))
    mirrored = [seeds]
    for axis in (0, 1):
        for side in (0, 1):
            other = seeds.copy()
            other[:, axis] = 2 * side - other[:, axis]
            mirrored.append(other)
    cells = Voronoi(numpy.vstack(mirrored))
    vertices = cells.vertices
    for side in (0, 1):
        vertices[abs(vertices - side) < 1e-9] = side
    rings = []
    for cell in cells.point_region[:GRAINS]:
        ring = [tuple(vertices[k]) for k in cells.regions[cell]]
        rings.append([point for k, point in enumerate(ring) if point != ring[k - 1]])
    return rings


def with_more_vertices(rings):
    """Adds vertices to every other ring, a third of the way along each edge, so that neighbours
    have other vertices on their common edges."""
    changed = []
    for number, ring in enumerate(rings):
        changed.append([])
        for k, (x, y) in enumerate(ring):
            changed[-1].append((x, y))
            if number % 2:
                u, v = ring[(k + 1) % len(ring)]
                changed[-1].append((x + (u - x) / 3, y + (v - y) / 3))
    return changed


def square(x, y, side):
    return [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]


def polygon(rings, **properties):
    return {"type": "Feature", "properties": properties,
            "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]] for ring in rings]}}


@exists_if(BUILT)
class PolygonRegions(CommandTest):
    def write(self, *features):
        path = self.folder / "map.geojson"
        path.write_text(json.dumps({"type": "FeatureCollection", "features": list(features)}))
        return path

    def options(self, path, spacing, *arguments, field="region"):
        return ("--domain", path, "--projection", "none", "--region-field", field, "--spacing",
                spacing, *arguments)

    def place_in(self, *features, spacing="0.1", field="region", arguments=()):
        """Runs the command. Returns points, triangles, their regions, and the report."""
        self.run_command(*self.options(self.write(*features), spacing, *arguments, field=field),
                         "--check", "-o", "a.vtu", "-o", "a.msh", "--report", "a.json")
        grid = meshio.read(self.folder / "a.vtu")
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual(report["region_field"], field)
        return grid.points, grid.cells[0].data, grid.cell_data["region"][0], report

    def check_areas(self, points, triangles, regions, expected):
        """Checks the area of each region, and that the elements conform."""
        self.assertEqual(set(regions), set(expected))
        for region, size in expected.items():
            total = sum(area(points[corners, :2]) for corners in triangles[regions == region])
            self.assertLess(abs(total / size - 1), 1e-12, region)

    def boundary_edges(self, triangles):
        edges = numpy.sort(numpy.vstack([triangles[:, (k, (k + 1) % 3)] for k in range(3)]))
        return numpy.unique(edges, axis=0, return_counts=True)

    def check_grains(self, rings):
        areas = {k + 1: area(ring) for k, ring in enumerate(rings)}
        points, triangles, regions, _ = self.place_in(
            *(polygon([ring], region=k + 1) for k, ring in enumerate(rings)), spacing="0.02")
        self.check_areas(points, triangles, regions, areas)
        # Grains share the nodes on their edges: only edges on the square belong to one triangle.
        edges, counts = self.boundary_edges(triangles)
        for edge in edges[counts == 1]:
            x = points[edge, :2]
            self.assertTrue(any((x[:, k] == side).all() for k in (0, 1) for side in (0, 1)), x)

    def test_grains(self):
        rings = grains()
        self.assertAlmostEqual(sum(map(area, rings)), 1, 12)
        self.check_grains(rings)

    def test_grains_with_other_vertices_than_their_neighbours(self):
        self.check_grains(with_more_vertices(grains()))

    @unittest.skipUnless(MPIEXEC, "without MPI")
    def test_grains_on_ranks(self):
        path = self.write(*(polygon([ring], region=k + 1)
                            for k, ring in enumerate(with_more_vertices(grains()))))
        results = []
        for ranks in (1, 2, 3):
            self.run_on_ranks(*self.options(path, "0.03"), "-o", "a.vtu", "--report", "a.json",
                              ranks=ranks)
            grid = meshio.read(self.folder / "a.vtu")
            order = numpy.argsort(grid.point_data["id"])
            ids = numpy.sort(grid.point_data["id"][grid.cells[0].data], axis=1)
            elements = numpy.column_stack([ids, grid.cell_data["region"][0]])
            results.append((json.loads((self.folder / "a.json").read_text())["hash"],
                            grid.points[order].tobytes(),
                            elements[numpy.lexsort(elements.T)].tolist()))
        self.assertEqual(results[1:], results[:1] * 2)

    def test_parcels_around_a_lake(self):
        """A parcel with a hole, in which a lake lies around an island without a region."""
        lake, island = square(1, 1, 2), square(1.5, 1.5, 1)
        features = [polygon([square(0, 0, 4), lake[::-1]], use="wood"),
                    polygon([[(4, 0), (6, 0), (6, 4), (4, 4), (4, 1)]], use="arable"),
                    polygon([lake, island], use="water"), polygon([island], use="wood")]
        areas = {1: 8, 2: 3, 3: 13}
        points, triangles, regions, report = self.place_in(*features, spacing="0.3", field="use")
        self.check_areas(points, triangles, regions, areas)
        names = {"arable": 1, "water": 2, "wood": 3}
        self.assertEqual({group["name"]: group["tag"] for group in report["groups"]}, names)
        self.assertEqual({group["dimension"] for group in report["groups"]}, {2})
        rows = report["by_region"]
        self.assertEqual({row["name"]: row["tag"] for row in rows}, names)
        for row in rows:
            inside = triangles[regions == row["tag"]]
            self.assertEqual((row["elements"], row["nodes"]),
                             (len(inside), len(numpy.unique(inside))))
            self.assertAlmostEqual(row["area"], areas[row["tag"]], 12)
        groups = meshio.read(self.folder / "a.msh", file_format="gmsh").field_data
        self.assertEqual({name: tag for name, (tag, dimension) in groups.items() if dimension == 2},
                         names)
        # Without the water, the lake is a hole.
        points, triangles, regions, _ = self.place_in(*features[:2], spacing="0.3", field="use")
        self.check_areas(points, triangles, regions, {1: 8, 2: 12})

    def test_values(self):
        squares = [square(k, 0, 1) for k in range(4)]
        for values, expected in (((7, -2, 7, 0), {7: 2, -2: 1, 0: 1}),
                                 ((2.0, 4.0, 2.0, 5.0), {2: 2, 4: 1, 5: 1}),
                                 ((10.5, 4, 10.5, 9), {1: 1, 2: 1, 3: 2}),
                                 (("b", "10", "9", "b"), {1: 1, 2: 1, 3: 2})):
            points, triangles, regions, _ = self.place_in(
                *(polygon([ring], region=value) for ring, value in zip(squares, values)),
                spacing="0.25")
            self.check_areas(points, triangles, regions, expected)

    def test_parts_of_polygons(self):
        """Lines divide a polygon, of which each part has its region, and a polygon has two parts."""
        line = {"type": "Feature", "properties": {}, "geometry": {
            "type": "MultiLineString", "coordinates": [
                [[0, 1], [1, 1.5], [2, 1]], [[0.5, 0.3], [1.5, 0.3], [1, 0.6], [0.5, 0.3]]]}}
        two = {"type": "Feature", "properties": {"region": 6}, "geometry": {
            "type": "MultiPolygon", "coordinates": [
                [[*square(2, 0, 2), (2, 0)]], [[*square(5, 0, 1), (5, 0)]]]}}
        points, triangles, regions, _ = self.place_in(
            polygon([square(0, 0, 2)], region=5), line, two, spacing="0.15")
        self.check_areas(points, triangles, regions, {5: 4, 6: 5})

    def test_polygons_that_do_not_fit(self):
        one = polygon([square(0, 0, 2)], region=1)
        for other, words in (
                (square(0.5, 0.5, 1), ("features 0 and 1 overlap at (1, 1)", "cut a hole")),
                (square(1, 0.5, 3), ("cross at (2, 0.5) (feature 0, feature 1)", "subtract")),
                (square(0, 0, 1), ("features 0 and 1 overlap, on the same side", "subtract")),
                (square(2 + 1e-6, 0, 2), ("features 0 and 1 have a gap of 1e-06", "same vertices")),
                (square(2 + 1e-6, -1, 4), ("features 0 and 1 have a gap of 1e-06", "same vertices")),
                (square(2 - 1e-6, 0, 2), ("features 0 and 1 overlap, on the same side", "subtract"))):
            path = self.write(one, polygon([other], region=2))
            message = self.refuse(*self.options(path, "0.2"))
            for text in words:
                self.assertIn(text, message)

    def test_a_vertex_beside_the_common_edge(self):
        """The vertex leaves a gap or an overlap between the neighbours."""
        one = polygon([square(0, 0, 2)], region=1)
        for x, words in ((2 + 1e-6, "have a gap of 5e-07"), (2 - 1e-6, "overlap")):
            other = [(2, 0), (4, 0), (4, 2), (2, 2), (x, 1)]
            message = self.refuse(*self.options(self.write(one, polygon([other], region=2)), "0.2"))
            self.assertIn(words, message)
            self.assertRegex(message, "features (0 and 1|1 and 0)")

    def test_short_edges_between_grains_are_no_gaps(self):
        e = 1e-7
        rings = ([(0, 0), (1, 0), (1, 1), (1 - e, 1 + e), (0, 1 + e)],
                 [(1, 0), (2, 0), (2, 1), (1, 1)], [(1, 1), (2, 1), (2, 2), (1 - e, 2), (1 - e, 1 + e)],
                 [(0, 1 + e), (1 - e, 1 + e), (1 - e, 2), (0, 2)])
        points, triangles, regions, _ = self.place_in(
            *(polygon([ring], region=k + 1) for k, ring in enumerate(rings)))
        self.check_areas(points, triangles, regions,
                         {k + 1: area(ring) for k, ring in enumerate(rings)})

    def test_a_narrow_gap_gives_a_note(self):
        for gap in (2**-10, 0.1):
            report = self.place_in(polygon([square(0, 0, 2)], region=1),
                                   polygon([square(2 + gap, 0, 2)], region=2))[-1]
            notes = [text for text in report["warnings"] if "gap" in text]
            self.assertEqual(len(notes), gap < 0.01)
            for note in notes:
                self.assertIn("features 0 and 1 have a gap of 0.0009766 between them at (2.00048828125, 1)", note)

    def test_what_has_no_regions(self):
        without = polygon([square(0, 0, 2)])
        point = {"type": "Feature", "properties": {"region": 1},
                 "geometry": {"type": "Point", "coordinates": [1, 1]}}
        given = polygon([square(3, 0, 2)], region=1)
        refuse = lambda *features, field="region": self.refuse(
            *self.options(self.write(*features), "0.2", field=field))
        self.assertIn("field 'region' of feature 0 has no value", refuse(without, given))
        self.assertIn("has no field 'soil'; it has: region", refuse(given, field="soil"))
        self.assertIn("is 3000000000: the number of a region is an integer of 32 bits",
                      refuse(polygon([square(0, 0, 2)], region=3000000000)))
        self.assertIn("has no polygons", refuse(point))
        self.assertIn("on a sphere polygons cannot be regions", self.refuse(
            "--domain", self.write(given), "--sphere", "1,90,0", "--region-field", "region",
            "--spacing", "0.01"))
        self.assertIn("--region-field is for GeoJSON", self.refuse(
            "--domain", self.square, "--region-field", "region", "--spacing", "0.1"))


if __name__ == "__main__":
    unittest.main()
