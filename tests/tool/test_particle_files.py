# SPDX-License-Identifier: BSD-3-Clause
"""Tests files of particles for other programs, .peridigm, .lammps and .hdf5, against the .csv file.
"""

import math
import os
import subprocess
import unittest

import numpy

try:
    import h5py
except ImportError:
    h5py = None

from builds import exists_if
from command import COMMAND, MPIEXEC, CommandTest
from readers import read_csv
from test_regions import CUBES

HDF5 = os.environ.get("PNPBS_HAVE_HDF5") == "1"
# A cube is used because a ball, with its many facets, takes 9 s.
CUBE = ("--domain", "box(1,0,-1, 3,2,1)", "--spacing", "0.4", "--nodes-at", "centers")
DENSITY = ("--density", "1000 + 100*z")
TEXTS = ("a.peridigm", "a.lammps")


def read_peridigm(path):
    """Reads the file like TextFileDiscretization: five numbers per line, and comments begin with #.
    """
    lines = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    assert all(len(line) == 5 for line in lines)
    rows = numpy.array(lines, float)
    return rows[:, :3], rows[:, 3], rows[:, 4]


def read_lammps(path):
    """Reads the file like read_data: header lines are recognized by their last words, and one line
    is skipped after the title and after the name of the section. Returns the rows and the header.
    """
    lines = path.read_text().splitlines()[1:]
    begin = lines.index("Atoms # peri")
    head = {}
    for line in filter(None, lines[:begin]):
        words = line.split()
        numbers = 2 if words[-1].endswith("hi") else 1
        head[" ".join(words[numbers:])] = [float(word) for word in words[:numbers]]
    assert lines[begin + 1] == ""
    return numpy.array([line.split() for line in lines[begin + 2:]], float), head


class ParticleFiles(CommandTest):
    def outputs(self, *names):
        return [word for name in names for word in ("-o", name)]

    def points(self, table):
        return numpy.column_stack([table[axis] for axis in "xyz" if axis in table])

    def test_peridigm(self):
        self.run_on_ranks(*CUBE, *self.outputs("a.peridigm", "a.csv"))
        table = read_csv(self.folder / "a.csv")
        points, blocks, volumes = read_peridigm(self.folder / "a.peridigm")
        numpy.testing.assert_array_equal(points, self.points(table))
        numpy.testing.assert_array_equal(volumes, table["volume"])
        self.assertEqual(set(blocks), {1})
        self.assertAlmostEqual(math.fsum(volumes), 8, delta=1e-12)
        self.assertGreater(volumes.min(), 0)

    # Nodes of a mesh can be written as well. Their volumes need not be requested.
    def test_peridigm_of_a_mesh(self):
        self.run_on_ranks("--domain", "box(0,0,0, 1,1,1)", "--spacing", "0.3", *self.outputs("a.peridigm"))
        points, _, volumes = read_peridigm(self.folder / "a.peridigm")
        self.assertEqual((points.min(), points.max()), (0, 1))
        self.assertAlmostEqual(math.fsum(volumes), 1, delta=1e-12)

    def test_lammps(self):
        self.run_on_ranks(*CUBE, *DENSITY, *self.outputs("a.lammps", "a.csv"))
        table = read_csv(self.folder / "a.csv")
        rows, head = read_lammps(self.folder / "a.lammps")
        n = len(table["id"])
        numpy.testing.assert_array_equal(rows[:, 0], numpy.arange(1, n + 1))
        self.assertEqual(set(rows[:, 1]), {1})
        numpy.testing.assert_array_equal(rows[:, 2], table["volume"])
        numpy.testing.assert_array_equal(rows[:, 3], table["density"])
        numpy.testing.assert_array_equal(rows[:, 4:], self.points(table))
        self.assertEqual((head["atoms"], head["atom types"]), ([n], [1]))
        size = table["volume"].max() ** (1 / 3)
        for axis in "xyz":
            numpy.testing.assert_allclose(
                head[f"{axis}lo {axis}hi"],
                [table[axis].min() - size, table[axis].max() + size], atol=1e-12)

    # Blocks and types are the tags of regions, if there are any.
    def test_regions(self):
        (self.folder / "cubes.poly").write_text(CUBES)
        ask = ("--domain", "cubes.poly", "--inner", "2", "--spacing", "0.3", "--density", "1",
               *self.outputs(*TEXTS, "a.csv"))
        tags = ("--region", "0.5,0.5,0.5:2", "--region", "0.5,0.5,1.5:5")
        self.run_on_ranks(*ask, *tags)
        z = read_csv(self.folder / "a.csv")["z"]
        _, blocks, volumes = read_peridigm(self.folder / "a.peridigm")
        self.assertEqual((set(blocks[z < 1]), set(blocks[z > 1])), ({2}, {5}))
        self.assertAlmostEqual(math.fsum(volumes), 2, delta=1e-12)
        rows, head = read_lammps(self.folder / "a.lammps")
        numpy.testing.assert_array_equal(rows[:, 1], blocks)
        self.assertEqual(head["atom types"], [5])
        self.check_ranks((*ask, *tags), TEXTS)
        self.run_on_ranks(*ask, *tags[:2])
        self.assertEqual(set(read_peridigm(self.folder / "a.peridigm")[1][z > 1]), {1})
        self.assertEqual(read_lammps(self.folder / "a.lammps")[1]["atom types"], [2])
        for name in TEXTS:
            process = subprocess.run(
                [COMMAND, *map(str, ask[:-2 * len((*TEXTS, "a.csv"))]), *self.outputs(name), "--region",
                 "0.5,0.5,0.5:-2"], cwd=self.folder, capture_output=True, check=False)
            self.assertIn(f"a .{name[2:]} file numbers blocks and types from 1 on, and the tag of a "
                          "region is -2", process.stderr.decode())

    def check_gadget(self, table, dimension):
        points = self.points(table)
        n = len(points)
        with h5py.File(self.folder / "a.hdf5") as file:
            head, gas = file["Header"].attrs, file["PartType0"]
            for name in ("NumPart_ThisFile", "NumPart_Total"):
                self.assertEqual(list(head[name]), [n, 0, 0, 0, 0, 0])
            self.assertEqual(list(head["NumPart_Total_HighWord"]), [0] * 6)
            self.assertEqual(list(head["MassTable"]), [0] * 6)
            for name, value in (("Dimension", dimension), ("NumFilesPerSnapshot", 1),
                                ("Flag_Entropy_ICs", 0), ("Time", 0)):
                self.assertEqual(head[name], value)
            self.assertEqual(file["RuntimePars"].attrs["PeriodicBoundariesOn"], 0)
            self.assertNotIn("Units", file)
            self.assertEqual({name: array.shape for name, array in gas.items()},
                             {**dict.fromkeys(("Coordinates", "Velocities"), (n, 3)),
                              **dict.fromkeys(("Masses", "Density", "SmoothingLength",
                                               "InternalEnergy", "ParticleIDs"), (n,))})
            numpy.testing.assert_array_equal(gas["Coordinates"][:, :dimension], points)
            self.assertFalse(gas["Coordinates"][:, dimension:].any())
            self.assertFalse(gas["Velocities"][:].any() or gas["InternalEnergy"][:].any())
            numpy.testing.assert_array_equal(gas["Masses"], table["mass"])
            numpy.testing.assert_array_equal(gas["Density"], table["density"])
            numpy.testing.assert_array_equal(gas["ParticleIDs"], numpy.arange(1, n + 1))
            numpy.testing.assert_allclose(gas["SmoothingLength"],
                                          1.2348 * table["volume"] ** (1 / dimension), rtol=1e-14)
            size = table["volume"].max() ** (1 / dimension)
            self.check_box(head["BoxSize"], gas["Coordinates"][:], size)

    def check_box(self, box, points, size):
        """The box begins at 0. If particles have negative coordinates, they are shifted, and the
        box has room for the shifted ones."""
        self.assertEqual(box.shape, (3,))
        low, high = points.min(axis=0), points.max(axis=0)
        expected = numpy.where(low < 0, high - low + 2 * size, high + size)
        numpy.testing.assert_allclose(box, expected, rtol=1e-12)

    @exists_if(HDF5)
    def test_gadget(self):
        square = ("--domain", self.square, "--spacing", "0.02 + 0.03*x", "--nodes-at", "centers")
        for ask, dimension in ((CUBE, 3), (square, 2)):
            self.run_on_ranks(*ask, *DENSITY[:1], "1000 + 100*x", *self.outputs("a.hdf5", "a.csv"))
            self.check_gadget(read_csv(self.folder / "a.csv"), dimension)

    # Checks that the files have the same bytes on any number of ranks.
    def check_ranks(self, ask, names):
        expected = {name: (self.folder / name).read_bytes() for name in names}
        for ranks in (1, 2, 3) if MPIEXEC else (1,):
            for name in names:
                (self.folder / name).write_text("old")
            self.run_on_ranks(*ask, ranks=ranks)
            for name, content in expected.items():
                self.assertTrue((self.folder / name).read_bytes() == content, f"{name}, {ranks}")

    # Checks more particles than are written at a time, and so few that some ranks have none.
    def test_on_ranks(self):
        names = ("a.hdf5",) if HDF5 else ("a.csv",)
        for spacing in ("0.004 + 0.01*x", "0.25"):
            ask = ("--domain", self.square, "--spacing", spacing, "--density", "2 + y",
                   *self.outputs(*names))
            self.run_on_ranks(*ask)
            self.check_ranks(ask, names)
        ask = (*CUBE, *DENSITY, *self.outputs(*TEXTS, *names))
        self.run_on_ranks(*ask)
        self.check_ranks(ask, (*TEXTS, *names))

    # Checks a file with the particles of walls and of the domain that they surround.
    @exists_if(HDF5)
    def test_walls(self):
        self.run_on_ranks("--domain", self.square, "--spacing", "0.1", "--nodes-at", "walls", "--density",
                   "3", *self.outputs("a.hdf5", "a.csv"))
        table = read_csv(self.folder / "a.csv")
        self.assertLess(table["x"].min(), 0)
        self.check_gadget(table, 2)


class Refused(CommandTest):
    def ask(self, *arguments):
        return self.refuse(*(CUBE if "--domain" not in arguments else ()), *arguments)

    def test_without_density(self):
        for name in ("lammps", "hdf5"):
            for output in ((f"a.{name}",), ("a.dat", "--format", name)):
                self.assertIn(f"a .{name} file needs the density of particles: give --density",
                              self.ask("-o", *output))

    def test_in_the_plane(self):
        for name in ("peridigm", "lammps"):
            self.assertIn(f"a .{name} file is for bodies, not for the plane",
                          self.ask("--domain", self.square, "--spacing", "0.1", *DENSITY[:1], "1",
                                   "-o", f"a.{name}"))

    def test_on_surfaces(self):
        for name in ("peridigm", "lammps", "hdf5"):
            self.assertIn(f"a .{name} file is for bodies, and with --surfaces-only",
                          self.ask("--domain", "box(1,0,-1, 3,2,1)", "--spacing", "0.5", *DENSITY,
                                   "--surfaces-only", "-o", f"a.{name}"))

    @exists_if(HDF5)
    def test_no_stream(self):
        self.assertIn("standard output", self.ask(*DENSITY, "-o", "-", "--format", "hdf5"))

    def test_streams(self):
        out, _ = self.run_command(*CUBE, "-o", "-", "--format", "peridigm")
        self.run_command(*CUBE, "-o", "a.peridigm")
        self.assertEqual((self.folder / "a.peridigm").read_bytes(), out)


if __name__ == "__main__":
    unittest.main()
