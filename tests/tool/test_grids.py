# SPDX-License-Identifier: BSD-3-Clause
"""--spacing-grid beside and across the domain, in formulas, and of files that GDAL reads. PNPBS_GEO
says whether the command was built with GDAL."""

import json
import os
import subprocess
import unittest

import numpy as np

from command import BAD_INPUT, COMMAND, DONE, FAILED, NOT_CONVERGED, CommandTest
from rasters import write_geotiff, write_netcdf

BUILT = os.environ["PNPBS_GEO"] == "1"
QUICK = ("--set", "steps=3")

# d from 0.05 in the west to 0.1 in the east of the unit square, and beyond it.
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
        """The nodes of a run, its report, and what it said."""
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

    def test_all_of_the_domain(self):
        _, report, err = self.on_square("--spacing-grid", self.write(grid()))
        self.assertNotIn("covers only", err)
        # Cells that end where the domain does, so that their middles do not reach it.
        _, _, err = self.on_square("--spacing-grid", self.write(grid(0, 0, 0.25)))
        self.assertNotIn("covers only", err)
        self.assertFalse([w for w in report["warnings"] if "grid" in w])

    def test_a_part_of_the_domain(self):
        _, report, err = self.on_square("--spacing-grid", self.write(grid(-0.7, -0.1)))
        self.assertRegex(err, r"the grid of the spacing covers only a part of the domain: of [0-9]+ "
                              r"nodes, [0-9]+ are farther than d from it, one of them at \(.*The grid "
                              r"reaches from \(-0.7, -0.1\) to \(0.5, 1.1\), the domain from \(0, 0\) "
                              r"to \(1, 1\)")
        self.assertEqual(len([w for w in report["warnings"] if "covers only" in w]), 1)

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
        alone, *_ = self.on_square("--spacing-grid", "g.asc")
        for arguments in (("--spacing-grid", "g.asc", "--spacing", "grid"),
                          ("--spacing-grid", "h=g.asc", "--spacing", "h")):
            same, report, _ = self.on_square(*arguments)
            np.testing.assert_allclose(same["x"], alone["x"], atol=1e-9)
            self.assertEqual(report["spacing_grid"], arguments[1])

    def test_several_grids_with_the_shape(self):
        table, report, _ = self.on_square("--spacing-grid", "h=g.asc", "--spacing-grid",
                                          "k=two.asc", "--spacing", "min(h, 0.03*k + 0.1*dist(2))")
        self.assertEqual(report["spacing_grid"], ["h=g.asc", "k=two.asc"])
        x, y = table["x"], table["y"]
        at = np.clip((x + 0.1) / 0.3 - 0.5, 0, 3)
        h = np.interp(at, range(4), [0.05, 0.06, 0.08, 0.1])
        # From the hole in the square, 0.4 .. 0.6, which has tag 2.
        dist = np.hypot(np.maximum(abs(x - 0.5) - 0.1, 0), np.maximum(abs(y - 0.5) - 0.1, 0))
        np.testing.assert_allclose(table["spacing"], np.minimum(h, 0.06 + 0.1 * dist), rtol=0.03)

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
        self.assertIn("would replace", self.refuse("--domain", self.square, "--spacing-grid",
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

    def test_names_that_are_none(self):
        ask = ("--domain", self.square, "-o", "a.csv", "--name", "2=hole", "--spacing")
        message = self.refuse(*ask, "0.1 + dist(hle)")
        self.assertIn("dist(hle): the domain has no group of that name; did you mean hole?", message)
        self.assertIn("unknown name 'hole'", self.refuse(*ask, "0.1 + hole"))


@unittest.skipIf(BUILT, "built with GDAL")
class Without(GridsTest):
    def test_says_how_to_get_it(self):
        (self.folder / "g.tif").write_bytes(b"II")
        message = self.refuse("--domain", self.square, "--spacing-grid", "g.tif", code=1)
        self.assertIn("libgdal-dev", message)


@unittest.skipUnless(BUILT, "built without GDAL")
class Rasters(GridsTest):
    """A bay from 18 to 20 degrees east and 54 to 55 north; depths that are linear in the degrees."""

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
        """By the series of the transverse Mercator projection, to some 10 m."""
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

    def test_geotiff_in_degrees(self):
        write_geotiff(self.folder / "d.tif", self.depths(17.5, 55.5, 0.05, 60, 40), 17.5, 55.5,
                      0.05, 4326)
        table, report, err = self.table(*self.ask, "--spacing-grid", "d.tif")
        self.expect_depths(table)
        self.assertNotIn("covers only", err)
        self.assertEqual(report["spacing_grid"], "d.tif")
        # With longitudes beyond 360 it is the same.
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

    @unittest.skipUnless("PNPBS_MPIEXEC" in os.environ, "without MPI")
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
