# SPDX-License-Identifier: BSD-3-Clause
"""The problems of the comparison: solutions, domains and spacings."""
import numpy as np


class Wave:
    """The solution sin(3 x + y) exp(y), in space times exp(z / 2), which is equally smooth
    everywhere."""

    def solution(self, x):
        u = np.sin(3 * x[:, 0] + x[:, 1]) * np.exp(x[:, 1])
        return u * np.exp(x[:, 2] / 2) if x.shape[1] == 3 else u

    def gradient(self, x):
        u = self.solution(x)
        cosine = np.cos(3 * x[:, 0] + x[:, 1]) * np.exp(x[:, 1])
        if x.shape[1] == 3:
            cosine = cosine * np.exp(x[:, 2] / 2)
        parts = [3 * cosine, cosine + u] + ([u / 2] if x.shape[1] == 3 else [])
        return np.stack(parts, axis=1)

    def source(self, x):
        u = self.solution(x)
        by_y = self.gradient(x)[:, 1]
        # u_xx = -9 u, u_yy = -2 u + 2 u_y, u_zz = u / 4
        return 9 * u + 2 * u - 2 * by_y - (u / 4 if x.shape[1] == 3 else 0)


class Peak:
    """The solution log(r^2 + e^2) / 2, where r is the distance from a centre, the origin by
    default. It is steep at the centre, so that spacings that grow with r suit it."""
    E2 = 0.05**2

    def __init__(self, e2=E2, centre=0.0):
        self.e2, self.centre = e2, np.asarray(centre)

    def square(self, x):
        return ((x - self.centre)**2).sum(1)

    def solution(self, x):
        return np.log(self.square(x) + self.e2) / 2

    def gradient(self, x):
        return (x - self.centre) / (self.square(x) + self.e2)[:, None]

    def source(self, x):
        square = self.square(x)
        if x.shape[1] == 2:
            return -2 * self.e2 / (square + self.e2)**2
        return -(square + 3 * self.e2) / (square + self.e2)**2


class Case:
    def __init__(self, name, title, shape, problem, graded, sizes, finer=()):
        self.name, self.title, self.shape, self.problem = name, title, shape, problem
        # `finer` has factors for meshers that use d as an upper bound, so that they reach the same
        # number of nodes.
        self.graded, self.sizes, self.finer = graded, sizes, list(finer)
        self.dim = 2 if shape == "square" else 3

    def spacing(self, h):
        """Returns the spacing as a function of points, for PNPBS."""
        if not self.graded:
            return h
        return lambda x: h * np.sqrt((x**2).sum(1) + Peak.E2)

    def formula(self, h):
        """Returns the spacing as a formula for gmsh."""
        return f"{h!r} * Sqrt(x*x + y*y + z*z + {Peak.E2!r})" if self.graded else f"{h!r}"


CASES = [
    Case("square", "Unit square, uniform", "square", Wave(), False, [0.06, 0.03, 0.015, 0.0075]),
    Case("square_graded", "Unit square, graded 1:28", "square", Peak(), True,
         [0.2, 0.1, 0.05, 0.025]),
    Case("ball", "Ball, uniform", "ball", Wave(), False, [0.24, 0.16, 0.11, 0.08], [0.065]),
    Case("cube_graded", "Unit cube, graded 1:35", "cube", Peak(), True, [0.42, 0.29, 0.2, 0.14, 0.1], [0.08]),
]
