# SPDX-License-Identifier: BSD-3-Clause
"""The distance of many points from a closed loop of straight segments."""
import numpy as np
from scipy.spatial import cKDTree

GROUP = 16  # segments


def distance_to_loop(points, loop):
    """Returns exact distances. Groups of segments whose circle is farther away than the nearest
    corner are skipped."""
    square = cKDTree(loop).query(points)[0] ** 2
    for first in range(0, len(loop), GROUP):
        corners = loop[np.arange(first, min(first + GROUP, len(loop)) + 1) % len(loop)]
        middle = 0.5 * (corners[0] + corners[-1])
        radius = np.hypot(*(corners - middle).T).max()
        near = np.flatnonzero(np.hypot(*(points - middle).T) - radius < np.sqrt(square))
        square[near] = np.minimum(square[near], square_to_segments(points[near], corners))
    return np.sqrt(square)


def square_to_segments(points, corners):
    """Returns the squared distance to the nearest of the segments from corner to corner."""
    x, y = np.ascontiguousarray(points.T)
    least = np.full(len(points), np.inf)
    for (ax, ay), (bx, by) in zip(corners, corners[1:]):
        ex, ey, rx, ry = bx - ax, by - ay, x - ax, y - ay
        t = np.clip((rx * ex + ry * ey) / (ex * ex + ey * ey), 0, 1)
        np.minimum(least, (rx - t * ex) ** 2 + (ry - t * ey) ** 2, out=least)
    return least
