#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the evaluator and the cases of compare.py in space against exact values."""
import math
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

import bodies  # noqa: E402
import volume_cases as cases  # noqa: E402
from adapters import with_gmsh_volume  # noqa: E402
from evaluate_volume import boundary_faces, evaluate, measures, restricted, shape  # noqa: E402

CUBIC_QUALITY = 3 / math.sqrt(10)  # quality of the body-centred cubic lattice


def one_everywhere(points):
    return np.ones(len(points))


def body_centred(cells):
    """Returns the corners and centres of cubic cells."""
    corners, middles = (np.stack(np.meshgrid(*[np.arange(n, dtype=float)] * 3), -1).reshape(-1, 3)
                        for n in (cells + 1, cells))
    return np.vstack([corners, middles + 0.5])


def cube(side):
    body = bodies.box()
    body.vertices = body.vertices * side
    return body


class Shapes(unittest.TestCase):
    def test_regular_tetrahedron(self):
        corners = np.array([[1, 1, 1], [-1, -1, 1], [1, -1, -1], [-1, 1, -1]], float)
        quality, angle = shape(corners, np.array([[0, 1, 2, 3], [1, 0, 2, 3]]))
        for q, a in zip(quality, angle):
            self.assertAlmostEqual(q, 1, 13)
            self.assertAlmostEqual(a, math.degrees(math.acos(1 / 3)), 11)

    def test_sliver(self):
        """The corners of a square are moved up and down in turn by h. At its sides the faces meet
        at an angle with the cosine 1 / (1 + 4 h^2)."""
        for wanted in (0.1, 5, 15, 25):
            h = 0.5 * math.sqrt(1 / math.cos(math.radians(wanted)) - 1)
            corners = np.array([[1, 0, h], [-1, 0, h], [0, 1, -h], [0, -1, -h]])
            quality, angle = shape(corners, np.array([[0, 1, 2, 3]]))
            self.assertAlmostEqual(angle[0], wanted, 9)
            surface = 4 * math.sqrt(1 + 4 * h * h)
            self.assertAlmostEqual(quality[0], 12 * h / (surface * math.sqrt(1 + h * h)), 9)
            # The triangulation of the nodes alone is the same tetrahedron. It is the only one, so
            # it is not removed as an open one.
            m = measures(corners, np.array([[0, 1, 2, 3]]), np.zeros(4, bool), np.ones(4), cube(1))
            self.assertEqual((m["below_20"], m["below_10"]), (wanted < 20, wanted < 10))
            self.assertAlmostEqual(m["covered"], 4 * h / 3, 12)

    def test_flat_tetrahedron(self):
        corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
        quality, angle = shape(corners, np.array([[0, 1, 2, 3]]))
        self.assertEqual((quality[0], angle[0]), (0, 0))

    def test_random_tetrahedra(self):
        """The expected values come from the sphere through the corners as the solution of three
        plane equations, and from the angles between normals."""
        corners = np.random.default_rng(3).random((400, 3))
        tetrahedra = np.arange(400).reshape(-1, 4)
        quality, angle = shape(corners, tetrahedra)
        for t, (a, b, c, d) in enumerate(corners[tetrahedra]):
            edges = np.array([b - a, c - a, d - a])
            centre = np.linalg.solve(2 * edges, (edges ** 2).sum(1))
            normals, area = [], 0
            for face, other in (((a, b, c), d), ((a, b, d), c), ((a, c, d), b), ((b, c, d), a)):
                normal = np.cross(face[1] - face[0], face[2] - face[0])
                area += np.linalg.norm(normal) / 2
                normals.append(normal * -np.sign(normal @ (other - face[0]))
                               / np.linalg.norm(normal))
            inner = abs(np.linalg.det(edges)) / 2 / area
            self.assertAlmostEqual(quality[t], 3 * inner / np.linalg.norm(centre), 9)
            found = [180 - math.degrees(math.acos(normals[i] @ normals[j]))
                     for i in range(4) for j in range(i)]
            self.assertAlmostEqual(angle[t], min(found), 5)


class Lattices(unittest.TestCase):
    def test_body_centred_lattice(self):
        """The tetrahedra of the lattice are two halves of the square between each two adjacent
        centres."""
        cells = 4
        numbers = {tuple(p): k for k, p in enumerate(body_centred(cells).tolist())}
        tetrahedra = []
        for middle in np.stack(np.meshgrid(*[np.arange(cells)] * 3), -1).reshape(-1, 3) + 0.5:
            for axis in range(3):
                step = np.eye(3)[axis]
                other = middle + step
                if tuple(other) not in numbers:
                    continue
                u, v = 0.5 * np.eye(3)[(axis + 1) % 3], 0.5 * np.eye(3)[(axis + 2) % 3]
                ring = [middle + 0.5 * step + w for w in (u + v, u - v, -u - v, v - u)]
                for p, q in zip(ring, ring[1:] + ring[:1]):
                    tetrahedra.append([numbers[tuple(x.tolist())] for x in (middle, other, p, q)])
        m = evaluate(body_centred(cells), np.array(tetrahedra), cube(cells), one_everywhere)
        self.assertEqual(m["tetrahedra"], 3 * 4 * cells ** 2 * (cells - 1))
        for key in ("quality_mean", "quality_one_percent", "quality_least"):
            self.assertAlmostEqual(m[key], CUBIC_QUALITY, 12)
        self.assertAlmostEqual(m["angle_least"], 60, 9)
        self.assertEqual(m["below_20"], 0)
        self.assertEqual(m["histogram"][int(CUBIC_QUALITY * 50)], m["tetrahedra"])

    def box(self, points):
        """Returns the tetrahedra of a box from its nodes alone. In the middle they are those of the
        lattice."""
        middle = points.mean(0)
        on_boundary = (np.abs(points - middle) > 2 - 1e-9).any(1)
        return restricted(points, on_boundary, cube(4)), on_boundary

    def test_nodes_alone(self):
        points = body_centred(4)
        tetrahedra, on_boundary = self.box(points)
        m = measures(points, tetrahedra, on_boundary, np.ones(len(points)), cube(4))
        self.assertAlmostEqual(m["covered"], 1, 12)
        self.assertAlmostEqual(m["angle_least"], 45, 9)
        self.assertEqual(len(boundary_faces(tetrahedra)), 6 * 16 * 2)
        self.assertAlmostEqual(m["triangle_angle_least"], 45, 9)
        self.assertAlmostEqual(m["triangle_quality_mean"], 2 * math.sqrt(2) - 2, 9)
        self.assertAlmostEqual(m["quality_mean_inside"], CUBIC_QUALITY, 9)

    def test_flat_ones_at_the_boundary(self):
        """Nodes slightly off their planes have flat tetrahedra between them."""
        points = body_centred(4)
        _, on_boundary = self.box(points)
        body = cube(4)
        body.vertices = 2 + 1.001 * (body.vertices - 2)
        random = np.random.default_rng(6)
        points[on_boundary] += random.uniform(-1e-4, 1e-4, (on_boundary.sum(), 3))
        whole = restricted(points, np.zeros(len(points), bool), body)
        self.assertLess(shape(points, whole)[1].min(), 1)
        found = restricted(points, on_boundary, body)
        self.assertAlmostEqual(shape(points, found)[1].min(), 45, delta=0.1)
        self.assertEqual(len(boundary_faces(found)), 6 * 16 * 2)

    def test_exactly_on_a_sphere(self):
        """Qhull divides cubes arbitrarily. No tetrahedron without volume remains."""
        points = body_centred(3)[:64]
        found = restricted(points, np.zeros(64, bool), cube(3))
        m = measures(points, found, np.zeros(64, bool), np.ones(64), cube(3))
        self.assertAlmostEqual(m["covered"], 1, 12)
        self.assertGreater(m["angle_least"], 30)

    def test_octaves(self):
        """d of one half of a lattice is an eighth of the other. The octaves show what the mean does
        not."""
        points = body_centred(8)
        tetrahedra = restricted(points, np.zeros(len(points), bool), cube(8))
        d = np.where(points[:, 0] < 4.2, 0.125, 1)
        m = measures(points, tetrahedra, np.zeros(len(points), bool), d, cube(8))
        mean = (8 * math.sqrt(0.75) + 6) / 14
        self.assertEqual(len(m["edge_octaves"]), 2)
        self.assertAlmostEqual(m["edge_octaves"][0] / (8 * mean), 1, 1)
        self.assertAlmostEqual(m["edge_octaves"][1] / mean, 1, 0)


class Bodies(unittest.TestCase):
    def test_volumes_by_counting(self):
        random = np.random.default_rng(5)
        for body in (bodies.box(), bodies.l_block(), bodies.ball(0.2),
                     bodies.read_obj(bodies.DATA / "kleopatra.obj")):
            low, high = body.bounds()
            some = low + (high - low) * random.random((40000, 3))
            share = body.contains(some).mean()
            self.assertAlmostEqual(share, body.volume() / np.prod(high - low), delta=0.01)
        self.assertAlmostEqual(bodies.l_block().volume(), 0.75, 14)
        self.assertAlmostEqual(bodies.box().volume(), 1, 14)

    def test_triangles_of_the_ball(self):
        body = bodies.ball(0.1)
        triangles = body.triangles()
        self.assertEqual(len(boundary_edges(triangles)), 0)
        self.assertAlmostEqual(len(body.vertices), len(triangles) / 2 + 2)
        a, b, c = body.vertices[triangles].transpose(1, 0, 2)
        self.assertTrue(((a * np.cross(b, c)).sum(1) > 0).all())
        sides = np.linalg.norm(b - a, axis=1)
        self.assertTrue(0.07 < sides.min() < sides.max() < 0.13)
        self.assertAlmostEqual(sides.mean() / 0.1, 1, 1)

    def test_asteroids_are_closed(self):
        for read, name in ((bodies.read_off, "eros.off"), (bodies.read_obj, "kleopatra.obj")):
            self.assertEqual(len(boundary_edges(read(bodies.DATA / name).triangles())), 0)

    def test_stl(self):
        with tempfile.TemporaryDirectory() as folder:
            bodies.l_block().write_stl(Path(folder) / "l.stl")
            words = (Path(folder) / "l.stl").read_text().split()
        self.assertEqual(words.count("facet"), len(bodies.l_block().triangles()))
        self.assertEqual(words.count("vertex"), 3 * words.count("facet"))


def boundary_edges(triangles):
    """Returns the edges that do not have two triangles in opposite directions."""
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    there, back = ({tuple(e) for e in some.tolist()} for some in (edges, edges[:, ::-1]))
    return there ^ back if len(there) == len(edges) else there


class Cases(unittest.TestCase):
    def test_sizes(self):
        for name in ("uniform-cube", "graded-cube", "uniform-ball", "uniform-l-block"):
            case = cases.CASES[name](7000)
            self.assertAlmostEqual(case.expected_nodes() / 7000, 1, 1, name)
        d = cases.CASES["uniform-cube"](7000).constant
        self.assertAlmostEqual((1.575 / d ** 3 + 3 / d ** 2) / 7000, 1, 3)
        graded = cases.CASES["graded-cube"](7000)
        middle, corner = graded.spacing(np.array([[0.5, 0.5, 0.5], [1, 1, 1]]))
        self.assertAlmostEqual(corner / middle, 5, 3)

    def test_formula(self):
        case = cases.CASES["graded-cube"](500)
        value = eval(case.formula(power="**2"), {"sqrt": math.sqrt, "x": 0.1, "y": 0.9, "z": 0.3})
        self.assertAlmostEqual(value, case.spacing(np.array([[0.1, 0.9, 0.3]]))[0], 14)


class Files(unittest.TestCase):
    def test_gmsh_file(self):
        text = ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 9 9 9\n3 0 0 0\n4 1 0 0\n"
                "7 0 1 0\n8 0 0 1\n$EndNodes\n$Elements\n2\n1 2 2 0 1 3 4 7\n2 4 2 0 1 3 4 7 8\n"
                "$EndElements\n")
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "m.msh").write_text(text)
            points, tetrahedra = with_gmsh_volume.read_msh(Path(folder) / "m.msh")
        self.assertEqual(points[tetrahedra[0]].tolist(),
                         [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        self.assertEqual(len(tetrahedra), 1)


if __name__ == "__main__":
    unittest.main()
