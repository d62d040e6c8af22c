# SPDX-License-Identifier: BSD-3-Clause
"""Evaluates nodes whose sizes come from the shape, by SciPy's Delaunay triangulation. It measures
how well they follow a known d, or their sizes where the boundary is curved or the domain narrow."""
import numpy as np
from distance_to_boundary import DistanceToBoundary
from evaluate import Mesh
from evaluate_volume import EDGES, restricted
from scipy.spatial import cKDTree
from shape_cases import ACROSS, PER_TURN

BANDS = 8         # of d, with equal steps in log d
FEWEST = 100      # least number of edges of a band
ON_BOUNDARY = 0.1  # relative to a node's shortest edge: a node nearer to the boundary is on it
SMOOTH = 40       # largest angle in degrees between adjacent pieces of a smooth boundary
FACING = 20       # largest angle in degrees between the two sides of a gap
RAYS = 1000       # maximum number of rays that search for gaps


def evaluate(points, case):
    points = np.ascontiguousarray(points, float)
    # The boundary is the whole one, whatever d grows from.
    boundary = DistanceToBoundary(case.shape.pieces, case.largest / 4)
    shortest = cKDTree(points).query(points, 2)[0][:, 1]
    away, piece = boundary.nearest(points)
    on_boundary = away < ON_BOUNDARY * shortest
    edges = edges_of(points, on_boundary, case)
    length = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    found = {"nodes": len(points), "boundary_nodes": int(on_boundary.sum())}
    if not case.automatic:
        return {**found, **followed(points, edges, length, on_boundary, case)}
    return {**found, **sizes(points, edges, length, on_boundary, piece, case)}


def edges_of(points, on_boundary, case):
    """Returns each edge once, as (count, 2)."""
    if case.shape.dimension == 2:
        edges = Mesh(points, case.domain).edges()
    else:
        edges = restricted(points, on_boundary, case.domain)[:, EDGES].reshape(-1, 2)
    return np.unique(np.sort(edges, 1), axis=0)


def followed(points, edges, length, on_boundary, case):
    """Returns measures of edge lengths over the mean d at their ends, and the edge for which this
    ratio differs most from 1."""
    d = case.spacing(points)[edges].mean(1)
    ratio = length / d
    at_boundary = on_boundary[edges].all(1)
    worst = int(np.argmax(np.abs(np.log(ratio))))
    return {"edge_mean": float(ratio.mean()), "edge_deviation": float(ratio.std()),
            "edge_one_percent": float(np.quantile(ratio, 0.01)),
            "edge_99_percent": float(np.quantile(ratio, 0.99)),
            "edge_bands": band_means(d, ratio),
            **spread("boundary", ratio[at_boundary]), **spread("inside", ratio[~at_boundary]),
            "worst": float(ratio[worst]), "worst_at": points[edges[worst]].mean(0).tolist()}


def spread(where, ratio):
    return {f"{where}_mean": float(ratio.mean()) if len(ratio) else None,
            f"{where}_deviation": float(ratio.std()) if len(ratio) else None}


def band_means(d, ratio):
    low, high = np.log(d.min()), np.log(d.max())
    if high - low < 0.1:
        return [float(ratio.mean())]
    band = np.minimum((BANDS * (np.log(d) - low) / (high - low)).astype(int), BANDS - 1)
    counts = np.bincount(band, minlength=BANDS)
    return [float(s / n) for s, n in zip(np.bincount(band, ratio, BANDS), counts) if n >= FEWEST]


def sizes(points, edges, length, on_boundary, piece, case):
    """Returns measures of the nodes' sizes, which are the mean lengths of their edges."""
    count = np.bincount(edges.ravel(), minlength=len(points))
    size = np.bincount(edges.ravel(), np.repeat(length, 2), len(points)) / np.maximum(count, 1)
    growth = np.abs(size[edges[:, 0]] - size[edges[:, 1]]) / length
    # Circumference of the circle of curvature.
    turn = 2 * np.pi / np.maximum(curvature(case)[piece], 1e-300)
    asked = on_boundary & (turn / PER_TURN < case.largest) & (count > 0)
    per_turn = turn[asked] / size[asked]
    places, width = gaps(case)
    if len(places):
        used = np.flatnonzero(count)
        across = width / size[used[cKDTree(points[used]).query(places)[1]]]
    return {"size_least": float(size[count > 0].min()), "size_mean": float(size[count > 0].mean()),
            "size_largest": float(size.max()),
            "growth_99_percent": float(np.quantile(growth, 0.99)),
            "curved": int(asked.sum()), "per_turn": quantiles(per_turn),
            "gaps": len(places), "across": quantiles(across) if len(places) else None}


def quantiles(values):
    """Returns the 5 % quantile and the median."""
    return [float(q) for q in np.quantile(values, [0.05, 0.5])] if len(values) else None


def curvature(case):
    """Returns the curvature of each piece of the input: the largest turn of the normal towards an
    adjacent piece, divided by the distance of their centres. Edges and corners, where it turns by
    more, do not count."""
    pieces, result = case.shape.pieces, np.zeros(len(case.shape.pieces))
    normal, middle = normals(pieces), pieces.mean(1)
    ends = case.domain.segments if pieces.shape[1] == 2 else case.domain.triangles()
    sides = ends if pieces.shape[1] == 2 else np.sort(
        np.stack([ends, np.roll(ends, -1, 1)], 2), 2)
    number = np.repeat(np.arange(len(pieces)), pieces.shape[1])
    keys = np.unique(sides.reshape(-1, *sides.shape[2:]), axis=0, return_inverse=True)[1].ravel()
    order = np.argsort(keys, kind="stable")
    together = keys[order][1:] == keys[order][:-1]
    first, second = number[order][:-1][together], number[order][1:][together]
    # Segments have either direction, so "ahead" is away from the shared end.
    if pieces.shape[1] == 2:
        shared = case.domain.vertices[sides.ravel()[order[:-1][together]]]
        back, on = ((way / np.linalg.norm(way, axis=1)[:, None])
                    for way in (shared - middle[first], middle[second] - shared))
        cosine = (back * on).sum(1)
    else:
        cosine = (normal[first] * normal[second]).sum(1)
    angle = np.arccos(np.clip(cosine, -1, 1))
    way = np.linalg.norm(middle[first] - middle[second], axis=1)
    if pieces.shape[1] == 3:  # uses the component across the common side only
        shared = case.domain.vertices[sides.reshape(-1, 2)[order[:-1][together]]]
        along = shared[:, 1] - shared[:, 0]
        along /= np.linalg.norm(along, axis=1)[:, None]
        between = middle[second] - middle[first]
        way = np.linalg.norm(between - (between * along).sum(1)[:, None] * along, axis=1)
    bend = np.where(angle < np.radians(SMOOTH), angle, 0) / np.maximum(way, 1e-300)
    for which in (first, second):
        np.maximum.at(result, which, bend)
    return result


def normals(pieces):
    along = pieces[:, 1] - pieces[:, 0]
    if pieces.shape[1] == 2:
        normal = np.column_stack([along[:, 1], -along[:, 0]])
    else:
        normal = np.cross(along, pieces[:, 2] - pieces[:, 0])
    return normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]


def gaps(case):
    """Returns the gaps that need a d below the largest: positions and widths. A ray inward from the
    boundary meets a facing side, and the position is the middle of this ray."""
    pieces = case.shape.pieces
    normal, middle = normals(pieces), pieces.mean(1)
    tiny = 1e-6 * case.shape.width()
    chosen = np.arange(0, len(pieces), max(1, len(pieces) // RAYS))
    inward = np.where(case.domain.contains(middle + tiny * normal)[:, None], normal, -normal)
    width = np.array([way_ahead(middle[k] + tiny * inward[k], inward[k], k, pieces, inward)
                      for k in chosen]) + tiny
    narrow = width < ACROSS * case.largest
    return middle[chosen][narrow] + 0.5 * width[narrow, None] * inward[chosen][narrow], width[narrow]


def way_ahead(origin, ahead, own, pieces, inward):
    """Returns the distance along a ray to the nearest of all pieces if this piece faces the ray,
    else infinity."""
    a, sides = pieces[:, 0], pieces[:, 1:] - pieces[:, :1]
    matrix = np.concatenate([sides, np.broadcast_to(-ahead, (len(pieces), 1, len(ahead)))], 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse_volume = 1 / np.linalg.det(matrix)
        # Cramer's rule replaces each row in turn by the vector from the piece's first corner.
        shares = []
        for row in range(matrix.shape[1]):
            replaced = matrix.copy()
            replaced[:, row] = origin - a
            shares.append(np.linalg.det(replaced) * inverse_volume)
        *within, way = shares
        hit = (np.min(within, 0) >= 0) & (np.sum(within, 0) <= 1) & (way > 0)
    hit[own] = False
    if not hit.any():
        return np.inf
    first = np.flatnonzero(hit)[np.argmin(way[hit])]
    facing = -(inward[first] @ ahead) > np.cos(np.radians(FACING))
    return way[first] if facing else np.inf
