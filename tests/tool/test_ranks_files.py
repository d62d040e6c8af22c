# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the command writes the same files under mpirun as alone."""

import collections
import json
import unittest

import meshio
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from command import LAKE, NOT_CONVERGED
from ranks import RanksTest
from readers import point_array, read_with_vtk

SAME_BYTES = ("a.vtu", "a_facets.vtu", "a.msh", "a.msh2", "a.node", "a.ele", "a.csv", "a.svg")


def grid_by_ids(grid):
    """Returns the nodes and triangles of a grid as sets that do not depend on indices in the file.
    """
    ids = point_array(grid, "id")
    points = vtk_to_numpy(grid.GetPoints().GetData())
    own = numpy.ones(len(ids), bool)
    if grid.GetPointData().HasArray("vtkGhostType"):
        own = point_array(grid, "vtkGhostType") == 0
    data = zip(ids, points[:, 0], points[:, 1], point_array(grid, "tag"),
               point_array(grid, "spacing"), strict=True)
    nodes = [row for row, kept in zip(data, own) if kept]
    corners = ids[vtk_to_numpy(grid.GetCells().GetConnectivityArray())].reshape(-1, 3)
    quality = vtk_to_numpy(grid.GetCellData().GetArray("quality"))
    triangles = [(*row, q) for row, q in zip(corners.tolist(), quality.tolist(), strict=True)]
    return sorted(nodes), sorted(triangles)


def facets_by_ids(grid):
    ids = point_array(grid, "id")
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 2)
    tags = vtk_to_numpy(grid.GetCellData().GetArray("tag"))
    return sorted(zip(ids[corners].tolist(), tags.tolist()))


def tetrahedron_in_cube(path):
    """Writes a cube with a tetrahedron as the group "inner", whose corners it returns."""
    cube = [[i & 1, i >> 1 & 1, i >> 2] for i in range(8)]
    sides = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))
    inner = [[0.2, 0.2, 0.3], [0.8, 0.3, 0.2], [0.4, 0.8, 0.3], [0.5, 0.5, 0.8]]
    path.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in cube + inner) + "g shell\n" +
                    "".join("f {} {} {} {}\n".format(*(k + 1 for k in side)) for side in sides) +
                    "g inner\nf 9 11 10\nf 9 10 12\nf 10 11 12\nf 11 9 12\n")
    return inner


class InnerSurfaces(RanksTest):
    def test_are_the_same_triangles(self):
        """Checks a tetrahedron in a cube: its faces are the same in the files of any number of
        ranks."""
        inner = tetrahedron_in_cube(self.folder / "m.obj")
        ask = ("--domain", "m.obj", "--inner", "inner", "--spacing", "0.12", "--quiet", "--set",
               "tolerance_mean=1", "--steps", "40", "-o", "a.msh", "-o", "a.vtu", "-o", "a.face")
        self.run_command(*ask)
        expected = {name: (self.folder / name).read_bytes() for name in ("a.msh", "a.vtu", "a.face")}
        mesh = meshio.read(self.folder / "a.msh", file_format="gmsh")
        area = 0
        for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
            if block.type == "triangle":
                x = mesh.points[block.data[tags == 2]]
                area += numpy.linalg.norm(numpy.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]),
                                          axis=1).sum() / 2
        x = numpy.array(inner)[[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]]
        exact = numpy.linalg.norm(numpy.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1).sum() / 2
        self.assertAlmostEqual(area, exact, 6)
        self.run_ranks(3, *ask)
        for name, data in expected.items():
            self.assertTrue((self.folder / name).read_bytes() == data, name)


class Regions(RanksTest):
    def test_are_the_same(self):
        """Some elements have no region, and some ranks have no nodes if d is coarse."""
        pair = self.folder / "pair.poly"
        pair.write_text("6 2 0 0\n1 0 0\n2 1 0\n3 2 0\n4 2 1\n5 1 1\n6 0 1\n8 1\n1 1 2 1\n"
                        "2 2 3 1\n3 3 4 1\n4 4 5 1\n5 5 6 1\n6 6 1 1\n7 2 5 2\n8 1 5 3\n0\n"
                        "2\n1 0.9 0.1 7\n2 1.5 0.5 4\n")
        names = ("a.vtu", "a.msh", "a.msh2", "a.ele")
        outputs = [word for name in names for word in ("-o", name)]
        for spacing in ("0.01 + 0.02*x", "0.6"):
            ask = ("--domain", pair, "--spacing", spacing, "--quiet", *outputs, "-o", "a.pvtu")
            self.run_command(*ask)
            expected = {name: (self.folder / name).read_bytes() for name in names}
            grid = read_with_vtk(self.folder / "a.vtu")
            regions = vtk_to_numpy(grid.GetCellData().GetArray("region"))
            self.assertEqual(set(regions), {0, 4, 7})
            self.run_ranks(3, *ask)
            for name, content in expected.items():
                self.assertTrue((self.folder / name).read_bytes() == content, name)
            whole = read_with_vtk(self.folder / "a.pvtu", vtk.vtkXMLPUnstructuredGridReader)
            again = vtk_to_numpy(whole.GetCellData().GetArray("region"))
            self.assertEqual(collections.Counter(again), collections.Counter(regions))


class SameFiles(RanksTest):
    def outputs(self):
        names = (*(name for name in SAME_BYTES if "facets" not in name), "a.pvtu")
        return [*(word for name in names for word in ("-o", name)), "--report", "a.json"]

    def check(self, spacing, all_ranks):
        """Compares the files of one rank with those of several. Returns the numbers of nodes in the
        pieces of the last run."""
        ask = ("--domain", self.square, "--spacing", spacing, *self.outputs())
        _, warnings = self.run_command(*ask)
        expected = {name: (self.folder / name).read_bytes() for name in SAME_BYTES}
        report = json.loads((self.folder / "a.json").read_text())
        grid = grid_by_ids(read_with_vtk(self.folder / "a.vtu"))
        facets = facets_by_ids(read_with_vtk(self.folder / "a_facets.vtu"))
        for ranks in all_ranks:
            for name in self.files():
                if name.startswith("a"):
                    (self.folder / name).unlink()
            out, err = self.run_ranks(ranks, *ask)
            self.assertEqual((len(out.splitlines()), err), (7, warnings.decode()))
            for name, content in expected.items():
                self.assertEqual((self.folder / name).read_bytes(), content, f"{name}, {ranks}")
            again = json.loads((self.folder / "a.json").read_text())
            self.assertEqual((again["hash"], again["ranks"]), (report["hash"], ranks))
            pieces = [f"a_{rank}.vtu" for rank in range(ranks)]
            self.assertEqual(self.files(), sorted([
                *expected, "a.pvtu", "a.json", "square.poly", *pieces, "a_facets.pvtu",
                *(piece.replace("a_", "a_facets_") for piece in pieces)]))
            whole = read_with_vtk(self.folder / "a.pvtu", vtk.vtkXMLPUnstructuredGridReader)
            self.assertEqual(grid_by_ids(whole), grid)
            self.assertEqual(facets_by_ids(read_with_vtk(
                self.folder / "a_facets.pvtu", vtk.vtkXMLPUnstructuredGridReader)), facets)
        return [read_with_vtk(self.folder / piece).GetNumberOfPoints() for piece in pieces]

    def test_graded(self):
        held = self.check("0.02 + 0.05*x", (1, 3, 5))
        nodes = json.loads((self.folder / "a.json").read_text())["nodes"]
        self.assertLess(max(held), nodes / 2)  # no rank has all nodes

    # Checks d from the shape, in the plane and in space, also for a given number of nodes.
    def test_spacing_from_the_shape(self):
        for ask in (("--domain", LAKE, "--spacing", "auto", "--nodes", "1e3"),
                    ("--domain", "box(0,0,0, 1,0.8,0.4)",
                     "--spacing", "min(gap(4), 0.08 + 0.05*dist(1))")):
            self.run_command(*ask, "-o", "a.csv")
            expected = (self.folder / "a.csv").read_bytes()
            self.run_ranks(3, *ask, "-o", "a.csv")
            self.assertEqual((self.folder / "a.csv").read_bytes(), expected)

    def test_ranks_without_nodes(self):
        self.assertIn(0, self.check("0.5", (5,)))

    def test_nodes_only(self):
        names = ("a.vtu", "a.msh")
        ask = ("--domain", self.square, "--spacing", "0.05", "--nodes-only", "-o", names[0],
               "-o", names[1], "-o", "a.pvtu")
        self.run_command(*ask)
        expected = [(self.folder / name).read_bytes() for name in names]
        self.run_ranks(3, *ask)
        self.assertEqual([(self.folder / name).read_bytes() for name in names], expected)
        whole = read_with_vtk(self.folder / "a.pvtu", vtk.vtkXMLPUnstructuredGridReader)
        alone = read_with_vtk(self.folder / "a.vtu")
        self.assertEqual(sorted(point_array(whole, "id")), list(point_array(alone, "id")))
        self.assertEqual(whole.GetNumberOfCells(), alone.GetNumberOfPoints())

    def test_elements_of_second_order(self):
        """Checks a lake, a body with an inner surface and a region, and a cylinder, whose rims are
        feature edges. Fields at mid nodes need those of ghosts."""
        tetrahedron_in_cube(self.folder / "m.obj")
        body = ("--domain", "m.obj", "--spacing", "0.15", "--inner", "inner", "--region",
                "0.5,0.5,0.4:5")
        names = ("a.vtu", "a_facets.vtu", "a.msh", "a.msh2")
        # With few nodes some edges of the lake stay straight.
        lake = ("--domain", LAKE, "--corner-angle", "60", "--spacing", "8", "--nodes", "100")
        for ask in (lake, body,
                    ("--domain", "cylinder(0,0,0, 0,0,1, 0.5)", "--spacing", "0.15")):
            ask = (*ask, "--order", "2", "--field", "f=x+y*y", "-o", "a.vtu", "-o", "a.msh", "-o",
                   "a.msh2", "--quiet")
            self.run_command(*ask)
            expected = {name: (self.folder / name).read_bytes() for name in names}
            grid = read_with_vtk(self.folder / "a.vtu")
            self.assertIn(grid.GetCellType(0), (vtk.VTK_QUADRATIC_TRIANGLE, vtk.VTK_QUADRATIC_TETRA))
            self.run_ranks(3, *ask)
            for name, content in expected.items():
                self.assertTrue((self.folder / name).read_bytes() == content, name)

    def test_colors(self):
        ask = ("--domain", self.square, "--spacing", "0.02 + 0.05*x", "-o", "a.svg", "--color")
        for by in ("quality", "edge", "spacing"):
            self.run_command(*ask, by)
            expected = (self.folder / "a.svg").read_bytes()
            (self.folder / "a.svg").unlink()
            self.run_ranks(3, *ask, by)
            self.assertEqual((self.folder / "a.svg").read_bytes(), expected)
        self.assertIn("--color", self.refuse_ranks(3, *ask, "red"))

    # Checks pictures of bodies, and the summary line with extent, volume and surface.
    def test_pictures_of_bodies(self):
        ask = ("--domain", "cylinder(0,0,0, 0,0,2, 1)", "--spacing", "0.25", "--steps", "10",
               "-o", "a.svg", "-o", "a.png", "--cut", "1,1,0, 0.3")
        out, _ = self.run_command(*ask, code=NOT_CONVERGED)
        expected = {name: (self.folder / name).read_bytes() for name in ("a.svg", "a.png")}
        again, _ = self.run_ranks(3, *ask, code=NOT_CONVERGED)
        self.assertEqual(again.splitlines()[0], out.splitlines()[0])
        for name, content in expected.items():
            self.assertEqual((self.folder / name).read_bytes(), content)
        self.assertIn("misses the body", self.refuse_ranks(2, *ask[:-1], "z=3"))

    # With the finest spacing there are more nodes than the ranks write at a time. With the coarsest
    # one some ranks have none.
    def test_volumes(self):
        names = ("a.vtu", "a.msh", "a.csv")
        outputs = [word for name in names for word in ("-o", name)]
        for domain in ((self.square, "0.003 + 0.01*x"), (self.square, "0.5"),
                       ("ball(0,0,0, 1)", "0.3"), ("ball(0,0,0, 1)", "0.3", "--surfaces-only"),
                       (self.square, "0.01 + 0.02*x", "--nodes-at", "centers"),
                       ("box(0,0,0, 1,1,1)", "0.2 + 0.05*x", "--nodes-at", "centers"),
                       (self.square, "0.02 + 0.02*x", "--nodes-at", "walls")):
            ask = ("--domain", domain[0], "--spacing", *domain[1:], "--density", "3 + x/7",
                   *outputs, "--report", "a.json")
            self.run_command(*ask)
            expected = {name: (self.folder / name).read_bytes() for name in names}
            report = json.loads((self.folder / "a.json").read_text())
            self.run_ranks(3, *ask)
            for name, content in expected.items():
                self.assertEqual((self.folder / name).read_bytes(), content, domain)
            again = json.loads((self.folder / "a.json").read_text())
            self.assertEqual((again["volumes"], again["mass"], again["ranks"]),
                             (report["volumes"], report["mass"], 3))

    def test_standard_streams(self):
        out, _ = self.run_command("--domain", LAKE, "--spacing", "6", "-o", "-", "--format", "vtu")
        again, _ = self.run_ranks(3, "--domain", "-", "--spacing", "6", "-o", "-", "--format",
                                  "vtu", stdin=LAKE.read_bytes())
        self.assertEqual(again, out)

    def test_report_to_standard_output(self):
        out, _ = self.run_ranks(2, "--domain", self.square, "--spacing", "0.1", "--report", "-")
        self.assertEqual(json.loads(out)["ranks"], 2)


if __name__ == "__main__":
    unittest.main()
