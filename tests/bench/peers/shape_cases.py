# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spacing from the shape: the same d = min(largest, constant + slope * distance from the
boundary) for every tool, and each tool's own sizes for the shape."""
import dataclasses
import math
from functools import cached_property

import bodies
import numpy as np
from airfoil import airfoil
from cases import DATA
from distance_to_boundary import DistanceToBoundary
from domain import Domain, from_loops, read_poly
from volume_cases import NODES_PER_CUBE

RANGE = 8       # the largest d over the least
PER_TURN = 20   # nodes around a circle, for a tool's own sizes
ACROSS = 3      # nodes across a gap, for a tool's own sizes
GROWTH = 0.15   # growth of d per distance, for a tool's own sizes
FINEST = 100    # the largest d over the least, for a tool's own sizes
GRID = {2: 400, 3: 30}  # points per side at which d is evaluated to count nodes


@dataclasses.dataclass(frozen=True)
class Shape:
    """A Domain or a Body, and those of its pieces that d grows from."""
    domain: object
    grows_from: tuple = None  # numbers of the pieces, first and one past the last; None: all

    @property
    def dimension(self):
        return 2 if isinstance(self.domain, Domain) else 3

    @cached_property
    def pieces(self):
        """Returns all pieces of the boundary, (count, corners, dimension)."""
        return self.domain.vertices[self.domain.segments if self.dimension == 2
                                    else self.domain.triangles()]

    @cached_property
    def grid(self):
        """Returns evenly distributed inner points for integrals."""
        low, high = self.domain.vertices.min(0), self.domain.vertices.max(0)
        count = GRID[self.dimension]
        sides = [a + (b - a) * (np.arange(count) + 0.5) / count for a, b in zip(low, high)]
        grid = np.column_stack([axis.ravel() for axis in np.meshgrid(*sides)])
        return grid[self.domain.contains(grid)]

    def measure(self):
        return self.domain.area() if self.dimension == 2 else self.domain.volume()

    def width(self):
        return float((self.domain.vertices.max(0) - self.domain.vertices.min(0)).max())

    def source(self):
        return self.pieces[slice(*(self.grows_from or (None,)))]


def measure_of(pieces):
    """Returns lengths of segments or areas of triangles."""
    if pieces.shape[1] == 2:
        return np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1)
    return 0.5 * np.linalg.norm(np.cross(pieces[:, 1] - pieces[:, 0], pieces[:, 2] - pieces[:, 0]),
                                axis=1)


@dataclasses.dataclass(frozen=True)
class ShapeCase:
    name: str
    title: str
    shape: Shape
    constant: float
    slope: float
    largest: float
    automatic: bool = False  # the tool chooses the sizes, which are at least constant

    @property
    def domain(self):
        return self.shape.domain

    @cached_property
    def distance(self):
        """Returns the distance from the pieces that d grows from."""
        return DistanceToBoundary(self.shape.source(), self.constant)

    def spacing(self, points):
        return self.of_distance(self.distance(points) if self.slope else np.zeros(len(points)))

    def of_distance(self, away):
        return np.minimum(self.largest, self.constant + self.slope * away)

    def with_nodes(self, nodes):
        """Returns the case with a d for about this number of nodes and the same slope."""
        dimension, case = self.shape.dimension, self
        away = DistanceToBoundary(self.shape.source(), self.shape.width() / 300)(self.shape.grid)
        for _ in range(20):
            factor = (case.expected_nodes(away) / nodes) ** (1 / dimension)
            case = dataclasses.replace(case, constant=float(case.constant * factor),
                                       largest=float(case.largest * factor))
        return case

    def expected_nodes(self, away):
        dimension = self.shape.dimension
        per_cell = 2 / math.sqrt(3) if dimension == 2 else NODES_PER_CUBE
        inner = self.shape.measure() * np.mean(self.of_distance(away) ** -dimension)
        source, whole = (measure_of(p).sum() for p in (self.shape.source(), self.shape.pieces))
        boundary = (source / self.constant ** (dimension - 1)
                    + (whole - source) / self.largest ** (dimension - 1))
        return per_cell * inner + 0.5 * boundary

    def even(self, nodes):
        """Returns the case with a constant d for about this number of nodes, which a tool uses
        without a field of sizes."""
        case, nowhere = self, np.zeros(1)
        for _ in range(20):
            factor = (case.expected_nodes(nowhere) / nodes) ** (1 / self.shape.dimension)
            d = float(case.constant * factor)
            case = dataclasses.replace(case, slope=0.0, constant=d, largest=d, automatic=False)
        return case


def airfoil_in_box():
    box, loop = np.array([[-1, -1.5], [2, -1.5], [2, 1.5], [-1, 1.5]]), airfoil(60)
    return Shape(from_loops([box, loop], [(0.5, 0.02)]), (4, 4 + len(loop)))


SHAPES = {
    "airfoil": ("box, from the airfoil", airfoil_in_box, 0.15),
    "islands": ("Great Lakes with 109 islands",
                lambda: Shape(read_poly(DATA / "great_lakes_islands.poly")), 0.15),
    "bracket": ("bracket", lambda: Shape(bodies.read_stl(DATA / "bracket.stl")), 0.2),
    "eros": ("asteroid Eros", lambda: Shape(bodies.read_off(DATA / "eros.off")), 0.2)}


def followed(name, nodes):
    title, shape, slope = SHAPES[name]
    case = ShapeCase(f"follow-{name}", f"{title}, d growing by {slope} from the boundary", shape(), 1,
                     slope, RANGE)
    return case.with_nodes(nodes)


def automatic(name, nodes):
    """Returns a case with bounds of d only. The largest d is the constant one for a fifth of the
    nodes."""
    title, shape, _ = SHAPES[name]
    case = ShapeCase(f"auto-{name}", f"{title}, sizes by the tool itself", shape(), 1, 0, 1)
    largest = case.even(nodes / 5).constant
    return dataclasses.replace(case, constant=largest / FINEST, largest=largest, automatic=True)


CASES = {f"{kind}-{name}": lambda nodes, make=make, name=name: make(name, nodes)
         for kind, make in (("follow", followed), ("auto", automatic)) for name in SHAPES}
