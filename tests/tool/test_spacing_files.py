# SPDX-License-Identifier: BSD-3-Clause
"""Spacing from files with values at points, as meshio and VTK write them and as a user may spoil
them."""

import itertools
import unittest

import meshio
import numpy as np
import scipy.spatial
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from command import CommandTest

QUICK = ("--set", "steps=3")


def lattice(dim, n, low=-0.05, high=1.05):
    """Points of a lattice and its triangles or tetrahedra, some of either way round."""
    axis = np.linspace(low, high, n)
    grid = np.meshgrid(*[axis] * dim, indexing="ij")
    points = np.zeros((n**dim, 3))
    points[:, :dim] = np.stack([c.ravel() for c in grid[::-1]], axis=1)
    steps = n ** np.arange(dim)
    cells = []
    for corner in itertools.product(range(n - 1), repeat=dim):
        first = int(np.dot(corner, steps))
        for way in itertools.permutations(steps):
            cells.append(np.cumsum([first, *way]))
    return points, np.array(cells)


class SpacingFiles(CommandTest):
    def nodes(self, spacing, dim=2, **more):
        """What is placed by that, exact to the bit."""
        domain = self.square if dim == 2 else "box(0,0,0,1,1,1)"
        self.place_body(domain, spacing, *QUICK, "-o", "out.csv", "--nodes-only", **more)
        return (self.folder / "out.csv").read_bytes()

    def spacing_of(self, nodes, dim=2):
        rows = np.array([[float(x) for x in line.split(b",")] for line in nodes.splitlines()[1:]])
        return rows[:, 1:1 + dim], rows[:, -1]

    def refuse_spacing(self, spacing, domain=None):
        return self.refuse("--domain", domain or self.square, "--spacing", spacing, "-o", "a.csv")

    def write_meshes(self, dim):
        points, cells = lattice(dim, 9 if dim == 2 else 5)
        d = (0.08 if dim == 2 else 0.25) * (1 + points[:, 0])
        kind = "triangle" if dim == 2 else "tetra"
        mesh = meshio.Mesh(points, [(kind, cells)],
                           point_data={"size": d, "way": np.stack([d, d, d], axis=1)})
        mesh.write(self.folder / "packed.vtu")
        mesh.write(self.folder / "plain.vtu", compression=None)
        mesh.write(self.folder / "old.msh", file_format="gmsh22")
        mesh.write(self.folder / "new.msh", file_format="gmsh")
        return mesh, d

    def test_what_meshio_writes(self):
        for dim in (2, 3):
            self.write_meshes(dim)
            first = self.nodes("packed.vtu", dim)
            for other in ("packed.vtu:size", "plain.vtu", "old.msh", "new.msh:size"):
                with self.subTest(other, dim=dim):
                    self.assertEqual(self.nodes(other, dim), first)
            x, d = self.spacing_of(first, dim)
            np.testing.assert_allclose(d, (0.08 if dim == 2 else 0.25) * (1 + x[:, 0]), rtol=1e-12)

    def test_what_vtk_writes(self):
        mesh, d = self.write_meshes(2)
        first = self.nodes("packed.vtu")
        for mode, packed, wide, encoded, order in (
                ("Ascii", 0, 0, 0, 0), ("Binary", 0, 0, 0, 1), ("Binary", 1, 1, 0, 0),
                ("Appended", 0, 1, 0, 0), ("Appended", 0, 0, 1, 1), ("Appended", 1, 0, 0, 1),
                ("Appended", 1, 1, 1, 0)):
            with self.subTest(mode, packed=packed, wide=wide, encoded=encoded, order=order):
                self.write_by_vtk(mesh, d, mode, packed, wide, encoded, order)
                self.assertEqual(self.nodes("vtk.vtu"), first)

    def write_by_vtk(self, mesh, d, mode, packed, wide, encoded, order):
        points = vtk.vtkPoints()
        points.SetData(numpy_to_vtk(mesh.points, deep=True))
        grid = vtk.vtkUnstructuredGrid()
        grid.SetPoints(points)
        for cell in mesh.cells[0].data:
            grid.InsertNextCell(vtk.VTK_TRIANGLE, 3, cell.tolist())
        size = numpy_to_vtk(d, deep=True)
        size.SetName("size")
        grid.GetPointData().AddArray(size)
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetInputData(grid)
        getattr(writer, f"SetDataModeTo{mode}")()
        writer.SetEncodeAppendedData(encoded)
        writer.SetHeaderType(64 if wide else 32)
        writer.SetByteOrder(order)
        writer.SetCompressor(vtk.vtkZLibDataCompressor() if packed else None)
        writer.SetBlockSize(256)
        writer.SetFileName(str(self.folder / "vtk.vtu"))
        writer.Write()

    def test_what_we_wrote_ourselves(self):
        self.place_body(self.square, "0.1 + 0.1*x", *QUICK, "-o", "own.vtu", "-o", "own.csv")
        for name in ("own.vtu", "own.csv", "own.csv:spacing"):
            with self.subTest(name):
                x, d = self.spacing_of(self.nodes(name))
                np.testing.assert_allclose(d, 0.1 + 0.1 * x[:, 0], rtol=0.02)

    def test_tables(self):
        random = np.random.default_rng(5)
        points = random.uniform(-0.1, 1.1, (500, 2))
        d = 0.08 + 0.08 * points[:, 1]
        rows = [f"{x:.17g},{y:.17g},{v:.17g},7" for (x, y), v in zip(points, d)]
        (self.folder / "plain.csv").write_text("\n".join(["x,y,d,other", *rows]) + "\n")
        first = self.nodes("plain.csv:d")
        x, d = self.spacing_of(first)
        np.testing.assert_allclose(d, 0.08 + 0.08 * x[:, 1], rtol=0.05)
        random.shuffle(rows)
        text = "\r\n".join(['"Points:0" ; "Points:1";d;other', *(r.replace(",", ";") for r in rows)])
        (self.folder / "OTHER.CSV").write_text(text)
        self.assertEqual(self.nodes("OTHER.CSV:d"), first)

    def test_a_mesh_without_elements_is_scattered_points(self):
        points, cells = lattice(2, 9)
        d = 0.08 * (1 + points[:, 0])
        vertices = np.arange(len(points)).reshape(-1, 1)
        meshio.Mesh(points, [("vertex", vertices)], point_data={"d": d}).write(
            self.folder / "vertices.vtu")
        rows = [f"{x!r},{y!r},{v!r}" for x, y, v in zip(points[:, 0].tolist(),
                                                        points[:, 1].tolist(), d.tolist())]
        (self.folder / "same.csv").write_text("\n".join(["x,y,d", *rows]))
        self.assertEqual(self.nodes("vertices.vtu"), self.nodes("same.csv"))

    def test_a_small_fine_spot_is_found(self):
        """Between all places where cells are sampled, in the middle of values 50 times as large."""
        middle = np.array([0.637, 0.211])
        random = np.random.default_rng(7)
        points = np.concatenate([random.uniform(0, 1, (300, 2)),
                                 middle + random.normal(0, 0.02, (1000, 2)),
                                 [[0, 0], [1, 0], [1, 1], [0, 1]]])
        d = np.where(np.hypot(*(points - middle).T) < 0.02, 0.004, 0.2)
        triangles = scipy.spatial.Delaunay(points).simplices
        meshio.Mesh(np.pad(points, ((0, 0), (0, 1))), [("triangle", triangles)],
                    point_data={"d": d}).write(self.folder / "spot.vtu")
        rows = [f"{x!r},{y!r},{v!r}" for (x, y), v in zip(points.tolist(), d.tolist())]
        (self.folder / "spot.csv").write_text("\n".join(["x,y,d", *rows]))
        wanted = 2 / 3**0.5 * np.pi * 0.02**2 / 0.004**2
        for name in ("spot.vtu", "spot.csv"):
            with self.subTest(name):
                x, _ = self.spacing_of(self.nodes(name))
                found = np.count_nonzero(np.hypot(*(x - middle).T) < 0.02)
                self.assertGreater(found, 0.7 * wanted)
                self.assertLess(found, 1.4 * wanted)

    def test_quadrangles_are_two_triangles(self):
        points = np.array([[-1, -1, 0], [2, -1, 0], [2, 2, 0], [-1, 2, 0.0]])
        d = np.array([0.08, 0.12, 0.12, 0.08])
        for name, cells in (("quad", [[0, 1, 2, 3]]), ("triangle", [[0, 1, 2], [0, 2, 3]])):
            meshio.Mesh(points, [(name, np.array(cells))], point_data={"d": d}).write(
                self.folder / f"{name}.vtu")
        self.assertEqual(self.nodes("quad.vtu"), self.nodes("triangle.vtu"))

    def test_what_is_refused(self):
        mesh, d = self.write_meshes(2)
        self.assertIn("no field 'hight'; of values at points it has 'size', 'way' (3 components)",
                      self.refuse_spacing("packed.vtu:hight"))
        self.assertIn("'way' has 3 components", self.refuse_spacing("new.msh:way"))
        mesh.point_data["other"] = d
        mesh.write(self.folder / "two.vtu")
        self.assertIn("expected the name of the field", self.refuse_spacing("two.vtu"))
        mesh.point_data = {"d": np.where(np.arange(len(d)) == 3, -1, d)}
        mesh.write(self.folder / "below.vtu")
        self.assertIn("below.vtu: d[3] at (", self.refuse_spacing("below.vtu"))
        mesh.point_data = {"d": d}
        mesh.points[:, 0] += 1000
        mesh.write(self.folder / "away.vtu")
        self.assertIn("outside of the domain", self.refuse_spacing("away.vtu"))
        mesh.point_data = {}
        mesh.write(self.folder / "bare.vtu")
        self.assertIn("it has none", self.refuse_spacing("bare.vtu"))
        mesh.write(self.folder / "bare.msh", file_format="gmsh22")
        self.assertIn("it has none", self.refuse_spacing("bare.msh"))
        cube = meshio.Mesh(np.array(list(itertools.product((0, 1.0), repeat=3))),
                           [("hexahedron", np.array([[0, 4, 6, 2, 1, 5, 7, 3]]))],
                           point_data={"d": np.ones(8)})
        cube.write(self.folder / "cube.vtu")
        self.assertIn("Tetrahedralize", self.refuse_spacing("cube.vtu", "box(0,0,0,1,1,1)"))
        self.assertIn("missing.vtu", self.refuse_spacing("missing.vtu"))
        self.assertIn("expected a field", self.refuse("--domain", self.square, "--spacing", "bare.msh",
                                                      "--simplify", "0.1", "-o", "a.csv"))
        self.assertIn("overwrite", self.refuse("--domain", self.square, "--spacing",
                                             "packed.vtu:size", "-o", "packed.vtu"))

    def test_cut_anywhere(self):
        self.write_meshes(2)
        whole = (self.folder / "plain.vtu").read_bytes()
        for part in (0.3, 0.6, 0.9, 0.99):
            (self.folder / "cut.vtu").write_bytes(whole[:int(part * len(whole))])
            with self.subTest(part):
                message = self.refuse_spacing("cut.vtu:size")
                self.assertRegex(message, "ends (too early|before)|never closed|not closed")

    def test_tables_that_are_wrong(self):
        def refuse(text, domain=None):
            (self.folder / "bad.csv").write_text(text)
            return self.refuse_spacing("bad.csv", domain)

        self.assertIn("bad.csv:3: found 'x', expected d, a number", refuse("x,y,d\n0,0,1\n0,1,x\n"))
        self.assertIn("bad.csv:2: found 2 columns, expected 3", refuse("x,y,d\n0,0\n"))
        self.assertIn("columns x and y", refuse("0,0,1\n0,1,2\n"))
        self.assertIn("no column z", refuse("x,y,d\n0,0,1\n", "box(0,0,0,1,1,1)"))
        self.assertIn("both at (0, 0)", refuse("x,y,d\n0,0,1\n0,0,2\n"))
        self.assertIn("no point", refuse("x,y,d\n"))
        self.assertIn("header", refuse(""))
        self.assertIn("= nan", refuse("x,y,d\n0,0,nan\n"))
        self.assertIn("two columns", refuse("x,y,X,d\n0,0,0,1\n"))


if __name__ == "__main__":
    unittest.main()
