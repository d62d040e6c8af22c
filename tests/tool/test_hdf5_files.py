# SPDX-License-Identifier: BSD-3-Clause
"""Files by HDF5, .vtkhdf and .xdmf, read back by VTK, h5py and meshio, against the .vtu file."""

import os
import subprocess
import unittest

import h5py
import meshio
import numpy
import vtk

from command import BAD_INPUT, COMMAND, FAILED, CommandTest
from readers import grid_arrays, read_with_vtk

NO_HDF5 = os.environ.get("PNPBS_NO_HDF5")
MPIEXEC = os.environ.get("PNPBS_MPIEXEC")
FILES = ("a.vtkhdf", "a.xdmf", "a.h5")
BOX = ("--domain", "box(0,0,0, 1,0.8,0.6)", "--spacing", "0.15")
OUTPUTS = ("-o", "a.vtu", "-o", "a.vtkhdf", "-o", "a.xdmf")


class Hdf5Files(CommandTest):
    def write(self, *ask, ranks=1):
        process = subprocess.run(
            [*([MPIEXEC, "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle",
                "1", "-np", str(ranks)] if ranks > 1 else []), COMMAND, *map(str, ask), "-q"],
            cwd=self.folder, env=dict(os.environ, OMP_NUM_THREADS="1"), capture_output=True,
            timeout=300, check=False)
        self.assertEqual(process.returncode, 0, process.stderr.decode())

    def contents(self):
        return {name: (self.folder / name).read_bytes() for name in FILES}

    def check(self, ask, kinds):
        self.write(*ask, *OUTPUTS)
        self.assertEqual(self.files(), sorted([*FILES, "a.vtu", "square.poly"]))
        self.expected = grid_arrays(read_with_vtk(self.folder / "a.vtu"))
        self.check_vtk("a.vtkhdf", vtk.vtkHDFReader)
        self.check_vtk("a.xdmf", vtk.vtkXdmfReader)
        self.check_meshio(kinds)
        self.check_h5py()
        self.check_ranks(ask)

    # VTK's reader of XDMF has numbers of other types, and takes nodes for sets of one node.
    def check_vtk(self, name, reader):
        found = grid_arrays(read_with_vtk(self.folder / name, reader))
        self.assertEqual(set(found), set(self.expected))
        if name == "a.xdmf":
            found["types"][found["types"] == vtk.VTK_POLY_VERTEX] = vtk.VTK_VERTEX
        for key, array in self.expected.items():
            with self.subTest(name, key=key):
                numpy.testing.assert_array_equal(found[key], array)
                if name == "a.vtkhdf":
                    self.assertEqual(found[key].dtype, array.dtype)

    def check_meshio(self, kinds):
        mesh, other = meshio.read(self.folder / "a.xdmf"), meshio.read(self.folder / "a.vtu")
        self.assertEqual([block.type for block in mesh.cells], kinds)
        numpy.testing.assert_array_equal(mesh.points, other.points)
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

    def check_h5py(self):
        with h5py.File(self.folder / "a.vtkhdf") as file, h5py.File(self.folder / "a.h5") as heavy:
            grid = file["VTKHDF"]
            self.assertEqual(list(grid.attrs["Version"]), [1, 0])
            self.assertEqual(grid.attrs["Type"], b"UnstructuredGrid")
            self.assertEqual(list(grid["NumberOfPoints"]), [len(self.expected["points"])])
            numpy.testing.assert_array_equal(heavy["points"], self.expected["points"])
            for (place, name) in (key for key in self.expected if isinstance(key, tuple)):
                ours, theirs = grid[f"{place.title()}Data/{name}"], heavy[f"{place}_data/{name}"]
                self.assertEqual(ours.dtype, self.expected[place, name].dtype)
                self.assertEqual(theirs.dtype, ours.dtype)
                numpy.testing.assert_array_equal(theirs, ours)

    # The same bytes again, on any ranks.
    def check_ranks(self, ask):
        expected = self.contents()
        for ranks in (1, 2, 3) if MPIEXEC else (1,):
            for name in FILES:
                (self.folder / name).write_text("old")
            self.write(*ask, *OUTPUTS, ranks=ranks)
            for name, content in self.contents().items():
                self.assertEqual(content, expected[name], f"{name}, {ranks}")

    def test_plane(self):
        self.check(("--domain", self.square, "--spacing", "0.03 + 0.05*x"), ["triangle"])

    def test_space(self):
        self.check(BOX, ["tetra", "triangle"])

    def test_nodes_only(self):
        self.check(("--domain", self.square, "--spacing", "0.1", "--nodes-only"), ["vertex"])

    def test_nodes_of_a_body_only(self):
        self.check((*BOX, "--nodes-only"), ["vertex"])

    # More rows than a rank writes at a time, and than are in a window.
    def test_many_nodes(self):
        ask = ("--domain", self.square, "--spacing", "0.006", "--steps", "3", "--set", "sweeps=0")
        process = subprocess.run([COMMAND, *map(str, ask), *OUTPUTS, "-q"], cwd=self.folder,
                                 capture_output=True, check=False)
        self.assertIn(process.returncode, (0, 3, 4), process.stderr.decode())
        self.expected = grid_arrays(read_with_vtk(self.folder / "a.vtu"))
        self.assertGreater(len(self.expected["points"]), 20000)
        self.check_vtk("a.vtkhdf", vtk.vtkHDFReader)
        self.check_meshio(["triangle"])


class Refused(CommandTest):
    def ask(self, *arguments, code=BAD_INPUT, **more):
        return self.refuse("--domain", self.square, "--spacing", "0.05", *arguments, code=code,
                           **more)

    # Before the run, which would take hours.
    @unittest.skipUnless(NO_HDF5, "nothing is preloaded before sanitizers")
    def test_hdf5_is_not_found(self):
        for name in ("a.vtkhdf", "a.xdmf"):
            message = self.refuse("--domain", "box(0,0,0, 1,1,1)", "--spacing", "0.001", "-o", name,
                                  code=FAILED, environment={"LD_PRELOAD": NO_HDF5})
            for words in ("HDF5", "cannot be opened", ".vtkhdf and .xdmf", "LD_LIBRARY_PATH"):
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

    # Of blocks of 1024 bytes: no room for the layout, or not for all rows.
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
