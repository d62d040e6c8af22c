# SPDX-License-Identifier: BSD-3-Clause
"""The six bodies of the comparison in space, with problems for finite elements."""
import dataclasses
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "peers"))
import bodies  # noqa: E402
import volume_cases  # noqa: E402
from problems import Peak, Wave  # noqa: E402

TITLES = {"uniform-cube": "unit cube, uniform", "graded-cube": "unit cube, graded 1:5",
          "uniform-ball": "ball, uniform", "uniform-l-block": "L-block, uniform",
          "uniform-kleopatra": "asteroid Kleopatra, uniform", "uniform-eros": "asteroid Eros, uniform"}


class BodyCase:
    """A body, a problem, and the numbers of nodes that are requested of PNPBS."""

    def __init__(self, name, sizes=(3500, 7000, 14000, 28000)):
        self.name, self.title, self.sizes = name, TITLES[name], sizes
        # The spacing of the graded cube is in proportion to r + 0.2165, where r is the distance from
        # the middle.
        self.problem = Peak(0.2165**2, (0.5, 0.5, 0.5)) if name == "graded-cube" else Wave()

    def with_nodes(self, nodes):
        """Returns the body and the spacing for about this number of nodes."""
        case = volume_cases.CASES[self.name](nodes)
        return in_unit_size(case) if case.body.kind == "file" else case


def in_unit_size(case):
    """Returns a uniform case whose body has its middle at the origin and reaches from -1 to 1 in its
    longest direction."""
    low, high = case.body.bounds()
    half = (high - low).max() / 2
    body = dataclasses.replace(case.body, vertices=(case.body.vertices - (low + high) / 2) / half)
    return dataclasses.replace(case, body=body, constant=float(case.constant / half))


BODIES = [BodyCase(name) for name in volume_cases.CASES]
