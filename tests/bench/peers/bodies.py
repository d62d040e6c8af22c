# SPDX-License-Identifier: BSD-3-Clause
"""Bodies as closed surfaces of triangles. Some have further properties."""
import dataclasses
import math
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

DATA = Path(__file__).resolve().parents[3] / "examples" / "data"


@dataclasses.dataclass
class Body:
    """A body. The corners of its polygons are counter-clockwise seen from outside."""
    kind: str             # box, l-block, ball, file
    vertices: np.ndarray  # (count, 3)
    polygons: list        # plane ones, as the numbers of their corners
    path: Path = None     # if the body comes from a file

    def triangles(self):
        """Returns triangles (count, 3), the fans of the polygons. A polygon with a reentrant corner
        must begin there."""
        return np.array([[p[0], b, c] for p in self.polygons for b, c in zip(p[1:], p[2:])])

    def bounds(self):
        return self.vertices.min(0), self.vertices.max(0)

    def volume(self):
        if self.kind == "ball":
            return 4 * math.pi / 3
        a, b, c = self.vertices[self.triangles()].transpose(1, 0, 2)
        return float((a * np.cross(b, c)).sum() / 6)

    def contains(self, points):
        """Returns whether points are inside, by the number of triangles above each point."""
        if self.kind == "ball":
            return (points ** 2).sum(1) <= 1
        order = np.argsort(points[:, 0], kind="stable")
        sorted_points = points[order]
        above = np.zeros(len(points), bool)
        for corners in self.vertices[self.triangles()]:
            first, last = np.searchsorted(sorted_points[:, 0],
                                          (corners[:, 0].min(), corners[:, 0].max()))
            if first < last:
                above[first:last] ^= below_triangle(sorted_points[first:last], corners)
        inside = np.empty(len(points), bool)
        inside[order] = above
        return inside

    def cavities(self):
        """Returns a point in each cavity: just beyond the largest triangle of a surface that
        encloses the outside."""
        triangles = self.triangles()
        a, b, c = self.vertices[triangles].transpose(1, 0, 2)
        links = coo_matrix((np.ones(len(triangles)), triangles.T[:2]), shape=(len(self.vertices),) * 2)
        piece = connected_components(links, directed=False)[1][triangles[:, 0]]
        normals = np.cross(b - a, c - a)
        area = np.linalg.norm(normals, axis=1)
        points = []
        for k in np.flatnonzero(np.bincount(piece, (a * np.cross(b, c)).sum(1)) < 0):
            largest = np.where(piece == k, area, 0).argmax()
            step = 1e-3 * normals[largest] / math.sqrt(area[largest])
            points.append(((a + b + c)[largest] / 3 + step).tolist())
        return points

    def write_off(self, path):
        triangles = self.triangles().tolist()
        lines = ["OFF", f"{len(self.vertices)} {len(triangles)} 0"]
        lines += [" ".join(map(repr, vertex)) for vertex in self.vertices.tolist()]
        lines += [f"3 {a} {b} {c}" for a, b, c in triangles]
        Path(path).write_text("\n".join(lines) + "\n")

    def write_stl(self, path):
        corners = self.vertices[self.triangles()]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        lines = ["solid body"]
        for (nx, ny, nz), triangle in zip(normals.tolist(), corners.tolist()):
            lines += [f"facet normal {nx!r} {ny!r} {nz!r}", "outer loop"]
            lines += [f"vertex {x!r} {y!r} {z!r}" for x, y, z in triangle]
            lines += ["endloop", "endfacet"]
        Path(path).write_text("\n".join([*lines, "endsolid body"]) + "\n")


def below_triangle(points, corners):
    """Returns which points lie below a triangle. The ends of a side are taken in one order, so that
    both of its triangles compute the same sign for a point beside it."""
    x, y = points[:, 0], points[:, 1]
    within = np.zeros(len(points), bool)
    for a, b in zip(corners, np.roll(corners, -1, 0)):
        if tuple(a) > tuple(b):
            a, b = b, a
        between = (a[0] <= x) & (x < b[0])
        within[between] ^= ((b[0] - a[0]) * (y[between] - a[1])
                            > (b[1] - a[1]) * (x[between] - a[0]))
    nx, ny, nz = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    if nz == 0:
        return np.zeros(len(points), bool)
    height = corners[0, 2] - (nx * (x - corners[0, 0]) + ny * (y - corners[0, 1])) / nz
    return within & (points[:, 2] < height)


def prism(kind, outline):
    """Returns a prism of height 1 above a plane, counter-clockwise outline."""
    n = len(outline)
    vertices = [[x, y, z] for z in (0, 1) for x, y in outline]
    sides = [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)]
    top = list(range(n, 2 * n))
    return Body(kind, np.array(vertices, float), [*sides, top, [0, *range(n - 1, 0, -1)]])


def box():
    return prism("box", [(0, 0), (1, 0), (1, 1), (0, 1)])


def l_block():
    """Returns the unit cube without a quarter. Its outline begins at the reentrant corner."""
    return prism("l-block", [(0.5, 0.5), (0.5, 1), (0, 1), (0, 0), (1, 0), (1, 0.5)])


def ball(d):
    """Returns the unit ball, with a surface of triangles for tools that need one. The surface is an
    octahedron projected onto the sphere, whose sides are divided so that edges are about d long."""
    rows = max(1, round(0.6 * math.pi / d))
    numbers, vertices, triangles = {}, [], []

    def corner(signs, i, j):
        place = tuple(s * k for s, k in zip(signs, (i, j, rows - i - j)))
        if place not in numbers:
            numbers[place] = len(vertices)
            vertices.append(place)
        return numbers[place]

    for signs in [(a, b, c) for a in (1, -1) for b in (1, -1) for c in (1, -1)]:
        turn = math.prod(signs)
        for i in range(rows):
            for j in range(rows - i):
                found = [(corner(signs, i, j), corner(signs, i + 1, j), corner(signs, i, j + 1))]
                if i + j + 1 < rows:
                    found.append((corner(signs, i + 1, j + 1), corner(signs, i, j + 1),
                                  corner(signs, i + 1, j)))
                triangles += [list(t[::turn]) for t in found]
    # Equal angles instead of equal steps give more similar triangles.
    places = np.sin(0.5 * math.pi * np.array(vertices, float) / rows)
    return Body("ball", places / np.linalg.norm(places, axis=1)[:, None], triangles)


def read_off(path):
    words = [line.split() for line in Path(path).read_text().splitlines()
             if line.strip() and not line.startswith(("#", "OFF"))]
    count, faces = int(words[0][0]), int(words[0][1])
    vertices = np.array([[float(v) for v in row[:3]] for row in words[1:count + 1]])
    polygons = [[int(v) for v in row[1:4]] for row in words[count + 1:count + 1 + faces]]
    return Body("file", vertices, polygons, Path(path))


def read_obj(path):
    words = [line.split() for line in Path(path).read_text().splitlines()]
    vertices = np.array([[float(v) for v in row[1:4]] for row in words if row[:1] == ["v"]])
    polygons = [[int(v.split("/")[0]) - 1 for v in row[1:4]] for row in words if row[:1] == ["f"]]
    return Body("file", vertices, polygons, Path(path))


def read_stl(path):
    """Reads a binary STL file. Coincident corners become one vertex."""
    triangle = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    corners = np.frombuffer(Path(path).read_bytes(), triangle, offset=84)["corners"].astype(float)
    vertices, numbers = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    return Body("file", vertices, numbers.reshape(-1, 3).tolist(), Path(path))
