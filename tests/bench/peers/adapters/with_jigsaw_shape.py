# SPDX-License-Identifier: BSD-3-Clause
"""JIGSAW with sizes from the shape, by its commands marche and jigsaw.

The sizes are given at the grid points beside the boundary, and marche limits their growth. JIGSAW
has no command for automatic sizes. Those are a multiple of the local feature size (Amenta, Bern
1999), computed here by SciPy."""
import math
import time

import numpy as np
from adapters import tool, with_jigsaw, with_jigsaw_volume
from adapters.with_jigsaw import Jigsaw, block, read_points
from distance_to_boundary import samples_of
from measure import measure
from scipy.spatial import Delaunay, cKDTree
from shape_cases import GROWTH, PER_TURN

MOST_LINES = {2: 1000, 3: 120}  # grid lines per side
# The distance of samples for the feature size, and the least size from it, in units of the largest
# d. At sharp edges the feature size is 0.
SAMPLES = {2: 0.05, 3: 0.25}


def grid_of(case):
    """Returns the axes, and all points. The second coordinate varies fastest, then the first, then
    the third."""
    low, high = case.domain.vertices.min(0), case.domain.vertices.max(0)
    step = max(case.constant, case.shape.width() / MOST_LINES[case.shape.dimension])
    axes = [a - step + step * np.arange(math.ceil((b - a) / step) + 3) for a, b in zip(low, high)]
    if case.shape.dimension == 2:
        mixed = np.meshgrid(*axes, indexing="ij")
    else:
        z, x, y = np.meshgrid(axes[2], axes[0], axes[1], indexing="ij")
        mixed = [x, y, z]
    return axes, np.column_stack([axis.ravel() for axis in mixed]), step


def sizes_at_boundary(case):
    """Returns the sizes at the grid points next to the boundary, and the largest d at the others.
    """
    axes, points, step = grid_of(case)
    beside = 1.01 * math.sqrt(case.shape.dimension) * step
    values = np.full(len(points), case.largest)
    if case.automatic:
        apart = SAMPLES[case.shape.dimension] * case.largest
        samples, _ = samples_of(case.shape.pieces, apart)
        samples = np.unique(samples, axis=0)
        sizes = 2 * math.pi / PER_TURN * feature_size(samples)
        away, nearest = cKDTree(samples).query(points)
        beside = max(beside, apart)
        found = np.clip(sizes[nearest] + GROWTH * away, apart, case.largest)
    else:
        away = case.distance(points)
        found = case.of_distance(away)
    near = away <= beside
    values[near] = found[near]
    return axes, values


def feature_size(samples):
    """Returns the distance of each sample from the nearest pole. The poles are the farthest corner
    of its Voronoi cell, and the farthest one on the other side."""
    mesh = Delaunay(samples)
    centres = circumcentres(samples[mesh.simplices])
    node, centre = mesh.simplices.ravel(), np.repeat(np.arange(len(centres)), samples.shape[1] + 1)
    way = centres[centre] - samples[node]
    length = np.linalg.norm(way, axis=1)
    first = farthest(node, length, len(samples))
    ahead = way[np.maximum(first, 0)]
    other = (way * ahead[node]).sum(1) < 0
    second = farthest(node, np.where(other, length, -1), len(samples))
    found = np.concatenate([first[first >= 0], second[second >= 0]])
    return cKDTree(centres[centre[found]]).query(samples)[0]


def farthest(node, length, count):
    """Returns for each node the row with the greatest length, or -1 if none is positive."""
    order = np.argsort(length, kind="stable")
    order = order[(length[order] > 0) & np.isfinite(length[order])]
    rows = np.full(count, -1)
    rows[node[order]] = order
    return rows


def circumcentres(corners):
    sides = corners[:, 1:] - corners[:, :1]
    squares = 0.5 * (sides ** 2).sum(2)
    flat = np.abs(np.linalg.det(sides)) < 1e-12 * squares.max(1) ** (sides.shape[1] / 2)
    sides[flat] = np.eye(sides.shape[1])
    centres = corners[:, 0] + np.linalg.solve(sides, squares[:, :, None])[:, :, 0]
    centres[flat] = np.nan
    return centres


def write_grid(path, axes, values, slope):
    with open(path, "w") as file:
        file.write(f"mshid=3;euclidean-grid\nndims={len(axes)}\n")
        for axis, lines in enumerate(axes, 1):
            file.write(f"coord={axis};{len(lines)}\n" + "\n".join(map(repr, lines.tolist())) + "\n")
        file.write(f"value={len(values)};1\n" + "\n".join(f"{v:.8g}" for v in values.tolist()))
        file.write(f"\nslope={len(values)};1\n" + f"{slope!r}\n" * len(values))


class JigsawByShape(tool.ByShape, Jigsaw):
    needs = "the commands jigsaw and marche"

    def __init__(self, name, sweeps):
        super().__init__(name, sweeps)
        self.setting += (f"; marche on a grid; by itself 2 pi / {PER_TURN} of the local feature size, "
                         "by SciPy")

    def available(self):
        return super().available() and bool(tool.command("marche"))

    def place(self, case, folder, time_limit):
        dimension = case.shape.dimension
        kind = with_jigsaw if dimension == 2 else with_jigsaw_volume
        (folder / "domain.msh").write_text(kind.geometry(case.domain))
        settings = {"GEOM_FILE": "domain.msh", "MESH_FILE": "nodes.msh", "MESH_DIMS": dimension,
                    "GEOM_FEAT": "TRUE", "MESH_TOP1": "TRUE", "HFUN_SCAL": "ABSOLUTE",
                    "OPTM_ITER": self.sweeps, "NUMTHREAD": 1, "VERBOSITY": 1,
                    "HFUN_HMAX": repr(case.largest), "HFUN_HMIN": repr(case.constant)}
        used, field_seconds = [], None
        if case.automatic or case.slope:
            begin = time.process_time()
            axes, values = sizes_at_boundary(case)
            field_seconds = time.process_time() - begin
            settings["HFUN_FILE"] = "spacing.msh"
            write_grid(folder / "spacing.msh", axes, values,
                       GROWTH if case.automatic else case.slope)
        (folder / "case.jig").write_text(
            "".join(f"{key} = {value}\n" for key, value in settings.items()))
        if field_seconds is not None:
            used.append(measure(["marche", "case.jig"], folder, time_limit))
            field_seconds += used[0].cpu_seconds
        used.append(measure(["jigsaw", "case.jig"], folder, time_limit))
        if dimension == 2:
            return read_points(folder / "nodes.msh"), used, field_seconds
        text = (folder / "nodes.msh").read_text()
        points = block(text, "point")[:, :3]
        tetrahedra = block(text, "tria4")[:, :4].astype(int)
        return points[np.unique(tetrahedra)], used, field_seconds


def tools():
    return [JigsawByShape("default", 16)]
