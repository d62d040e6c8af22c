# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of bodies by PNPBS and by gmsh's HXT, in this process and with one thread, with their CPU
seconds."""
import pathlib
import tempfile
import time

import numpy as np

import body_cases  # noqa: F401  (finds the folder of the adapters)
from adapters.with_gmsh_volume import SIZE, geometry
from elements import Mesh

OURS, HXT = "PNPBS", "gmsh, HXT"
# At an equal error HXT needs about twice as many nodes.
TIMES_NODES = {OURS: 1, HXT: 2}
REPEATS = 3


def mesh(case, mesher):
    """Returns the mesh and the median of the CPU seconds of some meshings."""
    with tempfile.TemporaryDirectory() as folder:
        surface = pathlib.Path(folder) / "body.stl"
        case.body.write_stl(surface)
        make = by_pnpbs if mesher == OURS else by_hxt
        seconds = []
        for _ in range(REPEATS):
            begin = time.process_time()
            made = make(case, surface)
            seconds.append(time.process_time() - begin)
    return Mesh(*made), float(np.median(seconds))


def by_pnpbs(case, surface):
    import pnpbs
    with pnpbs.Context(threads=1) as context:
        domain = pnpbs.Domain(context, 3)
        if case.body.kind == "box":
            domain.add_box((0, 0, 0), (1, 1, 1))
        elif case.body.kind == "ball":
            domain.add_ball((0, 0, 0), 1)
        else:
            domain.read_surface(surface)
        placement = pnpbs.Placement(domain).set_spacing(case.spacing if case.slope else case.constant)
        placement.run()
        return placement.nodes().points, placement.tetrahedra()


def by_hxt(case, surface):
    """Meshes by gmsh with its default optimisation (Mesh.Optimize = 1)."""
    import gmsh
    gmsh.initialize()
    try:
        for option, value in (("General.Terminal", 0), ("General.NumThreads", 1),
                              ("Mesh.MaxNumThreads2D", 1), ("Mesh.MaxNumThreads3D", 1),
                              ("Mesh.Algorithm3D", 10), ("Mesh.Optimize", 1)):
            gmsh.option.setNumber(option, value)
        script = surface.with_name("case.geo")
        script.write_text(geometry(case, SIZE["hxt"]))
        gmsh.open(str(script))
        gmsh.model.mesh.generate(3)
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        row = np.zeros(int(tags.max()) + 1, np.int64)
        row[tags] = np.arange(len(tags))
        corners = gmsh.model.mesh.getElementsByType(4)[1]
        return coordinates.reshape(-1, 3), row[corners].reshape(-1, 4)
    finally:
        gmsh.finalize()
