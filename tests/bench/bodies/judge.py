# SPDX-License-Identifier: BSD-3-Clause
"""Checks whether the boundary of tetrahedra is the surface of a body.

It uses only corners and positions and no code of the library. A result is whole if its boundary is
a closed surface with two triangles at each edge and one fan of triangles around each node, if it
has as many pieces and handles as the body, and if each node belongs to a tetrahedron."""
import sys
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "peers"))
from evaluate import lower_quantile  # noqa: E402
from evaluate_volume import EDGES, FACES, boundary_faces, shape  # noqa: E402
from sharp_edges import near_sharp_edges  # noqa: E402

SMALL_ANGLE = 20  # degrees
# Limit of the volume over the cube of the longest edge, which is 0.118 for a regular tetrahedron.
FLAT = 1e-9
PLACES = 5        # maximum number of reported positions where the boundary is torn


def corner_points(x, triangles):
    return x[triangles[:, 0]], x[triangles[:, 1]], x[triangles[:, 2]]


def joined(x, triangles):
    """Merges coincident points. Triangles that become degenerate are removed."""
    x, places = np.unique(x, axis=0, return_inverse=True)
    a, b, c = places.reshape(-1)[triangles].T
    return x, np.column_stack([a, b, c])[(a != b) & (b != c) & (a != c)]


def crowded_faces(tetrahedra):
    """Returns the number of faces with more than two tetrahedra."""
    faces = np.sort(tetrahedra[:, FACES].reshape(-1, 3), 1)
    return int((np.unique(faces, axis=0, return_counts=True)[1] > 2).sum())


def pieces(pairs, count):
    ones = np.ones(len(pairs))
    return connected_components(coo_matrix((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count)),
                                directed=False)[1]


def fans_at(triangles):
    """Returns for each node the number of fans that its triangles form. Triangles in a fan share
    edges."""
    corners = np.arange(triangles.size).reshape(-1, 3)
    edges = np.concatenate([np.column_stack([triangles[:, i], triangles[:, j], corners[:, i], corners[:, j]])
                            for i, j in ((0, 1), (1, 2), (2, 0))])
    turned = edges[:, 0] > edges[:, 1]
    edges[turned] = edges[turned][:, [1, 0, 3, 2]]
    edges = edges[np.lexsort((edges[:, 1], edges[:, 0]))]
    same = (edges[1:, :2] == edges[:-1, :2]).all(1)
    one, other = edges[:-1][same], edges[1:][same]
    fan = pieces(np.concatenate([np.column_stack([one[:, k], other[:, k]]) for k in (2, 3)]), triangles.size)
    node = np.zeros(fan.max() + 1, int)
    node[fan] = triangles.reshape(-1)
    return np.bincount(node, minlength=triangles.max() + 1)


def edges_of(triangles):
    """Returns each edge once, and its number of triangles."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(sides, 1), axis=0, return_counts=True)


def torn_at(triangles):
    """Returns the nodes whose triangles do not form one fan, and those of edges without exactly two
    triangles."""
    edges, count = edges_of(triangles)
    return np.union1d(np.flatnonzero(fans_at(triangles) > 1), edges[count != 2])


def topology(triangles):
    edges, count = edges_of(triangles)
    nodes = np.unique(triangles)
    piece = pieces(edges, triangles.max() + 1)[nodes]
    return {"pieces": len(np.unique(piece)), "euler": len(nodes) - len(edges) + len(triangles),
            "torn_edges": int((count != 2).sum()), "torn_nodes": int((fans_at(triangles)[nodes] > 1).sum())}


def spread(x, triangles, apart):
    """Returns the corners, and points on the triangles about this distance apart."""
    a, b, c = corner_points(x, triangles)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    count = int(min(2e6, max(1000, 2 * area.sum() / apart**2)))
    random = np.random.default_rng(1)
    k = random.choice(len(triangles), count, p=area / area.sum())
    u, v = np.sqrt(random.random(count))[:, None], random.random(count)[:, None]
    return np.concatenate([(1 - u) * a[k] + u * (1 - v) * b[k] + u * v * c[k], x[np.unique(triangles)]])


def flat(x, tetrahedra):
    """Returns the number of tetrahedra whose volume is zero within rounding."""
    corners = x[tetrahedra]
    longest = np.max([np.linalg.norm(corners[:, i] - corners[:, j], axis=1) for i, j in EDGES], 0)
    volume = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    return int((volume < FLAT * longest ** 3).sum())


def volume_of_body(x, triangles):
    """Of a closed surface whose triangles turn outwards."""
    a, b, c = corner_points(x, triangles)
    return float(np.einsum("ij,ij->", np.cross(a, b), c) / 6)


def volume_of(x, tetrahedra):
    corners = x[tetrahedra]
    return float(np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6)


def least(values):
    return float(values.min()) if len(values) else None


def distances(body, x, boundary, unit):
    """Returns the largest distance of a point on one surface to the other surface, in units, for
    both directions."""
    own, others = spread(x, boundary, unit / 10), spread(*body, unit / 10)
    return {"from_body": float(cKDTree(own).query(others)[0].max() / unit),
            "to_body": float(cKDTree(others).query(own)[0].max() / unit)}


def shapes(body, x, tetrahedra, reach):
    """Returns quality and angles. The least angles at sharp edges of the body are reported
    separately."""
    quality, angles = shape(x, tetrahedra)
    sharp = near_sharp_edges(body, x, tetrahedra, reach)
    corners = x[tetrahedra]
    return {"quality_mean": float(quality.mean()), "quality_one_percent": lower_quantile(quality, 0.01),
            "least_angle": float(angles.min()), "small_angles": int((angles < SMALL_ANGLE).sum()),
            "at_sharp_edges": int(sharp.sum()), "least_angle_at_sharp_edges": least(angles[sharp]),
            "least_angle_elsewhere": least(angles[~sharp]),
            "flat": flat(x, tetrahedra),
            "turned_over": int((np.linalg.det(corners[:, 1:] - corners[:, :1]) <= 0).sum())}


def is_whole(figures):
    return (figures["pieces"] == figures["pieces_of_body"] and figures["euler"] == figures["euler_of_body"]
            and not any(figures[name] for name in
                        ("crowded_faces", "isolated", "torn_edges", "torn_nodes", "turned_over")))


def judged(body, x, tetrahedra, unit=None):
    """Evaluates tetrahedra. `body` consists of points and triangles of its surface. Distances are
    in units of `unit`, by default the median boundary edge."""
    body = joined(*body)
    boundary = boundary_faces(tetrahedra)
    a, b, _ = corner_points(x, boundary)
    unit = unit or float(np.median(np.linalg.norm(b - a, axis=1)))
    wanted = topology(body[1])
    figures = {"nodes": len(x), "tetrahedra": len(tetrahedra), "crowded_faces": crowded_faces(tetrahedra),
               "isolated": len(x) - len(np.unique(tetrahedra)), **topology(boundary),
               "pieces_of_body": wanted["pieces"], "euler_of_body": wanted["euler"],
               "volume": volume_of(x, tetrahedra), "volume_of_body": volume_of_body(*body),
               **distances(body, x, boundary, unit), **shapes(body, x, tetrahedra, unit),
               "unit": unit, "torn_at": x[torn_at(boundary)[:PLACES]].tolist()}
    return {**figures, "whole": is_whole(figures)}
