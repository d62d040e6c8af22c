# SPDX-License-Identifier: BSD-3-Clause
"""Finds sharp edges of a body. Where two sheets of its surface meet at a sharp angle, no
tetrahedron can have a larger angle than the body, so the angles there are reported separately."""
import numpy as np
from scipy.spatial import cKDTree

SHARP = 33           # degrees between the sheets, measured inside the body
STEPS_TO_REACH = 10  # steps of the points along an edge within `reach`


def unit_normals(x, triangles):
    a, b, c = x[triangles].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    return normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]


def outward(x, triangles):
    """Returns the triangles, all reversed if needed, so that the enclosed volume is positive."""
    a, b, c = x[triangles].transpose(1, 0, 2)
    return triangles if (a * np.cross(b, c)).sum() >= 0 else triangles[:, ::-1]


def is_surface(triangles):
    """Returns whether each edge has two triangles that use it in opposite directions."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    both = np.concatenate([edges, edges[:, ::-1]])
    return len(np.unique(edges, axis=0)) == len(edges) and len(np.unique(both, axis=0)) == len(edges)


def opening_angles(x, triangles):
    """Returns the edges, and the angle between their two triangles inside the body, from 0 to 360
    degrees."""
    triangles = outward(x, triangles)
    ends = np.concatenate([triangles[:, [i, j]] for i, j in ((0, 1), (1, 2), (2, 0))])
    of = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort(np.sort(ends, 1).T)
    ends, of = ends[order], of[order]
    pair = np.flatnonzero((ends[1:] == ends[:-1, ::-1]).all(1))
    edges, one, other = ends[pair], of[pair], of[pair + 1]
    normal = unit_normals(x, triangles)
    along = x[edges[:, 1]] - x[edges[:, 0]]
    along /= np.linalg.norm(along, axis=1)[:, None]
    turn = np.arctan2((np.cross(normal[one], normal[other]) * along).sum(1),
                      (normal[one] * normal[other]).sum(1))
    return edges, 180 - np.degrees(turn)


def points_along(x, edges, apart):
    """Returns points on the edges, ends included, at most this distance apart."""
    a, b = x[edges[:, 0]], x[edges[:, 1]]
    pieces = np.ceil(np.linalg.norm(b - a, axis=1) / apart).astype(int) + 1
    edge = np.repeat(np.arange(len(edges)), pieces + 1)
    step = np.arange(len(edge)) - np.repeat(np.cumsum(pieces + 1) - (pieces + 1), pieces + 1)
    share = (step / pieces[edge])[:, None]
    return (1 - share) * a[edge] + share * b[edge]


def near_sharp_edges(body, x, tetrahedra, reach):
    """Returns for each tetrahedron whether a corner is within `reach` of a sharp edge of the body.
    """
    edges, angles = opening_angles(*body)
    sharp = edges[angles < SHARP]
    if len(sharp) == 0:
        return np.zeros(len(tetrahedra), bool)
    tree = cKDTree(points_along(body[0], sharp, reach / STEPS_TO_REACH))
    return (tree.query(x)[0] <= reach)[tetrahedra].any(1)
