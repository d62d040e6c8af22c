# SPDX-License-Identifier: BSD-3-Clause
"""Runs the Python package triangle on a case; see place_common.py for the arguments."""
import time

import numpy as np
import triangle
from place_common import Job


def place(job):
    plane = {"vertices": job.domain.vertices, "segments": job.domain.segments}
    if len(job.domain.holes):
        plane["holes"] = job.domain.holes
    angle = f"q{job.angle:g}"
    if job.is_uniform:
        return triangle.triangulate(plane, f"p{angle}a{float(job.largest_area(0, 0)):.17f}")
    mesh = triangle.triangulate(plane, f"p{angle}")
    while True:
        corners = mesh["vertices"][mesh["triangles"]]
        a, b, c = corners.transpose(1, 2, 0)
        area = 0.5 * np.abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        wanted = job.largest_area(*corners.mean(1).T)
        if (area <= wanted).all():
            return mesh
        # d at the centroid says little about a large triangle, so each pass reduces the area by a
        # factor of at most four.
        mesh["triangle_max_area"] = np.maximum(wanted, 0.25 * area)
        mesh = triangle.triangulate(mesh, f"rp{angle}a")


job = Job()
begin = time.perf_counter()
found = place(job)
used = np.zeros(len(found["vertices"]), bool)
used[found["triangles"]] = True
job.finish(found["vertices"][used], time.perf_counter() - begin)
