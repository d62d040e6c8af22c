# SPDX-License-Identifier: BSD-3-Clause
"""CGAL's Mesh_3, by ../cgal_mesh_3.cpp."""
import numpy as np
from adapters import tool
from measure import measure

# In units of d: the longest piece of a feature edge and the largest circumradii of triangles and
# tetrahedra for which about the wanted number of nodes results, and the distance of triangles from
# the surface.
EDGE, FACET, CELL, DISTANCE = 1, 0.85, 0.95, 0.1
FEATURE_ANGLE = 40  # degrees


class Mesh3(tool.Tool):
    name = "CGAL Mesh_3"
    needs = "pnpbs-cgal-mesh-3 (cmake --build build/release --target pnpbs-cgal-mesh-3)"
    setting = (f"edges up to {EDGE} d, circumradii up to {FACET} d and {CELL} d, {DISTANCE} d off the surface, "
               f"features from {FEATURE_ANGLE} degrees on, manifold()")

    def program(self):
        return tool.built("pnpbs-cgal-mesh-3") or tool.command("pnpbs-cgal-mesh-3")

    def available(self):
        return self.program() is not None

    def version(self):
        return tool.answer_of(self.program(), "--version")

    def run(self, case, folder, time_limit):
        case.body.write_off(folder / "body.off")
        sizes = [factor * case.constant for factor in (EDGE, FACET, CELL, DISTANCE)]
        used = measure([self.program(), "body.off", "made.node", "made.ele", *sizes, FEATURE_ANGLE],
                       folder, time_limit)
        points = tool.read_node(folder / "made.node", 3)
        tetrahedra = np.loadtxt(folder / "made.ele", int, usecols=(1, 2, 3, 4), skiprows=1, ndmin=2)
        return tool.VolumeOutcome(points, tetrahedra - 1, used, tool.told_seconds(used.stdout))


def tools():
    return [Mesh3()]
