# SPDX-License-Identifier: BSD-3-Clause
"""Tests tags of regions: from files and --region to the files of the results."""

import json
import unittest

import meshio
import numpy
import vtk

from command import BAD_INPUT, CommandTest
from readers import grid_arrays, read_rows, read_with_vtk

# Two adjacent unit squares, and the contents of the regions section.
PAIR = """\
6 2 0 0
1 0 0
2 1 0
3 2 0
4 2 1
5 1 1
6 0 1
7 1
1 1 2 1
2 2 3 1
3 3 4 1
4 4 5 1
5 5 6 1
6 6 1 1
7 2 5 2
0
"""
# Two unit cubes, one on top of the other, in TetGen's format. The wall between them is an inner
# facet.
CUBES = """\
12 3 0 0
""" + "".join(f"{4 * z + k} {x} {y} {z}\n" for z in range(3)
              for k, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1)))) + """\
11 1
""" + "".join("1 0 {}\n4 {} {} {} {}\n".format(tag, *corners) for tag, corners in (
    (1, (0, 3, 2, 1)), (2, (4, 5, 6, 7)), (1, (8, 9, 10, 11)),
    *((1, (z + k, z + (k + 1) % 4, z + 4 + (k + 1) % 4, z + 4 + k))
      for z in (0, 4) for k in range(4)))) + "0\n"


def sizes(points, corners):
    """Returns the areas of triangles, or the volumes of tetrahedra."""
    x = points[corners]
    edges = x[:, 1:] - x[:, :1]
    if corners.shape[1] == 3:
        return numpy.linalg.norm(numpy.cross(edges[:, 0], edges[:, 1]), axis=1) / 2
    return abs(numpy.linalg.det(edges)) / 6


def sums(size, tags):
    return {int(tag): round(float(size[tags == tag].sum()), 9) for tag in set(tags)}


class RegionTest(CommandTest):
    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def fill(self, domain, *arguments, spacing="0.15", warning=""):
        """Runs the command and writes all formats. The report must have one warning with this text,
        or none."""
        names = ("a.vtu", "a.msh", "a.msh2", "a.node", "a.ele")
        process = self.start("--domain", domain, "--spacing", spacing, "--check", "--steps", "40",
                             "--set", "tolerance_mean=1", "--report", "a.json", *arguments,
                             *(word for name in names for word in ("-o", name)))
        _, err = process.communicate()
        self.assertNotEqual(process.returncode, BAD_INPUT, err)
        warnings = json.loads((self.folder / "a.json").read_text())["warnings"]
        warnings = [text for text in warnings if "rest" not in text]
        self.assertEqual(len(warnings), 1 if warning else 0, warnings)
        for text in warnings:
            self.assertIn(warning, text)

    def check_sizes(self, expected, names=None):
        """Checks the sums of the sizes by region in all of the files. `names` are the names of the
        groups by tag in Gmsh files."""
        grid = meshio.read(self.folder / "a.vtu")
        corners, tags = grid.cells[0].data, grid.cell_data["region"][0]
        self.assertEqual(tags.dtype, numpy.int32)
        self.assertEqual(sums(sizes(grid.points, corners), tags), expected)
        again = grid_arrays(read_with_vtk(self.folder / "a.vtu"))
        numpy.testing.assert_array_equal(again["cell", "region"], tags)
        (_, attributes), rows = read_rows(self.folder / "a.ele")
        self.assertEqual(attributes, 1)
        numpy.testing.assert_array_equal([int(row[-1]) for row in rows], tags)
        for name in ("a.msh", "a.msh2"):
            self.check_groups(meshio.read(self.folder / name, file_format="gmsh"), expected,
                              names or {})
        self.check_entities()

    def check_groups(self, mesh, expected, names):
        dimension = 3 if "tetra" in mesh.cells_dict else 2
        kind = {2: "triangle", 3: "tetra"}[dimension]
        called = {int(tag): name for name, (tag, of) in mesh.field_data.items() if of == dimension}
        found = {}
        for block, groups in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
            if block.type == kind:
                for group, size in sums(sizes(mesh.points, block.data), groups).items():
                    found[called.pop(group)] = size
        self.assertEqual(called, {})
        self.assertEqual(found, {names.get(tag, f"region_{tag}" if tag else "domain"): size
                                 for tag, size in expected.items()})

    def check_entities(self):
        """Checks that nodes on no facet belong to the entity of the elements around them."""
        lines = iter((self.folder / "a.msh").read_text().splitlines())
        blocks = {}
        for section in ("$Nodes", "$Elements"):
            while next(lines) != section:
                pass
            blocks[section] = []
            for _ in range(int(next(lines).split()[0])):
                dimension, entity, _, count = map(int, next(lines).split())
                rows = [list(map(int, next(lines).split())) for _ in range(count)]
                if section == "$Nodes":
                    for _ in range(count):
                        next(lines)
                blocks[section].append(((dimension, entity), rows))
        entity_of = {row[0]: entity for entity, rows in blocks["$Nodes"] for row in rows}
        dimension = max(entity[0] for entity, _ in blocks["$Elements"])
        for entity, rows in blocks["$Elements"]:
            for row in rows if entity[0] == dimension else ():
                for node in row[1:]:
                    if entity_of[node][0] == dimension:
                        self.assertEqual(entity_of[node], entity)


class FilesOfTriangle(RegionTest):
    def test_attributes_become_tags(self):
        self.fill(self.write("m.poly", PAIR + "2\n1 0.5 0.5 7 0.1\n2 1.5 0.5 30.0\n"))
        self.check_sizes({7: 1.0, 30: 1.0})
        self.fill(self.write("m.poly", PAIR + "2\n1 0.5 0.5 0\n2 1.5 0.5 -3 -1\n"))
        grid = meshio.read(self.folder / "a.vtu")
        self.assertEqual(set(grid.cell_data["region"][0]), {0, -3})

    def test_other_attributes_are_skipped(self):
        self.fill(self.write("m.poly", PAIR + "3\n1 0.5 0.5 7\n2 1.5 0.5 0.5\n3 1.5 0.6 x\n"),
                  warning="no integers, and so no tags, are skipped: '0.5' of region 2, 'x' of "
                          "region 3")
        self.check_sizes({7: 1.0, 0: 1.0})
        for attribute in ("0.5", "3e9", "nan", "0", ""):
            self.fill(self.write("m.poly", PAIR + f"1\n1 0.5 0.5 {attribute}\n"),
                      warning="are skipped: " if attribute not in ("", "0") else "")
            self.assertNotIn("region", meshio.read(self.folder / "a.vtu").cell_data)

    def test_points_that_do_not_fit(self):
        self.fill(self.write("m.poly", PAIR + "3\n1 0.5 0.5 7\n2 5 0.5 8\n3 0.6 0.5 9\n"),
                  warning="left out: ")
        self.check_sizes({7: 1.0, 0: 1.0})
        warning = json.loads((self.folder / "a.json").read_text())["warnings"][-1]
        self.assertIn("m.poly: region 2 at (5, 0.5) lies outside the domain", warning)
        self.assertIn("region 3 at (0.6, 0.5) has the tag 9, but lies in the same region as",
                      warning)
        path = self.write("m.poly", PAIR + "1\n1 0.5 high 7\n")
        self.assertIn("m.poly:18: found 'high', expected y",
                      self.refuse("--domain", path, "--spacing", "0.2"))


class FilesOfTetGen(RegionTest):
    def test_attributes_become_tags(self):
        path = self.write("m.poly", CUBES + "2\n1 0.5 0.5 0.5 7\n2 0.5 0.5 1.5 4\n")
        self.fill(path, "--inner", "2", spacing="0.3")
        self.check_sizes({7: 1.0, 4: 1.0})
        self.fill(path, "--inner", "2", "--surfaces-only", spacing="0.3")
        self.assertNotIn("region", meshio.read(self.folder / "a.vtu").cell_data)
        # Facets divide a body even if they are not given as inner ones. Such a body is sound and is
        # not repaired. A rebuilt surface has no wall inside.
        self.fill(path, spacing="0.3")
        self.check_sizes({7: 1.0, 4: 1.0})
        self.fill(path, "--repair", "0.1", spacing="0.3", warning="not repaired: the body is sound")
        self.check_sizes({7: 1.0, 4: 1.0})
        self.place_body(path, "0.3", "--resurface", "0.1", "-o", "a.vtu", "--report", "a.json")
        self.assertEqual(set(meshio.read(self.folder / "a.vtu").cell_data["region"][0]), {7})
        warnings = " ".join(json.loads((self.folder / "a.json").read_text())["warnings"])
        self.assertIn("region 2 at (0.5, 0.5, 1.5) has the tag 4, but lies in the same", warnings)

    def test_other_attributes_are_skipped(self):
        path = self.write("m.poly", CUBES + "2\n1 0.5 0.5 0.5 0.1\n2 0.5 0.5 1.5 4\n")
        self.fill(path, "--inner", "2", spacing="0.3", warning="are skipped: '0.1' of region 1")
        self.check_sizes({0: 1.0, 4: 1.0})


    def cube_in_cube(self, rest):
        """Writes a cube of side 3 with a cube of side 1 in its middle, with the markers 10 and 20.
        """
        corners = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        sides = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
        rows = ["16 3 0 0"]
        for k, corner in enumerate([[3 * c for c in corner] for corner in corners] +
                                   [[1 + c for c in corner] for corner in corners]):
            rows.append(f"{k} {corner[0]} {corner[1]} {corner[2]}")
        rows.append("12 1")
        for first, marker in ((0, 10), (8, 20)):
            rows += [f"4 {' '.join(str(first + k) for k in side)} {marker}" for side in sides]
        return self.write("cubes.smesh", "\n".join(rows) + "\n" + rest)

    def check_follows_inner_cube(self):
        x = meshio.read(self.folder / "a.vtu").points
        self.assertGreater(numpy.count_nonzero(abs(abs(x - 1.5).max(axis=1) - 0.5) < 1e-12), 20)

    def test_closed_facets_divide(self):
        self.fill(self.cube_in_cube("0\n2\n0 0.5 0.5 0.5 10\n1 1.5 1.5 1.5 20\n"), spacing="0.5")
        self.check_sizes({10: 26.0, 20: 1.0})
        self.check_follows_inner_cube()
        self.fill(self.cube_in_cube("0\n0\n"), spacing="0.5")
        mesh = meshio.read(self.folder / "a.vtu")
        self.assertAlmostEqual(sizes(mesh.points, mesh.cells[0].data).sum(), 27, delta=1e-9)
        self.check_follows_inner_cube()

    def test_hole_points_make_cavities(self):
        self.fill(self.cube_in_cube("1\n0 1.5 1.5 1.5\n1\n0 0.5 0.5 0.5 10\n"), spacing="0.5")
        self.check_sizes({10: 26.0})
        self.check_follows_inner_cube()


class FilesOfGmsh(RegionTest):
    def there_and_back(self, expected, names, spacing):
        for name in ("a.msh", "a.msh2"):
            path = self.folder / "b.msh"
            path.write_bytes((self.folder / name).read_bytes())
            self.fill(path, spacing=spacing)
            self.check_sizes(expected, names)

    def test_there_and_back_in_the_plane(self):
        self.fill(self.write("m.poly", PAIR + "2\n1 0.5 0.5 7\n2 1.5 0.5 4\n"))
        self.there_and_back({7: 1.0, 4: 1.0}, {}, "0.11")

    def test_there_and_back_in_space(self):
        path = self.write("m.poly", CUBES + "2\n1 0.5 0.5 0.5 7\n2 0.5 0.5 1.5 4\n")
        self.fill(path, "--inner", "2", spacing="0.3")
        self.there_and_back({7: 1.0, 4: 1.0}, {}, "0.25")

    def square_of(self, groups, lines=()):
        """Writes four by four quadrangles, which have these groups."""
        points = [(x, y, 0.0) for y in range(5) for x in range(5)]
        squares = [(5 * y + x, 5 * y + x + 1, 5 * y + x + 6, 5 * y + x + 5)
                   for y in range(4) for x in range(4)]
        cells, tags = [("quad", squares)], [numpy.array(groups)]
        if lines:
            cells.append(("line", lines))
            tags.append(numpy.full(len(lines), 9))
        mesh = meshio.Mesh(numpy.array(points, float), cells,
                           cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
                           field_data={"steel": numpy.array([3, 2])})
        meshio.write(self.folder / "m.msh", mesh, file_format="gmsh22", binary=False)
        return self.folder / "m.msh"

    def test_parts_of_groups(self):
        """One group is in two corners, and a loop of lines lies in the middle of another group."""
        groups = [3, 5, 5, 5] + 2 * [5, 5, 5, 5] + [5, 5, 5, 3]
        self.fill(self.square_of(groups), spacing="0.5")
        self.check_sizes({3: 2.0, 5: 14.0}, {3: "steel"})
        loop = [(6, 8), (8, 18), (18, 16), (16, 6)]
        loop = [edge for a, b in loop for edge in ((a, (a + b) // 2), ((a + b) // 2, b))]
        self.fill(self.square_of(groups, loop), spacing="0.5")
        self.check_sizes({3: 2.0, 5: 14.0}, {3: "steel"})

    def test_one_group_is_the_inside(self):
        self.fill(self.square_of(16 * [3]), spacing="0.5")
        self.assertNotIn("region", meshio.read(self.folder / "a.vtu").cell_data)
        self.check_groups(meshio.read(self.folder / "a.msh", file_format="gmsh"), {0: 16.0},
                          {0: "steel"})


class Command(RegionTest):
    def test_tags_by_points(self):
        path = self.write("m.poly", PAIR)
        self.fill(path, "--region", "0.5,0.5:7", "--region", "0.6, 1e-1:7")
        self.check_sizes({7: 1.0, 0: 1.0})
        self.assertEqual(json.loads((self.folder / "a.json").read_text())["regions"],
                         ["0.5,0.5:7", "0.6, 1e-1:7"])
        self.fill("box(0,0,0, 1,1,1)", "--region", "0.5,0.5,0.5:3", spacing="0.3")
        self.check_sizes({3: 1.0})

    def test_come_before_those_of_files(self):
        self.fill(self.write("m.poly", PAIR + "1\n1 0.5 0.5 7\n"), "--region", "0.1,0.1:8",
                  warning="region 1 at (0.5, 0.5) has the tag 7, but lies in the same region as "
                          "region 0 at (0.1, 0.1) with the tag 8")
        self.check_sizes({8: 1.0, 0: 1.0})

    def test_in_other_grids(self):
        """Checks files by HDF5, if the command has it."""
        ask = ("--domain", self.write("m.poly", PAIR), "--spacing", "0.2", "--quiet",
               "--region", "0.5,0.5:7", "-o", "a.vtu")
        process = self.start(*ask, "-o", "a.vtkhdf", "-o", "a.xdmf")
        _, err = process.communicate()
        if b"built without HDF5" in err:
            self.skipTest("built without HDF5")
        expected = meshio.read(self.folder / "a.vtu").cell_data["region"][0]
        for name, kind in (("a.vtkhdf", vtk.vtkHDFReader), ("a.xdmf", vtk.vtkXdmfReader)):
            grid = grid_arrays(read_with_vtk(self.folder / name, kind))
            numpy.testing.assert_array_equal(grid["cell", "region"], expected)

    def test_refusals(self):
        square = ("--domain", self.square, "--spacing", "0.2", "--region")
        for text in ("", "0.1,0.1", "0.1:3", "0.1,0.1:0", "0.1,0.1:x", "0.1,x:3", "0.1,0.1:3:4",
                     "1,2,3,4:5", "0.1,0.1:3000000000"):
            self.assertIn(f"--region: expected X,Y:TAG or X,Y,Z:TAG with a tag other than 0, found "
                          f"'{text}'", self.refuse(*square, text))
        self.assertIn("--region: expected X,Y:TAG for this domain, found '0.1,0.1,0:3'",
                      self.refuse(*square, "0.1,0.1,0:3"))
        box = ("--domain", "box(0,0,0, 1,1,1)", "--spacing", "0.5", "--region")
        self.assertIn("--region: expected X,Y,Z:TAG for this domain", self.refuse(*box, "0,0:3"))
        self.assertIn("--region is for the inside of bodies",
                      self.refuse(*box, "0.5,0.5,0.5:3", "--surfaces-only"))
        self.assertIn("region 0 at (0.5, 0.5) lies outside the domain",
                      self.refuse(*square, "0.5,0.5:3"))
        self.assertIn("region 1 at (0.9, 0.9) has the tag 4, but lies in the same region as region "
                      "0 at (0.1, 0.1)", self.refuse(*square, "0.1,0.1:3", "--region", "0.9,0.9:4"))


if __name__ == "__main__":
    unittest.main()
