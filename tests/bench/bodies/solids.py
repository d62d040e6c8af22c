# SPDX-License-Identifier: BSD-3-Clause
"""A body of several solids, that touch nowhere, as one body each: its outer surface and its cavities."""
import bodies
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


def surfaces(body):
    """The closed surfaces that it consists of, each a body."""
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
    """A cavity belongs to the smallest outer surface that has it inside."""
    found = surfaces(body)
    outer = sorted((s for s in found if s.volume() > 0), key=lambda s: s.volume())
    groups = [[s] for s in outer]
    for cavity in found:
        if cavity.volume() < 0:
            around = [k for k, s in enumerate(outer) if s.contains(cavity.vertices[:1])[0]]
            groups[around[0]].append(cavity)
    return [joined(group) for group in groups]
