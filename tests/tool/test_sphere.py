# SPDX-License-Identifier: BSD-3-Clause
"""Tests whole spheres, and seas on spheres that coasts in longitude and latitude bound. PNPBS_GEO
says whether the command was built with GDAL."""

import json
import os
import re
import unittest

import numpy as np

from builds import exists_if
from command import LAKE, CommandTest

RADIUS = 6371.22


def closed(ring):
    return ring + ring[:1]


def feature(*polygons):
    return {"type": "Feature", "properties": {},
            "geometry": {"type": "MultiPolygon", "coordinates": [[closed(ring)] for ring in polygons]}}


# Antarctica is cut at 180 degrees, as in real files: the curve follows the meridian to the pole and
# returns along it. Some points have -179.99999999999994 there.
WEST = -180 + 6e-14
ANTARCTICA = feature([[max(lon, WEST), -74 + 3 * np.cos(np.radians(3 * lon))]
                      for lon in range(-180, 181, 5)] + [[180, -90], [WEST, -90]])
ACROSS = feature([[168, 8], [180, 8], [180, 22], [170, 25]], [[-180, 8], [-172, 12], [-180, 22]])
CONTINENT = feature([[-20, -10], [30, -30], [50, 10], [20, 40], [-30, 30]])


def element_rows(path):
    """Returns the rows of an .msh2 file: number, kind (1: edge, 2: triangle), tags and nodes."""
    lines = path.read_text().split("$Elements\n")[1].split("\n")[1:]
    return [[int(word) for word in line.split()] for line in lines if line and line[0] != "$"]


def triangles_and_edges(rows):
    """Returns triangles and edges by the indices of their nodes."""
    return (np.array([row[-3:] for row in rows if row[1] == 2]) - 1,
            np.array([row[-2:] for row in rows if row[1] == 1]) - 1)


class WholeSphere(CommandTest):
    """A sphere without a file, which does not require GDAL."""

    SPACING = "250 + 150*sin(pi*lon/180)^2"

    def placed(self, *arguments, ranks=0, spacing=SPACING, **more):
        run = (lambda *a: self.run_on_ranks(*a, ranks=ranks)) if ranks else self.run_command
        run("--sphere", f"{RADIUS},20,-30", "--spacing", spacing, "--check", "--quiet", "--output", "nodes.csv",
            "--report", "report.json", *arguments, **more)
        return ((self.folder / "nodes.csv").read_bytes(),
                json.loads((self.folder / "report.json").read_text()))

    def test_it_is_closed(self):
        nodes, report = self.placed("--output", "sphere.msh2", "--output", "sphere.svg")
        rows = element_rows(self.folder / "sphere.msh2")
        self.assertEqual({row[1] for row in rows}, {2})  # only triangles
        corners, _ = triangles_and_edges(rows)
        self.assertEqual(len(corners), 2 * (report["nodes"] - 2))
        edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
        self.assertTrue(np.all(np.unique(edges, axis=0, return_counts=True)[1] == 2))
        self.assertEqual(report["boundary_nodes"], 0)
        seen = len(re.findall(r"<path[^>]*Z", (self.folder / "sphere.svg").read_text()))
        self.assertTrue(0.4 * len(corners) < seen < 0.6 * len(corners), f"{seen} of {len(corners)}")

    def triangles_in_picture(self, *arguments, spacing="600"):
        """Returns the triangles in the picture, each an array of x and y, and the size of the
        picture."""
        self.placed("--output", "sphere.svg", *arguments, spacing=spacing)
        picture = (self.folder / "sphere.svg").read_text()
        size = [float(value) for value in re.findall(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', picture)[0]]
        paths = [[float(number) for number in re.findall(r"-?[\d.]+", path)]
                 for path in re.findall(r'<path[^>]*fill-rule[^>]* d="([^"]*Z)', picture)]
        return [np.reshape(path, (-1, 2)) for path in paths if len(path) in (6, 8)], size

    def test_views(self):
        """Checks views. In a view from a point, triangles there are largest. A map shows all
        triangles, and those at its ends twice."""
        for view in ("0,0", "120,50", "-70,-90"):
            triangles, size = self.triangles_in_picture("--view", view)
            areas = np.array([abs(np.linalg.det(x[1:3] - x[0])) / 2 for x in triangles])
            middles = np.array([x[:3].mean(axis=0) for x in triangles])
            off = np.linalg.norm(middles - [size[0] / 2, middles.mean(axis=0)[1]], axis=1) / (size[0] / 2)
            self.assertGreater(areas[off < 0.3].mean(), 2 * areas[off > 0.8].mean())
        for view in ("0,0", "map"):  # east is to the right and north upwards, where nodes are fewer
            for k, spacing in enumerate(("600 + 0.05*y", "600 + 0.05*z")):
                triangles, size = self.triangles_in_picture("--view", view, spacing=spacing)
                middle = np.array([x[:3].mean(axis=0)[k] for x in triangles])
                half = size[0] / 2 if k == 0 else (middle.min() + middle.max()) / 2
                share = np.mean(middle > half)
                self.assertTrue(share < 0.42 if k == 0 else share > 0.55, f"{view}, {k}: {share}")
        shown, _ = self.triangles_in_picture("--view", "map")
        all_of_them = 2 * (self.placed(spacing="600")[1]["nodes"] - 2)
        self.assertTrue(all_of_them < len(shown) < 1.2 * all_of_them, f"{len(shown)} of {all_of_them}")
        # 12 meridians and 5 parallels; from above the equator all parallels are seen, and 7 meridians
        # of which two are at the rim.
        for view, expected in (("map", (17,)), ("0,0", (10, 11, 12))):
            self.triangles_in_picture("--view", view)
            picture = (self.folder / "sphere.svg").read_text()
            graticule = re.findall(r'<path style="fill:none;[^"]*stroke-opacity:0.55;[^"]*" d="([^"]*)"', picture)
            self.assertEqual(len(graticule), 1)
            self.assertIn(graticule[0].count("M"), expected)
        for view in ("0", "0,91", "maps"):
            self.assertIn("--view: expected LON,LAT", self.refuse("--sphere", "1", "--spacing", "1", "--view", view))
        self.assertIn("it needs --sphere", self.refuse("--domain", LAKE, "--spacing", "1", "--view", "map"))

    def test_nodes_follow_the_spacing_beside_the_patch(self):
        """Checks that no d is missed near the centre of projection. There d in the chart changes as
        the last sweeps move nodes, so it must be evaluated at the final positions. With d from
        before the sweeps, the status was a missed spacing, by 85 edges."""
        self.placed(spacing="100")

    def test_nodes_are_as_dense_on_both_sides(self):
        """Checks the number of nodes by distance from the centre of projection. In the chart d
        grows 100 times on the way. When levels lost nodes where d grows, there were 1.3 per cent
        too few nodes beside the patch."""
        nodes, _ = self.placed("--set", "topology_repairs=3", spacing="60")
        places = np.loadtxt(nodes.decode().splitlines(), delimiter=",", skiprows=1)
        header = nodes.decode().split("\n")[0].strip().split(",")
        x = places[:, [header.index(name) for name in "xyz"]] / RADIUS
        lon, lat = np.radians([20, -30])
        point = np.array([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])
        counted = np.histogram(x @ point, np.linspace(-1, 1, 9))[0]
        per_node = 4 * np.pi * RADIUS**2 / 8 / counted / 60**2
        self.assertLess(np.abs(per_node / (np.sqrt(3) / 2) - 1).max(), 0.005, per_node)

    def test_the_patch_fits_the_others(self):
        """Checks that the closing patch fits the other nodes. While they were beside fixed nodes,
        the least quality was 0.63 and triangles were obtuse."""
        for spacing in ("300", "220"):
            quality = self.placed(spacing=spacing)[1]["quality"]
            self.assertGreater(quality["min"], 0.85)
            self.assertEqual(quality["obtuse"], 0)

    def test_volumes(self):
        report = self.placed("--volumes")[1]
        self.assertAlmostEqual(report["volumes"]["total"] / (4 * np.pi * RADIUS**2), 1, 12)
        self.assertAlmostEqual(report["volumes"]["ratio"]["mean"], np.sqrt(3) / 2, 1)

    def test_as_many_nodes_as_are_wanted(self):
        nodes = self.placed("--nodes", "20000", spacing="100 + 2*abs(lat)")[1]["nodes"]
        self.assertLess(abs(nodes / 20000 - 1), 0.02)

    def test_values_in_files(self):
        """Checks that d of previous nodes, on a mesh or at points, gives the same number of nodes.
        """
        _, report = self.placed("--output", "before.vtu", "--output", "before.csv")
        for name in ("before.vtu:spacing", "before.csv:spacing"):
            with self.subTest(name):
                nodes, again = self.placed(spacing=name)
                self.assertLess(abs(again["nodes"] / report["nodes"] - 1), 0.01)
                rows = np.array([[float(x) for x in line.split(b",")] for line in nodes.splitlines()[1:]])
                expected = 250 + 150 * (rows[:, 2] / np.hypot(rows[:, 1], rows[:, 2]))**2
                off = np.abs(rows[:, -1] / expected - 1)
                off = off[np.abs(rows[:, 3]) < 0.9 * RADIUS]  # d as a function jumps at the poles
                self.assertLess(off.max(), 0.05)
                self.assertLess(off.mean(), 0.004)

    @exists_if("PNPBS_MPIEXEC" in os.environ)
    def test_ranks_place_the_same_nodes(self):
        nodes, _ = self.placed()
        for ranks in (2, 3, 5):
            self.assertEqual(self.placed(ranks=ranks)[0], nodes)

    @exists_if("PNPBS_MPIEXEC" in os.environ)
    def test_ranks_place_the_same_nodes_for_finite_volumes(self):
        wishes = ("--set", "centroidal_sweeps=8", "--set", "obtuse_rounds=20")
        nodes, report = self.placed(*wishes)
        self.assertEqual(report["quality"]["obtuse"], 0)
        self.assertLess(report["cell"]["mean_offset"], 0.3 * self.placed()[1]["cell"]["mean_offset"])
        for ranks in (2, 3, 5):
            self.assertEqual(self.placed(*wishes, ranks=ranks)[0], nodes)

    @exists_if("PNPBS_MPIEXEC" in os.environ)
    def test_ranks_go_on_from_one_file(self):
        self.placed("--checkpoint", "half.h5", "--set", "steps=20", code=3)
        goes_on = ("--restart", "half.h5", "--set", "steps=300")
        nodes, _ = self.placed(*goes_on)
        self.assertEqual(self.placed(*goes_on, ranks=3)[0], nodes)

    def test_what_is_refused(self):
        for spacing, words in (("auto", "without curves"), ("100 + 0.1*dist", "without curves"),
                               ("2000", "name another point")):
            self.assertIn(words, self.refuse("--sphere", str(RADIUS), "--spacing", spacing))
        self.assertIn("--domain is missing", self.refuse("--spacing", "1"))
        self.assertIn("--bubbles exclude", self.refuse("--sphere", "1", "--spacing", "0.3", "--bubbles"))
        self.assertIn("not on a sphere", self.refuse("--sphere", "1", "--spacing", "0.3", "--density", "1", "-q",
                                                      "--output", "gas.hdf5"))


@exists_if(os.environ["PNPBS_GEO"] == "1")
class Sphere(CommandTest):
    def sea(self, *features):
        path = self.folder / "coast.geojson"
        path.write_text(json.dumps({"type": "FeatureCollection",
                                    "features": list(features or (ANTARCTICA, ACROSS, CONTINENT))}))
        return path

    def placed(self, *arguments, spacing="250", coast=None, sphere=RADIUS):
        _, err = self.run_command("--domain", coast or self.sea(), "--sphere", str(sphere),
                                  "--corner-angle", "20", "--spacing", spacing, "--check", "--output", "nodes.csv",
                                  "--output", "sea.msh2", "--report", "report.json", *arguments)
        table = np.genfromtxt(self.folder / "nodes.csv", delimiter=",", names=True)
        report = json.loads((self.folder / "report.json").read_text())
        return np.column_stack([table[k] for k in "xyz"]), table, report, err.decode()

    def triangles(self):
        return triangles_and_edges(element_rows(self.folder / "sea.msh2"))

    def test_a_sea_with_a_pole_and_the_date_line(self):
        x, table, report, _ = self.placed()
        np.testing.assert_allclose(np.linalg.norm(x, axis=1), RADIUS, rtol=1e-15)
        np.testing.assert_allclose(table["spacing"], 250, rtol=1e-12)
        self.assertEqual(report["sphere"], {"radius": RADIUS, "outside": [55, -82]})
        self.assertNotIn("projection", report)
        self.assertFalse((self.folder / "nodes.prj").exists())
        triangles, edges = self.triangles()
        corners = x[triangles]
        self.assertTrue(np.all(np.linalg.det(corners) > 0))  # counter-clockwise from outside
        # Euler's formula for a sphere without three lands, each of which is in one piece.
        self.assertEqual(len(x) - (3 * len(triangles) + len(edges)) // 2 + len(triangles), 2 - 3)
        # The meridian of 180 degrees must not leave nodes in the middle of the island or of
        # Antarctica.
        lon, lat = np.degrees(np.arctan2(x[:, 1], x[:, 0])), np.degrees(np.arcsin(x[:, 2] / RADIUS))
        on_it = np.abs(np.abs(lon) - 180) < 1e-6
        self.assertTrue(np.all((lat[on_it] < 8.001) | (lat[on_it] > 21.999)))
        self.assertGreater(lat.min(), -77.1)
        self.assertGreater(report["quality"]["mean"], 0.97)

    def test_formulas_know_degrees_and_lengths_along_the_sphere(self):
        spacing = "150 + (lat > 0 ? 200 : 0) + 0.02*dist + 0*lon"
        x, table, _, _ = self.placed("--set", "growth_limit=0", spacing=spacing)
        lat = np.degrees(np.arcsin(np.clip(x[:, 2] / RADIUS, -1, 1)))
        on_coast = table["tag"] > 0
        np.testing.assert_allclose(table["spacing"][on_coast & (lat < -1)], 150, atol=0.5)
        np.testing.assert_allclose(table["spacing"][on_coast & (lat > 1)], 350, atol=0.5)
        self.assertGreater(table["spacing"].max(), 350 + 0.02 * 4000)

    def test_grids_are_in_degrees(self):
        rows = [" ".join(str(300 + 2 * row + (100 if column < 18 else 0)) for column in range(36))
                for row in range(18)]  # from north to south
        (self.folder / "d.asc").write_text("ncols 36\nnrows 18\nxllcorner -180\nyllcorner -90\n"
                                           "cellsize 10\n" + "\n".join(rows) + "\n")
        x, table, _, _ = self.placed("--spacing-grid", "d.asc", spacing="grid")
        lon = np.degrees(np.arctan2(x[:, 1], x[:, 0]))
        row = (90 - np.degrees(np.arcsin(x[:, 2] / RADIUS))) / 10 - 0.5
        for west, extra in ((True, 100), (False, 0)):
            here = (np.abs(lon) > 20) & (np.abs(lon) < 160) & ((lon < 0) == west) & (row > 0)
            np.testing.assert_allclose(table["spacing"][here], 300 + 2 * row[here] + extra, rtol=0.01)

    def grid_of_degrees(self, name, value):
        """Writes a grid of the whole Earth with cells of 5 degrees. Cells where the function of
        longitude and latitude is nan have no data."""
        lon, lat = np.meshgrid(np.arange(-177.5, 180, 5), np.arange(87.5, -90, -5))
        values = value(lon, lat)
        rows = "\n".join(" ".join("-1" if np.isnan(v) else repr(float(v)) for v in row) for row in values)
        (self.folder / name).write_text("ncols 72\nnrows 36\nxllcorner -180\nyllcorner -90\ncellsize 5\n"
                                        f"nodata_value -1\n{rows}\n")

    def test_grids_with_gaps(self):
        """Checks that a warning counts nodes in the middle of a gap, but none beside land without
        data."""
        self.grid_of_degrees("gap.asc", lambda lon, lat: np.where(abs(lon + 150) + abs(lat) < 20, np.nan, 300))
        _, table, report, err = self.placed("--spacing-grid", "gap.asc", spacing="grid")
        found = re.search(r"the grid 'grid' \(gap.asc\) has gaps in the domain: of (\d+) nodes, (\d+) lie where it has "
                          r"no data, one of them at \(longitude (.*), latitude (.*)\); there its", err)
        nodes, without, lon, lat = map(float, found.groups())
        self.assertEqual(nodes, report["nodes"])
        self.assertIn(found[0], report["warnings"][-1])
        self.assertLess(abs(lon + 150) + abs(lat), 20)
        # A node counts if none of the four cells whose centres surround it has data.
        its_lon = np.degrees(np.arctan2(table["y"], table["x"]))
        its_lat = np.degrees(np.arcsin(table["z"] / RADIUS))
        west, south = np.floor((its_lon - 2.5) / 5) * 5 + 2.5, np.floor((its_lat - 2.5) / 5) * 5 + 2.5
        gap = [abs(west + i + 150) + abs(south + j) < 20 for i in (0, 5) for j in (0, 5)]
        self.assertEqual(without, np.sum(np.all(gap, axis=0)))
        self.grid_of_degrees("land.asc", lambda lon, lat: np.where((abs(lon) < 18) & (abs(lat) < 8), np.nan, 300))
        self.assertNotIn("gaps", self.placed("--spacing-grid", "land.asc", spacing="grid")[3])

    def test_grids_without_a_value_in_the_domain(self):
        coast = self.sea(CONTINENT)
        ask = ("--domain", coast, "--sphere", f"{RADIUS},180,0", "--spacing", "min(grid, 300)", "--spacing-grid")
        self.grid_of_degrees("far.asc", lambda lon, lat: np.where(abs(lon) > 120, 300, np.nan))
        self.assertIn("the grid 'grid' (far.asc) has no value anywhere in the domain: of ",
                      self.refuse(*ask, "far.asc", "-o", "n.csv"))
        (self.folder / "beside.asc").write_text("ncols 2\nnrows 2\nxllcorner 100\nyllcorner 0\ncellsize 5\n"
                                                "300 300\n300 300\n")
        message = self.refuse(*ask, "beside.asc", "-o", "n.csv")
        self.assertRegex(message, r"of (\d+) nodes, \1 lie beyond its edge, one of them at \(longitude .*, latitude "
                                  r".*\)\. The grid reaches from \(100, 0\) to \(110, 10\)\n")

    def test_the_land_is_what_is_seen_from_the_sea(self):
        coast = self.sea(CONTINENT)
        x, _, report, _ = self.placed(sphere=f"{RADIUS},180,0", coast=coast, spacing="150")
        lon, lat = np.degrees(np.arctan2(x[:, 1], x[:, 0])), np.degrees(np.arcsin(x[:, 2] / RADIUS))
        self.assertTrue(np.all((lon > -31) & (lon < 51) & (lat > -32) & (lat < 41)))
        triangles, _ = self.triangles()
        whole = 0.5 * np.linalg.norm(np.cross(x[triangles[:, 1]] - x[triangles[:, 0]],
                                              x[triangles[:, 2]] - x[triangles[:, 0]]), axis=1).sum()
        self.assertEqual(report["sphere"]["outside"], [180, 0])
        rest = self.placed(coast=coast, spacing="400")[2]  # the default centre is outside of it as well
        self.assertLess(whole, 4 * np.pi * RADIUS ** 2 / 5)
        self.assertGreater(rest["nodes"], 100)

    @exists_if("PNPBS_MPIEXEC" in os.environ)
    def test_ranks_place_the_same_nodes(self):
        coast, spacing = self.sea(), "120 + 0.1*dist"
        one = self.placed(coast=coast, spacing=spacing)[2]["hash"]
        for ranks in (2, 3, 5):
            self.run_on_ranks("--domain", coast, "--sphere", str(RADIUS), "--corner-angle", "20",
                              "--spacing", spacing, "--report", "ranks.json", ranks=ranks)
            self.assertEqual(json.loads((self.folder / "ranks.json").read_text())["hash"], one)

    def test_borders_of_neighbours(self):
        """Checks a border between two polygons outside of the domain, as where a continent is cut
        in two. It does not count as a missing part of the coast."""
        east, west = feature([[168, 8], [180, 8], [180, 22], [170, 25]]), feature([[-180, 8], [-172, 12], [-180, 22]])
        whole = self.placed()[2]
        cut = self.sea(ANTARCTICA, east, west, CONTINENT)
        _, _, report, err = self.placed(coast=cut)
        self.assertLess(abs(report["nodes"] / whole["nodes"] - 1), 0.01)
        self.assertIn("1 segments that neighbouring polygons share were left out", err)
        # Nodes follow such a border in the domain.
        x, table, _, err = self.placed(coast=self.sea(east, west), sphere=f"{RADIUS},0,0", spacing="100")
        self.assertNotIn("left out", err)
        inner = (table["tag"] > 0) & (x[:, 0] < 0) & (abs(x[:, 1]) < 1e-6)
        self.assertGreater(inner.sum(), 10)

    def test_a_coast_that_is_far_finer(self):
        """Checks that a warning names points, and says whether much of the coast is too fine."""
        rough = feature([[20 * np.cos(a) * (1 + 0.02 * (k % 2)), 20 * np.sin(a) * (1 + 0.02 * (k % 2))]
                         for k, a in enumerate(np.linspace(0, 2 * np.pi, 600, endpoint=False))])
        _, _, report, err = self.placed(coast=self.sea(ANTARCTICA, rough))
        place = r"\(length [0-9.]+, spacing 2[0-9.]+, at \(longitude [-0-9.]+, latitude [-0-9.]+\)\)"
        self.assertRegex(err, "600 boundary edges shorter than half of it; the worst: .* " + place)
        self.assertRegex(err, r"much of the boundary, which has [0-9]+ edges: .*\(simplify\)")
        self.assertNotIn("much of the boundary", self.placed("--simplify", "0.5,2",
                                                             coast=self.sea(ANTARCTICA, rough))[3])

    def test_what_bounds_nothing(self):
        line = {"type": "Feature", "properties": {},
                "geometry": {"type": "LineString", "coordinates": [[0, 0], [20, 10], [40, 0]]}}
        _, _, _, err = self.placed(coast=self.sea(line))
        self.assertIn("note: no polygon and no closed line bounds the domain", err)

    # The segment across 180 degrees takes the short way, not the way along all other segments.
    def test_a_coast_on_a_parallel(self):
        for cut in ([], [[180, -74], [180, -90], [-180, -90], [-180, -80]]):
            coast = self.sea(feature([[lon, -74] for lon in range(-180, 180, 5)] + cut), CONTINENT)
            x, _, _, err = self.placed(coast=coast)
            self.assertAlmostEqual(np.degrees(np.arcsin(x[:, 2].min() / RADIUS)), -74, delta=0.1)
            self.assertEqual("traversed in both directions" in err, bool(cut))
            triangles, edges = self.triangles()
            self.assertEqual(len(x) - (3 * len(triangles) + len(edges)) // 2 + len(triangles), 2 - 2)

    # Checks that pictures hide the far side, also if there is no sea.
    def test_pictures(self):
        self.run_command("--domain", self.sea(), "--sphere", str(RADIUS), "--spacing", "500", "--corner-angle",
                         "20", "--output", "sea.svg")
        picture = (self.folder / "sea.svg").read_text()
        seen = len(re.findall(r"<path[^>]*Z", picture))
        self.placed(spacing="500")
        triangles = len(self.triangles()[0])
        self.assertTrue(0.3 * triangles < seen < 0.7 * triangles, f"{seen} of {triangles}")

    def test_what_is_refused(self):
        coast = self.sea()
        for arguments, words in ((("--sphere", "0"), "--sphere: expected RADIUS"),
                                 (("--sphere", "1,2"), "--sphere: expected RADIUS"),
                                 (("--sphere", "1,0,91"), "--sphere: expected RADIUS"),
                                 (("--sphere", "1", "--projection", "auto"), "--projection exclude"),
                                 (("--sphere", "1", "--surfaces-only"), "--surfaces-only exclude")):
            self.assertIn(words, self.refuse("--domain", coast, "--spacing", "1", *arguments))
        self.assertIn("--sphere", self.refuse("--domain", LAKE, "--spacing", "1", "--sphere", "1"))
        # The centre of projection at 6 degrees lies on the coast along the equator, from 0 to 10
        # degrees.
        on_equator = self.sea(feature([[0, 0], [10, 0], [10, 5], [0, 5]]))
        message = self.refuse("--domain", on_equator, "--sphere", f"{RADIUS},6,0", "--spacing", "300")
        self.assertIn("feature 0: vertex ", message)
        self.assertIn("named as outside of the domain lies on the curve", message)
        # The error names the point at which a coast crosses itself.
        crossed = self.sea(feature([[0, 0], [40, 0], [0, 30], [40, 30]]))
        message = self.refuse("--domain", crossed, "--sphere", str(RADIUS), "--spacing", "300")
        self.assertIn("cross at (longitude 19.99999", message)
        self.assertTrue(message.endswith("'Polygons that cross'\n"), message)


if __name__ == "__main__":
    unittest.main()
