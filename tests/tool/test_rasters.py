# SPDX-License-Identifier: BSD-3-Clause
"""Tests --spacing-grid with files that GDAL reads. PNPBS_GEO says whether the command was built
with GDAL."""

import json
import os
import subprocess
import unittest

import numpy as np

from builds import exists_if
from command import COMMAND, FAILED, NOT_CONVERGED
from rasters import write_geotiff, write_netcdf
from test_grids import QUICK, GridsTest

BUILT = os.environ["PNPBS_GEO"] == "1"


@exists_if(not BUILT)
class Without(GridsTest):
    def test_says_how_to_get_it(self):
        (self.folder / "g.tif").write_bytes(b"II")
        message = self.refuse("--domain", self.square, "--spacing-grid", "g.tif", code=1)
        self.assertIn("libgdal-dev", message)


class BayTest(GridsTest):
    """The domain is a bay from 18 to 20 degrees east and 54 to 55 north. The depths are linear in
    the degrees."""

    def setUp(self):
        super().setUp()
        ring = [[18, 54], [20, 54], [20, 55], [18, 55], [18, 54]]
        (self.folder / "bay.geojson").write_text(json.dumps({
            "type": "Feature", "properties": {"kind": "land"},
            "geometry": {"type": "Polygon", "coordinates": [ring]}}))
        self.ask = ("--domain", "bay.geojson", "--unit", "km", "--tag-field", "kind")

    def depths(self, west, north, step, columns, rows):
        longitude = west + step * (np.arange(columns) + 0.5)
        latitude = north - step * (np.arange(rows) + 0.5)
        return 10 + 5 * (longitude[None, :] - 18) + 4 * (latitude[:, None] - 54)

    def degrees(self, table):
        """Returns longitude and latitude by the series of the transverse Mercator projection, with
        an error of about 10 m."""
        # pylint: disable=too-many-locals
        a, f = 6378.137, 1 / 298.257223563
        n = f / (2 - f)
        radius = a / (1 + n) * (1 + n**2 / 4)
        xi, eta = table["y"] / (0.9996 * radius), (table["x"] - 500) / (0.9996 * radius)
        beta = n / 2 - 2 * n**2 / 3
        xi0 = xi - beta * np.sin(2 * xi) * np.cosh(2 * eta)
        eta0 = eta - beta * np.cos(2 * xi) * np.sinh(2 * eta)
        chi = np.arcsin(np.sin(xi0) / np.cosh(eta0))
        latitude = chi + (2 * n - 2 * n**2 / 3) * np.sin(2 * chi) + 7 / 3 * n**2 * np.sin(4 * chi)
        return 21 + np.degrees(np.arctan2(np.sinh(eta0), np.cos(xi0))), np.degrees(latitude)

    def expect_depths(self, table):
        longitude, latitude = self.degrees(table)
        expected = 10 + 5 * (longitude - 18) + 4 * (latitude - 54)
        np.testing.assert_allclose(table["spacing"], expected, rtol=0.01)


@exists_if(BUILT)
class Rasters(BayTest):
    def test_geotiff_in_degrees(self):
        write_geotiff(self.folder / "d.tif", self.depths(17.5, 55.5, 0.05, 60, 40), 17.5, 55.5,
                      0.05, 4326)
        table, report, err = self.table(*self.ask, "--spacing-grid", "d.tif")
        self.expect_depths(table)
        self.assertNotIn("covers only", err)
        self.assertEqual(report["spacing_grid"], "d.tif")
        # The result is the same with longitudes beyond 360.
        write_geotiff(self.folder / "e.tif", self.depths(17.5, 55.5, 0.05, 60, 40), 377.5, 55.5,
                      0.05, 4326)
        self.expect_depths(self.table(*self.ask, "--spacing-grid", "e.tif")[0])

    def test_geotiff_with_gaps(self):
        depths = self.depths(17.5, 55.5, 0.05, 60, 40)
        depths[:, 30:] = -9999
        write_geotiff(self.folder / "d.tif", depths, 17.5, 55.5, 0.05, 4326, no_data=-9999)
        table, *_ = self.table(*self.ask, "--spacing-grid", "d.tif")
        longitude, latitude = self.degrees(table)
        west = longitude < 18.9
        expected = 10 + 5 * (longitude - 18) + 4 * (latitude - 54)
        np.testing.assert_allclose(table["spacing"][west], expected[west], rtol=0.01)
        east = longitude > 19.1
        expected = 10 + 5 * (18.975 - 18) + 4 * (latitude - 54)
        np.testing.assert_allclose(table["spacing"][east], expected[east], rtol=0.01)

    def test_netcdf(self):
        longitudes, latitudes = np.arange(17.5, 20.6, 0.1), np.arange(53.5, 55.6, 0.1)
        depth = 10 + 5 * (longitudes[None, :] - 18) + 4 * (latitudes[:, None] - 54)
        write_netcdf(self.folder / "one.nc", longitudes, latitudes, depth=depth)
        self.expect_depths(self.table(*self.ask, "--spacing-grid", "one.nc")[0])
        (self.folder / "one.nc").rename(self.folder / "one.cdf")
        self.expect_depths(self.table(*self.ask, "--spacing-grid", "one.cdf")[0])
        write_netcdf(self.folder / "two.nc", longitudes, latitudes, depth=depth, speed=0 * depth)
        self.expect_depths(self.table(*self.ask, "--spacing-grid", "two.nc:depth")[0])
        for variable in ("two.nc", "two.nc:deep"):
            self.assertIn("depth, speed", self.refuse(*self.ask, "--spacing-grid", variable))

    def test_depth_and_distance_to_land(self):
        write_geotiff(self.folder / "d.tif", self.depths(17.5, 55.5, 0.05, 60, 40), 17.5, 55.5,
                      0.05, 4326)
        table, *_ = self.table(*self.ask, "--spacing-grid", "depth=d.tif", "--spacing",
                               "min(8, 0.5*depth) + 0.1*dist(land)")
        longitude, latitude = self.degrees(table)
        depth = 10 + 5 * (longitude - 18) + 4 * (latitude - 54)
        edge = table["tag"] != 0
        np.testing.assert_allclose(table["spacing"][edge], np.minimum(8, 0.5 * depth)[edge],
                                   rtol=0.02)
        self.assertGreater(table["spacing"][~edge].max(), 9)

    def test_ascii_grid_with_a_projection_beside_it(self):
        rows = self.depths(17.5, 55.5, 0.05, 60, 40)
        (self.folder / "d.asc").write_text(
            "ncols 60\nnrows 40\nxllcorner 17.5\nyllcorner 53.5\ncellsize 0.05\n" +
            "\n".join(" ".join(f"{v:.9g}" for v in row) for row in rows) + "\n")
        message = self.refuse(*self.ask, "--spacing-grid", "d.asc")
        self.assertIn("look like longitude and latitude", message)
        (self.folder / "d.prj").write_text(
            'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],'
            'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]')
        self.expect_depths(self.table(*self.ask, "--spacing-grid", "d.asc")[0])

    def test_beside_and_across(self):
        write_geotiff(self.folder / "d.tif", self.depths(30, 55.5, 0.05, 60, 40), 30, 55.5, 0.05,
                      4326)
        message = self.refuse(*self.ask, "--spacing-grid", "d.tif")
        self.assertIn("--spacing-grid d.tif", message)
        self.assertIn("lies outside of the domain", message)
        write_geotiff(self.folder / "d.tif", self.depths(19, 55.5, 0.05, 60, 40), 19, 55.5, 0.05,
                      4326)
        _, _, err = self.table(*self.ask, "--spacing-grid", "d.tif")
        self.assertIn("covers only a part of the domain", err)

    @exists_if("PNPBS_MPIEXEC" in os.environ)
    def test_ranks(self):
        write_geotiff(self.folder / "d.tif", self.depths(19, 55.5, 0.05, 60, 40), 19, 55.5, 0.05,
                      4326)
        ask = (*self.ask, "--spacing-grid", "d.tif", *QUICK, "-o")
        _, one = self.run_command(*ask, "one.csv", code=NOT_CONVERGED)
        import ranks  # pylint: disable=import-outside-toplevel  # needs MPI
        two = subprocess.run([*ranks.MPIRUN, "-np", "2", COMMAND, *ask, "two.csv"], check=False,
                             cwd=self.folder, stderr=subprocess.PIPE)
        self.assertEqual(two.returncode, NOT_CONVERGED)
        self.assertEqual((self.folder / "one.csv").read_bytes(),
                         (self.folder / "two.csv").read_bytes())
        warning = [line for line in one.splitlines() if b"covers only" in line]
        self.assertEqual(len(warning), 1)
        self.assertEqual(warning, [line for line in two.stderr.splitlines() if b"covers" in line])

    def test_without_the_library(self):
        write_geotiff(self.folder / "d.tif", self.depths(17.5, 55.5, 0.05, 60, 40), 17.5, 55.5,
                      0.05, 4326)
        folder = self.folder / "lib"
        folder.mkdir()
        (folder / "libpnpbs_geo.so.0").write_text("no library")
        message = self.refuse("--domain", self.square, "--spacing-grid", "d.tif", code=FAILED,
                              environment={"LD_LIBRARY_PATH": str(folder)})
        self.assertIn("libgdal-dev", message)

    def test_files_that_are_none(self):
        (self.folder / "no.tif").write_text("no raster")
        for name in ("no.tif", "missing.tif"):
            self.assertIn(name, self.refuse(*self.ask, "--spacing-grid", name))


if __name__ == "__main__":
    unittest.main()
