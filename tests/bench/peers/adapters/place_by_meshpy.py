# SPDX-License-Identifier: BSD-3-Clause
"""Runs the Python package meshpy on a case; see place_common.py for the arguments."""
import time

import numpy as np
from meshpy import triangle
from place_common import Job


def place(job):
    plane = triangle.MeshInfo()
    plane.set_points(job.domain.vertices.tolist())
    plane.set_facets(job.domain.segments.tolist())
    plane.set_holes(job.domain.holes.tolist())

    spacing_at, area_factor = job.spacing.at_one(), job.area_factor

    def too_large(vertices, area):
        (ax, ay), (bx, by), (cx, cy) = vertices
        d = spacing_at((ax + bx + cx) / 3, (ay + by + cy) / 3)
        return area > area_factor * d * d

    if job.is_uniform:
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
