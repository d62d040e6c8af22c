# SPDX-License-Identifier: BSD-3-Clause
"""Runs the Python package meshpy on a case; see place_common.py for the arguments."""
import math
import time

import numpy as np
from meshpy import triangle
from place_common import Job


def place(job):
    plane = triangle.MeshInfo()
    plane.set_points(job.domain.vertices.tolist())
    plane.set_facets(job.domain.segments.tolist())
    plane.set_holes(job.domain.holes.tolist())

    def too_large(vertices, area):
        (ax, ay), (bx, by), (cx, cy) = vertices
        d = job.constant + job.slope * math.hypot(job.x_counts * ((ax + bx + cx) / 3 - job.x0),
                                                  (ay + by + cy) / 3 - job.y0)
        return area > job.area_factor * d * d

    if job.slope == 0:
        return triangle.build(plane, max_volume=float(job.largest_area(0, 0)),
                              min_angle=job.angle)
    return triangle.build(plane, refinement_func=too_large, min_angle=job.angle)


job = Job()
begin = time.perf_counter()
mesh = place(job)
points, triangles = np.array(mesh.points), np.array(mesh.elements)
used = np.zeros(len(points), bool)
used[triangles] = True
job.finish(points[used], time.perf_counter() - begin)
