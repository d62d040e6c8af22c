# SPDX-License-Identifier: BSD-3-Clause
"""gmsh in space. Simple bodies use its own shapes. Others are given by their triangles, which gmsh
classifies into surfaces by their angles and meshes again."""
import math

import numpy as np
from adapters import tool
from adapters.with_gmsh import GmshCommand, read_nodes

# The size over d for which about the wanted number of nodes results.
SIZE = {"del3d": 0.79, "hxt": 0.76}


def geometry(case, size):
    lines = ['SetFactory("OpenCASCADE");'] if case.body.kind in ("box", "ball") else []
    lines += {"box": ["Box(1) = {0, 0, 0, 1, 1, 1};"], "ball": ["Sphere(1) = {0, 0, 0, 1};"],
              "l-block": prism(case.body), "file": from_triangles()}[case.body.kind]
    scaled = case.scaled(size)
    lines += ["Mesh.MeshSizeExtendFromBoundary = 0;", "Mesh.MeshSizeFromPoints = 0;",
              "Mesh.MeshSizeFromCurvature = 0;"]
    if case.slope == 0:
        lines += [f"Mesh.MeshSize{bound} = {scaled.constant!r};" for bound in ("Min", "Max")]
    else:
        lines += ["Field[1] = MathEval;", f'Field[1].F = "{scaled.formula("Sqrt")}";',
                  "Background Field = 1;"]
    return "\n".join(lines) + "\n"


def prism(body):
    """Returns the prism in gmsh's language. The first half of its vertices is the outline."""
    outline = body.vertices[:len(body.vertices) // 2, :2].tolist()
    count = len(outline)
    lines = [f"Point({k}) = {{{x!r}, {y!r}, 0}};" for k, (x, y) in enumerate(outline, 1)]
    lines += [f"Line({k}) = {{{k}, {k % count + 1}}};" for k in range(1, count + 1)]
    return [*lines, f"Curve Loop(1) = {{1:{count}}};", "Plane Surface(1) = {1};",
            "Extrude {0, 0, 1} { Surface{1}; }"]


def from_triangles():
    return ['Merge "body.stl";', f"ClassifySurfaces{{{math.radians(40)!r}, 1, 1, Pi}};",
            "CreateGeometry;", "Surface Loop(1) = Surface{:};", "Volume(1) = {1};"]


def read_msh(path):
    """Reads points and tetrahedra from a file of format 2.2."""
    with open(path) as file:
        nodes = read_nodes(file, 3)
        rows = [words[-4:] for words in map(str.split, file) if len(words) > 7 and words[1] == "4"]
    place = np.zeros(int(nodes[:, 0].max()) + 1, int)
    place[nodes[:, 0].astype(int)] = np.arange(len(nodes))
    return nodes[:, 1:], place[np.array(rows, int).reshape(-1, 4)]


class GmshInSpace(GmshCommand):
    def __init__(self, name, algorithm):
        self.size = SIZE[algorithm]
        super().__init__(name, f"-3 -algo {algorithm}")

    def run(self, case, folder, time_limit):
        case.body.write_stl(folder / "body.stl")
        used, inner = self.mesh(geometry(case, self.size), folder, time_limit)
        points, tetrahedra = read_msh(folder / "nodes.msh")
        return tool.VolumeOutcome(points, tetrahedra, used, inner)


def tools():
    return [GmshInSpace("Delaunay", "del3d"), GmshInSpace("HXT", "hxt")]
