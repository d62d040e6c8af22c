# SPDX-License-Identifier: BSD-3-Clause
"""Tests files of volumes, by readers of others, alone and over ranks."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import meshio
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from builds import exists_if
from readers import (point_array, read_csv, read_ele, read_face, read_msh, read_node,
                     read_with_vtk)

PROGRAM = os.environ["PNPBS_WRITE_VOLUMES"]
MPIEXEC = os.environ.get("PNPBS_MPIEXEC")
HAVE_HDF5 = os.environ.get("PNPBS_HAVE_HDF5") == "1"
SIZE = numpy.array([1.0, 0.8, 0.6])
SAME_BYTES = ("a.vtu", "a_facets.vtu", "a.msh", "a.msh2", "a.node", "a.ele", "a.face", "a.csv")
FACES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))  # faces of a tetrahedron seen from outside


def cells_of(grid, kind, corners):
    """Returns the corners of the cells, which must all be of one kind."""
    assert {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())} <= {kind}
    return vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, corners)


def tetrahedra_of(grid):
    return cells_of(grid, vtk.VTK_TETRA, 4)


def triangles_of(grid):
    return cells_of(grid, vtk.VTK_TRIANGLE, 3)


def cell_array(grid, name):
    return vtk_to_numpy(grid.GetCellData().GetArray(name))


def volumes(points, tetrahedra):
    a, b, c, d = (points[tetrahedra[:, k]] for k in range(4))
    return numpy.einsum("ij,ij->i", b - a, numpy.cross(c - a, d - a)) / 6


def areas(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 2


def tetrahedron_quality(points, tetrahedra):
    """Returns the quality 3 r_in / R, by the products of opposite edges."""
    x = points[tetrahedra]
    length = lambda i, j: numpy.linalg.norm(x[:, i] - x[:, j], axis=1)
    p, q, r = (length(0, i) * length(j, k) for i, j, k in ((1, 2, 3), (2, 1, 3), (3, 1, 2)))
    volume = volumes(points, tetrahedra)
    surface = sum(areas(points, tetrahedra[:, face]) for face in FACES)
    radius = numpy.sqrt((p + q + r) * (p + q - r) * (p - q + r) * (q + r - p)) / (24 * volume)
    return 9 * volume / surface / radius


def turned(rows):
    """Returns the rows in sorted order, each rotated such that its smallest entry is first."""
    first = rows.argmin(axis=1)
    rows = numpy.stack([rows[numpy.arange(len(rows)), (first + k) % 3] for k in range(3)], axis=1)
    return rows[numpy.lexsort(rows.T[::-1])]


def open_faces(tetrahedra):
    """Returns the faces that only one tetrahedron has."""
    faces = numpy.concatenate([tetrahedra[:, face] for face in FACES])
    _, index, count = numpy.unique(numpy.sort(faces, axis=1), axis=0, return_index=True,
                                   return_counts=True)
    assert count.max() == 2
    return faces[index[count == 1]]


class VolumeTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, body, spacing, *names, elements=1, ranks=1):
        mpi = [MPIEXEC, "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1",
               "-np", str(ranks)] if ranks > 1 else []
        subprocess.run([*mpi, PROGRAM, body, str(spacing), str(elements), *names], check=True,
                       cwd=self.folder, env=dict(os.environ, OMP_NUM_THREADS="1"), timeout=300)

    def grid(self, name="a.vtu", kind=vtk.vtkXMLUnstructuredGridReader):
        return read_with_vtk(self.folder / name, kind)


class Alone(VolumeTest):
    def place(self, body, spacing):
        self.write(body, spacing, "a.vtu", "a.pvtu", "a.msh", "a.msh2", "a.node", "a.csv")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         sorted([*SAME_BYTES, "a.pvtu", "a_0.vtu", "a_facets.pvtu", "a_facets_0.vtu"]))
        self.vtu = self.grid()
        self.points = vtk_to_numpy(self.vtu.GetPoints().GetData())
        self.facets = self.grid("a_facets.vtu")
        self.tetrahedra, self.triangles = tetrahedra_of(self.vtu), triangles_of(self.facets)
        self.tags = cell_array(self.facets, "tag")
        self.assertGreater(len(self.points), 3000)
        self.check_cells()
        self.check_meshio()
        for name in ("a.msh", "a.msh2"):
            self.check_msh(name)
        self.check_node_files()
        self.check_csv()
        self.check_pieces()

    def check_cells(self):
        self.assertGreater(volumes(self.points, self.tetrahedra).min(), 0)
        numpy.testing.assert_array_equal(turned(self.triangles), turned(open_faces(self.tetrahedra)))
        expected = tetrahedron_quality(self.points, self.tetrahedra)
        numpy.testing.assert_allclose(cell_array(self.vtu, "quality"), expected, rtol=1e-4,
                                      atol=1e-5)
        x = self.points[self.triangles]
        a, b, c = (numpy.linalg.norm(x[:, k] - x[:, k - 1], axis=1) for k in range(3))
        expected = 16 * areas(self.points, self.triangles) ** 2 / (a * b * c * (a + b + c))
        numpy.testing.assert_allclose(cell_array(self.facets, "quality"), expected, rtol=1e-5)
        ids = point_array(self.vtu, "id")
        numpy.testing.assert_array_equal(point_array(self.facets, "id"), ids)
        numpy.testing.assert_array_equal(vtk_to_numpy(self.facets.GetPoints().GetData()),
                                         self.points)
        self.assertTrue((numpy.diff(ids) > 0).all())
        on_boundary = numpy.zeros(len(ids), bool)
        on_boundary[self.triangles] = True
        numpy.testing.assert_array_equal(on_boundary, point_array(self.vtu, "tag") != 0)

    def check_meshio(self):
        mesh, facets = (meshio.read(self.folder / name) for name in ("a.vtu", "a_facets.vtu"))
        self.assertEqual([block.type for block in mesh.cells], ["tetra"])
        numpy.testing.assert_array_equal(mesh.cells[0].data, self.tetrahedra)
        self.assertEqual([block.type for block in facets.cells], ["triangle"])
        numpy.testing.assert_array_equal(facets.cells[0].data, self.triangles)
        numpy.testing.assert_array_equal(facets.cell_data["tag"][0], self.tags)

    def check_msh(self, name):
        cells, groups = read_msh(self.folder / name, self.points)
        self.assertEqual(list(cells), ["triangle", "tetra"])
        triangles, tags = cells["triangle"]
        rows = lambda corners, tags: sorted(zip(corners.tolist(), tags.tolist()))
        self.assertEqual(rows(triangles, tags), rows(self.triangles, self.tags))
        tetrahedra, inside = cells["tetra"]
        numpy.testing.assert_array_equal(tetrahedra, self.tetrahedra)
        self.assertEqual(set(inside), {1})
        expected = {f"tag_{tag}": (tag, 2) for tag in set(self.tags.tolist())}
        self.assertEqual(groups, {**expected, "domain": (1, 3)})

    def check_node_files(self):
        points, markers = read_node(self.folder / "a.node", dimension=3)
        numpy.testing.assert_array_equal(points, self.points)
        numpy.testing.assert_array_equal(markers, point_array(self.vtu, "tag"))
        numpy.testing.assert_array_equal(read_ele(self.folder / "a.ele", corners=4),
                                         self.tetrahedra)
        triangles, markers = read_face(self.folder / "a.face")
        numpy.testing.assert_array_equal(triangles, self.triangles)
        numpy.testing.assert_array_equal(markers, self.tags)

    def check_csv(self):
        table = read_csv(self.folder / "a.csv")
        self.assertEqual(list(table), ["id", "x", "y", "z", "tag", "spacing"])
        numpy.testing.assert_array_equal(numpy.stack([table[k] for k in "xyz"], 1), self.points)
        for name in ("id", "tag", "spacing"):
            numpy.testing.assert_array_equal(table[name], point_array(self.vtu, name))

    def check_pieces(self):
        whole = self.grid("a.pvtu", vtk.vtkXMLPUnstructuredGridReader)
        numpy.testing.assert_array_equal(vtk_to_numpy(whole.GetPoints().GetData()), self.points)
        self.assertFalse(point_array(whole, "vtkGhostType").any())
        self.assertEqual(whole.GetNumberOfCells(), self.vtu.GetNumberOfCells())
        facets = self.grid("a_facets.pvtu", vtk.vtkXMLPUnstructuredGridReader)
        numpy.testing.assert_array_equal(turned(triangles_of(facets)), turned(self.triangles))

    def test_box(self):
        self.place("box", 0.06)
        self.assertAlmostEqual(volumes(self.points, self.tetrahedra).sum(), SIZE.prod(), places=9)
        self.assertEqual(set(self.tags), set(range(1, 7)))
        area = areas(self.points, self.triangles)
        for tag in range(1, 7):
            axis, high = divmod(tag - 1, 2)
            side = self.triangles[self.tags == tag]
            numpy.testing.assert_allclose(self.points[side][..., axis], high * SIZE[axis],
                                          atol=1e-12)
            self.assertAlmostEqual(area[self.tags == tag].sum(), SIZE.prod() / SIZE[axis], places=9)

    def test_ball(self):
        self.place("ball", 0.06)
        self.assertEqual(set(self.tags), {7})
        edge = 0.06  # upper bound for the part that chords cut off a ball
        ball, sphere = numpy.pi / 6, numpy.pi
        volume = volumes(self.points, self.tetrahedra).sum()
        self.assertTrue(ball - 0.3 * sphere * edge**2 < volume < ball)
        radii = numpy.linalg.norm(self.points[self.triangles] - [1, 2, 3], axis=2)
        self.assertLess(abs(radii - 0.5).max(), 1e-4)


class NodesOnly(VolumeTest):
    def test_points(self):
        self.write("box", 0.2, "a.vtu", "a.msh", "a.node", elements=0)
        self.assertEqual(len(list(self.folder.iterdir())), 3)
        grid = self.grid()
        points = vtk_to_numpy(grid.GetPoints().GetData())
        self.assertEqual(grid.GetNumberOfCells(), len(points))
        self.assertEqual(set(point_array(grid, "tag")), set(range(7)))
        cells, _ = read_msh(self.folder / "a.msh", points)
        self.assertEqual(list(cells), ["vertex"])


class OutputFields(VolumeTest):
    """Fields of the caller, which write_volumes computes from the positions."""

    COMPONENTS = {"u-1": 1, "Flow_2": 2, "moved": 3, "stress": 6}

    def expected(self, points):
        both = numpy.hstack([points, points**2])
        return {name: both[:, :count].squeeze() for name, count in self.COMPONENTS.items()}

    def check(self, grid, points, point_data):
        for name, values in self.expected(points).items():
            found = point_data(grid, name)
            if values.ndim == 2:  # VTK's reader of XDMF extends plane vectors to space
                self.assertFalse(found[:, values.shape[1]:].any())
                found = found[:, : values.shape[1]]
            numpy.testing.assert_array_equal(found, values, name)

    def check_vtk(self, name, reader):
        grid = self.grid(name, reader)
        self.check(grid, vtk_to_numpy(grid.GetPoints().GetData()), point_array)
        self.assertEqual(point_array(grid, "vtkGhostType").max() if "_" in name else 0,
                         1 if "_" in name else 0)

    # Checks that rows have the numbers of nodes and are in the order of the nodes in the file. The
    # numbers follow the ids, like the points of the .vtu file.
    def check_msh(self, name, points, order):
        lines = (self.folder / name).read_text().splitlines()
        for field, values in self.expected(points).items():
            at = lines.index(f'"{field}"')
            self.assertEqual(lines[at - 2 : at], ["$NodeData", "1"])
            count = self.COMPONENTS[field]
            # Gmsh's vectors and tensors have the components of space.
            written = 1 if count == 1 else 3 if count <= 3 else 9
            self.assertEqual(lines[at + 1 : at + 7],
                             ["1", "0", "3", "0", str(written), str(len(points))])
            end = at + 7 + len(points)
            self.assertEqual(lines[end], "$EndNodeData")
            rows = numpy.array([line.split() for line in lines[at + 7 : end]], float)
            self.assertEqual(rows.shape[1], 1 + written)
            numpy.testing.assert_array_equal(rows[:, 0], order + 1)
            numpy.testing.assert_array_equal(rows[:, 1 : 1 + count].squeeze(), values[order])
            self.assertFalse(rows[:, 1 + count :].any())

    # meshio assigns the rows to the nodes in the order of the file.
    def check_meshio(self, name):
        mesh = meshio.read(self.folder / name, "gmsh")
        for field, values in self.expected(mesh.points).items():
            found = mesh.point_data[field]
            found = found if values.ndim == 1 else found[:, : values.shape[1]]
            numpy.testing.assert_array_equal(found, values, field)
        return mesh.points

    def check_csv(self, points):
        table = read_csv(self.folder / "a.csv")
        names = ["id", "x", "y", "z", "tag", "spacing"]
        for field, values in self.expected(points).items():
            columns = [field] if values.ndim == 1 else [
                f"{field}:{c}" for c in range(values.shape[1])]
            names += columns
            found = numpy.stack([table[column] for column in columns], 1).squeeze()
            numpy.testing.assert_array_equal(found, values, field)
        self.assertEqual(list(table), names)

    def test_all_formats(self):
        names = ["a.vtu", "a.pvtu", "a.msh", "a.msh2", "a.csv"]
        by_hdf5 = ["a.vtkhdf", "a.xdmf"] if HAVE_HDF5 else []
        self.write("box", 0.2, *names, *by_hdf5, elements=2)
        for name, reader in (("a.vtu", vtk.vtkXMLUnstructuredGridReader),
                             ("a.pvtu", vtk.vtkXMLPUnstructuredGridReader),
                             ("a.vtkhdf", vtk.vtkHDFReader), ("a.xdmf", vtk.vtkXdmfReader)):
            if name in (*names, *by_hdf5):
                self.check_vtk(name, reader)
        points = vtk_to_numpy(self.grid().GetPoints().GetData())
        by_number = {tuple(x): number for number, x in enumerate(points)}
        for name in ("a.msh", "a.msh2"):
            order = numpy.array([by_number[tuple(x)] for x in self.check_meshio(name)])
            self.check_msh(name, points, order)
        self.check_csv(points)
        facets = self.grid("a_facets.vtu").GetPointData()
        self.assertFalse(any(facets.HasArray(name) for name in self.COMPONENTS))
        if not MPIEXEC:
            return
        same = [name for name in (*names, *by_hdf5) if name != "a.pvtu"] + ["a.h5"] * HAVE_HDF5
        alone = {name: (self.folder / name).read_bytes() for name in same}
        self.write("box", 0.2, *names, *by_hdf5, elements=2, ranks=3)
        for name, content in alone.items():
            self.assertEqual((self.folder / name).read_bytes(), content, name)
        self.check_vtk("a.pvtu", vtk.vtkXMLPUnstructuredGridReader)
        self.check_vtk("a_1.vtu", vtk.vtkXMLUnstructuredGridReader)


@exists_if(MPIEXEC)
class OverRanks(VolumeTest):
    def test_same_files(self):
        names = ("a.vtu", "a.pvtu", "a.msh", "a.msh2", "a.node", "a.csv")
        self.write("box", 0.06, *names)
        expected = {name: (self.folder / name).read_bytes() for name in SAME_BYTES}
        grid, facets = self.grid(), self.grid("a_facets.vtu")
        for ranks in (2, 3):
            for path in self.folder.iterdir():
                path.unlink()
            self.write("box", 0.06, *names, ranks=ranks)
            for name, content in expected.items():
                self.assertEqual((self.folder / name).read_bytes(), content, f"{name}, {ranks}")
            whole = self.grid("a.pvtu", vtk.vtkXMLPUnstructuredGridReader)
            pieces = [[self.grid(f"{name}_{rank}.vtu") for name in ("a", "a_facets")]
                      for rank in range(ranks)]
            self.assertEqual(whole.GetNumberOfCells(), grid.GetNumberOfCells())
            self.assertEqual(self.by_ids(pieces), self.by_ids([(grid, facets)]))

    def by_ids(self, pieces):
        """Returns owned nodes and all cells as sets that do not depend on indices in the files."""
        found = [[], [], []]
        for grid, facets in pieces:
            ids = point_array(grid, "id")
            own = numpy.ones(len(ids), bool)
            if grid.GetPointData().HasArray("vtkGhostType"):
                own = point_array(grid, "vtkGhostType") == 0
            found[0] += zip(ids[own].tolist(), vtk_to_numpy(grid.GetPoints().GetData())[own].tolist())
            found[1] += zip(ids[tetrahedra_of(grid)].tolist(),
                            cell_array(grid, "quality").tolist())
            quality, tags = (cell_array(facets, name).tolist() for name in ("quality", "tag"))
            found[2] += zip(point_array(facets, "id")[triangles_of(facets)].tolist(), quality, tags)
        return [sorted(rows) for rows in found]


if __name__ == "__main__":
    unittest.main()
