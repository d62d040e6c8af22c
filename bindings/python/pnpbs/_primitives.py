# SPDX-License-Identifier: BSD-3-Clause
"""Triangles of boxes, balls and cylinders, for surfaces that do not bound the domain. The library
merges their common vertices. Normals point outwards."""

from __future__ import annotations

import itertools

import numpy as np

from ._types import Doubles

_CUTS = 6  # of an icosahedron, so that triangles lie within 1e-4 of the radius
_STRIPS = 256  # of a cylinder, for the same


def box_triangles(low: Doubles, high: Doubles) -> Doubles:
    """Returns the triangles of a box, two for each side, of shape (n, 3, 3)."""
    low, high = np.minimum(low, high), np.maximum(low, high)
    triangles = []
    for axis, end in itertools.product(range(3), (low, high)):
        quad = np.array([low, low, high, high])
        across, up = (axis + 1) % 3, (axis + 2) % 3
        quad[:, across] = low[across], high[across], high[across], low[across]
        quad[:, up] = low[up], low[up], high[up], high[up]
        quad[:, axis] = end[axis]
        triangles += [quad[[0, 1, 2]], quad[[0, 2, 3]]]
    return _outwards(np.array(triangles), 0.5 * (low + high))


def ball_triangles(centre: Doubles, radius: float) -> Doubles:
    """Returns the triangles of a ball, of shape (n, 3, 3)."""
    golden = (1 + 5**0.5) / 2
    vertices = np.array([np.roll((0, y, golden * z), turn)
                         for turn in range(3) for y in (-1, 1) for z in (-1, 1)])
    faces = [face for face in itertools.combinations(vertices, 3)
             if all(np.isclose(np.linalg.norm(a - b), 2) for a, b in itertools.combinations(face, 2))]
    triangles = _unit(np.array(faces))
    for _ in range(_CUTS):
        a, b, c = triangles.transpose(1, 0, 2)
        ab, bc, ca = _unit(a + b), _unit(b + c), _unit(c + a)
        triangles = np.concatenate([np.stack(corners, axis=1) for corners in
                                    ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return _outwards(centre + radius * triangles, centre)


def cylinder_triangles(begin: Doubles, end: Doubles, radius: float) -> Doubles:
    """Returns the triangles of a circular cylinder, of shape (n, 3, 3)."""
    axis = _unit(end - begin)
    across = np.cross(axis, np.eye(3)[np.argmin(abs(axis))])
    u = _unit(across)
    angles = 2 * np.pi * np.arange(_STRIPS)[:, None] / _STRIPS
    around = radius * (np.cos(angles) * u + np.sin(angles) * np.cross(axis, u))
    following = np.roll(around, -1, axis=0)
    low, high = np.broadcast_to(begin, around.shape), np.broadcast_to(end, around.shape)
    corners = ((low + around, low + following, high + following),
               (low + around, high + following, high + around),
               (low, low + following, low + around), (high, high + around, high + following))
    return _outwards(np.concatenate([np.stack(three, axis=1) for three in corners]),
                     0.5 * (begin + end))


def _unit(vectors: Doubles) -> Doubles:
    unit: Doubles = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return unit


def _outwards(triangles: Doubles, centre: Doubles) -> Doubles:
    """Returns the triangles of a convex body around a centre with normals that point outwards."""
    turned = triangles[np.linalg.det(triangles - centre) < 0]
    triangles[np.linalg.det(triangles - centre) < 0] = turned[:, [0, 2, 1]]
    return triangles
