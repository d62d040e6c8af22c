# SPDX-License-Identifier: BSD-3-Clause
"""Splits a body of several separate solids into one body per solid, with its outer surface and
cavities."""
import bodies
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


def surfaces(body):
    """Returns the closed surfaces of the body, each as a body."""
    triangles = body.triangles()
    links = coo_matrix((np.ones(len(triangles)), triangles.T[:2]), shape=(len(body.vertices),) * 2)
    piece = connected_components(links, directed=False)[1][triangles[:, 0]]
    return [part(body.vertices, triangles[piece == k]) for k in np.unique(piece)]


def part(vertices, triangles):
    used, corners = np.unique(triangles, return_inverse=True)
    return bodies.Body("file", vertices[used], corners.reshape(-1, 3).tolist())


def joined(parts):
    firsts = np.cumsum([0, *(len(p.vertices) for p in parts)])
    return bodies.Body("file", np.concatenate([p.vertices for p in parts]),
                       np.concatenate([p.triangles() + k for p, k in zip(parts, firsts)]).tolist())


def solids(body):
    """Returns the solids. A cavity belongs to the smallest outer surface that contains it."""
    found = surfaces(body)
    outer = sorted((s for s in found if s.volume() > 0), key=lambda s: s.volume())
    groups = [[s] for s in outer]
    for cavity in found:
        if cavity.volume() < 0:
            around = [k for k, s in enumerate(outer) if s.contains(cavity.vertices[:1])[0]]
            groups[around[0]].append(cavity)
    return [joined(group) for group in groups]
