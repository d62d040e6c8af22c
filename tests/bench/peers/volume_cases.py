# SPDX-License-Identifier: BSD-3-Clause
"""Cases in space: a body and a spacing d = constant + slope * distance from a point."""
import dataclasses
import math

import bodies
import numpy as np

# The nodes per volume d^3 of a body-centred cubic lattice whose mean edge is d.
NODES_PER_CUBE = 1.575


@dataclasses.dataclass
class VolumeCase:
    name: str
    title: str
    body: bodies.Body
    constant: float
    slope: float = 0
    centre: tuple = (0, 0, 0)

    def spacing(self, points):
        return self.constant + self.slope * np.linalg.norm(points - np.array(self.centre), axis=1)

    def formula(self, root="sqrt", power="^2"):
        """Returns the spacing as text for tools that read formulas."""
        if self.slope == 0:
            return repr(self.constant)
        squares = " + ".join(f"({axis}-({c!r})){power}" for axis, c in zip("xyz", self.centre))
        return f"{self.constant!r} + {self.slope!r}*{root}({squares})"

    def scaled(self, factor):
        return dataclasses.replace(self, constant=float(factor * self.constant),
                                   slope=float(factor * self.slope))

    def expected_nodes(self):
        """Returns the number of nodes of a lattice with this spacing, plus half a node per d^2 of
        the surface."""
        return self.inner_nodes() + self.boundary_nodes()

    def inner_nodes(self):
        low, high = self.body.bounds()
        sides = [a + (b - a) * (np.arange(60) + 0.5) / 60 for a, b in zip(low, high)]
        grid = np.column_stack([axis.ravel() for axis in np.meshgrid(*sides)])
        grid = grid[self.body.contains(grid)]
        return NODES_PER_CUBE * self.body.volume() * np.mean(self.spacing(grid) ** -3)

    def boundary_nodes(self):
        """Returns half the number of nodes on the surface, with evenly distributed points on each
        triangle for the integral of 1 / d^2."""
        share = (np.arange(40) + 0.5) / 40
        u, v = (w.ravel()[:, None] for w in np.meshgrid(np.sqrt(share), share))
        a, b, c = self.body.vertices[self.body.triangles()].transpose(1, 0, 2)
        areas = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
        if self.slope == 0:
            return 0.5 * areas.sum() / self.constant ** 2
        return 0.5 * sum(area * np.mean(self.spacing((1 - u) * p + u * ((1 - v) * q + v * r)) ** -2)
                         for area, p, q, r in zip(areas, a, b, c))

    def with_nodes(self, nodes):
        """Returns the case with all spacings scaled for about this number of nodes."""
        inner, boundary, factor = self.inner_nodes(), self.boundary_nodes(), 1
        for _ in range(20):
            factor *= ((inner / factor ** 3 + boundary / factor ** 2) / nodes) ** (1 / 3)
        return self.scaled(factor)


def make_uniform_cube(nodes):
    return VolumeCase("uniform-cube", "unit cube, uniform", bodies.box(), 0.1).with_nodes(nodes)


def make_graded_cube(nodes):
    """Returns a case in which d grows from 1 in the middle to 5 in the corners."""
    case = VolumeCase("graded-cube", "unit cube, d graded 1:5", bodies.box(), 0.02,
                      0.02 * 4 / 0.866, (0.5, 0.5, 0.5))
    return case.with_nodes(nodes)


def make_ball(nodes):
    """Returns a case on the ball. For tools that need triangles its surface has triangles of side
    d."""
    case = VolumeCase("uniform-ball", "ball, uniform", bodies.ball(0.3), 0.1).with_nodes(nodes)
    return dataclasses.replace(case, body=bodies.ball(case.constant))


def make_l_block(nodes):
    case = VolumeCase("uniform-l-block", "L-block, uniform", bodies.l_block(), 0.1)
    return case.with_nodes(nodes)


def make_eros(nodes):
    body = bodies.read_off(bodies.DATA / "eros.off")
    return VolumeCase("uniform-eros", "asteroid Eros, uniform", body, 0.1).with_nodes(nodes)


def make_kleopatra(nodes):
    body = bodies.read_obj(bodies.DATA / "kleopatra.obj")
    case = VolumeCase("uniform-kleopatra", "asteroid Kleopatra, uniform", body, 10)
    return case.with_nodes(nodes)


CASES = {"uniform-cube": make_uniform_cube, "graded-cube": make_graded_cube,
         "uniform-ball": make_ball, "uniform-l-block": make_l_block,
         "uniform-kleopatra": make_kleopatra, "uniform-eros": make_eros}
