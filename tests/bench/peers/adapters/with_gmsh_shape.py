# SPDX-License-Identifier: BSD-3-Clause
"""gmsh with sizes from the shape: the fields Distance and Threshold, or its own sizes from the
curvature and from the boundary. Surfaces are given as triangles, classified by their angles and
meshed again."""
import math
import re

import numpy as np
from adapters.tool import ByShape
from adapters.with_gmsh import TOO_LARGE, GmshCommand, outline, read_msh
from adapters.with_gmsh_volume import SIZE, from_triangles
from adapters.with_gmsh_volume import read_msh as read_msh_in_space
from measure import Failed
from shape_cases import PER_TURN

# Least number of samples of a surface that d grows from, along each side of its bounding box.
FEWEST_SAMPLES = 100


def geometry(case, size):
    if case.shape.dimension == 3:
        lines = [*from_triangles(), "surfaces() = Surface{:};"]
        sources = "SurfacesList = {surfaces()}"
    elif case.automatic and case.shape.grows_from:
        lines, sources = with_spline(case.domain, *case.shape.grows_from), None
    else:
        first, last = case.shape.grows_from or (0, len(case.domain.segments))
        lines, sources = outline(case.domain)[0], f"CurvesList = {{{first + 1}:{last}}}"
    lines += ["Mesh.MeshSizeFromPoints = 0;",
              f"Mesh.MeshSizeExtendFromBoundary = {int(case.automatic)};"]
    if case.automatic:
        lines += [f"Mesh.MeshSizeFromCurvature = {PER_TURN};",
                  f"Mesh.MeshSizeMin = {size * case.constant!r};"]
    if case.automatic or case.slope == 0:
        lines.append(f"Mesh.MeshSizeMax = {size * case.largest!r};")
    if not case.automatic and case.slope == 0:
        lines.append(f"Mesh.MeshSizeMin = {size * case.constant!r};")
    elif not case.automatic:
        lines += field(case, size, sources)
    return "\n".join(lines) + "\n"


def field(case, size, sources):
    """Returns fields of the distance to samples. On curves the relative error of d is at most
    TOO_LARGE."""
    if case.shape.dimension == 2:
        longest = np.linalg.norm(np.diff(case.shape.source(), axis=1)[:, 0], axis=1).max()
        samples = math.ceil(0.5 * case.slope * longest / (TOO_LARGE * case.constant)) + 1
    else:
        samples = max(FEWEST_SAMPLES, math.ceil(case.shape.width() / case.constant))
    way = (case.largest - case.constant) / case.slope
    return ["Field[1] = Distance;", f"Field[1].{sources};", f"Field[1].Sampling = {samples};",
            "Field[2] = Threshold;", "Field[2].InField = 1;", "Field[2].DistMin = 0;",
            f"Field[2].SizeMin = {size * case.constant!r};", f"Field[2].DistMax = {way!r};",
            f"Field[2].SizeMax = {size * case.largest!r};", "Background Field = 2;"]


def with_spline(domain, first, last):
    """Returns the loop of these segments as a smooth curve through its corners. gmsh computes the
    curvature of such a curve, but not of straight lines. The curve begins at its only sharp corner.
    """
    lines, _ = outline(domain)
    kept = [line for line in lines
            if not line.startswith(tuple(f"Line({k + 1})" for k in range(first, last)))
            and not line.startswith(("Curve Loop(2)", "Plane"))]
    corners = [*range(first + 1, last + 1), first + 1]
    middle = len(corners) // 2
    numbers = [", ".join(map(str, part)) for part in (corners[:middle + 1], corners[middle:])]
    return [*kept, f"Spline({first + 1}) = {{{numbers[0]}}};", f"Spline({first + 2}) = {{{numbers[1]}}};",
            f"Curve Loop(2) = {{{first + 1}, {first + 2}}};", "Plane Surface(1) = {1, 2};"]


class GmshByShape(ByShape, GmshCommand):
    def __init__(self):
        super().__init__("frontal, in space Delaunay", "")
        self.setting = (f"-algo front2d, in space del3d with {SIZE['del3d']} of the size; Distance "
                        f"and Threshold; by itself MeshSizeFromCurvature {PER_TURN} and "
                        "MeshSizeExtendFromBoundary")

    def place(self, case, folder, time_limit):
        in_space = case.shape.dimension == 3
        size = SIZE["del3d"] if in_space else 1
        if in_space:
            case.domain.write_stl(folder / "body.stl")
        words = "-3 -algo del3d" if in_space else "-2 -algo front2d"
        used, _ = self.mesh(geometry(case, size), folder, time_limit, words)
        points = read_msh_in_space(folder / "nodes.msh")[0] if in_space else read_msh(
            folder / "nodes.msh")
        wrong = re.search(r"^Error +: (.*)", (folder / "measured.err").read_text(), re.MULTILINE)
        if wrong or len(points) == 0:
            raise Failed(wrong[1] if wrong else "no elements")
        return points, [used], None


def tools():
    return [GmshByShape()]
