# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts that run a Python package as a tool have in common: arguments and files."""
import math
import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[1]))
from cases import read_poly  # noqa: E402


class Job:
    """IN.poly OUT.node CONSTANT SLOPE X0 Y0 X_COUNTS AREA_BOUND LEAST_ANGLE"""

    def __init__(self):
        poly, self.output, *numbers = sys.argv[1:]
        self.domain = read_poly(poly)
        (self.constant, self.slope, self.x0, self.y0, self.x_counts, bound,
         self.angle) = map(float, numbers)
        self.area_factor = bound * math.sqrt(3) / 4

    def largest_area(self, x, y):
        d = self.constant + self.slope * np.hypot(self.x_counts * (x - self.x0), y - self.y0)
        return self.area_factor * d * d

    def finish(self, points, seconds):
        points = np.asarray(points)
        with open(self.output, "w") as file:
            file.write(f"{len(points)} 2 0 0\n")
            for i, (x, y) in enumerate(points.tolist(), 1):
                file.write(f"{i} {x!r} {y!r}\n")
        print(f"seconds {seconds:.6f}")
