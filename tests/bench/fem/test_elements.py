#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the elements of the comparison: Order p finds a polynomial of degree p exactly, the
problems' sources belong to their solutions, and known power laws give the known ratio of meshing
times at an equal error."""
import itertools
import unittest

import numpy as np
from scipy.spatial import Delaunay

import study
from body_cases import BODIES
from elements import Mesh, Solved, Space
from equal_error import Comparison, Curve
from problems import CASES, Peak, Wave


def scattered(dim, inner=40):
    points = [*itertools.product((0.0, 0.5, 1.0), repeat=dim)]
    points = np.vstack([points, 0.1 + 0.8 * np.random.default_rng(7).random((inner, dim))])
    return Mesh(points, Delaunay(points).simplices)


class Polynomial:
    """A polynomial: x + 2 y (+ z) of degree 1, or x^2 + x y (+ z^2) of degree 2."""

    def __init__(self, degree):
        self.degree = degree

    def solution(self, x):
        if self.degree == 1:
            return x @ np.arange(1, x.shape[1] + 1)
        return x[:, 0]**2 + x[:, 0] * x[:, 1] + (x[:, 2:]**2).sum(1)

    def gradient(self, x):
        if self.degree == 1:
            return np.tile(np.arange(1.0, x.shape[1] + 1), (len(x), 1))
        found = np.zeros_like(x)
        found[:, 0] = 2 * x[:, 0] + x[:, 1]
        found[:, 1] = x[:, 0]
        found[:, 2:] = 2 * x[:, 2:]
        return found

    def source(self, x):
        return np.full(len(x), 0.0 if self.degree == 1 else -2.0 * (x.shape[1] - 1))


class Elements(unittest.TestCase):
    def test_polynomials_are_found(self):
        for dim, order in itertools.product((2, 3), (1, 2)):
            solved = Solved(scattered(dim), order, Polynomial(order))
            self.assertLess(solved.error, 1e-7, (dim, order))

    def test_others_are_not(self):
        for dim in (2, 3):
            self.assertGreater(Solved(scattered(dim), 1, Polynomial(2)).error, 0.01)

    def test_degrees_of_freedom(self):
        mesh = scattered(2)
        space = Space(mesh, 2)
        # Euler's formula gives vertices + edges = 2 vertices + triangles - 1.
        self.assertEqual(len(space.points), 2 * len(mesh) + len(mesh.elements) - 1)
        self.assertEqual(space.fixed.sum(), 16)

    def test_problems(self):
        for dim, problem in itertools.product((2, 3), (Wave(), Peak(), Peak(0.2, 0.5))):
            x, step = np.random.default_rng(1).random((20, dim)), 1e-4
            ways = step * np.eye(dim)
            u = problem.solution
            gradient = np.stack([(u(x + w) - u(x - w)) / (2 * step) for w in ways], axis=1)
            laplace = sum((u(x + w) - 2 * u(x) + u(x - w)) / step**2 for w in ways)
            np.testing.assert_allclose(problem.gradient(x), gradient, rtol=1e-3, atol=1e-5)
            np.testing.assert_allclose(problem.source(x), -laplace, rtol=1e-3, atol=1e-4)


def rows_by_law(nodes, error, seconds, **more):
    """Returns results with the error a n^-p and the seconds b n^q for pairs (a, p) and (b, q)."""
    return [{"nodes": n, "error": error[0] * n**-error[1], "meshing": seconds[0] * n**seconds[1],
             "order": 1, **more} for n in nodes]


class EqualError(unittest.TestCase):
    # The errors of the first are from 0.1 to 0.05, those of the second from 0.15 to 0.06.
    OURS = rows_by_law((1000, 3000, 8000), (1, 1 / 3), (2e-5, 1.2))
    PEER = rows_by_law((1000, 5000, 15625), (1.5, 1 / 3), (1e-5, 1.1))

    def test_power_laws_give_their_ratio(self):
        found = Comparison(self.OURS, self.PEER)
        np.testing.assert_allclose([found.coarse, found.middle, found.fine],
                                   [0.1, np.sqrt(0.1 * 0.06), 0.06])
        for error in (found.coarse, found.middle, 0.08, found.fine):
            ours, peer = error**-3, (error / 1.5)**-3
            self.assertAlmostEqual(found.ratio(error) / (1e-5 * peer**1.1 / (2e-5 * ours**1.2)), 1)
            np.testing.assert_allclose([nodes(error) for nodes in found.nodes], [ours, peer])

    def test_the_order_of_results_does_not_matter(self):
        turned = Comparison(self.OURS[::-1], self.PEER[1:] + self.PEER[:1])
        self.assertEqual(turned.ratio(0.07), Comparison(self.OURS, self.PEER).ratio(0.07))

    def test_nothing_is_extrapolated(self):
        curve = Curve([0.1, 0.05], [1, 2])
        for error in (0.11, 0.04):
            with self.assertRaises(ValueError):
                curve(error)
        with self.assertRaises(ValueError):
            Comparison(self.OURS, rows_by_law((10, 20), (1, 1 / 3), (1, 1)))


class Page(unittest.TestCase):
    def test_sections_without_results_are_kept(self):
        before = study.sections_of("text\n## " + CASES[0].title + "\n\nfigures\n\n## Other\n")
        self.assertEqual(study.case_section([], CASES[0], before), "\nfigures\n\n")

    def test_table_of_bodies(self):
        body = BODIES[0]
        rows = [{**row, "case": body.name, "mesher": mesher} for mesher, some in
                (("PNPBS", EqualError.OURS), ("gmsh, HXT", EqualError.PEER)) for row in some]
        section = study.bodies_section(rows, {})
        ours = 0.006**-1.5
        ratio = 1e-5 * (3.375 * ours)**1.1 / (2e-5 * ours**1.2)
        self.assertIn(f"| {body.title} | 0.100 to 0.0600 | 0.0775 | 2 152 | 7 262 |", section)
        self.assertIn(f"| **{ratio:.2f}** |", section)


if __name__ == "__main__":
    unittest.main()
