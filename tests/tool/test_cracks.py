# SPDX-License-Identifier: BSD-3-Clause
"""Tests --crack: nodes are doubled along inner curves and surfaces, except at their tips."""

import math
import unittest

import meshio
import numpy
import scipy.sparse
import scipy.sparse.csgraph
import scipy.sparse.linalg

from command import MPIEXEC, CommandTest

CRACK = 7


def poly(vertices, segments):
    """Returns a .poly with the unit square, tag 1, and inner segments (first, last, tag), which
    refer to further vertices from number 5 on."""
    vertices = [(0, 0), (1, 0), (1, 1), (0, 1), *vertices]
    segments = [(1, 2, 1), (2, 3, 1), (3, 4, 1), (4, 1, 1), *segments]
    lines = [f"{len(vertices)} 2 0 0"]
    lines += [f"{k} {x} {y}" for k, (x, y) in enumerate(vertices, 1)]
    lines += [f"{len(segments)} 1"]
    lines += [f"{k} {a} {b} {tag}" for k, (a, b, tag) in enumerate(segments, 1)]
    return "\n".join([*lines, "0", ""])


def smesh(*sheets):
    """Returns a .smesh with the box of the sides 1, 1 and 1, tag 1, and sheets (corners, tag)."""
    corners = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    facets = [((1, 4, 3, 2), 1), ((5, 6, 7, 8), 1),
              *((((k + 1), (k + 1) % 4 + 1, (k + 1) % 4 + 5, k + 5), 1) for k in range(4))]
    for points, tag in sheets:
        facets.append((range(len(corners) + 1, len(corners) + len(points) + 1), tag))
        corners += points
    lines = [f"{len(corners)} 3 0 0"]
    lines += [f"{k} {x!r} {y!r} {z!r}" for k, (x, y, z) in enumerate(corners, 1)]
    lines += [f"{len(facets)} 1"]
    lines += [" ".join(map(str, (len(facet), *facet, tag))) for facet, tag in facets]
    return "\n".join([*lines, "0", "0", ""])


def disc(radius, n=24):
    turns = [2 * math.pi * k / n for k in range(n)]
    return [(0.5 + radius * math.cos(t), 0.5 + radius * math.sin(t), 0.5) for t in turns]


ACROSS = [(0, 0, 0.5), (1, 0, 0.5), (1, 1, 0.5), (0, 1, 0.5)]


def faces_of(elements):
    """Returns the faces of elements as sorted rows of nodes, and how many elements have each."""
    corners = elements.shape[1]
    faces = numpy.vstack([numpy.delete(elements, k, axis=1) for k in range(corners)])
    return numpy.unique(numpy.sort(faces, axis=1), axis=0, return_counts=True)


def euler_characteristic(elements):
    """Returns the alternating sum of the numbers of nodes, edges, faces and elements."""
    total, cells = 0, elements
    while True:
        cells = numpy.unique(numpy.sort(cells, axis=1), axis=0)
        total += (-1) ** (cells.shape[1] - 1) * len(cells)
        if cells.shape[1] == 1:
            return total
        cells = numpy.vstack([numpy.delete(cells, k, axis=1) for k in range(cells.shape[1])])


def measures(points, elements):
    x = points[elements]
    return numpy.linalg.det(x[:, 1:] - x[:, :1]) / math.factorial(x.shape[1] - 1)


def parts(elements):
    """Returns the number of parts that share no node."""
    first = numpy.repeat(elements[:, 0], elements.shape[1])
    graph = scipy.sparse.coo_matrix((numpy.ones(elements.size), (first, elements.ravel())))
    n = elements.max() + 1
    graph = scipy.sparse.coo_matrix((graph.data, (graph.row, graph.col)), shape=(n, n))
    return scipy.sparse.csgraph.connected_components(graph, directed=False)[0]


def harmonic(points, elements, fixed, values):
    """Solves Laplace's equation by linear elements, with given values at fixed nodes."""
    dim = points.shape[1]
    x = points[elements]
    inverse = numpy.linalg.inv(x[:, 1:] - x[:, :1])
    gradients = numpy.concatenate([-inverse.sum(axis=2)[:, None, :],
                                   inverse.transpose(0, 2, 1)], axis=1)
    local = numpy.einsum("eik,ejk,e->eij", gradients, gradients, measures(points, elements))
    rows = numpy.repeat(elements, dim + 1, axis=1).ravel()
    columns = numpy.tile(elements, dim + 1).ravel()
    matrix = scipy.sparse.csr_matrix((local.ravel(), (rows, columns)))
    u = numpy.zeros(len(points))
    u[fixed] = values
    free = numpy.setdiff1d(numpy.arange(len(points)), fixed)
    u[free] = scipy.sparse.linalg.spsolve(matrix[free][:, free].tocsc(),
                                          -matrix[free][:, fixed] @ u[fixed])
    return u


class Cracks(CommandTest):
    def options(self, name, text, spacing, *more):
        path = self.folder / name
        path.write_text(text)
        return ("--domain", path, "--spacing", spacing, *more)

    def mesh(self, *options, elements):
        """Returns points, elements, facets and their tags of a run."""
        self.run_command(*options, "--output", "a.vtu")
        mesh = meshio.read(self.folder / "a.vtu")
        facets = meshio.read(self.folder / "a_facets.vtu")
        numpy.testing.assert_array_equal(facets.points, mesh.points)
        dim = 2 if elements == "triangle" else 3
        return (mesh.points[:, :dim], mesh.cells_dict[elements], facets.cells[0].data,
                facets.cell_data["tag"][0])

    def cracked(self, *options, crack=(CRACK,), elements="triangle"):
        """Returns what mesh() does without cracks, and with them after checks that hold for any."""
        whole = self.mesh(*options, elements=elements)
        cracks = [word for tag in crack for word in ("--crack", tag)]
        opened = self.mesh(*options, *cracks, elements=elements)
        points, cells, facets, tags = opened
        n = len(whole[0])
        # Nodes are the same, and copies lie on nodes on the crack.
        numpy.testing.assert_array_equal(points[:n], whole[0])
        on_crack = numpy.unique(whole[2][numpy.isin(whole[3], crack)])
        coordinates = {tuple(x) for x in points[on_crack]}
        self.assertTrue(all(tuple(x) in coordinates for x in points[n:]))
        # Elements are the same up to copies of their nodes. Sorted rows of points identify them.
        def as_points(mesh):
            rows = mesh[0][mesh[1]]
            return numpy.unique([sorted(map(tuple, row)) for row in rows], axis=0)
        numpy.testing.assert_array_equal(as_points(opened), as_points(whole))
        self.assertGreater(measures(points, cells).min(), 0)
        self.assertAlmostEqual(measures(points, cells).sum(), 1, 12)
        self.assertEqual(len(numpy.unique(cells)), len(points))
        # The facets of the file are those of one element, and those of inner curves that are whole.
        faces, counts = faces_of(cells)
        self.assertLessEqual(counts.max(), 2)
        bounding = {tuple(face) for face in faces[counts == 1]}
        listed = [tuple(sorted(facet)) for facet in facets]
        self.assertEqual(len(set(listed)), len(listed))
        self.assertTrue(bounding <= set(listed))
        # Each facet of the crack that opens bounds elements twice.
        all_facets = numpy.isin(whole[3], crack).sum()
        before = (faces_of(whole[1])[1] == 1).sum()
        opening = ((counts == 1).sum() - before) / 2
        self.assertEqual(opening, all_facets)
        return whole, opened

    # ------------------------------------------------------------ in the plane -----------------

    def test_from_side_to_side(self):
        (points, *_), (x, cells, *_) = self.cracked(*self.options(
            "a.poly", poly([(0, 0.5), (1, 0.5)], [(5, 6, CRACK)]), 0.05))
        self.assertEqual(len(x) - len(points), (points[:, 1] == 0.5).sum())
        self.assertEqual(parts(cells), 2)
        ends = numpy.flatnonzero((x[:, 1] == 0) | (x[:, 1] == 1))
        u = harmonic(x, cells, ends, x[ends, 1])
        above = x[cells].mean(axis=1)[:, 1] > 0.5
        self.assertLess(abs(u[cells[above]] - 1).max(), 1e-12)
        self.assertLess(abs(u[cells[~above]]).max(), 1e-12)

    def test_with_two_tips(self):
        (points, *_), (x, cells, *_) = self.cracked(*self.options(
            "a.poly", poly([(0.3, 0.4), (0.7, 0.6)], [(5, 6, CRACK)]), 0.04))
        on_crack = abs((points[:, 1] - 0.4) * 0.4 - (points[:, 0] - 0.3) * 0.2) < 1e-12
        on_crack &= (points[:, 0] >= 0.3) & (points[:, 0] <= 0.7)
        self.assertEqual(len(x) - len(points), on_crack.sum() - 2)
        self.assertEqual(parts(cells), 1)
        self.assertEqual(euler_characteristic(cells), 0)  # a ring
        # No element connects a node and its copy, and copies are below the crack.
        below = (x[cells].mean(axis=1) - (0.3, 0.4)) @ (0.2, -0.4) > 0
        copied = numpy.flatnonzero(cells.max(axis=1) >= len(points))
        self.assertTrue(below[copied].all())

    def test_with_one_tip(self):
        (points, *_), (x, cells, *_) = self.cracked(*self.options(
            "a.poly", poly([(0, 0.5), (0.6, 0.5)], [(5, 6, CRACK)]), 0.05))
        on_crack = (points[:, 1] == 0.5) & (points[:, 0] <= 0.6)
        self.assertEqual(len(x) - len(points), on_crack.sum() - 1)
        self.assertEqual(euler_characteristic(cells), 1)

    def test_cross(self):
        ends = [(0.2, 0.5), (0.8, 0.5), (0.5, 0.2), (0.5, 0.8), (0.5, 0.5)]
        segments = [(5, 9, CRACK), (9, 6, CRACK), (7, 9, 8), (9, 8, 8)]
        (points, *_), (x, cells, *_) = self.cracked(
            *self.options("a.poly", poly(ends, segments), 0.05), crack=(CRACK, 8))
        centre = (x == 0.5).all(axis=1)
        self.assertEqual(centre.sum(), 4)
        on_crack = ((points[:, 1] == 0.5) & (abs(points[:, 0] - 0.5) <= 0.3 + 1e-12)
                    | (points[:, 0] == 0.5) & (abs(points[:, 1] - 0.5) <= 0.3 + 1e-12))
        self.assertEqual(len(x) - len(points), on_crack.sum() - 1 - 4 + 3)
        self.assertEqual(euler_characteristic(cells), 0)

    def test_one_that_ends_on_another(self):
        vertices = [(0.2, 0.5), (0.8, 0.5), (0.5, 0.8), (0.5, 0.5)]
        segments = [(5, 8, CRACK), (8, 6, CRACK), (7, 8, 8)]
        _, (x, cells, *_) = self.cracked(*self.options("a.poly", poly(vertices, segments), 0.05),
                                         crack=(CRACK, 8))
        self.assertEqual((x == 0.5).all(axis=1).sum(), 3)
        self.assertEqual(euler_characteristic(cells), 0)

    def test_only_one_of_two_curves(self):
        vertices = [(0.2, 0.5), (0.8, 0.5), (0.5, 0.8), (0.5, 0.5)]
        segments = [(5, 8, CRACK), (8, 6, CRACK), (7, 8, 8)]
        _, (x, *_) = self.cracked(*self.options("a.poly", poly(vertices, segments), 0.05))
        self.assertEqual((x == 0.5).all(axis=1).sum(), 2)

    # ------------------------------------------------------------ in space ---------------------

    def test_sheet_from_side_to_side(self):
        (points, *_), (x, cells, *_) = self.cracked(*self.options(
            "a.smesh", smesh((ACROSS, CRACK)), 0.1, "--fragment"), elements="tetra")
        self.assertEqual(len(x) - len(points), (points[:, 2] == 0.5).sum())
        self.assertEqual(parts(cells), 2)
        ends = numpy.flatnonzero((x[:, 2] == 0) | (x[:, 2] == 1))
        u = harmonic(x, cells, ends, x[ends, 2])
        above = x[cells].mean(axis=1)[:, 2] > 0.5
        self.assertLess(abs(u[cells[above]] - 1).max(), 1e-12)
        self.assertLess(abs(u[cells[~above]]).max(), 1e-12)

    def test_two_sheets_across(self):
        upright = [(0.5, 0, 0), (0.5, 1, 0), (0.5, 1, 1), (0.5, 0, 1)]
        (points, *_), (x, cells, *_) = self.cracked(
            *self.options("a.smesh", smesh((ACROSS, CRACK), (upright, 8)), 0.1, "--fragment"),
            crack=(CRACK, 8), elements="tetra")
        on = points[:, (0, 2)] == 0.5
        self.assertEqual(len(x) - len(points), on.any(axis=1).sum() + 2 * on.all(axis=1).sum())
        self.assertEqual(parts(cells), 4)

    def test_sheet_that_elements_do_not_follow(self):
        options = self.options("a.smesh", smesh((ACROSS, CRACK)), 0.12, "--fragment")
        _, messages = self.run_command(*options, "--crack", CRACK, "--output", "a.vtu")
        self.assertRegex(messages.decode(), r"note: elements follow 9\d\.\d* percent of the cracks")

    def test_penny(self):
        (points, *_), (x, cells, facets, tags) = self.cracked(*self.options(
            "a.smesh", smesh((disc(0.3), CRACK)), 0.08, "--inner", CRACK), elements="tetra")
        away = numpy.hypot(*(points[:, :2] - 0.5).T)
        inside = (points[:, 2] == 0.5) & (away < 0.29)
        self.assertEqual(len(x) - len(points), inside.sum())
        self.assertEqual(parts(cells), 1)
        # The boundary is a sphere within a sphere.
        faces, counts = faces_of(cells)
        self.assertEqual(euler_characteristic(faces[counts == 1]), 4)
        self.assertEqual(euler_characteristic(cells), 2)
        # Facets of the crack are counter-clockwise as seen from outside of their elements.
        a, b, c = x[facets[tags == CRACK]].transpose(1, 0, 2)
        up = numpy.cross(b - a, c - a)[:, 2]
        self.assertEqual((up > 0).sum(), (up < 0).sum())
        owner = {tuple(sorted(numpy.delete(cell, k))): cell[k] for cell in cells for k in range(4)}
        for facet, normal in zip(facets[tags == CRACK], up):
            self.assertLess((x[owner[tuple(sorted(facet))], 2] - 0.5) * normal, 0)

    def test_edge_crack(self):
        sheet = [(0, 0, 0.5), (0.6, 0, 0.5), (0.6, 1, 0.5), (0, 1, 0.5)]
        (points, *_), (x, cells, *_) = self.cracked(*self.options(
            "a.smesh", smesh((sheet, CRACK)), 0.12, "--fragment"), elements="tetra")
        on_crack = (points[:, 2] == 0.5) & (points[:, 0] < 0.6 - 1e-9)
        self.assertEqual(len(x) - len(points), on_crack.sum())
        self.assertEqual(euler_characteristic(cells), 1)

    # ------------------------------------------------------------ files ------------------------

    @unittest.skipUnless(MPIEXEC, "without MPI")
    def test_same_bytes_on_any_ranks(self):
        plane = self.options("a.poly", poly([(0, 0.5), (0.5, 0.5), (1, 0.5), (0.5, 0.1), (0.5, 0.9)],
                                            [(5, 6, CRACK), (6, 7, CRACK), (8, 6, 8), (6, 9, 8)]),
                             0.03, "--crack", 8)
        # Zeros of either sign must not make the bounding boxes of groups depend on ranks.
        sheet = [(-0.0, 0, 0.5), *ACROSS[1:]]
        space = self.options("b.smesh", smesh((sheet, CRACK)), 0.1, "--fragment")
        for options in (plane, space):
            files = set()
            for ranks in (1, 2, 3):
                self.run_on_ranks(*options, "--crack", CRACK, "--field", "u=x+y", "-o", "a.msh",
                                  "-o", "b.vtu", ranks=ranks)
                files.add(tuple((self.folder / name).read_bytes()
                                for name in ("a.msh", "b.vtu", "b_facets.vtu")))
            self.assertEqual(len(files), 1)

    def test_vtu_has_ids_tags_and_fields_of_originals(self):
        self.run_command(*self.options("a.poly", poly([(0, 0.5), (1, 0.5)], [(5, 6, CRACK)]), 0.1),
                         "--crack", CRACK, "--field", "u=x", "--name", f"{CRACK}=fault",
                         "--output", "a.vtu", "--report", "a.json")
        mesh = meshio.read(self.folder / "a.vtu")
        ids = mesh.point_data["id"]
        first = {}
        for k, own in enumerate(ids):
            if own in first:
                for values in (mesh.points, *mesh.point_data.values()):
                    numpy.testing.assert_array_equal(values[k], values[first[own]])
            first.setdefault(own, k)
        self.assertEqual(len(ids) - len(first), (mesh.points[list(first.values()), 1] == 0.5).sum())

    def test_a_name(self):
        options = self.options("a.poly", poly([(0, 0.5), (1, 0.5)], [(5, 6, CRACK)]), 0.1,
                               "--name", f"{CRACK}=fault")
        self.run_command(*options, "--crack", CRACK, "--output", "a.msh")
        self.run_command(*options, "--crack", "fault", "--output", "b.msh")
        self.assertEqual((self.folder / "a.msh").read_bytes(),
                         (self.folder / "b.msh").read_bytes())
        self.assertIn("neither a tag nor the name", self.refuse(*options, "--crack", "fualt"))

    def test_bad_requests(self):
        options = self.options("a.poly", poly([(0, 0.5), (1, 0.5)], [(5, 6, CRACK)]), 0.1)
        for more, words in ((("--crack", 9, "-o", "a.msh"), "tag = 9"),
                            (("--crack", CRACK, "-o", "a.gr3"), "elements with cracks"),
                            (("--crack", CRACK, "-o", "a.pvtu"), "elements with cracks"),
                            (("--crack", CRACK, "-o", "a.msh", "--order", 2), "--order 2"),
                            (("--crack", CRACK, "-o", "a.msh", "--nodes-only"), "--nodes-only")):
            self.assertIn(words, self.refuse(*options, *more))


if __name__ == "__main__":
    unittest.main()
