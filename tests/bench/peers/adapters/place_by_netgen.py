# SPDX-License-Identifier: BSD-3-Clause
"""Runs Netgen, by its Python package, on a case; see place_in_space.py for the arguments."""
import numpy as np
from netgen import csg, stl
from netgen.meshing import MeshingParameters
from place_in_space import Job


def geometry(job):
    if job.kind == "file":
        return stl.STLGeometry("body.stl")
    box = csg.OrthoBrick(csg.Pnt(0, 0, 0), csg.Pnt(1, 1, 1))
    body = {"box": lambda: box, "ball": lambda: csg.Sphere(csg.Pnt(0, 0, 0), 1),
            "l-block": lambda: box - csg.OrthoBrick(csg.Pnt(0.5, 0.5, -1), csg.Pnt(2, 2, 2))}
    whole = csg.CSGeometry()
    whole.Add(body[job.kind]())
    return whole


def points_of_spacing(job):
    """Returns the centres of cubes that are divided until they are at most 2 d wide."""
    low, high = job.vertices.min(0), job.vertices.max(0)
    middles, width, found = 0.5 * (low + high)[None, :], (high - low).max(), []
    cut = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]) / 4
    while len(middles):
        small = width <= 2 * job.spacing(middles)
        found.append(middles[small])
        middles = (middles[~small][:, None, :] + width * cut).reshape(-1, 3)
        width *= 0.5
    return np.concatenate(found)


job = Job()
job.begin()
if job.slope == 0:
    settings = MeshingParameters(maxh=job.size * job.constant)
else:
    points = points_of_spacing(job)
    d = job.size * job.spacing(points)
    settings = MeshingParameters(maxh=float(d.max()))
    for (x, y, z), h in zip(points.tolist(), d.tolist()):
        settings.RestrictH(x=x, y=y, z=z, h=h)
mesh = geometry(job).GenerateMesh(settings)
coordinates = np.array([point.p for point in mesh.Points()])
tetrahedra = np.array([[v.nr - 1 for v in element.vertices] for element in mesh.Elements3D()])
job.finish(coordinates, tetrahedra)
