# SPDX-License-Identifier: BSD-3-Clause
"""Points on the unit sphere for comparison: icosahedral ones, and their Lloyd iterations."""
import numpy as np

from cgrid import circumcentres, dot, hull, signed_area, unit


def icosahedron():
    """Returns an icosahedron with two of its 12 corners at the poles."""
    z = 1 / np.sqrt(5)
    ring = np.arange(5) * 2 * np.pi / 5
    points = [[0, 0, 1]]
    for turn, height in ((0, z), (np.pi / 5, -z)):
        points += [[2 * z * np.cos(a + turn), 2 * z * np.sin(a + turn), height] for a in ring]
    return np.array(points + [[0, 0, -1]])


def bisected(levels):
    """Returns 10 4^levels + 2 points by repeated bisection of all sides."""
    points = icosahedron()
    triangles = hull(points)
    for _ in range(levels):
        begin, end = triangles.ravel(), np.roll(triangles, -1, 1).ravel()
        sides, which = np.unique(np.sort(np.column_stack([begin, end]), 1), axis=0, return_inverse=True)
        a, b, c = triangles.T
        ab, bc, ca = (len(points) + which.reshape(-1, 3)).T
        points = np.concatenate([points, unit(points[sides].sum(1))])
        triangles = np.concatenate([np.column_stack(t) for t in (
            (a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
    return points


class Cells:
    """The Voronoi cells of points, with which centroids are computed."""

    def __init__(self, points):
        self.triangles = hull(points)
        begin, end = self.triangles.ravel(), np.roll(self.triangles, -1, 1).ravel()
        order = np.lexsort((begin < end, np.maximum(begin, end), np.minimum(begin, end)))
        right, left = order.reshape(-1, 2).T  # sides of the triangles on both sides of an edge
        self.cells = np.column_stack([begin[left], end[left]])
        self.beside = np.column_stack([right // 3, left // 3])
        # The opposite corner of the right triangle.
        self.facing = self.triangles[right // 3, (right + 2) % 3]

    def is_delaunay(self, points):
        a, b, c = points[self.triangles].swapaxes(0, 1)
        normal = np.cross(b - a, c - a)
        left = self.beside[:, 1]
        height = dot(normal[left], points[self.facing] - a[left])
        return np.all(dot(a, normal) > 0) and np.all(height < 1e-14)

    def centroids(self, points, density):
        """Returns the centroids of the cells. The integrals use the triangles between a cell's
        point and its edges, each with the density at its centre."""
        vertices = circumcentres(*points[self.triangles].swapaxes(0, 1))
        v, w = vertices[self.beside].swapaxes(0, 1)
        sums = np.zeros((len(points), 3))
        for cells, first, second in ((self.cells[:, 0], v, w), (self.cells[:, 1], w, v)):
            x = points[cells]
            middle = unit(x + first + second)
            part = (signed_area(x, first, second) * density(middle))[:, None] * middle
            for k in range(3):
                sums[:, k] += np.bincount(cells, part[:, k], len(points))
        return unit(sums)


def constant(x):
    return np.ones(len(x))


def centroidal(points, rounds, density=constant):
    """Runs Lloyd's iteration."""
    cells = Cells(points)
    for _ in range(rounds):
        points = cells.centroids(points, density)
        if not cells.is_delaunay(points):
            cells = Cells(points)
    return points
