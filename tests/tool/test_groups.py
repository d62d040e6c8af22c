# SPDX-License-Identifier: BSD-3-Clause
"""Tests named groups: Gmsh files as domains, inner surfaces in files, and names from input to
output."""

import itertools
import json
import unittest

import meshio
import numpy

from command import SQUARE_AREA, CommandTest

# The corners of a unit cube, and the corners of its sides as seen from outside.
CORNERS = numpy.array([(i & 1, i >> 1 & 1, i >> 2) for i in range(8)], float)
SIDES = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))
SHEET = numpy.array([(0.3, 0.3, 0.5), (0.7, 0.3, 0.5), (0.7, 0.7, 0.5), (0.3, 0.7, 0.5)])


def octasphere(radius, times):
    """Returns the triangles of an octahedron on a sphere about (0.5, 0.5, 0.5), after cutting each
    into four `times` times."""
    triangles = [numpy.array([(x, 0, 0), (0, y, 0), (0, 0, z)], float)[:: x * y * z]
                 for x in (1, -1) for y in (1, -1) for z in (1, -1)]
    for _ in range(times):
        triangles = [numpy.array(corners) for a, b, c in triangles for corners in
                     ((a, a + b, a + c), (a + b, b, b + c), (a + c, b + c, c), (a + b, b + c, a + c))]
        triangles = [t / numpy.linalg.norm(t, axis=1)[:, None] for t in triangles]
    return [0.5 + radius * t for t in triangles]


def edges_of(triangles):
    """Returns the edges of the triangles, and the number of triangles at each edge."""
    edges = numpy.sort(numpy.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    return numpy.unique(edges, axis=0, return_counts=True)


def two_triangles(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def stl(**solids):
    """Returns an STL text with named solids, each of squares and triangles."""
    lines = []
    for name, squares in solids.items():
        lines.append(f"solid {name}")
        for square in squares:
            for triangle in two_triangles(*square) if len(square) == 4 else [square]:
                lines += ["facet normal 0 0 0", "outer loop"]
                lines += ["vertex {} {} {}".format(*corner) for corner in triangle]
                lines += ["endloop", "endfacet"]
        lines.append(f"endsolid {name}")
    return "\n".join(lines) + "\n"


def areas(mesh, kind):
    """Returns the sum of the areas of triangles, or of the lengths of lines, by the names of their
    groups."""
    name_of = {group[0]: name for name, group in mesh.field_data.items()
               if group[1] == {"line": 1, "triangle": 2}[kind]}
    sums = {}
    for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
        if block.type != kind:
            continue
        x = mesh.points[block.data]
        size = numpy.linalg.norm(x[:, 1] - x[:, 0], axis=1)
        if kind == "triangle":
            size = numpy.linalg.norm(numpy.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1) / 2
        for tag in set(tags):
            name = name_of[tag]
            sums[name] = sums.get(name, 0) + size[tags == tag].sum()
    return {name: round(size, 9) for name, size in sums.items()}


class GroupTest(CommandTest):
    def fill(self, domain, *arguments, spacing="0.2", **more):
        return self.place("--report", "r.json", *arguments, domain=self.folder / domain,
                          spacing=spacing, **more)

    def report(self):
        return json.loads((self.folder / "r.json").read_text())

    def groups(self):
        return {(group["dimension"], group["tag"]): group["name"]
                for group in self.report()["groups"]}

    def mesh(self, name):
        return meshio.read(self.folder / name, file_format="gmsh")

    def node_tags(self):
        rows = numpy.loadtxt(self.folder / "a.csv", delimiter=",", skiprows=1)
        return rows[:, 1:4], rows[:, 4].astype(int)


class Gmsh(GroupTest):
    def test_there_and_back_in_the_plane(self):
        """Checks that a written file can be read as a domain with the same groups, in both versions
        of the format."""
        self.place("-o", "a.msh", "-o", "a.msh2", "--name", "1=outer wall", "--name", "2=hole",
                   spacing="0.1")
        (self.folder / "b.msh").write_bytes((self.folder / "a.msh2").read_bytes())
        expected = {"outer wall": 4.0, "hole": 0.8}
        for name in ("a.msh", "b.msh"):
            self.assertEqual(areas(self.mesh(name), "line"), expected)
            self.fill(name, "-o", "c.msh", spacing="0.07")
            self.assertEqual(areas(self.mesh("c.msh"), "line"), expected)
            self.assertEqual(areas(self.mesh("c.msh"), "triangle"), {"domain": SQUARE_AREA})
            self.assertEqual(self.groups(),
                             {(1, 1): "outer wall", (1, 2): "hole", (2, 1): "domain"})

    def test_there_and_back_in_space(self):
        names = [word for k in range(6) for word in ("--name", f"{k + 1}=side {k}")]
        (self.folder / "cube.stl").write_text(
            stl(**{f"s{k}": [CORNERS[list(side)]] for k, side in enumerate(SIDES)}))
        self.fill("cube.stl", "-o", "a.msh", *names)
        expected = {f"side {k}": 1.0 for k in range(6)}
        self.assertEqual(areas(self.mesh("a.msh"), "triangle"), expected)
        self.fill("a.msh", "-o", "b.msh", "-o", "b.msh2", spacing="0.25")
        for name in ("b.msh", "b.msh2"):
            self.assertEqual(areas(self.mesh(name), "triangle"), expected)
        self.assertIn(((3, 1), "domain"), self.groups().items())

    def test_meshio_writes_them(self):
        """Checks a body of tetrahedra that meshio writes, as text and as binary file."""
        tetrahedra = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7),
                      (0, 5, 1, 7)]
        triangles = sum((two_triangles(*side) for side in SIDES), [])
        # meshio's triangles do not match the sides of the tetrahedra where a side is split along
        # the other diagonal. Such triangles are ignored.
        mesh = meshio.Mesh(CORNERS, [("triangle", triangles), ("tetra", tetrahedra)],
                           cell_data={"gmsh:physical": [numpy.repeat(range(1, 7), 2),
                                                        numpy.full(6, 9)],
                                      "gmsh:geometrical": [numpy.repeat(range(1, 7), 2),
                                                           numpy.full(6, 1)]},
                           field_data={"left": numpy.array([1, 2]), "meat": numpy.array([9, 3])})
        for binary in (False, True):
            meshio.write(self.folder / "m.msh", mesh, file_format="gmsh22", binary=binary)
            self.fill("m.msh", "-o", "a.msh", spacing="0.3")
            self.assertEqual(self.groups(), {(2, 1): "left", (3, 9): "meat"})
            sizes = areas(self.mesh("a.msh"), "triangle")
            self.assertEqual(sizes["left"], 1.0)
            self.assertAlmostEqual(sum(sizes.values()), 6.0)

    def test_surfaces_alone(self):
        mesh = meshio.Mesh(CORNERS, [("triangle", two_triangles(*SIDES[4]))],
                           cell_data={"gmsh:physical": [numpy.array([5, 5])],
                                      "gmsh:geometrical": [numpy.array([1, 1])]})
        meshio.write(self.folder / "m.msh", mesh, file_format="gmsh22", binary=False)
        self.fill("m.msh", "-o", "a.msh")  # a surface in a plane is a plane domain
        self.assertEqual(areas(self.mesh("a.msh"), "triangle"), {"domain": 1.0})
        self.fill("m.msh", "-o", "a.msh", "--surfaces-only")
        self.assertEqual(areas(self.mesh("a.msh"), "triangle"), {"tag_5": 1.0})

    def test_refusals(self):
        (self.folder / "m.msh").write_text("$MeshFormat\n1.0 0 8\n")
        self.assertIn("m.msh:2: found '1.0', expected version 4.1", self.refuse(
            "--domain", "m.msh", "--spacing", "1"))
        self.assertIn("no.msh: cannot be read", self.refuse(
            "--domain", "no.msh", "--spacing", "1"))
        for name in ("x=a", "0=a", "3=", "3"):
            self.assertIn("--name: expected TAG=NAME", self.refuse(
                "--domain", self.square, "--spacing", "1", "--name", name))


class InnerSurfaces(GroupTest):
    def setUp(self):
        super().setUp()
        cube = [CORNERS[list(side)] for side in SIDES]
        (self.folder / "cube.stl").write_text(stl(shell=cube, membrane=[SHEET]))

    def test_by_name_and_by_tag(self):
        for group in ("membrane", "2"):
            self.fill("cube.stl", "--inner", group, "-o", "a.csv")
            self.assertEqual(self.groups(), {(2, 1): "shell", (2, 2): "membrane"})
            self.assertEqual(self.report()["inner"], [group])
            points, tags = self.node_tags()
            on_sheet = points[tags == 2]
            self.assertGreater(len(on_sheet), 7)
            self.assertTrue((on_sheet[:, 2] == 0.5).all())
            self.assertTrue((abs(on_sheet[:, :2] - 0.5) <= 0.2).all())

    def check_faces(self, mesh, triangles):
        """Checks that each face belongs to two tetrahedra and occurs once."""
        faces = {tuple(face) for face in numpy.sort(triangles, axis=1).tolist()}
        self.assertEqual(len(faces), len(triangles))
        counts = dict.fromkeys(faces, 0)
        for tetrahedron in numpy.sort(mesh.cells_dict["tetra"], axis=1).tolist():
            for face in itertools.combinations(tetrahedron, 3):
                if face in counts:
                    counts[face] += 1
        self.assertEqual(set(counts.values()), {2})

    def triangles_of(self, name, tag):
        mesh = self.mesh(name)
        found = [block.data[tags == tag] for block, tags in
                 zip(mesh.cells, mesh.cell_data["gmsh:physical"]) if block.type == "triangle"]
        return mesh, numpy.concatenate(found)

    def test_a_sheet_becomes_triangles(self):
        """The sheet is used as it is, and rotated such that no node lies exactly on it."""
        axis = numpy.array([1, 2, 3]) / numpy.sqrt(14)
        turned = [0.5 + r * numpy.cos(0.7) + numpy.cross(axis, r) * numpy.sin(0.7)
                  + axis * axis.dot(r) * (1 - numpy.cos(0.7)) for r in SHEET - 0.5]
        cube = [CORNERS[list(side)] for side in SIDES]
        for sheet in (SHEET, numpy.array(turned)):
            (self.folder / "cube.stl").write_text(stl(shell=cube, membrane=[sheet]))
            self.fill("cube.stl", "--inner", "membrane", "-o", "a.msh", "-o", "a.msh2",
                      "-o", "a.vtu", spacing="0.1")
            sizes = areas(self.mesh("a.msh"), "triangle")
            self.assertAlmostEqual(sizes["membrane"], 0.16, 6)
            self.assertAlmostEqual(sizes["shell"], 6, 6)
            self.assertEqual(areas(self.mesh("a.msh2"), "triangle"), sizes)
            mesh, triangles = self.triangles_of("a.msh", 2)
            self.check_faces(mesh, triangles)
            edges, counts = edges_of(triangles)
            x = mesh.points[edges[counts == 1]]
            self.assertAlmostEqual(numpy.linalg.norm(x[:, 0] - x[:, 1], axis=1).sum(), 1.6, 6)
            self.assertEqual(set(counts), {1, 2})
            x = mesh.points[triangles]
            normals = numpy.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
            self.assertTrue((normals @ numpy.cross(sheet[1] - sheet[0], sheet[2] - sheet[0]) > 0).all())
            grid = meshio.read(self.folder / "a_facets.vtu")
            self.assertEqual(len(grid.cells_dict["triangle"]), len(mesh.cells_dict["triangle"]))
        # The written file is read again.
        self.fill("a.msh", "-o", "b.msh", spacing="0.1")
        self.assertAlmostEqual(areas(self.mesh("b.msh"), "triangle")["membrane"], 0.16, 6)

    def test_a_sphere_becomes_triangles(self):
        cube = [CORNERS[list(side)] for side in SIDES]
        (self.folder / "cube.stl").write_text(stl(shell=cube, ball=octasphere(0.3, 4)))
        self.fill("cube.stl", "--inner", "ball", "-o", "a.msh", spacing="0.1 + 0.08*x")
        mesh, triangles = self.triangles_of("a.msh", 2)
        self.check_faces(mesh, triangles)
        self.assertEqual(set(edges_of(triangles)[1]), {2})
        corners = len(numpy.unique(triangles))
        self.assertEqual(corners - len(triangles) / 2, 2)  # V - E + F with E = 3 F / 2
        sphere = 4 * numpy.pi * 0.09
        self.assertTrue(0.93 * sphere < areas(mesh, "triangle")["ball"] < sphere)
        a, b, c = mesh.points[triangles.T] - 0.5
        volume = numpy.einsum("ij,ij", a, numpy.cross(b, c)) / 6
        self.assertTrue(0.9 < volume / (4 / 3 * numpy.pi * 0.027) < 1, volume)

    def test_of_other_formats(self):
        vertices = [*CORNERS, *SHEET]
        squares = [*SIDES, (8, 9, 10, 11)]
        (self.folder / "m.obj").write_text(
            "".join("v {} {} {}\n".format(*x) for x in vertices) + "g shell\n" +
            "".join("{}f {} {} {} {}\n".format("g membrane\n" if k == 6 else "",
                                               *(i + 1 for i in square))
                    for k, square in enumerate(squares)))
        self.fill("m.obj", "--inner", "membrane")
        nodes = self.report()["nodes"]
        (self.folder / "m.poly").write_text(
            f"{len(vertices)} 3 0 0\n" +
            "".join("{} {} {} {}\n".format(i, *x) for i, x in enumerate(vertices)) + "7 1\n" +
            "".join("1 0 {}\n4 {} {} {} {}\n".format(2 if k == 6 else 1, *square)
                    for k, square in enumerate(squares)) + "0\n0\n")
        self.fill("m.poly", "--inner", "2")
        self.assertEqual(self.report()["nodes"], nodes)
        # In a Gmsh mesh, the surface is found by its position.
        triangles = sum((two_triangles(*square) for square in squares), [])
        groups = numpy.repeat((1, 2), (12, 2))
        mesh = meshio.Mesh(numpy.array(vertices), [("triangle", triangles)],
                           cell_data={"gmsh:physical": [groups], "gmsh:geometrical": [groups]})
        meshio.write(self.folder / "m.msh", mesh, file_format="gmsh22", binary=True)
        self.fill("m.msh")
        self.assertEqual(self.report()["nodes"], nodes)

    def test_refusals(self):
        ask = ("--domain", "cube.stl", "--spacing", "0.2")
        self.assertIn("not closed", self.refuse(*ask))
        self.assertIn("'membran' is neither a tag nor the name of a group of triangles; did you "
                      "mean membrane? (known: shell, membrane)",
                      self.refuse(*ask, "--inner", "membran"))
        self.assertIn("the tag 7", self.refuse(*ask, "--inner", "membrane", "--inner", "7"))
        self.assertIn("--inner is for surfaces in space", self.refuse(
            "--domain", self.square, "--spacing", "0.2", "--inner", "2"))


if __name__ == "__main__":
    unittest.main()
