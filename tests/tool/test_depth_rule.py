# SPDX-License-Identifier: BSD-3-Clause
"""Tests --depth-rule, which derives d from the depth, against numpy on the same values."""

import re
import unittest

import numpy as np

from rasters import write_geotiff, write_netcdf
from builds import exists_if
from test_grids import GridsTest
from test_rasters import BUILT, BayTest

G, M2 = 9.81, 44712


def by_waves(depth, nodes=30, period=M2, least=10, metres=1000):
    return np.sqrt(G * np.maximum(depth, least)) * period / nodes / metres


def by_slopes(depth, slope, nodes, least=10):
    with np.errstate(divide="ignore"):
        return np.where(depth > least, 2 * np.pi * depth / (nodes * slope), np.inf)


@exists_if(BUILT)
class InThePlane(BayTest):
    """The depth ranges from 10 to 24 m. It increases by 5 m per degree to the east and by 4 m to
    the north."""

    def setUp(self):
        super().setUp()
        write_geotiff(self.folder / "d.tif", self.depths(17.5, 55.5, 0.05, 60, 40), 17.5, 55.5, 0.05,
                      4326)

    def depths_at(self, table):
        longitude, latitude = self.degrees(table)
        return 10 + 5 * (longitude - 18) + 4 * (latitude - 54)

    def slopes_at(self, table):
        """Returns the slope per kilometre. A degree of a meridian at 54.5 degrees is 111.3 km long.
        """
        latitude = np.radians(self.degrees(table)[1])
        return np.hypot(5 / (111.6 * np.cos(latitude)), 4 / 111.3)

    def test_waves(self):
        table, report, err = self.table(*self.ask, "--depth-rule", "d.tif,wave=60")
        depth = self.depths_at(table)
        np.testing.assert_allclose(table["spacing"], by_waves(depth, 60), rtol=0.01)
        self.assertEqual(report["depth_rule"], "d.tif,wave=60")
        self.assertNotIn("covers only", err)
        table, *_ = self.table(*self.ask, "--depth-rule", "d.tif,period=20000,least=15")
        expected = by_waves(self.depths_at(table), period=20000, least=15)
        np.testing.assert_allclose(table["spacing"], expected, rtol=0.01)

    def test_slopes(self):
        table, *_ = self.table(*self.ask, "--depth-rule", "d.tif,slope=60,least=5")
        depth, slope = self.depths_at(table), self.slopes_at(table)
        expected = np.minimum(by_waves(depth, least=5), by_slopes(depth, slope, 60, 5))
        steep = np.mean(expected < by_waves(depth, least=5))
        self.assertTrue(0.1 < steep < 0.9, steep)
        np.testing.assert_allclose(table["spacing"], expected, rtol=0.02)
        # Where the depth is less than the minimum, the bottom counts as flat.
        table, *_ = self.table(*self.ask, "--depth-rule", "d.tif,slope=70,least=16", "--set",
                               "growth_limit=0")
        depth, slope = self.depths_at(table), self.slopes_at(table)
        clear = abs(depth - 16) > 0.2
        expected = np.minimum(by_waves(depth, least=16), by_slopes(depth, slope, 70, 16))
        np.testing.assert_allclose(table["spacing"][clear], expected[clear], rtol=0.02)

    def test_bounds_and_formulas(self):
        table, *_ = self.table(*self.ask, "--depth-rule", "d.tif,wave=60", "--min-spacing", "8.1",
                               "--max-spacing", "9.7")
        expected = np.clip(by_waves(self.depths_at(table), 60), 8.1, 9.7)
        np.testing.assert_allclose(table["spacing"], expected, rtol=0.01)
        table, *_ = self.table(*self.ask, "--depth-rule", "h=d.tif,wave=60", "--spacing",
                               "min(by_depth, 0.5*h) + 0*h_slope")
        depth = self.depths_at(table)
        np.testing.assert_allclose(table["spacing"], np.minimum(by_waves(depth, 60), depth / 2),
                                   rtol=0.01)

    def test_units(self):
        metres = (*self.ask[:2], "--unit", "m", *self.ask[4:])
        table, *_ = self.table(*metres, "--depth-rule", "d.tif,wave=60")
        self.assertGreater(table["spacing"].min(), 7000)
        self.table(*self.ask, "--depth-rule", "d.tif,wave=60,metres=1000")
        message = self.refuse(*self.ask, "--depth-rule", "d.tif,metres=1")
        self.assertIn("metres=1, but the unit of length of the domain is km", message)
        (self.folder / "s.asc").write_text("ncols 1\nnrows 1\nxllcenter 0\nyllcenter 0\ncellsize 1\n20\n")
        message = self.refuse("--domain", self.square, "--depth-rule", "s.asc")
        self.assertIn("the unit of length of the domain is not known: add ,metres=1000", message)
        known, *_ = self.table("--domain", self.square, "--depth-rule", "s.asc", "--unit", "km")
        given, *_ = self.table("--domain", self.square, "--depth-rule", "s.asc,metres=1000")
        np.testing.assert_array_equal(known["spacing"], given["spacing"])
        self.assertAlmostEqual(known["spacing"].max(), by_waves(20, metres=1000), places=9)
        table, *_ = self.table("--domain", self.square, "--depth-rule", "s.asc,metres=200000")
        np.testing.assert_allclose(table["spacing"], by_waves(20, metres=200000), rtol=1e-9)

    def test_what_is_refused(self):
        for more, words in (
                (["d.tif,upp"], "did you mean up?"), (["d.tif,wave=-1"], "not negative"),
                (["d.tif,period=0"], "greater than 0"), (["d.tif,least=a"], "'least=a'"),
                (["d.tif,wave=0"], "nothing gives d"), ([",up"], "expected a file"),
                (["d.tif,wave=0,slope=9"], "--max-spacing"),
                (["d.tif", "--spacing", "3"], "does not use 'by_depth'"),
                (["d.tif", "--spacing", "auto"], "exclude"),
                (["d.tif", "--spacing", "by_depth", "--max-spacing", "5"], "min(...)"),
                (["d.tif", "--spacing-grid", "d.tif"], "combines them"),
                (["none.tif"], "--depth-rule none.tif: cannot open")):
            with self.subTest(more):
                self.assertIn(words, self.refuse(*self.ask, "--depth-rule", *more))
        message = self.refuse(*self.ask, "--depth-rule", "d.tif", "--format", "csv", "-o", "d.tif")
        self.assertIn("would overwrite", message)

    def test_a_raster_elsewhere_and_of_a_part(self):
        write_geotiff(self.folder / "e.tif", self.depths(30, 55.5, 0.05, 60, 40), 30, 55.5, 0.05,
                      4326)
        message = self.refuse(*self.ask, "--depth-rule", "e.tif")
        self.assertIn("--depth-rule e.tif", message)
        self.assertIn("lies outside of the domain", message)
        write_geotiff(self.folder / "e.tif", self.depths(19, 55.5, 0.05, 60, 40), 19, 55.5, 0.05,
                      4326)
        _, _, err = self.table(*self.ask, "--depth-rule", "e.tif,wave=60")
        found = re.search(r"covers only a part of the domain: of (\d+) nodes, (\d+) lie beyond its edge, "
                          r"one of them at \((.*), (.*)\); .* from \(", err)
        nodes, beyond, x, y = map(float, found.groups())
        table = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
        longitude = self.degrees(table)[0]
        self.assertEqual(nodes, len(table))
        self.assertEqual(beyond, np.sum(longitude < 18.975))
        self.assertLess(self.degrees({"x": np.array([x]), "y": np.array([y])})[0][0], 18.975)
        self.assertTrue(np.any(np.hypot(table["x"] - x, table["y"] - y) == 0))


@exists_if(BUILT)
class OnASphere(GridsTest):
    """The grid has elevations of the whole Earth, from 0 to 360 degrees, and some land without
    data."""

    radius = 6371.22

    def setUp(self):
        super().setUp()
        self.longitudes, self.latitudes = np.arange(0.5, 360), np.arange(-89.5, 90)
        lon, lat = np.meshgrid(np.radians(self.longitudes), np.radians(self.latitudes))
        self.elevations = (-2600 - 2700 * np.sin(2 * lon) * np.cos(lat) ** 2).astype("f4")
        write_netcdf(self.folder / "e.nc", self.longitudes, self.latitudes, height=self.elevations)
        self.ask = ("--sphere", f"{self.radius},20,-30", "--set", "growth_limit=0", "--depth-rule")

    def cells_of(self, table):
        """Returns the column and row of the cell centres around each node, and the weights between
        them."""
        lat = np.degrees(np.arcsin(table["z"] / self.radius))
        lon = np.degrees(np.arctan2(table["y"], table["x"])) % 360
        column, row = np.clip(lon - 0.5, 0, 359), np.clip(lat + 89.5, 0, 179)
        i, j = np.minimum(column.astype(int), 358), np.minimum(row.astype(int), 178)
        return lon, lat, i, j, column - i, row - j

    def depth_and_slope(self, table, values):
        lon, lat, i, j, s, t = self.cells_of(table)
        a, b, c, d = values[j, i], values[j, i + 1], values[j + 1, i], values[j + 1, i + 1]
        height = (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d)
        degree = np.pi / 180 * self.radius
        east = ((1 - t) * (b - a) + t * (d - c)) / (degree * np.cos(np.radians(lat)))
        north = ((1 - s) * (c - a) + s * (d - b)) / degree
        # The slope jumps at the edges of cells, and is 0 beyond the outermost cell centres. These
        # nodes are left out.
        clear = ((abs(s - 0.5) < 0.499) & (abs(t - 0.5) < 0.499) & (abs(lat) < 89) & (lon > 0.5) &
                 (lon < 359.5))
        return -height, np.hypot(east, north), clear

    def test_waves_and_slopes(self):
        table, *_ = self.table(*self.ask, "e.nc,up,slope=100,metres=1000", "--min-spacing", "90",
                               "--max-spacing", "300")
        depth, slope, clear = self.depth_and_slope(table, self.elevations.astype(float))
        wave, steep = by_waves(depth), by_slopes(depth, slope, 100)
        self.assertGreater(np.mean(steep[clear] < wave[clear]), 0.1)
        self.assertGreater(np.mean(wave[clear] < steep[clear]), 0.1)
        self.assertGreater(np.mean(depth < 10), 0.005)
        lon = np.degrees(np.arctan2(table["y"], table["x"]))
        self.assertGreater(np.sum(clear & (abs(lon) > 179)), 20)
        np.testing.assert_allclose(table["spacing"][clear],
                                   np.clip(np.minimum(wave, steep), 90, 300)[clear], rtol=1e-5)

    def test_land_without_data(self):
        """A gap has the depth of the nearest cell, which here is the same along a parallel."""
        heights = np.repeat(-500 - 20 * abs(self.latitudes)[:, None], 360, 1).astype("f4")
        holes = heights.copy()
        holes[40:140, 100:140] = np.nan
        write_netcdf(self.folder / "h.nc", self.longitudes, self.latitudes, height=holes)
        table, *_ = self.table(*self.ask, "h.nc,up,metres=1000,wave=20")
        depth, _, clear = self.depth_and_slope(table, heights.astype(float))
        lon, lat, *_ = self.cells_of(table)
        clear &= (abs(lon - 120) > 22) | (abs(lat) < 25)  # others are nearer to other rows
        self.assertGreater(np.sum(clear & (abs(lon - 120) < 19)), 100)
        np.testing.assert_allclose(table["spacing"][clear], by_waves(depth, 20)[clear], rtol=1e-5)

    def test_places_are_in_degrees(self):
        write_netcdf(self.folder / "n.nc", self.longitudes, self.latitudes[95:],
                     height=self.elevations[95:])
        _, _, err = self.table(*self.ask, "n.nc,up,metres=1000", "--min-spacing", "200")
        found = re.search(r"one of them at \(longitude (.*), latitude (.*)\); there", err)
        self.assertLess(float(found[2]), 6)
        message = self.refuse(*self.ask, "e.nc,up,metres=1000", "--spacing", "by_depth*sqrt(lat-50)")
        found = re.search(r"the spacing at \(longitude (.*), latitude (.*)\) is -?nan", message)
        self.assertLess(float(found[2]), 50)

    def test_the_unit_must_be_given(self):
        message = self.refuse(*self.ask, "e.nc,up")
        self.assertIn("the unit of length of the domain is not known", message)


if __name__ == "__main__":
    unittest.main()
