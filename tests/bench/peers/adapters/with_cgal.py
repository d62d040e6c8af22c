# SPDX-License-Identifier: BSD-3-Clause
"""CGAL's Delaunay mesher and Lloyd optimiser, by ../cgal_mesh.cpp."""
from adapters import tool
from measure import measure

# The longest edge over d for which the mesher's mean edge is about d.
EDGE_BOUND = 1.45


class Cgal(tool.Tool):
    needs = "pnpbs-cgal-mesh (cmake --build build/release --target pnpbs-cgal-mesh)"

    def __init__(self, steps):
        self.steps = steps
        self.name = f"CGAL, {steps} Lloyd steps" if steps else "CGAL, Delaunay refinement"
        self.setting = f"edges up to {EDGE_BOUND} d, {steps} Lloyd steps"

    def program(self):
        return tool.built("pnpbs-cgal-mesh") or tool.command("pnpbs-cgal-mesh")

    def available(self):
        return self.program() is not None

    def version(self):
        return tool.answer_of(self.program(), "--version")

    def run(self, case, folder, time_limit):
        case.domain.write_poly(folder / "case.poly")
        used = measure([self.program(), "case.poly", "nodes.node",
                        *tool.words_of_spacing(case, folder), EDGE_BOUND, self.steps], folder,
                       time_limit)
        return tool.Outcome(tool.read_node(folder / "nodes.node"), used.seconds,
                            tool.told_seconds(used.stdout), used.peak_bytes)


def tools():
    return [Cgal(0), Cgal(20)]
