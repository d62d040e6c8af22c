#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the elements of the comparison: Order p finds a polynomial of degree p exactly, and the
problems' sources belong to their solutions."""
import itertools
import unittest

import numpy as np
from scipy.spatial import Delaunay

from elements import Mesh, Solved, Space
from problems import Peak, Wave


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
        for dim, problem in itertools.product((2, 3), (Wave(), Peak())):
            x, step = np.random.default_rng(1).random((20, dim)), 1e-4
            ways = step * np.eye(dim)
            u = problem.solution
            gradient = np.stack([(u(x + w) - u(x - w)) / (2 * step) for w in ways], axis=1)
            laplace = sum((u(x + w) - 2 * u(x) + u(x - w)) / step**2 for w in ways)
            np.testing.assert_allclose(problem.gradient(x), gradient, rtol=1e-3, atol=1e-5)
            np.testing.assert_allclose(problem.source(x), -laplace, rtol=1e-3, atol=1e-4)


if __name__ == "__main__":
    unittest.main()
