# SPDX-License-Identifier: BSD-3-Clause
"""Tests shapes that GDAL reads, in Python."""
import json
import pathlib
import tempfile
import unittest

import numpy as np
import pnpbs
from pnpbs import PNPBSError, Status

SQUARE = [[18, 54], [20, 54], [20, 55], [18, 55], [18, 54]]


class Shapes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder / "land.geojson"
        self.path.write_text(json.dumps({
            "type": "Feature", "properties": {"name": "shore"},
            "geometry": {"type": "Polygon", "coordinates": [SQUARE]}}))

    def test_nodes(self):
        with pnpbs.Context() as context, pnpbs.Shapes(self.path, projection="EPSG:2180", unit="km",
                                                      tag_field="name") as shapes:
            domain = shapes.add_to(pnpbs.Domain(context), corner_angle=45)
            self.assertEqual((shapes.notes, shapes.note_data), ([], []))
            self.assertEqual(shapes.counts, (4, 1, 0, 0))
            self.assertIn("GDAL", pnpbs.geo_build_info())
            projection = shapes.projection
            self.assertEqual((projection.name, projection.unit),
                             ("ETRF2000-PL / CS92 in kilometre", "kilometre"))
            self.assertTrue(0.999 < projection.scale[0] < projection.scale[1] < 1)
            placement = pnpbs.Placement(domain).set_spacing(5)
            placement.run()
            # Sides are straight in the projection, so the northern one bends to 55.004 degrees.
            degrees = shapes.to_degrees(placement.nodes().points)
            self.assertTrue(np.all((degrees > (17.999, 53.98)) & (degrees < (20.001, 55.01))))
            corners = shapes.from_degrees(SQUARE[:4])
            gaps = [np.hypot(*(placement.nodes().points - corner).T).min() for corner in corners]
            self.assertLess(max(gaps), 1e-9)
            shapes.write_prj(self.folder / "nodes.vtu")
            self.assertEqual((self.folder / "nodes.prj").read_text(), projection.prj)
            self.assertEqual(shapes.explain("at (500, 700)"), "at (500, 700)")
            domain.add_polyline([(500, 690), (500, 710)], closed=False, role="inner")
            domain.add_polyline([(490, 700), (510, 700)], closed=False, role="inner")
            with self.assertRaises(PNPBSError) as caught:
                domain.check()
            self.assertEqual(caught.exception.reason, pnpbs.ErrorReason.CROSSING)
            np.testing.assert_allclose(caught.exception.points[0][:2], (500, 700))
            self.assertIn("(500, 700) [longitude", shapes.explain(caught.exception))
        self.assertFalse(shapes.is_open)
        with self.assertRaises(PNPBSError):
            shapes.to_degrees(SQUARE)

    def test_regions(self):
        squares = [(18, "sand"), (19, "clay")]
        self.path.write_text(json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"soil": soil}, "geometry": {
                "type": "Polygon",
                "coordinates": [[[x, 54], [x + 1, 54], [x + 1, 55], [x, 55], [x, 54]]]}}
            for x, soil in squares]}))
        with pnpbs.Context() as context, pnpbs.Shapes(self.path, projection="none",
                                                      region_field="soil") as shapes:
            domain = shapes.add_to(pnpbs.Domain(context))
            self.assertEqual(domain.tag_names(), {(2, 1): "clay", (2, 2): "sand"})
            placement = pnpbs.Placement(domain).set_spacing(0.2)
            placement.run()
            middles = placement.nodes().points[placement.triangles()].mean(axis=1)
            np.testing.assert_array_equal(placement.element_tags(),
                                          np.where(middles[:, 0] > 19, 1, 2))

    def test_nodes_on_a_sphere(self):
        with pnpbs.Context() as context, pnpbs.Shapes(self.path,
                                                      projection="sphere(100,-20)") as shapes:
            outside = pnpbs.sphere_points(1, [(100, -20)])[0]
            domain = shapes.add_to(pnpbs.Domain.on_sphere(context, 6371, outside), corner_angle=45)
            placement = pnpbs.Placement(domain).set_spacing(20)
            self.assertEqual(placement.run(), Status.OK)
            points = placement.nodes().points
            np.testing.assert_allclose(np.linalg.norm(points, axis=1), 6371, rtol=1e-15)
            # Sides are great circles, so the northern one bends to 55.004 degrees.
            degrees = pnpbs.sphere_degrees(points)
            self.assertTrue(np.all((degrees > (17.999, 53.999)) & (degrees < (20.001, 55.01))))
            for corner in pnpbs.sphere_points(6371, SQUARE):
                self.assertLess(np.linalg.norm(points - corner, axis=1).min(), 1e-8)
            with self.assertRaisesRegex(PNPBSError, "on a sphere"):
                shapes.add_to(pnpbs.Domain(context))

    def test_grids(self):
        # Checks a grid with the values 3 longitude + latitude. The file beside it says that it is
        # in degrees.
        rows = [[3 * (17 + 0.5 * i) + 56 - 0.5 * j for i in range(9)] for j in range(7)]
        path = self.folder / "depth.asc"
        path.write_text("ncols 9\nnrows 7\nxllcenter 17\nyllcenter 53\ncellsize 0.5\n" +
                        "\n".join(" ".join(map(str, row)) for row in rows) + "\n")
        path.with_suffix(".prj").write_text(
            'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],'
            'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]')
        with pnpbs.Shapes(self.path) as shapes:
            corners = shapes.from_degrees(SQUARE[:4])
            with pnpbs.GeoGrid(path, corners.min(axis=0), corners.max(axis=0),
                               projection=shapes.projection.wkt) as depth:
                np.testing.assert_allclose(depth(corners), [108, 114, 115, 109], rtol=1e-6)
                self.assertEqual(list(depth.inside([corners[0], corners[0] + 1e6])), [True, False])
                x = corners.mean(axis=0)[None]
                beside = [depth(x + np.multiply(step, 1e3)) - depth(x - np.multiply(step, 1e3))
                          for step in ([[1, 0]], [[0, 1]])]
                np.testing.assert_allclose(depth.slopes(x), np.hypot(*beside) / 2e3, rtol=1e-3)
                low, high = depth.extent
                self.assertTrue(np.all(low < corners) and np.all(corners < high))
        self.assertFalse(depth.is_open)
        with pnpbs.GeoGrid(path, (17, 53), (21, 56)) as depth:
            degree = 6371 * np.pi / 180
            np.testing.assert_allclose(depth.slopes([(19.1, 55.1)], radius=6371),
                                       np.hypot(3 / np.cos(np.radians(55.1)), 1) / degree, rtol=1e-4)
        with self.assertRaisesRegex(PNPBSError, "outside of the domain"):
            pnpbs.GeoGrid(path, (50, 10), (51, 11))

    def test_spacing_by_depth(self):
        h, steep = np.array([3000, 100, 1, -50.0]), np.array([0, 40, 40, 0.0])
        wave = np.sqrt(9.81 * np.maximum(h, 10)) * 44.712 / 30
        np.testing.assert_allclose(pnpbs.depth_spacing(h, metres=1000), wave)
        d = pnpbs.depth_spacing(h, steep, slope=20, metres=1000)
        np.testing.assert_allclose(d, [wave[0], min(wave[1], 2 * np.pi * 100 / 800), *wave[2:]])
        with self.assertRaisesRegex(PNPBSError, r"depths\[0\] is not a number"):
            pnpbs.depth_spacing([np.nan])
        with self.assertRaisesRegex(ValueError, "requires the argument slopes"):
            pnpbs.depth_spacing(h, slope=20)
        with self.assertRaisesRegex(ValueError, "vectors of the same length"):
            pnpbs.depth_spacing(h, [1.0])

    def test_errors(self):
        for arguments, status, words in (
                ({"layer": "sea"}, Status.ERROR_FILE, "no layer 'sea'"),
                ({"projection": "EPSG:1"}, Status.ERROR_ARGUMENT, "EPSG:1"),
                ({"unit": "mile"}, Status.ERROR_ARGUMENT, "m or km")):
            with self.subTest(arguments), self.assertRaisesRegex(PNPBSError, words) as caught:
                pnpbs.Shapes(self.path, **arguments)
            self.assertEqual(caught.exception.status, status)


if __name__ == "__main__":
    unittest.main()
