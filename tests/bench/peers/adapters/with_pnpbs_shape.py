# SPDX-License-Identifier: BSD-3-Clause
"""PNPBS with formulas of the shape, by its command."""
import numpy as np
from adapters.tool import ByShape
from adapters.with_pnpbs import Pnpbs, settings
from measure import measure

TAG = 7  # tag of the curves and surfaces that d grows from


class PnpbsByShape(ByShape, Pnpbs):
    def place(self, case, folder, time_limit):
        if case.shape.dimension == 2:
            domain = "case.poly"
            case.domain.write_poly(folder / domain, markers(case.shape))
        else:
            domain = "body.stl"
            case.domain.write_stl(folder / domain)
        command = [self.program, "--domain", domain, *spacing(case), "--threads", 1, "--quiet"]
        for option in self.options:
            command += ["--set", option]
        used = measure([*command, "--output", "nodes.csv"], folder, time_limit, accepted=(0, 3, 4))
        columns = range(1, 1 + case.shape.dimension)
        points = np.loadtxt(folder / "nodes.csv", delimiter=",", skiprows=1, usecols=columns)
        # A dry run builds the tree of d and counts the nodes, but places none.
        estimate = measure([*command, "--dry-run"], folder, time_limit)
        return points, [used], estimate.cpu_seconds


def markers(shape):
    first, last = shape.grows_from or (0, len(shape.domain.segments))
    return [TAG if first <= k < last else 1 for k in range(len(shape.domain.segments))]


def spacing(case):
    if case.automatic:
        return ["--spacing", "auto", "--min-spacing", repr(case.constant),
                "--max-spacing", repr(case.largest)]
    if case.slope == 0:
        return ["--spacing", repr(case.constant)]
    away = f"dist({TAG})" if case.shape.grows_from else "dist"
    return ["--spacing", f"min({case.largest!r}, {case.constant!r} + {case.slope!r}*{away})"]


def tools(given=None, more=()):
    return settings(PnpbsByShape, given, more)
