# SPDX-License-Identifier: BSD-3-Clause
"""The cases: a domain, the region inside straight segments by the even-odd rule, and a spacing
d = constant + slope * distance from a point or from a horizontal line."""
import dataclasses
import math
from pathlib import Path

import numpy as np

DATA = Path(__file__).resolve().parents[3] / "examples" / "data"


@dataclasses.dataclass
class Domain:
    vertices: np.ndarray  # (count, 2)
    segments: np.ndarray  # (count, 2), indices of vertices
    holes: np.ndarray     # (count, 2), a point in each hole

    def ends(self):
        """First and second ends of the segments."""
        return self.vertices[self.segments[:, 0]], self.vertices[self.segments[:, 1]]

    def area(self):
        """Of simple closed curves, one within another, by the even-odd rule."""
        areas = [abs(loop_area(self.vertices[loop])) for loop in self.loops()]
        return 2 * max(areas) - sum(areas)

    def perimeter(self):
        a, b = self.ends()
        return np.hypot(*(b - a).T).sum()

    def loops(self):
        """The closed curves: arrays of vertex numbers, the one that encloses the others first."""
        after = {}
        for a, b in self.segments.tolist():
            after.setdefault(a, []).append(b)
            after.setdefault(b, []).append(a)
        left, found = set(after), []
        while left:
            start = last = min(left)
            loop, at = [start], after[start][0]
            while at != start:
                loop.append(at)
                one, other = after[at]
                last, at = at, other if one == last else one
            left.difference_update(loop)
            found.append(np.array(loop))
        return sorted(found, key=lambda loop: -abs(loop_area(self.vertices[loop])))

    def contains(self, points):
        """Even-odd rule for many points at once: each segment turns the points to its left in
        the strip of heights that it spans. Sorted by height, a strip is a slice."""
        order = np.argsort(points[:, 1], kind="stable")
        x, y = points[order].T
        inside = np.zeros(len(points), bool)
        for (ax, ay), (bx, by) in zip(*self.ends()):
            first, last = np.searchsorted(y, (min(ay, by), max(ay, by)))
            if first < last:
                strip = slice(first, last)
                inside[strip] ^= x[strip] < ax + (bx - ax) * ((y[strip] - ay) / (by - ay))
        result = np.empty(len(points), bool)
        result[order] = inside
        return result

    def write_poly(self, path):
        lines = [f"{len(self.vertices)} 2 0 0"]
        lines += [f"{i} {x!r} {y!r}" for i, (x, y) in enumerate(self.vertices.tolist(), 1)]
        lines.append(f"{len(self.segments)} 0")
        lines += [f"{i} {a + 1} {b + 1}" for i, (a, b) in enumerate(self.segments.tolist(), 1)]
        lines.append(f"{len(self.holes)}")
        lines += [f"{i} {x!r} {y!r}" for i, (x, y) in enumerate(self.holes.tolist(), 1)]
        Path(path).write_text("\n".join(lines) + "\n")


def loop_area(xy):
    x, y = xy.T
    return 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))


def read_poly(path):
    """Triangle's .poly, numbered from 0 or 1."""
    rows = iter([line.split("#")[0].split() for line in Path(path).read_text().splitlines()
                 if line.split("#")[0].strip()])
    vertices = [next(rows) for _ in range(int(next(rows)[0]))]
    first = int(vertices[0][0])
    segments = [next(rows) for _ in range(int(next(rows)[0]))]
    holes = [next(rows) for _ in range(int(next(rows)[0]))]
    return Domain(np.array([[float(v) for v in row[1:3]] for row in vertices]),
                  np.array([[int(v) - first for v in row[1:3]] for row in segments]),
                  np.array([[float(v) for v in row[1:3]] for row in holes]).reshape(-1, 2))


def from_loops(loops, holes=()):
    """A domain of closed curves, each an array of its corners."""
    segments, count = [], 0
    for loop in loops:
        numbers = np.arange(len(loop))
        segments.append(count + np.column_stack([numbers, np.roll(numbers, -1)]))
        count += len(loop)
    return Domain(np.concatenate(loops), np.concatenate(segments),
                  np.array(holes, float).reshape(-1, 2))


def square():
    return from_loops([np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)])


def annulus(d):
    """Radii 0.4 and 1; regular polygons with sides of about d, so that no tool is made to follow
    corners finer than its nodes."""
    loops = []
    for radius in (1, 0.4):
        count = max(3, round(2 * math.pi * radius / d))
        angle = 2 * math.pi * np.arange(count) / count
        loops.append(radius * np.column_stack([np.cos(angle), np.sin(angle)]))
    return from_loops(loops, [(0, 0)])


@dataclasses.dataclass
class Case:
    name: str
    title: str
    domain: Domain
    constant: float
    slope: float
    x0: float = 0
    y0: float = 0
    x_counts: int = 1  # in the distance; 0: it is that from the line y = y0

    def spacing(self, points):
        return self.constant + self.slope * np.hypot(self.x_counts * (points[:, 0] - self.x0),
                                                     points[:, 1] - self.y0)

    def formula(self, root="sqrt", power="^2"):
        """The spacing as text, for tools that read formulas."""
        if self.slope == 0:
            return repr(self.constant)
        across = f"(x-({self.x0!r})){power} + " if self.x_counts else ""
        return f"{self.constant!r} + {self.slope!r}*{root}({across}(y-({self.y0!r})){power})"

    def scaled(self, factor):
        return dataclasses.replace(self, constant=float(factor * self.constant),
                                   slope=float(factor * self.slope))

    def expected_nodes(self):
        """As many as hexagonal lattices of this spacing have: 2 / (sqrt(3) d^2) per area, and on
        the boundary half a node more per d."""
        inner, boundary = self.integrals()
        return inner + boundary

    def integrals(self):
        domain = self.domain
        # Where d varies with y alone, and steeply, nearly all samples are spent on that.
        per_side, parts = ((1000, 1000), 100) if self.x_counts else ((10, 100000), 20000)
        low, high = domain.vertices.min(0), domain.vertices.max(0)
        x, y = [a + (b - a) * (np.arange(n) + 0.5) / n for a, b, n in zip(low, high, per_side)]
        grid = np.column_stack([axis.ravel() for axis in np.meshgrid(x, y)])
        grid = grid[domain.contains(grid)]
        inner = domain.area() * np.mean(2 / math.sqrt(3) / self.spacing(grid) ** 2)
        a, b = domain.ends()
        lengths, boundary = np.hypot(*(b - a).T), 0
        for part in range(parts):
            there = a + (b - a) * (part + 0.5) / parts
            boundary += 0.5 * (lengths / parts / self.spacing(there)).sum()
        return inner, boundary

    def with_nodes(self, nodes):
        """The same with every spacing scaled, so that about so many nodes fit."""
        inner, boundary = self.integrals()
        return self.scaled((boundary + math.sqrt(boundary ** 2 + 4 * nodes * inner)) / (2 * nodes))


# Spacings in proportion as in ../bench.cpp; with_nodes() gives them their size. The square's grows
# from 1 in the middle to 10 in the corners, d = h0 (1 + 9 r / 0.7071).
def make_uniform_square(nodes):
    return Case("uniform-square", "unit square, uniform", square(), 1, 0).with_nodes(nodes)


def make_graded_square(nodes):
    case = Case("graded-square", "unit square, d graded 1:10", square(), 1, 9 / 0.7071, 0.5, 0.5)
    return case.with_nodes(nodes)


def make_graded_line(nodes):
    """Grows by a fifth of the distance whatever the number of nodes, which goes with 1 / least d:
    only that is scaled."""
    case = Case("graded-line", "unit square, d growing by 0.2 from a line", square(), 12 / nodes,
                0.2, 0.5, 0.5, 0)
    for _ in range(12):
        case.constant *= float(case.expected_nodes() / nodes)
    return case


def make_annulus(nodes):
    case = Case("uniform-annulus", "annulus, uniform", annulus(0.01), 1, 0).with_nodes(nodes)
    return dataclasses.replace(case, domain=annulus(case.constant))


def make_lakes(nodes):
    domain = read_poly(DATA / "great_lakes_islands.poly")
    case = Case("graded-lakes", "Great Lakes with 109 islands, graded", domain, 0.3, 0.006)
    return case.with_nodes(nodes)


CASES = {"uniform-square": make_uniform_square, "graded-square": make_graded_square,
         "graded-line": make_graded_line,
         "uniform-annulus": make_annulus, "graded-lakes": make_lakes}
