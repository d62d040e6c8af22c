# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of a case by PNPBS and by gmsh, in this process and with one thread, with their CPU
seconds."""
import time

import numpy as np
import pnpbs

from elements import Mesh

# The names and numbers of gmsh's algorithms.
PLANE = {"gmsh, frontal": 6, "gmsh, Delaunay": 5}
SPACE = {"gmsh, HXT": 10, "gmsh, Delaunay": 1, "gmsh, Delaunay and Netgen's optimiser": 1}
OURS = "PNPBS"


def names(case):
    return [OURS, *(PLANE if case.dim == 2 else SPACE)]


def mesh(case, name, h):
    """Returns the mesh and its CPU seconds."""
    begin = time.process_time()
    made = by_pnpbs(case, h) if name == OURS else by_gmsh(case, name, h)
    seconds = time.process_time() - begin
    return Mesh(*made), seconds


def by_pnpbs(case, h):
    with pnpbs.Context(threads=1) as context:
        domain = pnpbs.Domain(context, case.dim)
        if case.shape == "square":
            domain.add_polyline([(0, 0), (1, 0), (1, 1), (0, 1)])
        elif case.shape == "cube":
            domain.add_box((0, 0, 0), (1, 1, 1))
        else:
            domain.add_ball((0, 0, 0), 1)
        placement = pnpbs.Placement(domain).set_spacing(case.spacing(h))
        placement.run()
        elements = placement.triangles() if case.dim == 2 else placement.tetrahedra()
        return placement.nodes().points, elements


def by_gmsh(case, name, h):
    import gmsh
    gmsh.initialize()
    try:
        for option in ("General.Terminal", "Mesh.MeshSizeExtendFromBoundary",
                       "Mesh.MeshSizeFromPoints", "Mesh.MeshSizeFromCurvature"):
            gmsh.option.setNumber(option, 0)
        for option in ("General.NumThreads", "Mesh.MaxNumThreads2D", "Mesh.MaxNumThreads3D"):
            gmsh.option.setNumber(option, 1)
        if case.dim == 2:
            gmsh.option.setNumber("Mesh.Algorithm", PLANE[name])
            gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
        else:
            gmsh.option.setNumber("Mesh.Algorithm3D", SPACE[name])
            if case.shape == "ball":
                gmsh.model.occ.addSphere(0, 0, 0, 1)
            else:
                gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
        gmsh.model.occ.synchronize()
        field = gmsh.model.mesh.field.add("MathEval")
        gmsh.model.mesh.field.setString(field, "F", case.formula(h))
        gmsh.model.mesh.field.setAsBackgroundMesh(field)
        gmsh.model.mesh.generate(case.dim)
        if name.endswith("optimiser"):
            gmsh.model.mesh.optimize("Netgen")
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        row = np.zeros(int(tags.max()) + 1, np.int64)
        row[tags] = np.arange(len(tags))
        corners = gmsh.model.mesh.getElementsByType(2 if case.dim == 2 else 4)[1]
        return (coordinates.reshape(-1, 3)[:, :case.dim],
                row[corners].reshape(-1, case.dim + 1))
    finally:
        gmsh.finalize()
