# SPDX-License-Identifier: BSD-3-Clause
"""The distance of many points from segments in the plane or triangles in space, by a SciPy tree of
samples on them. It is exact with respect to the pieces of the nearest samples."""
import numpy as np
from scipy.spatial import cKDTree

NEAREST = 12  # number of nearest samples whose pieces are examined


class DistanceToBoundary:
    """Distances to pieces (count, 2 or 3, dimension), which are segments or triangles. Farther away
    than `step` other pieces than the examined ones can be nearer. The distance is then too large by
    at most a few hundredths of step."""

    def __init__(self, pieces, step):
        self.pieces = np.asarray(pieces, float)
        self.samples, self.piece = samples_of(self.pieces, step)
        self.tree = cKDTree(self.samples)

    def __call__(self, points):
        return self.nearest(points)[0]

    def nearest(self, points):
        """Returns distances and the numbers of the pieces."""
        looked_at = self.tree.query(points, min(NEAREST, len(self.samples)))[1]
        looked_at = looked_at.reshape(len(points), -1)
        away, number = np.full(len(points), np.inf), np.zeros(len(points), int)
        for sample in looked_at.T:
            pieces = self.piece[sample]
            found = distances(points, self.pieces[pieces])
            nearer = found < away
            away[nearer], number[nearer] = found[nearer], pieces[nearer]
        return away, number


def samples_of(pieces, step):
    """Returns points at most `step` apart on every piece, corners included, and the piece of each
    point."""
    sides = np.linalg.norm(pieces - np.roll(pieces, 1, 1), axis=2).max(1)
    counts = np.maximum(1, np.ceil(sides / step)).astype(int)
    points, numbers = [], []
    for count in np.unique(counts):
        which = np.flatnonzero(counts == count)
        weights = lattice(count, pieces.shape[1])
        points.append(np.einsum("wc,pcd->pwd", weights, pieces[which]).reshape(-1, pieces.shape[2]))
        numbers.append(np.repeat(which, len(weights)))
    return np.concatenate(points), np.concatenate(numbers)


def lattice(count, corners):
    """Returns barycentric weights of points that divide each side into this number of parts."""
    i = np.arange(count + 1)
    if corners == 2:
        return np.column_stack([i, count - i]) / count
    a, b = (w.ravel() for w in np.meshgrid(i, i))
    a, b = a[a + b <= count], b[a + b <= count]
    return np.column_stack([a, b, count - a - b]) / count


def distances(points, pieces):
    """Returns the distance of each point from the piece in the same row."""
    if pieces.shape[1] == 2:
        return from_segment(points, pieces[:, 0], pieces[:, 1])
    a, b, c = pieces.transpose(1, 0, 2)
    away = np.minimum(np.minimum(from_segment(points, a, b), from_segment(points, b, c)),
                      from_segment(points, c, a))
    u, v, w = b - a, c - a, points - a
    uu, uv, vv = dot(u, u), dot(u, v), dot(v, v)
    wu, wv, area = dot(w, u), dot(w, v), dot(u, u) * dot(v, v) - dot(u, v) ** 2
    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = (vv * wu - uv * wv) / area, (uu * wv - uv * wu) / area
    above = (s > 0) & (t > 0) & (s + t < 1)
    to_plane = w - s[:, None] * u - t[:, None] * v
    return np.where(above, np.sqrt(dot(to_plane, to_plane)), away)


def from_segment(points, a, b):
    along, way = b - a, points - a
    length = np.maximum(dot(along, along), 1e-300)
    rest = way - np.clip(dot(way, along) / length, 0, 1)[:, None] * along
    return np.sqrt(dot(rest, rest))


def dot(u, v):
    return (u * v).sum(1)
