# SPDX-License-Identifier: BSD-3-Clause
"""The cases: a domain and a spacing d = constant + slope * distance from a point, a horizontal line
or a loop."""
import dataclasses
import math
from pathlib import Path

import numpy as np
from airfoil import airfoil
from distance_to_loop import distance_to_loop
from domain import Domain, from_loops, read_poly

DATA = Path(__file__).resolve().parents[3] / "examples" / "data"


def square():
    return from_loops([np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)])


def annulus(d):
    """Returns a ring with radii 0.4 and 1. Regular polygons with sides of about d ensure that no
    tool has to follow corners finer than its nodes."""
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
    x_counts: int = 1  # 0 if the distance is that from the line y = y0
    has_formula = True

    def spacing(self, points):
        return self.constant + self.slope * np.hypot(self.x_counts * (points[:, 0] - self.x0),
                                                     points[:, 1] - self.y0)

    def formula(self, root="sqrt", power="^2"):
        """Returns the spacing as text for tools that read formulas."""
        if self.slope == 0:
            return repr(self.constant)
        across = f"(x-({self.x0!r})){power} + " if self.x_counts else ""
        return f"{self.constant!r} + {self.slope!r}*{root}({across}(y-({self.y0!r})){power})"

    def scaled(self, factor):
        return dataclasses.replace(self, constant=float(factor * self.constant),
                                   slope=float(factor * self.slope))

    def expected_nodes(self):
        """Returns the number of nodes of hexagonal lattices with this spacing: 2 / (sqrt(3) d^2)
        per area, and half a node more per d on the boundary."""
        return self.inner_nodes() + self.boundary_nodes()

    def inner_nodes(self):
        # If d varies with y alone, and steeply, nearly all samples are used in this direction.
        per_side = (1000, 1000) if self.x_counts else (10, 100000)
        low, high = self.domain.vertices.min(0), self.domain.vertices.max(0)
        x, y = [a + (b - a) * (np.arange(n) + 0.5) / n for a, b, n in zip(low, high, per_side)]
        grid = np.column_stack([axis.ravel() for axis in np.meshgrid(x, y)])
        grid = grid[self.domain.contains(grid)]
        return self.domain.area() * np.mean(2 / math.sqrt(3) / self.spacing(grid) ** 2)

    def boundary_nodes(self):
        parts = 100 if self.x_counts else 20000
        a, b = self.domain.ends()
        lengths, nodes = np.hypot(*(b - a).T), 0
        for part in range(parts):
            there = a + (b - a) * (part + 0.5) / parts
            nodes += 0.5 * (lengths / parts / self.spacing(there)).sum()
        return nodes

    def with_nodes(self, nodes):
        """Returns the case with all spacings scaled for about this number of nodes."""
        inner, boundary = self.inner_nodes(), self.boundary_nodes()
        return self.scaled((boundary + math.sqrt(boundary ** 2 + 4 * nodes * inner)) / (2 * nodes))

    def with_nodes_by_constant(self, nodes):
        """Returns the case with another constant for about this number of nodes. The growth of d
        stays the same, so that the number of nodes is proportional to 1 / constant."""
        case = self
        for _ in range(12):
            constant = float(case.constant * case.expected_nodes() / nodes)
            case = dataclasses.replace(case, constant=constant)
        return case


@dataclasses.dataclass
class CaseAroundLoop(Case):
    """A spacing d = constant + slope * distance from a convex loop, up to a largest d, which is
    reached before the outline. The loop begins with its sharpest corner."""
    loop: np.ndarray = None
    largest: float = math.inf
    has_formula = False

    def spacing(self, points):
        d = self.constant + self.slope * distance_to_loop(points, self.loop)
        return np.minimum(d, self.largest)

    def continued_spacing(self, points):
        """Returns d for tables. d continues to fall inside the loop, so that an interpolation
        outside near the loop sees no kink."""
        beside = self.slope * distance_to_loop(points, self.loop)
        inside = from_loops([self.loop]).contains(points)
        d = self.constant + np.where(inside, -beside, beside)
        return np.clip(d, 0.2 * self.constant, self.largest)

    def loop_length(self):
        return np.hypot(*(self.loop - np.roll(self.loop, 1, 0)).T).sum()

    def inner_nodes(self):
        """Returns the number of inner nodes. The area within s of a convex loop of length P is P s
        + pi s^2."""
        least, length = min(self.constant, self.largest), self.loop_length()
        way = (self.largest - least) / self.slope
        # This is the integral of (P + 2 pi s) / d^2 over s = (d - least) / slope.
        near = ((length * self.slope - 2 * math.pi * least) * (1 / least - 1 / self.largest)
                + 2 * math.pi * math.log(self.largest / least)) / self.slope ** 2
        far = self.domain.area() - length * way - math.pi * way ** 2
        return 2 / math.sqrt(3) * (near + far / self.largest ** 2)

    def boundary_nodes(self):
        length = self.loop_length()
        return 0.5 * (length / min(self.constant, self.largest)
                      + (self.domain.perimeter() - length) / self.largest)


# The spacings are proportional to those in ../bench.cpp, and with_nodes() scales them. The square's
# grows from 1 in the middle to 10 in the corners: d = h0 (1 + 9 r / 0.7071).
def make_uniform_square(nodes):
    return Case("uniform-square", "unit square, uniform", square(), 1, 0).with_nodes(nodes)


def make_graded_square(nodes):
    case = Case("graded-square", "unit square, d graded 1:10", square(), 1, 9 / 0.7071, 0.5, 0.5)
    return case.with_nodes(nodes)


def make_graded_line(nodes):
    case = Case("graded-line", "unit square, d growing by 0.2 from a line", square(), 12 / nodes,
                0.2, 0.5, 0.5, 0)
    return case.with_nodes_by_constant(nodes)


def make_graded_airfoil(nodes):
    loop = airfoil(200)
    box = np.array([[-1, -1.5], [2, -1.5], [2, 1.5], [-1, 1.5]])
    case = CaseAroundLoop("graded-airfoil", "box, d growing by 0.15 from an airfoil",
                          from_loops([box, loop], [(0.5, 0.02)]), 16 / nodes, 0.15, loop=loop,
                          largest=0.15)
    return case.with_nodes_by_constant(nodes)


def make_annulus(nodes):
    case = Case("uniform-annulus", "annulus, uniform", annulus(0.01), 1, 0).with_nodes(nodes)
    return dataclasses.replace(case, domain=annulus(case.constant))


def make_lakes(nodes):
    domain = read_poly(DATA / "great_lakes_islands.poly")
    case = Case("graded-lakes", "Great Lakes with 109 islands, graded", domain, 0.3, 0.006)
    return case.with_nodes(nodes)


CASES = {"uniform-square": make_uniform_square, "graded-square": make_graded_square,
         "graded-line": make_graded_line, "graded-airfoil": make_graded_airfoil,
         "uniform-annulus": make_annulus, "graded-lakes": make_lakes}
