# SPDX-License-Identifier: BSD-3-Clause
"""Tests the files of periodic domains: elements cut open beside the cell, with partner nodes."""
import os
import re
import tempfile
import unittest

import numpy as np
import pnpbs
from pnpbs import PNPBSError, Status

try:
    import meshio
except ImportError:
    meshio = None

LOW, HIGH = np.array([-0.3, 0.2, 1.0]), np.array([0.7, 1.5, 1.9])


def inclusion(domain):
    domain.add_arc(HIGH[:2], 0.3, tag=5, role="inner").add_region(HIGH[:2], 2)


def hole(domain):
    domain.add_arc(HIGH[:2], 0.3, tag=5)


def cavity(domain):
    centre = np.array([HIGH[0], HIGH[1], 1.45])
    domain.add_box(centre - 0.25, centre + 0.25, tag=7)


CASES = {  # dim, axes, d, change, Euler's characteristic of the torus with holes
    "channel": (2, (False, True), 0.05, None, 0),
    "hole": (2, True, 0.03, hole, -1),
    "inclusion": (2, True, 0.03, inclusion, 0),
    "cube": (3, True, 0.13, None, 0),
    "cavity": (3, (True, True, False), 0.12, cavity, 1),
}


def faces_of(cells):
    """Returns the faces of cells: their nodes in order, and the node opposite to each."""
    corners = cells.shape[1]
    faces = [np.delete(cells, k, axis=1) for k in range(corners)]
    return np.sort(np.vstack(faces), axis=1)


@unittest.skipIf(meshio is None, "meshio is missing")
class PeriodicFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.context = pnpbs.Context()
        cls.addClassCleanup(cls.context.close)
        cls.placements = {name: cls.place(*case) for name, case in CASES.items()}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    @classmethod
    def place(cls, dim, axes, d, change, _=None):
        domain = pnpbs.Domain(cls.context, dim).set_periodic(LOW[:dim], HIGH[:dim], axes)
        if change:
            change(domain)
        placement = pnpbs.Placement(domain).set_spacing(d)
        placement.run()
        placement.check()
        return placement

    def write(self, placement, name):
        path = os.path.join(self.folder, name)
        placement.write(path, elements=True)
        return path

    def test_elements(self):
        for name, case in CASES.items():
            with self.subTest(name):
                dim, axes, euler = case[0], np.broadcast_to(case[1], case[0]), case[4]
                placement = self.placements[name]
                mesh = meshio.read(self.write(placement, "a.vtu"))
                x, partner = mesh.points[:, :dim], mesh.point_data["partner"]
                cells = mesh.cells[0].data
                nodes = placement.nodes()
                n = len(nodes.ids)
                np.testing.assert_array_equal(partner[:n], np.arange(n))
                self.assertLess(partner[n:].max(), n)
                np.testing.assert_array_equal(mesh.point_data["id"], nodes.ids[partner])
                np.testing.assert_array_equal(mesh.point_data["tag"], nodes.tags[partner])
                # A node that no element has in the box lies beyond it.
                periods = (x[:n] - nodes.points) / (HIGH - LOW)[:dim]
                np.testing.assert_allclose(periods, np.rint(periods), atol=1e-12)
                self.assertLess((np.abs(periods).max(axis=1) > 0.5).sum(), 4)
                periods = (x - x[partner]) / (HIGH - LOW)[:dim]
                np.testing.assert_allclose(periods, np.rint(periods), atol=1e-12)
                periods = np.rint(periods)[n:]
                self.assertLessEqual(set(periods.ravel()), {-1, 0, 1})
                self.assertTrue((periods[:, ~axes] == 0).all())
                self.assertEqual(len(np.unique(np.column_stack([partner[n:], periods]), axis=0)),
                                 len(partner) - n)
                self.assertEqual(set(cells.ravel()), set(range(len(x))))
                edges = x[cells]
                self.assertTrue((np.linalg.det(edges[:, 1:] - edges[:, :1]) > 0).all())
                # Each element of the torus occurs once, and each inner face twice.
                own = placement.triangles() if dim == 2 else placement.tetrahedra()
                ids = np.concatenate([nodes.ids, placement.ghosts().ids])
                expected = np.sort(ids[own], axis=1)
                found = np.sort(mesh.point_data["id"][cells], axis=1)
                np.testing.assert_array_equal(*(np.unique(some, axis=0, return_counts=True)[k]
                                                for k in (0,) for some in (expected, found)))
                self.assertEqual(len(expected), len(found))
                faces, times = np.unique(np.sort(partner[faces_of(cells)], axis=1), axis=0,
                                         return_counts=True)
                if name in ("cube",):
                    facets = np.empty((0, dim), int)
                else:
                    facets = meshio.read(os.path.join(self.folder, "a_facets.vtu")).cells[0].data
                outside = np.unique(np.sort(partner[facets], axis=1), axis=0)
                self.assertLessEqual(times.max(), 2)
                if name != "inclusion":  # its facets have elements on both sides
                    np.testing.assert_array_equal(faces[times == 1], outside)
                faces_of_mesh = {tuple(face) for face in faces_of(cells)}
                for facet in np.sort(facets, axis=1):
                    self.assertIn(tuple(facet), faces_of_mesh)
                edges = np.unique(np.sort(np.vstack(
                    [partner[cells[:, [a, b]]] for a in range(dim + 1) for b in range(a)]), axis=1),
                    axis=0)
                sign = n - len(edges) + len(faces) - len(cells) if dim == 3 else (
                    n - len(edges) + len(cells))
                self.assertEqual(sign, euler)

    def test_gmsh_links(self):
        for name in ("channel", "inclusion", "cavity"):
            for extension in ("msh", "msh2"):
                with self.subTest(name, extension=extension):
                    dim = CASES[name][0]
                    placement = self.placements[name]
                    mesh = meshio.read(self.write(placement, "a.vtu"))
                    partner = mesh.point_data["partner"]
                    with open(self.write(placement, "a." + extension), encoding="ascii") as file:
                        text = file.read()
                    links = re.search(r"\$Periodic\n(.*)\$EndPeriodic", text, re.DOTALL)
                    lines = iter(links.group(1).splitlines())
                    pairs = {}
                    for _ in range(int(next(lines))):
                        dimension, entity, master = map(int, next(lines).split())
                        self.assertEqual(dimension, dim - 1)
                        self.assertNotEqual(entity, master)
                        affine = next(lines).split()
                        self.assertEqual(affine.pop(0), "16" if extension == "msh" else "Affine")
                        affine = np.array(affine, float).reshape(4, 4)
                        np.testing.assert_array_equal(affine[:3, :3], np.eye(3))
                        for _ in range(int(next(lines))):
                            copy, node = (int(number) - 1 for number in next(lines).split())
                            pairs[copy] = node
                            np.testing.assert_allclose(mesh.points[copy] - mesh.points[node],
                                                       affine[:3, 3], atol=1e-12)
                    copies = np.flatnonzero(partner != np.arange(len(partner)))
                    self.assertEqual(pairs, dict(zip(copies, partner[copies])))

    def test_flat_sides(self):
        line = [(LOW[0], 0.5), (0.1, 0.6), (HIGH[0], 0.5)]
        changes = {
            "square": (2, True, True, None),
            "one axis": (2, True, (True, False), None),
            "hole": (2, True, True, hole),
            "inclusion": (2, True, True,
                          lambda domain: domain.add_arc(HIGH[:2], 0.3, tag=5, role="inner")),
            "channel": (2, (True, False), True, None),
            "layer": (2, True, True,
                      lambda domain: domain.add_polyline(line, closed=False, role="inner", tags=7)),
            "cube": (3, True, True, None),
            "slab": (3, (True, True, False), True, None),
        }
        for name, (dim, axes, flat, change) in changes.items():
            with self.subTest(name):
                tags = 11 + np.arange(2 * dim)
                low, high = LOW[:dim], HIGH[:dim]
                axes, flat = np.broadcast_to(axes, dim), np.broadcast_to(flat, dim)
                domain = pnpbs.Domain(self.context, dim).set_periodic(low, high, axes, tags, flat)
                if change:
                    change(domain)
                placement = pnpbs.Placement(domain).set_spacing(0.04 if dim == 2 else 0.15)
                placement.run()
                placement.check()
                mesh = meshio.read(self.write(placement, "a.vtu"))
                x = mesh.points[:, :dim]
                self.assertTrue((x[:, flat | ~axes] < high[flat | ~axes] + 1e-12).all())
                edges = x[mesh.cells[0].data]
                measures = np.linalg.det(edges[:, 1:] - edges[:, :1]) / (2 if dim == 2 else 6)
                self.assertAlmostEqual(measures.sum(), domain.measure(), 2 if change else 10)
                facets = meshio.read(os.path.join(self.folder, "a_facets.vtu"))
                corners, of_facets = facets.cells[0].data, facets.cell_data["tag"][0]
                for axis in np.flatnonzero(flat & axes):
                    sides = []
                    for side, at in ((2 * axis, low[axis]), (2 * axis + 1, high[axis])):
                        y = x[corners[of_facets == tags[side]]]
                        np.testing.assert_allclose(y[..., axis], at, atol=1e-12)
                        self.assertGreater(len(y), 4)
                        y = np.round(np.delete(y, axis, axis=2), 9) + 0.0
                        sides.append({tuple(sorted(map(tuple, facet))) for facet in y})
                    self.assertEqual(*sides)
                with open(self.write(placement, "a.msh"), encoding="ascii") as file:
                    text = file.read()
                for axis in np.flatnonzero(flat & axes):
                    self.assertIn(f"\n{dim - 1} {12 + 2 * axis} {11 + 2 * axis} \n16 ", text)

    def test_fields_and_other_formats(self):
        placement = self.placements["inclusion"]
        x = placement.nodes().points
        wave = np.sin(2 * np.pi * (x[:, 0] - LOW[0])) + np.cos(2 * np.pi * (x[:, 1] - LOW[1]) / 1.3)
        placement.add_output_field("wave", wave)
        mesh = meshio.read(self.write(placement, "a.vtu"))
        x = mesh.points
        wave = np.sin(2 * np.pi * (x[:, 0] - LOW[0])) + np.cos(2 * np.pi * (x[:, 1] - LOW[1]) / 1.3)
        np.testing.assert_allclose(mesh.point_data["wave"], wave, atol=1e-9)
        inside = np.hypot(*(x[mesh.cells[0].data].mean(axis=1)[:, :2] - HIGH[:2]).T) < 0.29
        self.assertTrue((mesh.cell_data["region"][0][inside] == 2).all())
        for name in ("a.msh", "a.msh2"):
            other = meshio.read(self.write(placement, name), file_format="gmsh")
            self.assertEqual(len(other.points), len(x))
            self.assertEqual(len(other.get_cells_type("triangle")), len(mesh.cells[0].data))
        self.write(placement, "a.node")
        with open(os.path.join(self.folder, "a.ele"), encoding="ascii") as file:
            self.assertEqual(int(file.readline().split()[0]), len(mesh.cells[0].data))
        for name in ("a.pvtu", "a.gr3", "a.2dm"):
            with self.assertRaises(PNPBSError) as caught:
                self.write(placement, name)
            self.assertEqual(caught.exception.status, Status.ERROR_UNSUPPORTED)

    def test_nodes_alone(self):
        placement = self.placements["cube"]
        path = os.path.join(self.folder, "a.csv")
        placement.write(path)
        rows = np.loadtxt(path, delimiter=",", skiprows=1)
        np.testing.assert_array_equal(rows[:, 0], placement.nodes().ids)


if __name__ == "__main__":
    unittest.main()
