# SPDX-License-Identifier: BSD-3-Clause
"""Reads points and triangles of a body from a file."""
import meshio
import numpy as np


def in_its_plane(points):
    """Returns two coordinates of each point, chosen so that the polygon is counter-clockwise."""
    normal = np.cross(points, np.roll(points, -1, 0)).sum(0)
    k = np.abs(normal).argmax()
    u, v = (k + 1) % 3, (k + 2) % 3
    return points[:, [u, v] if normal[k] > 0 else [v, u]]


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def cut_to_triangles(x, polygon):
    """Cuts a face, which need not be convex, into triangles: one ear after another, the widest
    first."""
    flat = dict(zip(polygon, in_its_plane(x[polygon])))
    left, triangles = list(polygon), []
    while len(left) > 3:
        ears = []
        for k in range(len(left)):
            a, b, c = left[k - 1], left[k], left[(k + 1) % len(left)]
            inside = [p for p in left if p not in (a, b, c) and all(
                turn(flat[i], flat[j], flat[p]) >= 0 for i, j in ((a, b), (b, c), (c, a)))]
            if not inside:
                ears.append((turn(flat[a], flat[b], flat[c]), k))
        _, k = max(ears)
        triangles.append([left[k - 1], left[k], left[(k + 1) % len(left)]])
        del left[k]
    return [*triangles, left]


def read_off(path):
    """Reads a format with one vertex or face per line. Faces are cut into triangles."""
    lines = [line.split("#")[0].split() for line in path.read_text(errors="replace").splitlines()]
    rows = [line for line in lines if line]
    if rows[0][0].endswith("OFF"):
        rows[:1] = [rows[0][1:]] if len(rows[0]) > 1 else []
    count, faces = int(rows[0][0]), int(rows[0][1])
    x = np.array([row[:3] for row in rows[1:1 + count]], float)
    triangles = []
    for row in rows[1 + count:1 + count + faces]:
        triangles += cut_to_triangles(x, [int(word) for word in row[1:1 + int(row[0])]])
    return x, np.array(triangles)


def read_body(path):
    if path.suffix == ".off":
        return read_off(path)
    mesh = meshio.read(path)
    return mesh.points, mesh.cells_dict["triangle"]
