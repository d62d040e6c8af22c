# SPDX-License-Identifier: BSD-3-Clause
"""Runs TetGen, by the Python package meshpy, on a case; see place_in_space.py for the arguments."""
import math

import numpy as np
from meshpy import tet
from place_in_space import Job


DONE = 1e-3  # share of too large tetrahedra that may remain, as each division creates others


def largest_volume(job, points):
    return job.bound * math.sqrt(2) / 12 * job.spacing(points) ** 3


def place(job):
    body = tet.MeshInfo()
    body.set_points(job.vertices.tolist())
    body.set_facets(job.polygons)
    body.set_holes(job.holes)
    if job.slope == 0:
        largest = float(largest_volume(job, job.vertices[:1])[0])
        return tet.build(body, tet.Options("pq"), max_volume=largest)
    mesh = tet.build(body, tet.Options("pq"))
    while True:
        corners = np.array(mesh.points)[np.array(mesh.elements)]
        a, b, c, d = corners.transpose(1, 0, 2)
        volume = np.abs(((b - a) * np.cross(c - a, d - a)).sum(1)) / 6
        wanted = largest_volume(job, corners.mean(1))
        if (volume > wanted).mean() <= DONE:
            return mesh
        # d at the centroid says little about a large tetrahedron, so each pass reduces the volume
        # by a factor of at most eight.
        mesh.element_volumes.setup()
        for k, bound in enumerate(np.maximum(wanted, 0.125 * volume).tolist()):
            mesh.element_volumes[k] = bound
        mesh = tet.build(mesh, tet.Options("rqa"))


job = Job()
job.begin()
mesh = place(job)
job.finish(mesh.points, mesh.elements)
