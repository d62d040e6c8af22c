# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of the scripts that run a Python package as a tool: arguments and files."""
import dataclasses
import math
import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1]))
from domain import read_poly  # noqa: E402
from spacing_table import read_table  # noqa: E402


@dataclasses.dataclass
class Formula:
    constant: float
    slope: float
    x0: float
    y0: float
    x_counts: float

    def at(self, x, y):
        return self.constant + self.slope * np.hypot(self.x_counts * (x - self.x0), y - self.y0)

    def at_one(self):
        """Returns a function of x and y for one point at a time. It does not use NumPy, which is
        slower here."""
        return lambda x, y: self.constant + self.slope * math.hypot(
            self.x_counts * (x - self.x0), y - self.y0)


class Job:
    """The arguments IN.poly OUT.node SPACING... AREA_BOUND LEAST_ANGLE, where SPACING is CONSTANT
    SLOPE X0 Y0 X_COUNTS or the file of a table."""

    def __init__(self):
        poly, self.output, *spacing, bound, angle = sys.argv[1:]
        self.domain = read_poly(poly)
        if len(spacing) == 1:
            self.spacing = read_table(spacing[0])
        else:
            self.spacing = Formula(*map(float, spacing))
        self.is_uniform = len(spacing) > 1 and self.spacing.slope == 0
        self.area_factor = float(bound) * math.sqrt(3) / 4
        self.angle = float(angle)

    def largest_area(self, x, y):
        d = self.spacing.at(x, y)
        return self.area_factor * d * d

    def finish(self, points, seconds):
        points = np.asarray(points)
        with open(self.output, "w") as file:
            file.write(f"{len(points)} 2 0 0\n")
            for i, (x, y) in enumerate(points.tolist(), 1):
                file.write(f"{i} {x!r} {y!r}\n")
        print(f"seconds {seconds:.6f}")
