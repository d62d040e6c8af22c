# SPDX-License-Identifier: BSD-3-Clause
"""Tests files that are written by HDF5, .vtkhdf and .xdmf, by VTK, h5py and meshio against the .vtu
file."""

import os
import subprocess
import unittest
import xml.etree.ElementTree

import h5py
import meshio
import numpy
import pyvista
import vtk

from builds import exists_if
from command import BAD_INPUT, COMMAND, FAILED, MPIEXEC, CommandTest
from readers import grid_arrays, read_with_vtk

NO_HDF5 = os.environ.get("PNPBS_NO_HDF5")
FILES = ("a.vtkhdf", "a.xdmf", "a.h5")
FACETS = ("a_facets.vtkhdf", "a_facets.xdmf", "a_facets.h5")
BOX = ("--domain", "box(0,0,0, 1,0.8,0.6)", "--spacing", "0.15")
OUTPUTS = ("-o", "a.vtu", "-o", "a.vtkhdf", "-o", "a.xdmf")


class Hdf5Files(CommandTest):
    def contents(self):
        return {name: (self.folder / name).read_bytes() for name in self.names}

    # `kinds` are the kind of cells of the file, and that of the facets if there is a file of
    # facets.
    def check(self, ask, *kinds):
        self.run_on_ranks(*ask, *OUTPUTS)
        self.names = FILES + (FACETS if len(kinds) > 1 else ())
        vtu = ["a.vtu", "a_facets.vtu"][: len(kinds)]
        self.assertEqual(self.files(), sorted([*self.names, *vtu, "square.poly"]))
        for name, kind in zip(("a", "a_facets"), kinds):
            self.check_grid(name, kind)
        self.check_ranks(ask)

    def check_grid(self, name, kind):
        self.expected = grid_arrays(read_with_vtk(self.folder / f"{name}.vtu"))
        self.check_vtk(f"{name}.vtkhdf", vtk.vtkHDFReader)
        self.check_vtk(f"{name}.xdmf", vtk.vtkXdmfReader)
        self.check_meshio(name, kind)
        self.check_pyvista(name)
        self.check_dolfinx(name, kind)
        self.check_h5py(name)

    # VTK's reader of XDMF uses other types of numbers, and represents vertices and edges as
    # polyvertices and polylines.
    def check_vtk(self, name, reader):
        found = grid_arrays(read_with_vtk(self.folder / name, reader))
        self.assertEqual(set(found), set(self.expected))
        if name.endswith(".xdmf"):
            found["types"][found["types"] == vtk.VTK_POLY_VERTEX] = vtk.VTK_VERTEX
            found["types"][found["types"] == vtk.VTK_POLY_LINE] = vtk.VTK_LINE
        for key, array in self.expected.items():
            with self.subTest(name, key=key):
                numpy.testing.assert_array_equal(found[key], array)
                if name.endswith(".vtkhdf"):
                    self.assertEqual(found[key].dtype, array.dtype)

    # meshio does not read the time of a grid.
    def check_meshio(self, name, kind):
        text = (self.folder / f"{name}.xdmf").read_text()
        self.assertEqual(text.count('<Time Value="0"/>'), 1)
        timeless = self.folder / "timeless.xdmf"
        timeless.write_text(text.replace('<Time Value="0"/>', ""))
        mesh, other = meshio.read(timeless), meshio.read(self.folder / f"{name}.vtu")
        timeless.unlink()
        self.assertEqual([block.type for block in mesh.cells], [kind])
        dimension = mesh.points.shape[1]
        numpy.testing.assert_array_equal(mesh.points, other.points[:, :dimension])
        self.assertFalse(other.points[:, dimension:].any())
        for ours, theirs in zip(mesh.cells, other.cells, strict=True):
            self.assertEqual(ours.type, theirs.type)
            numpy.testing.assert_array_equal(ours.data, theirs.data)
        self.assertEqual(set(mesh.point_data), set(other.point_data))
        for name, data in other.point_data.items():
            numpy.testing.assert_array_equal(mesh.point_data[name], data)
        self.assertEqual(set(mesh.cell_data), set(other.cell_data))
        for name, blocks in other.cell_data.items():
            for ours, theirs in zip(mesh.cell_data[name], blocks, strict=True):
                numpy.testing.assert_array_equal(ours, theirs)

    def check_pyvista(self, name):
        for end in ("vtu", "vtkhdf", "xdmf"):
            mesh = pyvista.read(self.folder / f"{name}.{end}")
            numpy.testing.assert_array_equal(mesh.points, self.expected["points"])
            self.assertEqual(mesh.n_cells, len(self.expected["types"]))

    # Checks the requirements of DOLFINx's XDMFFile: grids with these names, arrays in the file of
    # the same name with the extension .h5, cells of one kind in a table, and the tags of facets as
    # the first attribute.
    def check_dolfinx(self, name, kind):
        kinds = {"Polyvertex": "vertex", "Polyline": "line", "Triangle": "triangle",
                 "Tetrahedron": "tetra"}
        grid, = xml.etree.ElementTree.parse(self.folder / f"{name}.xdmf").findall("Domain/Grid")
        self.assertEqual(grid.get("Name"), "facets" if name.endswith("_facets") else "mesh")
        topology, geometry = grid.find("Topology"), grid.find("Geometry")
        self.assertEqual(kinds[topology.get("TopologyType")], kind)
        dimension = {"XY": 2, "XYZ": 3}[geometry.get("GeometryType")]
        with h5py.File(self.folder / f"{name}.h5") as file:
            for item in grid.iter("DataItem"):
                heavy, path = item.text.split(":")
                self.assertEqual(heavy, f"{name}.h5")
                self.assertEqual(" ".join(map(str, file[path].shape)), item.get("Dimensions"))
            self.assertEqual(file["points"].shape[1], dimension)
            self.assertEqual(file["cells"].ndim, 2)
        if name.endswith("_facets"):
            self.assertEqual(grid.find("Attribute").get("Name"), "tag")

    def check_h5py(self, name):
        with (h5py.File(self.folder / f"{name}.vtkhdf") as file,
              h5py.File(self.folder / f"{name}.h5") as heavy):
            grid = file["VTKHDF"]
            self.assertEqual(list(grid.attrs["Version"]), [1, 0])
            self.assertEqual(grid.attrs["Type"], b"UnstructuredGrid")
            self.assertEqual(list(grid["NumberOfPoints"]), [len(self.expected["points"])])
            points = numpy.asarray(heavy["points"])
            numpy.testing.assert_array_equal(points, self.expected["points"][:, : points.shape[1]])
            for (place, name) in (key for key in self.expected if isinstance(key, tuple)):
                ours, theirs = grid[f"{place.title()}Data/{name}"], heavy[f"{place}_data/{name}"]
                self.assertEqual(ours.dtype, self.expected[place, name].dtype)
                self.assertEqual(theirs.dtype, ours.dtype)
                numpy.testing.assert_array_equal(theirs, ours)

    # Checks that the files have the same bytes on any number of ranks.
    def check_ranks(self, ask):
        expected = self.contents()
        for ranks in (1, 2, 3) if MPIEXEC else (1,):
            for name in self.names:
                (self.folder / name).write_text("old")
            self.run_on_ranks(*ask, *OUTPUTS, ranks=ranks)
            for name, content in self.contents().items():
                self.assertEqual(content, expected[name], f"{name}, {ranks}")

    def test_plane(self):
        self.check(("--domain", self.square, "--spacing", "0.03 + 0.05*x"), "triangle", "line")

    def test_space(self):
        self.check(BOX, "tetra", "triangle")

    def test_nodes_only(self):
        self.check(("--domain", self.square, "--spacing", "0.1", "--nodes-only"), "vertex")

    def test_nodes_of_a_body_only(self):
        self.check((*BOX, "--nodes-only"), "vertex")

    # Checks more rows than a rank writes at a time, and than a window contains.
    def test_many_nodes(self):
        ask = ("--domain", self.square, "--spacing", "0.006", "--steps", "3", "--set", "sweeps=0")
        process = subprocess.run([COMMAND, *map(str, ask), *OUTPUTS, "-q"], cwd=self.folder,
                                 capture_output=True, check=False)
        self.assertIn(process.returncode, (0, 3, 4), process.stderr.decode())
        self.expected = grid_arrays(read_with_vtk(self.folder / "a.vtu"))
        self.assertGreater(len(self.expected["points"]), 20000)
        self.check_vtk("a.vtkhdf", vtk.vtkHDFReader)
        self.check_meshio("a", "triangle")


class Refused(CommandTest):
    def ask(self, *arguments, code=BAD_INPUT, **more):
        return self.refuse("--domain", self.square, "--spacing", "0.05", *arguments, code=code,
                           **more)

    # The error comes before the run, which would take hours.
    @exists_if(NO_HDF5)
    def test_hdf5_is_not_found(self):
        for name in ("a.vtkhdf", "a.xdmf", "a.hdf5"):
            message = self.refuse("--domain", "box(0,0,0, 1,1,1)", "--spacing", "0.001", "-o", name,
                                  "--density", "1", code=FAILED, environment={"LD_PRELOAD": NO_HDF5})
            for words in ("HDF5", "cannot be opened", ".vtkhdf, .xdmf and .hdf5", "LD_LIBRARY_PATH"):
                self.assertIn(words, message)

    def test_no_stream_and_no_device(self):
        for name in ("vtkhdf", "xdmf"):
            self.assertIn("standard output", self.ask("-o", "-", "--format", name))
            self.assertIn("no device", self.ask("-o", "/dev/null", "--format", name))
        self.assertIn("a:b.h5", self.ask("-o", "a:b.xdmf"))
        self.assertIn("nowhere/a.xdmf", self.ask("-o", "nowhere/a.xdmf"))

    def test_a_folder_has_the_name_of_the_arrays(self):
        (self.folder / "a.h5").mkdir()
        self.assertIn("a.h5", self.ask("-o", "a.xdmf", "-o", "a.csv", code=FAILED))

    # The limits are in blocks of 1024 bytes: too few for the layout, or for all rows.
    def test_no_room(self):
        for name in FILES:
            (self.folder / name).write_text("old")
        before = self.files()
        for blocks in (3, 50, 90):
            for name in ("a.vtkhdf", "a.xdmf"):
                with self.subTest(name, blocks=blocks):
                    process = subprocess.run(
                        ["bash", "-c", f'ulimit -f {blocks}; exec "$0" "$@"', COMMAND, "--domain",
                         self.square, "--spacing", "0.03", "-q", "-o", name],
                        cwd=self.folder, capture_output=True, check=False)
                    self.assertIn(b"cannot write 'a.", process.stderr)
                    self.assertEqual(process.returncode, FAILED, process.stderr)
                    self.assertEqual(self.files(), before)
                    self.assertEqual({(self.folder / each).read_text() for each in FILES}, {"old"})


if __name__ == "__main__":
    unittest.main()
