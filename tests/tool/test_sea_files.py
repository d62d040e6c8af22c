# SPDX-License-Identifier: BSD-3-Clause
"""Tests meshes for models of seas and rivers, .gr3 and .2dm, by readers that follow the definitions
of the formats, against Gmsh files and tables of the same runs. PNPBS_GEO says whether the command
was built with GDAL."""

import collections
import json
import os
import unittest

import netCDF4
import numpy as np

from builds import exists_if
from command import BAD_INPUT, SQUARE, SQUARE_AREA, CommandTest
from readers import read_csv

Gr3 = collections.namedtuple("Gr3", "nodes depths triangles open land")
TwoDm = collections.namedtuple("TwoDm", "nodes heights triangles materials strings")

# The unit square with a square hole, with tags for an open right side and for an open side of the
# hole.
SIDES = SQUARE.replace("2 2 3 1\n", "2 2 3 3\n").replace("6 6 7 2\n", "6 6 7 4\n")
# A square with a triangle inside that touches its lower side, and with an inner curve.
TOUCHING = """\
9 2 0 0
1 0 0
2 1 0
3 1 1
4 0 1
5 0.5 0
6 0.3 0.4
7 0.7 0.4
8 0.7 0.7
9 0.7 0.9
9 1
1 1 5 1
2 5 2 1
3 2 3 1
4 3 4 1
5 4 1 1
6 5 6 2
7 6 7 2
8 7 5 2
9 8 9 5
1
1 0.5 0.2
"""


def read_gr3(path):
    """Reads a .gr3 file by SCHISM's manual. Text after the numbers of a line is a comment."""
    lines = iter(path.read_text().splitlines())
    assert next(lines).strip()

    def numbers(count):
        return [int(word) for word in next(lines).split()[:count]]

    elements, nodes = numbers(2)
    rows = [next(lines).split() for _ in range(nodes)]
    assert [row[0] for row in rows] == [str(k + 1) for k in range(nodes)] and {len(row) for row in rows} == {4}
    places = np.array([[float(word) for word in row[1:]] for row in rows])
    triangles = [[int(word) for word in next(lines).split()] for _ in range(elements)]
    assert [row[:2] for row in triangles] == [[k + 1, 3] for k in range(elements)]

    def segments(heads):
        count, total = numbers(1)[0], numbers(1)[0]
        found = []
        for _ in range(count):
            length, *kind = numbers(heads)
            found.append((*kind, [numbers(1)[0] - 1 for _ in range(length)]))
        assert total == sum(len(segment[-1]) for segment in found)
        return found

    open_ones = [segment[0] for segment in segments(1)]
    land = segments(2)
    assert not list(lines)
    return Gr3(places[:, :2], places[:, 2], np.array([row[2:] for row in triangles]) - 1, open_ones, land)


def read_2dm(path):
    """Reads a .2dm file by the page in the XMS Wiki."""
    cards = [line.split() for line in path.read_text().splitlines()]
    assert [card[0] for card in cards[:3]] == ["MESH2D", "MESHNAME", "NUM_MATERIALS_PER_ELEM"]
    by_kind = collections.defaultdict(list)
    for card in cards[3:]:
        by_kind[card[0]].append(card[1:])
    assert set(by_kind) <= {"E3T", "ND", "NS"}
    elements = np.array(by_kind["E3T"], int)
    nodes = np.array(by_kind["ND"], float)
    for rows in (elements, nodes):
        assert list(rows[:, 0]) == list(range(1, len(rows) + 1))
    strings, nodes_so_far = [], []
    for words in by_kind["NS"]:
        assert len(words) <= 11
        for k, word in enumerate(map(int, words)):
            nodes_so_far.append(abs(word) - 1)
            if word < 0:
                assert len(words) == k + 2
                strings.append((int(words[-1]), nodes_so_far))
                nodes_so_far = []
                break
    assert not nodes_so_far
    return TwoDm(nodes[:, 1:3], nodes[:, 3], elements[:, 1:4] - 1, elements[:, 4], strings)


def read_msh2(path):
    """Returns triangles and edges by the indices of their nodes from 0, and the tags of the edges.
    """
    lines = path.read_text().split("$Elements\n")[1].split("\n")[1:]
    rows = [[int(word) for word in line.split()] for line in lines if line and line[0] != "$"]
    return (np.array([row[-3:] for row in rows if row[1] == 2]) - 1,
            {tuple(sorted(np.array(row[-2:]) - 1)): row[3] for row in rows if row[1] == 1})


def read_ugrid(path):
    """Returns the variables of a UGRID file, which are found by the attributes of the mesh."""
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        mesh, = file.get_variables_by_attributes(cf_role="mesh_topology")
        assert mesh.topology_dimension == 2
        values = {name: file[name][:] for name in file.variables}
        values["places"] = np.column_stack([values[name] for name in mesh.node_coordinates.split()])
        for role in ("face", "boundary"):
            if f"{role}_node_connectivity" not in mesh.ncattrs():
                continue
            variable = file[mesh.getncattr(f"{role}_node_connectivity")]
            assert variable.cf_role == f"{role}_node_connectivity"
            values[role] = variable[:] - variable.start_index
        standard = [file[name].standard_name for name in mesh.node_coordinates.split()]
        at = {variable.name: variable.location for variable in file.get_variables_by_attributes(mesh=mesh.name)}
    return values, standard, at


def edges_of(nodes, is_loop=False):
    return list(zip(nodes, nodes[1:] + nodes[:1] if is_loop else nodes[1:]))


def bounding_edges(triangles):
    """Returns the edges that only one triangle has, with the orientation of that triangle."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    every = {tuple(edge) for edge in edges}
    return {edge for edge in every if edge[::-1] not in every}


def area_of(places):
    x, y = places.T
    return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


class SeaFiles(CommandTest):
    def read(self):
        return read_gr3(self.folder / "a.gr3"), read_2dm(self.folder / "a.2dm")

    def placed(self, domain=SIDES, *arguments):
        (self.folder / "a.poly").write_text(domain)
        outputs = [word for name in ("a.gr3", "a.2dm", "a.csv", "a.msh2") for word in ("-o", name)]
        self.run_command("--domain", "a.poly", "--spacing", "0.06", "--check", "-q", *outputs, *arguments)
        gr3, two_dm = self.read()
        self.check(gr3, two_dm, *read_msh2(self.folder / "a.msh2"))
        return gr3, two_dm

    def check(self, gr3, two_dm, triangles, tags):
        """The boundaries in both files must be that of the triangles, with the domain on the left
        of each edge."""
        for mesh in (gr3, two_dm):
            np.testing.assert_array_equal(mesh.triangles, triangles)
        edges = [edge for nodes in gr3.open for edge in edges_of(nodes)]
        edges += [edge for kind, nodes in gr3.land for edge in edges_of(nodes, is_loop=kind == 1)]
        self.assertEqual(len(edges), len(set(edges)))
        self.assertEqual(set(edges), bounding_edges(triangles))
        strings = {edge: tag for tag, nodes in two_dm.strings for edge in edges_of(nodes)}
        self.assertEqual(set(strings), set(edges))
        self.assertEqual(strings, {edge: tags[tuple(sorted(edge))] for edge in edges})
        for _, nodes in two_dm.strings:
            self.assertEqual(len(set(nodes[:-1])), len(nodes) - 1)

    def test_nodes_and_triangles(self):
        table = None
        for mesh in self.placed():
            table = table or read_csv(self.folder / "a.csv")
            np.testing.assert_array_equal(mesh.nodes, np.column_stack([table["x"], table["y"]]))
            areas = [area_of(mesh.nodes[corners]) for corners in mesh.triangles]
            self.assertGreater(min(areas), 0)
            self.assertAlmostEqual(sum(areas), SQUARE_AREA, places=12)
        gr3, two_dm = self.read()
        self.assertTrue(np.all(gr3.depths == 0) and np.all(two_dm.heights == 0))
        self.assertEqual(set(two_dm.materials), {1})
        self.assertFalse("-0\n" in (self.folder / "a.2dm").read_text())

    def test_open_and_land_by_the_names_of_tags(self):
        gr3, _ = self.placed(SIDES, "--name", "3=Open sea", "--name", "1=opera")
        (sea,), (coast, island) = gr3.open, gr3.land
        np.testing.assert_array_equal(gr3.nodes[sea][:, 0], 1)
        self.assertTrue(np.all(np.diff(gr3.nodes[sea][:, 1]) > 0))  # upwards: counter-clockwise
        self.assertEqual([coast[0], island[0]], [0, 1])
        self.assertEqual([coast[1][0], coast[1][-1]], [sea[-1], sea[0]])
        self.assertAlmostEqual(area_of(gr3.nodes[sea + coast[1][1:-1]]), 1, places=12)
        self.assertAlmostEqual(area_of(gr3.nodes[island[1]]), -0.04, places=12)
        self.assertNotEqual(island[1][0], island[1][-1])

    def test_open_where_a_formula_says(self):
        gr3, two_dm = self.placed(SIDES, "--open-boundary", "x > 0.55")
        (sea,) = gr3.open  # not the side of the island at x = 0.6
        np.testing.assert_array_equal(gr3.nodes[sea][:, 0], 1)
        self.assertEqual([kind for kind, _ in gr3.land], [0, 1])
        self.assertEqual(sorted(tag for tag, _ in two_dm.strings), [1, 2, 4, 5])
        gr3, two_dm = self.placed(SIDES, "--open-boundary", "dist(4) < 0.41", "--name", "2=open_sea")
        self.assertEqual(sorted({tag for tag, _ in two_dm.strings}), [1, 2, 4])
        self.assertGreater(len(gr3.open), 0)
        process = self.start("--domain", "a.poly", "--spacing", "0.06", "-o", "b.gr3", "--open-boundary", "x > 2")
        _, err = process.communicate()
        self.assertEqual(process.returncode, BAD_INPUT)
        self.assertIn("'x > 2' is greater than 0 nowhere on the boundary", err.decode())

    def test_an_island_with_an_open_side_is_none(self):
        gr3, _ = self.placed(SIDES, "--name", "4=open")
        (river,) = gr3.open
        np.testing.assert_array_equal(gr3.nodes[river][:, 0], 0.6)
        self.assertEqual([kind for kind, _ in gr3.land], [0, 0, 0])
        self.assertEqual([gr3.land[-1][1][0], gr3.land[-1][1][-1]], [river[-1], river[0]])

    def test_a_loop_of_one_kind_is_two_segments(self):
        gr3, _ = self.placed(SIDES)
        self.assertEqual(gr3.open, [])
        (_, one), (_, other), (_, island) = gr3.land
        self.assertEqual([kind for kind, _ in gr3.land], [0, 0, 1])
        self.assertEqual([one[0], one[-1]], [other[-1], other[0]])
        self.assertLessEqual(abs(len(one) - len(other)), 1)
        gr3, _ = self.placed(SIDES, *(word for tag in range(1, 5) for word in ("--name", f"{tag}=open_{tag}")))
        self.assertEqual(gr3.land, [])
        self.assertEqual(len(gr3.open), 4)
        for one, other in (gr3.open[:2], gr3.open[2:]):
            self.assertEqual([one[0], one[-1]], [other[-1], other[0]])

    def test_strings_by_tag(self):
        _, two_dm = self.placed()
        self.assertEqual(sorted(tag for tag, _ in two_dm.strings), [1, 2, 3, 4])
        (loop,) = [nodes for tag, nodes in self.placed(SQUARE)[1].strings if tag == 2]
        self.assertEqual(loop[0], loop[-1])
        self.assertAlmostEqual(area_of(two_dm.nodes[loop[:-1]]), -0.04, places=12)

    def test_loops_that_touch_and_curves_inside(self):
        gr3, two_dm = self.placed(TOUCHING)
        self.assertEqual([kind for kind, _ in gr3.land], [0, 0, 1])
        island = gr3.land[-1][1]
        self.assertAlmostEqual(area_of(gr3.nodes[island]), -0.08, places=12)
        self.assertIn((0.5, 0), map(tuple, gr3.nodes[island]))
        self.assertNotIn(5, [tag for tag, _ in two_dm.strings])
        self.assertIn(5, read_msh2(self.folder / "a.msh2")[1].values())

    def test_materials_are_the_tags_of_regions(self):
        halves = TOUCHING.replace("8 0.7 0.7", "8 0 0.7").replace("9 0.7 0.9", "9 1 0.7")
        _, two_dm = self.placed(halves, "--region", "0.95,0.1:7")
        middles = two_dm.nodes[two_dm.triangles].mean(axis=1)
        np.testing.assert_array_equal(two_dm.materials, np.where(middles[:, 1] < 0.7, 7, 1))
        message = self.refuse("--domain", "a.poly", "--spacing", "0.1", "--region", "0.95,0.1:-7", "-o", "b.2dm", "-q")
        self.assertIn("a .2dm file numbers materials from 1 on, and the tag of a region is -7", message)

    def test_ugrid(self):
        halves = TOUCHING.replace("8 0.7 0.7", "8 0 0.7").replace("9 0.7 0.9", "9 1 0.7")
        self.placed(halves, "--region", "0.95,0.1:7", "-o", "a.ugrid")
        values, standard, at = read_ugrid(self.folder / "a.ugrid")
        self.assertEqual(standard, ["projection_x_coordinate", "projection_y_coordinate"])
        table = read_csv(self.folder / "a.csv")
        np.testing.assert_array_equal(values["places"], np.column_stack([table["x"], table["y"]]))
        for name in ("tag", "spacing"):
            np.testing.assert_array_equal(values[name], table[name])
        triangles, tags = read_msh2(self.folder / "a.msh2")
        np.testing.assert_array_equal(values["face"], triangles)
        boundary = [tuple(sorted(edge)) for edge in values["boundary"]]
        self.assertEqual(sorted(boundary), sorted(tuple(sorted(edge)) for edge in bounding_edges(triangles)))
        self.assertEqual(values["boundary_tag"].tolist(), [tags[edge] for edge in boundary])
        middles = values["places"][values["face"]].mean(axis=1)
        np.testing.assert_array_equal(values["region"], np.where(middles[:, 1] < 0.7, 7, 0))
        self.assertTrue(np.all((values["quality"] > 0.3) & (values["quality"] <= 1)))
        self.assertEqual(at, {"tag": "node", "spacing": "node", "quality": "face", "region": "face",
                              "boundary_tag": "boundary"})

    def test_negative_tags_of_curves(self):
        """A minus sign marks the end of a string, so its tag cannot be negative."""
        (self.folder / "a.poly").write_text(SQUARE.replace(" 2\n", " -2\n"))
        message = self.refuse("--domain", "a.poly", "--spacing", "0.1", "-q", "-o", "b.2dm")
        self.assertIn("numbers node strings by tags from 1 on, and the tag of a curve is -2", message)

    def test_streams(self):
        self.placed(SIDES, "-o", "a.ugrid")
        for name in ("gr3", "2dm", "ugrid"):
            out, _ = self.place("-o", "-", "--format", name, domain=self.folder / "a.poly")
            self.assertEqual(out, (self.folder / f"a.{name}").read_bytes())

    def test_what_is_refused(self):
        for name in ("a.gr3", "a.2dm", "a.ugrid"):
            message = self.refuse("--domain", "box(0,0,0, 1,1,1)", "--spacing", "0.4", "-o", name)
            self.assertIn(f"a {name[1:]} file is for triangles in the plane or on a sphere, not for bodies: '{name}'",
                          message)
            message = self.refuse("--domain", self.square, "--spacing", "0.1", "--nodes-at", "centers", "-o", name)
            self.assertIn(f"a {name[1:]} file cannot contain particles", message)

    @exists_if("PNPBS_MPIEXEC" in os.environ)
    def test_ranks_write_the_same_bytes(self):
        (self.folder / "a.poly").write_text(SIDES)
        texts = []
        for ranks in (1, 3):
            self.run_on_ranks("--domain", "a.poly", "--spacing", "0.02", "--region", "0.1,0.1:3",
                              "--name", "3=open", "-o", "a.gr3", "-o", "a.2dm", "-o", "a.ugrid", ranks=ranks)
            texts.append([(self.folder / name).read_bytes() for name in ("a.gr3", "a.2dm", "a.ugrid")])
        self.assertEqual(*texts)


def closed(ring):
    return ring + ring[:1]


def coast(*rings):
    """Returns a feature for each ring, so that each ring has a tag."""
    return json.dumps({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {},
         "geometry": {"type": "MultiPolygon", "coordinates": [[closed(part)] for part in ring]}} for ring in rings]})


# Polygons that are cut at 180 degrees, as in real files, and Antarctica around the pole.
ANTARCTICA = [[[lon, -74 + 3 * np.cos(np.radians(3 * lon))] for lon in range(-180, 181, 5)] + [[180, -90], [-180, -90]]]
ACROSS = [[[168, 8], [180, 8], [180, 22], [170, 25]], [[-180, 8], [-172, 12], [-180, 22]]]
CONTINENT = [[[-20, -10], [30, -30], [50, 10], [20, 40], [-30, 30]]]


class OnSphere(CommandTest):
    RADIUS = 6371.22

    def placed(self, *arguments, ranks=1):
        self.run_on_ranks(*arguments, "--corner-angle", "20", "-o", "a.gr3", "-o", "a.2dm", "-o", "a.csv",
                          "-o", "a.msh2", "-o", "a.ugrid", ranks=ranks)
        gr3, two_dm = read_gr3(self.folder / "a.gr3"), read_2dm(self.folder / "a.2dm")
        table = read_csv(self.folder / "a.csv")
        x = np.column_stack([table[axis] for axis in "xyz"])
        degrees = np.degrees(np.column_stack([np.arctan2(x[:, 1], x[:, 0]),
                                              np.arctan2(x[:, 2], np.hypot(x[:, 0], x[:, 1]))]))
        for mesh in (gr3, two_dm):
            np.testing.assert_allclose(mesh.nodes, degrees, rtol=1e-14, atol=1e-13)
            np.testing.assert_array_equal(mesh.triangles, read_msh2(self.folder / "a.msh2")[0])
        edges = [edge for kind, nodes in gr3.land for edge in edges_of(nodes, is_loop=kind == 1)]
        edges += [edge for nodes in gr3.open for edge in edges_of(nodes)]
        self.assertEqual(sorted(edges), sorted(bounding_edges(gr3.triangles)))
        values, standard, _ = read_ugrid(self.folder / "a.ugrid")
        self.assertEqual(standard, ["longitude", "latitude"])
        np.testing.assert_array_equal(values["places"], gr3.nodes)
        np.testing.assert_array_equal(values["face"], gr3.triangles)
        self.assertEqual(len(values.get("boundary", ())), len(edges))
        return gr3

    def sea(self, *rings, sphere, spacing="300", more=(), **options):
        (self.folder / "coast.geojson").write_text(coast(*rings))
        return self.placed("--domain", "coast.geojson", "--sphere", sphere, "--spacing", spacing, *more, **options)

    def test_a_whole_sphere_has_no_boundary(self):
        gr3 = self.placed("--sphere", str(self.RADIUS), "--spacing", "900")
        self.assertEqual((gr3.open, gr3.land), ([], []))
        self.assertNotIn("NS", (self.folder / "a.2dm").read_text())

    @exists_if(os.environ["PNPBS_GEO"] == "1")
    def test_islands_of_an_ocean(self):
        gr3 = self.sea(ANTARCTICA, ACROSS, CONTINENT, sphere=str(self.RADIUS))
        self.assertEqual(gr3.open, [])
        self.assertEqual([kind for kind, _ in gr3.land], [1, 1, 1])

    @exists_if(os.environ["PNPBS_GEO"] == "1")
    def test_a_sea_between_lands(self):
        sphere = f"{self.RADIUS},180,0"  # the far side is land, and the continent is sea
        gr3 = self.sea(CONTINENT, [[[0, 0], [12, 0], [5, 8]]], sphere=sphere, spacing="150")
        self.assertEqual([kind for kind, _ in gr3.land], [0, 0, 1])
        outside = gr3.land[0][1][:-1] + gr3.land[1][1][:-1]
        self.assertGreater(area_of(gr3.nodes[outside]), 0)
        self.assertLess(area_of(gr3.nodes[gr3.land[2][1]]), 0)

    @exists_if(os.environ["PNPBS_GEO"] == "1" and "PNPBS_MPIEXEC" in os.environ)
    def test_ranks_write_the_same_bytes(self):
        texts = []
        for ranks in (1, 3):
            self.sea(ANTARCTICA, ACROSS, CONTINENT, sphere=str(self.RADIUS), ranks=ranks)
            texts.append([(self.folder / name).read_bytes() for name in ("a.gr3", "a.2dm")])
        self.assertEqual(*texts)


if __name__ == "__main__":
    unittest.main()
