# SPDX-License-Identifier: BSD-3-Clause
"""Is the boundary of tetrahedra the surface of a body? By corners and places alone, with no code of the
library's: whole means a closed surface with two triangles at each edge and one fan of them around each
node, as many pieces and handles as the body has, and no node in no tetrahedron."""
import sys
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "peers"))
from evaluate_volume import FACES, boundary_faces, shape  # noqa: E402

SMALL_ANGLE = 20  # degrees


def corner_points(x, triangles):
    return x[triangles[:, 0]], x[triangles[:, 1]], x[triangles[:, 2]]


def joined(x, triangles):
    """Points in one place become one; triangles that thereby vanish go."""
    x, places = np.unique(x, axis=0, return_inverse=True)
    a, b, c = places.reshape(-1)[triangles].T
    return x, np.column_stack([a, b, c])[(a != b) & (b != c) & (a != c)]


def crowded_faces(tetrahedra):
    """How many faces have more than two tetrahedra."""
    faces = np.sort(tetrahedra[:, FACES].reshape(-1, 3), 1)
    return int((np.unique(faces, axis=0, return_counts=True)[1] > 2).sum())


def pieces(pairs, count):
    ones = np.ones(len(pairs))
    return connected_components(coo_matrix((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count)),
                                directed=False)[1]


def fans_at(triangles):
    """Of each node, how many fans its triangles make, joined across edges."""
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


def topology(triangles):
    edges, count = np.unique(np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]],
                                                     triangles[:, [2, 0]]]), 1), axis=0, return_counts=True)
    nodes = np.unique(triangles)
    piece = pieces(edges, triangles.max() + 1)[nodes]
    return {"pieces": len(np.unique(piece)), "euler": len(nodes) - len(edges) + len(triangles),
            "torn_edges": int((count != 2).sum()), "torn_nodes": int((fans_at(triangles)[nodes] > 1).sum())}


def spread(x, triangles, apart):
    """The corners, and points so far apart on the triangles, about."""
    a, b, c = corner_points(x, triangles)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    count = int(min(2e6, max(1000, 2 * area.sum() / apart**2)))
    random = np.random.default_rng(1)
    k = random.choice(len(triangles), count, p=area / area.sum())
    u, v = np.sqrt(random.random(count))[:, None], random.random(count)[:, None]
    return np.concatenate([(1 - u) * a[k] + u * (1 - v) * b[k] + u * v * c[k], x[np.unique(triangles)]])


def judged(body, x, tetrahedra):
    """`body`: points and triangles of its surface. Distances are in median edges of the boundary."""
    body_x, body_triangles = joined(*body)
    boundary = boundary_faces(tetrahedra)
    figures = {"nodes": len(x), "tetrahedra": len(tetrahedra), "crowded_faces": crowded_faces(tetrahedra),
               "isolated": len(x) - len(np.unique(tetrahedra)), **topology(boundary)}
    wanted = topology(body_triangles)
    a, b, _ = corner_points(x, boundary)
    edge = np.median(np.linalg.norm(b - a, axis=1))
    own, body_points = spread(x, boundary, edge / 10), spread(body_x, body_triangles, edge / 10)
    figures["from_body"] = float(cKDTree(own).query(body_points)[0].max() / edge)
    figures["to_body"] = float(cKDTree(body_points).query(own)[0].max() / edge)
    _, angles = shape(x, tetrahedra)
    figures["least_angle"], figures["small_angles"] = float(angles.min()), int((angles < SMALL_ANGLE).sum())
    corners = x[tetrahedra]
    sides = corners[:, 1:] - corners[:, :1]
    figures["turned_over"] = int((np.linalg.det(sides) <= 0).sum())
    figures["pieces_of_body"], figures["euler_of_body"] = wanted["pieces"], wanted["euler"]
    figures["whole"] = (
        figures["pieces"] == wanted["pieces"] and figures["euler"] == wanted["euler"]
        and not any(figures[name] for name in
                    ("crowded_faces", "isolated", "torn_edges", "torn_nodes", "turned_over")))
    return figures
