#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the evaluation of spacing from the shape, on shapes with known measures."""
import dataclasses
import math
import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import bodies  # noqa: E402
import evaluate_shape  # noqa: E402
import numpy as np  # noqa: E402
from adapters import with_gmsh_shape, with_jigsaw_shape, with_pnpbs_shape  # noqa: E402
from distance_to_boundary import DistanceToBoundary, distances  # noqa: E402
from domain import from_loops  # noqa: E402
from shape_cases import CASES, Shape, ShapeCase  # noqa: E402


def circle(count, radius=1.0):
    angle = 2 * math.pi * np.arange(count) / count
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def rectangle(width, height, step=None):
    corners = np.array([[0, 0], [width, 0], [width, height], [0, height]], float)
    if step:
        x = np.arange(0, width, step)
        corners = np.vstack([np.column_stack([x, 0 * x]),
                             np.column_stack([width - x, 0 * x + height])])
    return Shape(from_loops([corners]))


def turned_round(shape):
    """Returns the shape with every second segment reversed."""
    segments = shape.domain.segments.copy()
    segments[::2] = segments[::2, ::-1]
    return Shape(dataclasses.replace(shape.domain, segments=segments))


class Distances(unittest.TestCase):
    def test_against_all_pieces(self):
        random = np.random.default_rng(1)
        for pieces in (Shape(from_loops([circle(40)])).pieces, Shape(bodies.l_block()).pieces,
                       Shape(bodies.ball(0.3)).pieces):
            points = random.uniform(-1.5, 1.5, (400, pieces.shape[2]))
            exact = np.min([distances(points, np.broadcast_to(piece, (400, *piece.shape)))
                            for piece in pieces], 0)
            found, number = DistanceToBoundary(pieces, 0.05).nearest(points)
            self.assertLess(np.abs(found - exact).max(), 0.05 * 0.05)
            self.assertLess(np.abs(distances(points, pieces[number]) - found).max(), 1e-14)

    def test_from_a_triangle(self):
        triangle = np.broadcast_to(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float), (4, 3, 3))
        points = np.array([[0.2, 0.2, 3], [-1, 0, 0], [1, 1, 0], [0.5, -2, 0]], float)
        self.assertTrue(np.allclose(distances(points, triangle), [3, 1, math.sqrt(0.5), 2]))


class Followed(unittest.TestCase):
    def lattice(self, d):
        y, x = np.meshgrid(np.arange(12) * d * math.sqrt(3) / 2, np.arange(20) * d, indexing="ij")
        x[1::2] += 0.5 * d
        return np.column_stack([x.ravel(), y.ravel()])

    def test_a_lattice(self):
        points = self.lattice(0.1) + [0.3, 0.2]
        case = ShapeCase("follow-box", "", rectangle(2.6, 1.5), 0.1, 0, 0.1)
        m = evaluate_shape.evaluate(points, dataclasses.replace(case, constant=0.05, largest=0.05))
        self.assertEqual((m["nodes"], m["boundary_nodes"]), (240, 0))
        self.assertIsNone(m["boundary_mean"])
        self.assertAlmostEqual(m["edge_one_percent"], 2)
        self.assertTrue(2 <= m["inside_mean"] < 2.05, m)

    def test_nodes_and_d_of_a_case(self):
        case = CASES["follow-airfoil"](5000)
        away = DistanceToBoundary(case.shape.source(), 0.003)(case.shape.grid)
        self.assertAlmostEqual(case.expected_nodes(away) / 5000, 1, 2)
        points = np.array([[1.1, 0], [0.5, 1.4], [-1, 0]])
        self.assertAlmostEqual(case.spacing(points)[0], case.constant + 0.1 * case.slope)
        self.assertEqual(case.spacing(points)[1], case.largest)
        even = case.even(5000)
        self.assertTrue(np.ptp(even.spacing(points)) == 0)
        self.assertAlmostEqual(even.expected_nodes(np.zeros(1)) / 5000, 1, 1)


class Sizes(unittest.TestCase):
    def test_curvature(self):
        case = ShapeCase("auto-disc", "", Shape(from_loops([circle(60, 2)])), 0.1, 0, 1, True)
        self.assertTrue(np.allclose(evaluate_shape.curvature(case), 0.5, rtol=0.01))
        either_way = dataclasses.replace(case, shape=turned_round(case.shape))
        self.assertTrue(np.allclose(evaluate_shape.curvature(either_way), 0.5, rtol=0.01))
        case = dataclasses.replace(case, shape=Shape(bodies.ball(0.1)))
        # Triangles of a sphere turn faster across some of their sides.
        self.assertTrue(0.95 < np.median(evaluate_shape.curvature(case)) < 1.3)
        wedge = Shape(from_loops([np.array([[0, 0], [1, -0.14], [1, 0.14]])]))
        for flat in (rectangle(2, 1), Shape(bodies.box()), wedge, turned_round(wedge)):
            case = dataclasses.replace(case, shape=flat)
            self.assertLess(evaluate_shape.curvature(case).max(), 1e-12)

    def test_gaps(self):
        case = ShapeCase("auto-strip", "", rectangle(4, 0.5, 0.1), 0.01, 0, 0.3, True)
        places, width = evaluate_shape.gaps(case)
        self.assertGreater(len(places), 60)
        self.assertLess(np.abs(width - 0.5).max(), 1e-4)
        self.assertLess(np.abs(places[:, 1] - 0.25).max(), 1e-4)
        wide = dataclasses.replace(case, largest=0.1)
        self.assertEqual(len(evaluate_shape.gaps(wide)[0]), 0)
        slab = bodies.prism("slab", [(0, 0), (4, 0), (4, 4), (0, 4)])
        places, width = evaluate_shape.gaps(dataclasses.replace(case, shape=Shape(slab), largest=0.5))
        self.assertGreater(len(places), 1)
        self.assertLess(np.abs(width - 1).max(), 1e-4)

    def test_per_turn_and_across(self):
        case = ShapeCase("auto-disc", "", Shape(from_loops([circle(40)])), 0.01, 0, 1, True)
        rings = [circle(max(1, 8 * k), k / 5) for k in range(6)]
        m = evaluate_shape.evaluate(np.concatenate(rings), case)
        self.assertEqual(m["boundary_nodes"], 40)
        self.assertTrue(25 < m["per_turn"][1] < 45, m)
        strip = ShapeCase("auto-strip", "", rectangle(4, 0.5, 0.1), 0.01, 0, 0.3, True)
        x, y = np.meshgrid(np.arange(0, 4.01, 0.1), np.arange(0, 0.51, 0.1))
        m = evaluate_shape.evaluate(np.column_stack([x.ravel(), y.ravel()]), strip)
        self.assertTrue(4 < m["across"][0] <= m["across"][1] <= 5, m)
        self.assertIsNone(m["per_turn"])

    def test_feature_size(self):
        """The feature size of a circle is its radius, that of a strip half its width except near
        corners."""
        found = with_jigsaw_shape.feature_size(circle(200, 3) + 1e-9 * np.sin(np.arange(200))[:, None])
        self.assertTrue(np.allclose(found, 3, rtol=0.01))
        x = np.arange(0, 4, 0.02)
        strip = np.vstack([np.column_stack([x, 0 * x]), np.column_stack([x + 0.007, 0 * x + 0.5])])
        found = with_jigsaw_shape.feature_size(strip)[80:120]
        self.assertTrue(np.allclose(found, 0.25, rtol=0.02), found)


class Told(unittest.TestCase):
    """Tests of the input of the tools, which need not be installed."""

    def test_words(self):
        case = CASES["follow-airfoil"](5000)
        self.assertIn(f"+ 0.15*dist({with_pnpbs_shape.TAG}))", with_pnpbs_shape.spacing(case)[1])
        markers = with_pnpbs_shape.markers(case.shape)
        self.assertEqual(markers[:4] + [markers.count(with_pnpbs_shape.TAG)], [1, 1, 1, 1, 120])
        words = with_gmsh_shape.geometry(case, 1)
        self.assertIn("Field[1].CurvesList = {5:124};", words)
        self.assertIn(f"Field[2].SizeMax = {case.largest!r};", words)
        words = with_gmsh_shape.geometry(CASES["auto-airfoil"](5000), 1)
        self.assertNotIn("Line(5)", words)
        self.assertIn("Spline(5) = {5, ", words)
        self.assertIn("Mesh.MeshSizeFromCurvature = 20;", words)

    def test_grid_of_sizes(self):
        case = CASES["follow-airfoil"](2000)
        axes, values = with_jigsaw_shape.sizes_at_boundary(case)
        self.assertEqual(len(values), len(axes[0]) * len(axes[1]))
        self.assertTrue(case.constant <= values.min() < 1.2 * case.constant)
        self.assertGreater((values == case.largest).mean(), 0.9)


if __name__ == "__main__":
    unittest.main()
