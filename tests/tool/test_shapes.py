# SPDX-License-Identifier: BSD-3-Clause
"""Tests domains in geographic formats, such as GeoJSON, with projections. PNPBS_GEO says whether
the command was built with GDAL."""

import json
import math
import os
import random
import re
import subprocess
import unittest

import numpy as np

from builds import exists_if
from command import COMMAND, LAKE, LEFT_OUT, CommandTest

BUILT = os.environ["PNPBS_GEO"] == "1"


def feature(kind, coordinates, **properties):
    return {"type": "Feature", "properties": properties,
            "geometry": {"type": kind, "coordinates": coordinates}}


def closed(ring):
    return ring + ring[:1]


SQUARE = closed([[18.0, 54.0], [20.0, 54.0], [20.0, 55.0], [18.0, 55.0]])
LAND = feature("Polygon", [SQUARE], name="land", code=5)


class ShapesTest(CommandTest):
    def geojson(self, *features, name="land.geojson"):
        path = self.folder / name
        path.write_text(json.dumps({"type": "FeatureCollection", "features": list(features)}))
        return path

    def report(self, *arguments, **more):
        _, err = self.run_command(*arguments, "--report", "report.json", **more)
        return json.loads((self.folder / "report.json").read_text()), err.decode()


@exists_if(not BUILT)
class Without(ShapesTest):
    def test_says_how_to_get_it(self):
        message = self.refuse("--domain", self.geojson(LAND), "--spacing", "20", code=1)
        self.assertIn("libgdal-dev", message)
        out, _ = self.run_command("--version")
        self.assertIn(b"GDAL: none", out)


@exists_if(BUILT)
class Shapes(ShapesTest):
    def test_the_version_names_gdal(self):
        out, _ = self.run_command("--version")
        self.assertRegex(out.decode(), r"(?m)^GDAL: \d+\.\d+")

    def nodes(self, *arguments, spacing="20", domain=None):
        """Runs the command in kilometres. Returns coordinates, report and messages."""
        report, err = self.report("--domain", domain or self.geojson(LAND), "--spacing", spacing,
                                  "--unit", "km", "--output", "nodes.csv", "--check", *arguments)
        table = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
        return np.column_stack([table["x"], table["y"]]), report, err

    def test_longitude_and_latitude_are_projected(self):
        x, report, err = self.nodes()
        self.assertIn("x and y are in 'WGS 84 / UTM zone 34N in kilometre', in kilometre", err)
        self.assertEqual(report["projection"]["name"], "WGS 84 / UTM zone 34N in kilometre")
        self.assertIn("+lon_0=21 +k=0.9996", report["projection"]["proj"])
        self.assertTrue(report["projection"]["wkt"].startswith("PROJCRS["))
        self.assertEqual(report["warnings"], [])
        least, greatest = report["projection"]["scale"]
        self.assertTrue(0.9996 < least < greatest < 1.001)
        # The central meridian, 21 degrees east, is at x = 500 km.
        self.assertTrue(np.all((x[:, 0] > 300) & (x[:, 0] < 440)))
        self.assertTrue(np.all((x[:, 1] > 5980) & (x[:, 1] < 6100)))
        self.assertIn("UTM", (self.folder / "nodes.prj").read_text())
        self.assertEqual(self.nodes("--quiet")[2], "")

    def test_other_projections(self):
        prj = self.folder / "asked.prj"
        self.nodes("--projection", "EPSG:2180")
        (self.folder / "nodes.prj").rename(prj)
        first, *_ = self.nodes("--projection", "EPSG:2180")
        again, report, _ = self.nodes("--projection", prj)
        np.testing.assert_allclose(first, again, atol=1e-6)
        self.assertIn("unit", report["projection"])
        plain, report, _ = self.nodes("--projection", "+proj=laea +lat_0=54.5 +lon_0=19 +units=km")
        self.assertLess(np.abs(plain).max(), 70)
        # A degree of latitude is 111.3 km here, and a degree of longitude is 65.6 km in the south.
        self.assertAlmostEqual(np.ptp(plain[:, 0]), 131.2, delta=0.5)
        self.assertAlmostEqual(np.ptp(plain[:, 1]), 111.3 + 0.5, delta=0.5)
        self.assertEqual(report["projection"]["unit"], "kilometre")

    def test_degrees_if_they_are_asked_for(self):
        report, err = self.report("--domain", self.geojson(LAND), "--spacing", "0.3",
                                  "--projection", "none", "--output", "nodes.csv")
        table = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
        self.assertEqual((table["x"].min(), table["x"].max()), (18, 20))
        self.assertIn("note: longitude and latitude are taken as x and y", err)
        self.assertEqual(len(report["warnings"]), 1)
        self.assertIn("GEOGCS", (self.folder / "nodes.prj").read_text())

    def test_tags_and_layers(self):
        hole = closed([[18.5, 54.3], [19.5, 54.3], [19.5, 54.7], [18.5, 54.7]])
        path = self.geojson(LAND, feature("Polygon", [hole], name="lake", code=7),
                            feature("Point", [18.2, 54.2], name="gauge", code=9))
        _, report, _ = self.nodes("--tag-field", "name", "--layer", "land", domain=path)
        self.assertEqual([group["name"] for group in report["groups"]], ["land", "lake", "gauge"])
        self.assertEqual(report["layer"], "land")
        self.nodes("--tag-field", "code", domain=path)
        table = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
        self.assertEqual(set(table["tag"]), {0, 5, 7, 9})
        ask = ("--domain", path, "--spacing", "20")
        self.assertIn("it has: land", self.refuse(*ask, "--layer", "sea"))
        self.assertIn("it has: name, code", self.refuse(*ask, "--tag-field", "tag"))

    def test_a_line_along_the_shore_is_an_open_boundary(self):
        # Checks an open boundary drawn by hand: it deviates by about 20 m and does not connect
        # corners.
        path = self.geojson(LAND, feature("LineString", [[20.0003, 54.2], [19.9998, 55.0002]],
                                          name="open"))
        x, report, err = self.nodes("--tag-field", "name", domain=path, spacing="5")
        self.assertIn("note: a line runs along the boundary", err)
        self.assertEqual([group["name"] for group in report["groups"]], ["land", "open"])
        table = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
        length = 0.8 * 111.3  # in km
        self.assertAlmostEqual(np.sum(table["tag"] == 2), length / 5, delta=2)
        self.assertLess(np.ptp(x[table["tag"] == 2][:, 0]), 8)

    def test_what_is_left_out_of_a_coast(self):
        """A coast whose lines do not close, with an island. Only the island is meshed,
        and the exit code and a warning tell that the rest is left out."""
        island = feature("Polygon", [closed([[18.8, 54.4], [19.2, 54.4], [19.2, 54.6]])], name="i")
        coast = feature("LineString", SQUARE[:4], name="coast")
        ask = ("--spacing", "5", "--unit", "km", "--tag-field", "name", "-o", "nodes.csv",
               "--report", "report.json")
        _, err = self.run_command("--domain", self.geojson(island, coast), *ask, code=LEFT_OUT)
        self.assertIn("warning: outside the domain and left out: ", err.decode())
        self.assertIn("nodes.csv", self.files())
        # With the open boundary the coast is closed, and the domain surrounds the island.
        ends = feature("LineString", [SQUARE[3], SQUARE[0]], name="open")
        self.run_command("--domain", self.geojson(island, coast, ends), *ask)
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual([group["name"] for group in report["groups"]], ["i", "coast", "open"])
        self.assertGreater(report["nodes"], 500)

    def test_what_is_refused(self):
        path = self.geojson(LAND)
        ask = ("--domain", path, "--spacing", "20")
        self.assertIn("--projection = 'EPSG:1'", self.refuse(*ask, "--projection", "EPSG:1"))
        self.assertIn("--unit = 'mile'", self.refuse(*ask, "--unit", "mile"))
        self.assertIn("--layer is for GeoJSON", self.refuse("--domain", LAKE, "--spacing", "20",
                                                            "--layer", "a"))
        self.assertIn("--layer is for GeoJSON", self.refuse("--domain", "ball(0,0,0, 1)",
                                                            "--spacing", "1", "--layer", "a"))
        bow = self.geojson(feature("Polygon", [closed([SQUARE[k] for k in (0, 2, 1, 3)])]))
        message = self.refuse("--domain", bow, "--spacing", "20")
        self.assertRegex(message, r"cross at \(.*\) \[longitude 19\.0[0-9]*, latitude 54\.5[0-9]*\]")
        self.assertIn("no such file", self.refuse("--domain", "no.shp", "--spacing", "1"))
        self.assertIn("cannot be opened", self.refuse(
            *ask, code=1, environment={"LD_LIBRARY_PATH": self.no_library()}))

    def no_library(self):
        folder = self.folder / "lib"
        folder.mkdir(exist_ok=True)
        (folder / "libpnpbs_geo.so.0").write_text("no library")
        return str(folder)

    def test_the_projection_of_the_input_stays(self):
        prj = self.folder / "land.prj"
        prj.write_text("the input's")
        message = self.refuse("--domain", "land.shp", "--spacing", "20", "--output", "land.vtu")
        self.assertIn("land.prj' would overwrite an input file", message)
        self.assertEqual(prj.read_text(), "the input's")
        # The .prj file beside the GeoJSON file is our own from the previous run, so it may be
        # replaced.
        self.run_command("--domain", self.geojson(LAND), "--spacing", "20000", "--output", "land.vtu")
        self.assertIn("UTM", prj.read_text())

    def test_one_projection_beside_several_files(self):
        out, _ = self.run_command("--domain", self.geojson(LAND), "--spacing", "20000", "--output",
                                  "a.vtu", "--output", "a.csv", "--output", "b.node", "--output",
                                  "c.svg")
        self.assertEqual(set(self.files()) - {"land.geojson", "square.poly"},
                         {"a.vtu", "a_facets.vtu", "a.csv", "a.prj", "b.node", "b.prj", "c.svg"})
        self.assertIn("b.prj", out.decode())

    @exists_if("PNPBS_MPIEXEC" in os.environ)
    def test_ranks(self):
        path = self.geojson(LAND)
        ask = ("--domain", path, "--spacing", "5", "--unit", "km", "--quiet", "--output")
        self.run_command(*ask, "one.csv")
        import ranks  # pylint: disable=import-outside-toplevel  # needs MPI
        subprocess.run([*ranks.MPIRUN, "-np", "2", COMMAND, *map(str, ask), "two.csv"],
                       cwd=self.folder, check=True)
        for ending in (".csv", ".prj"):
            self.assertEqual((self.folder / ("one" + ending)).read_bytes(),
                             (self.folder / ("two" + ending)).read_bytes())

    def test_coast_of_many_vertices(self):
        """Checks a coast with 10^5 vertices, with d from 0.2 to 20 km."""
        draw = random.Random(7)
        ring = [(2.2 * math.cos(2 * math.pi * k / 24), 2.2 * math.sin(2 * math.pi * k / 24))
                for k in range(24)]
        for _ in range(12):
            finer = []
            for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
                t = 0.13 * draw.uniform(-1, 1)
                finer += [(x0, y0), ((x0 + x1) / 2 - (y1 - y0) * t, (y0 + y1) / 2 + (x1 - x0) * t)]
            ring = finer
        coast = [[round(19 + 1.887 * x, 7), round(58 + y, 7)] for x, y in ring]
        self.assertEqual(len(coast), 98304)
        path = self.geojson(feature("Polygon", [closed(coast)]))
        _, report, err = self.nodes("--simplify", "0.5,2", "--corner-angle", "45", domain=path,
                                    spacing="max(0.2, min(20, 0.1*hypot(x - 200, y)))")
        self.assertIn("Lambert azimuthal equal-area at 58 N, 19 E", err)
        left_out = re.search(r"simplified: (\d+) vertices", report["warnings"][0])
        self.assertGreater(int(left_out[1]), 97000)
        self.assertGreater(report["nodes"], 500)


if __name__ == "__main__":
    unittest.main()
