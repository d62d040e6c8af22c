# SPDX-License-Identifier: BSD-3-Clause
"""Evaluates the tetrahedra of any tool, and then the nodes alone.

The nodes are evaluated by SciPy's Delaunay triangulation (Qhull) restricted to the body: tetrahedra
with their centroid inside, without flat ones of four boundary nodes that are open to the outside,
which are removed one by one as in ../evaluate_volume.cpp. Nodes of the tool's own boundary faces
are boundary nodes."""
import numpy as np
from evaluate import lower_quantile
from scipy.spatial import Delaunay

FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # opposite each corner
EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])
# The corners that do not belong to the edge.
OTHERS = np.array([[2, 3], [1, 3], [1, 2], [0, 3], [0, 2], [0, 1]])
FEWEST = 100     # least number of edges of a band
# Limit of the volume over the cube of the longest edge, which is 0.118 for a regular tetrahedron.
FLAT = 0.02
# The same ratio for tetrahedra of nodes on one sphere, whose volume is rounding error.
NOTHING = 1e-10
HISTOGRAM = np.linspace(0, 1, 51)


def evaluate(points, tetrahedra, body, spacing):
    """Evaluates points (n, 3) and tetrahedra (m, 4) for a Body and a spacing function of points.
    Returns a dict of measures, all of them plain numbers. Nodes without a tetrahedron do not count.
    """
    used, corners = np.unique(tetrahedra, return_inverse=True)
    points, tetrahedra = np.ascontiguousarray(points[used], float), corners.reshape(-1, 4)
    on_boundary = np.zeros(len(points), bool)
    on_boundary[boundary_faces(tetrahedra)] = True
    d = spacing(points)
    return {"nodes": len(points), **measures(points, tetrahedra, on_boundary, d, body),
            "delaunay": measures(points, restricted(points, on_boundary, body), on_boundary, d,
                                 body)}


def measures(points, tetrahedra, on_boundary, d, body):
    quality, angle = shape(points, tetrahedra)
    edges = np.unique(np.sort(tetrahedra[:, EDGES].reshape(-1, 2), 1), axis=0)
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    mean_d = 0.5 * (d[edges[:, 0]] + d[edges[:, 1]])
    ratio = lengths / mean_d
    free = ~on_boundary[edges].all(1)
    inside = ~on_boundary[tetrahedra].any(1)
    triangle_quality, triangle_angle = triangle_shape(points, boundary_faces(tetrahedra))
    return {
        "tetrahedra": len(tetrahedra),
        "covered": float(volume(points, tetrahedra).sum() / body.volume()),
        "quality_mean": float(quality.mean()),
        "quality_one_percent": lower_quantile(quality, 0.01),
        "quality_least": float(quality.min()),
        "quality_mean_inside": float(quality[inside].mean()) if inside.any() else None,
        "quality_mean_at_boundary": float(quality[~inside].mean()) if (~inside).any() else None,
        "angle_least": float(angle.min()),
        "below_20": int((angle < 20).sum()),
        "below_10": int((angle < 10).sum()),
        "edge_mean": float(ratio.mean()),
        "edge_deviation": float(ratio.std()),
        "edge_octaves": octave_means(mean_d[free], ratio[free]),
        "triangle_quality_mean": float(triangle_quality.mean()),
        "triangle_angle_least": float(triangle_angle.min()),
        "histogram": np.histogram(quality, HISTOGRAM)[0].tolist(),
    }


def octave_means(d, ratio):
    """Returns the mean of edge over d in each octave of d, from the finest on, without octaves of
    few edges. There is one band if d hardly varies."""
    if len(d) == 0 or d.max() < 1.1 * d.min():
        return [float(ratio.mean())] if len(d) else []
    count = int(np.ceil(np.log2(d.max() / d.min())))
    octave = np.minimum(np.log2(d / d.min()).astype(int), count - 1)
    counts = np.bincount(octave)
    return [float(s / n) for s, n in zip(np.bincount(octave, ratio), counts) if n >= FEWEST]


def volume(points, tetrahedra):
    a, b, c, d = points[tetrahedra].transpose(1, 0, 2)
    return np.abs(((b - a) * np.cross(c - a, d - a)).sum(1)) / 6


def shape(points, tetrahedra):
    """Returns the quality 3 r_in / R, 1 for a regular tetrahedron, and the least dihedral angle in
    degrees."""
    corners = points[tetrahedra]
    normals = np.cross(corners[:, FACES[:, 1]] - corners[:, FACES[:, 0]],
                       corners[:, FACES[:, 2]] - corners[:, FACES[:, 0]])
    surface = 0.5 * np.linalg.norm(normals, axis=2).sum(1)
    edge = np.linalg.norm(corners[:, EDGES[:, 1]] - corners[:, EDGES[:, 0]], axis=2)
    # The products of opposite edges are the sides of a triangle whose area gives the circumradius.
    a, b, c = (edge * edge[:, ::-1])[:, :3].T
    under_root = np.maximum((a + b + c) * (a + b - c) * (a - b + c) * (b + c - a), 0)
    six_volumes = 6 * volume(points, tetrahedra)
    with np.errstate(divide="ignore", invalid="ignore"):
        quality = 1.5 * six_volumes / surface * 4 * six_volumes / np.sqrt(under_root)
    quality[(six_volumes == 0) | (under_root == 0)] = 0
    least = np.full(len(tetrahedra), 180.0)
    for (i, j), (k, m) in zip(EDGES, OTHERS):
        along = corners[:, j] - corners[:, i]
        u = np.cross(along, corners[:, k] - corners[:, i])
        v = np.cross(along, corners[:, m] - corners[:, i])
        angle = np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), (u * v).sum(1))
        least = np.minimum(least, np.degrees(angle))
    return quality, least


def triangle_shape(points, triangles):
    """Returns the quality 2 r_in / R and the least angle in degrees."""
    corners = points[triangles]
    opposite = np.roll(corners, -1, 1) - np.roll(corners, 1, 1)
    sides = np.linalg.norm(opposite, axis=2)
    twice = np.linalg.norm(np.cross(opposite[:, 0], opposite[:, 1]), axis=1)
    quality = 4 * twice ** 2 / (sides.prod(1) * sides.sum(1))
    short, middle, long = np.sort(sides, 1).T
    cosine = (middle ** 2 + long ** 2 - short ** 2) / (2 * middle * long)
    return quality, np.degrees(np.arctan2(twice / (middle * long), cosine))


def boundary_faces(tetrahedra):
    """Returns the faces that belong to one tetrahedron only, as (count, 3)."""
    faces = tetrahedra[:, FACES].reshape(-1, 3)
    _, first, count = np.unique(np.sort(faces, 1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def restricted(points, on_boundary, body):
    """Returns the tetrahedra of the nodes' Delaunay triangulation that fill the body. The
    triangulation of nodes on one sphere is arbitrary and may contain tetrahedra of no volume, which
    are removed."""
    whole = Delaunay(points)
    # The last entry stands for -1, beyond the hull.
    inside = np.append(body.contains(points[whole.simplices].mean(1)), False)
    corners = points[whole.simplices]
    edge = np.linalg.norm(corners[:, EDGES[:, 1]] - corners[:, EDGES[:, 0]], axis=2)
    height = volume(points, whole.simplices) / edge.max(1) ** 3
    flat = height < FLAT
    in_question = flat & on_boundary[whole.simplices].all(1)
    while True:
        open_ones = in_question & inside[:-1] & ~inside[whole.neighbors].all(1)
        if not open_ones.any():
            return whole.simplices[inside[:-1] & (height > NOTHING)]
        inside[:-1][open_ones] = False
