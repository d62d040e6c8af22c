#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The smallest program: places nodes in the unit square with the constant spacing 0.05.
examples/c/smallest is the same program in C and explains the expected results."""
import numpy as np
import pnpbs

with pnpbs.Context() as context:
    square = pnpbs.Domain(context).add_polyline([(0, 0), (1, 0), (1, 1), (0, 1)])
    placement = pnpbs.Placement(square).set_spacing(0.05)
    placement.run()

    n = placement.node_count
    boundary = np.count_nonzero(placement.nodes().tags)
    print(f"nodes: {n}, expected about 503")
    print(f"on the boundary: {boundary}, expected 80")
    print(f"triangles: {len(placement.triangles())}, expected {2 * n - boundary - 2}")
