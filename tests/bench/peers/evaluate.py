# SPDX-License-Identifier: BSD-3-Clause
"""Evaluates a node set of any tool by a Delaunay triangulation of SciPy (Qhull).

Triangles with their centroid outside the domain are removed. Boundary edges are not enforced. Where
nodes see each other across a thin strip of land, triangles cross it. These count as "crossing" and
in the measures of all triangles. "wide" measures exclude them and their neighbours. Like
../evaluate.hpp, they also exclude what no node set can improve: triangles at a boundary edge
shorter than 0.7 d, and those through whose centroid some chord of the domain is shorter than 3 d.
"""
import numpy as np
from scipy.spatial import Delaunay, cKDTree

CHORDS = 12        # directions in which the width of the domain is measured
NARROW = 3         # spacings
SHORT_EDGE = 0.7   # spacings
BANDS = 8          # of d, with equal steps in log d
FEWEST = 100       # least number of edges of a band
RINGS = 3          # rings of triangles from the boundary in which the domain can be narrow
HISTOGRAM = np.linspace(0.5, 1, 51)


def evaluate(points, domain, spacing):
    """Evaluates points (n, 2) for a Domain and a spacing function of points. Returns a dict of
    measures, all of them plain numbers."""
    points = np.ascontiguousarray(points, float)
    d = spacing(points)
    mesh = Mesh(points, domain)
    quality, angle = shape(points, mesh.triangles)
    crossing = across_boundary(mesh, domain)
    wide = mendable(mesh, d) & ~crossing & ~touching(mesh, crossing)
    edges = np.unique(np.sort(mesh.edges(), 1), axis=0)
    lengths = np.hypot(*(points[edges[:, 0]] - points[edges[:, 1]]).T)
    ratio = lengths / (0.5 * (d[edges[:, 0]] + d[edges[:, 1]]))
    nearest = cKDTree(points).query(points, 2)[0][:, 1]
    inner = np.ones(len(points), bool)
    inner[mesh.boundary_edges().ravel()] = False
    inner[np.setdiff1d(np.arange(len(points)), mesh.triangles)] = False
    cell = cell_radius(points, mesh.triangles)[inner] / nearest[inner]
    return {
        "nodes": len(points),
        "triangles": len(mesh.triangles),
        "crossing": int(crossing.sum()),
        "covered": float(area(points, mesh.triangles).sum() / domain.area()),
        "quality_mean": float(quality.mean()),
        "quality_one_percent": lower_quantile(quality, 0.01),
        "quality_least": float(quality.min()),
        "angle_least": float(angle.min()),
        "wide_triangles": int(wide.sum()),
        "wide_quality_mean": float(quality[wide].mean()) if wide.any() else None,
        "wide_quality_one_percent": lower_quantile(quality[wide], 0.01) if wide.any() else None,
        "wide_quality_least": float(quality[wide].min()) if wide.any() else None,
        "wide_angle_least": float(angle[wide].min()) if wide.any() else None,
        "edge_mean": float(ratio.mean()),
        "edge_deviation": float(ratio.std()),
        "edge_bands": band_means(0.5 * (d[edges[:, 0]] + d[edges[:, 1]]), ratio),
        "nearest_mean": float((nearest / d).mean()),
        "nearest_deviation": float((nearest / d).std()),
        "cell_99_percent": float(np.quantile(cell, 0.99)) if len(cell) else None,
        "histogram": np.histogram(np.clip(quality, HISTOGRAM[0], 1), HISTOGRAM)[0].tolist(),
    }


def band_means(d, ratio):
    """Returns the mean of edge over d in each band of d, from the finest on, without bands of few
    edges."""
    low, high = np.log(d.min()), np.log(d.max())
    if high - low < 0.1:
        return [float(ratio.mean())]
    band = np.minimum((BANDS * (np.log(d) - low) / (high - low)).astype(int), BANDS - 1)
    counts = np.bincount(band, minlength=BANDS)
    sums = np.bincount(band, ratio, minlength=BANDS)
    return [float(s / n) for s, n in zip(sums, counts) if n >= FEWEST]


def lower_quantile(values, share):
    """Returns the value below which this share of the values lies, without interpolation, as in
    ../evaluate.cpp."""
    return float(np.partition(values, int(share * len(values)))[int(share * len(values))])


class Mesh:
    """The Delaunay triangles inside the domain with their neighbours."""

    def __init__(self, points, domain):
        whole = Delaunay(points)
        if len(whole.coplanar):
            raise ValueError(f"{len(whole.coplanar)} nodes coincide with others")
        kept = domain.contains(points[whole.simplices].mean(1))
        kept &= ~flat_on_boundary(points, whole.simplices, domain)
        # The last entry stands for Qhull's -1, outside the hull.
        number = np.full(len(kept) + 1, -1)
        number[:-1][kept] = np.arange(kept.sum())
        self.points = points
        self.triangles = whole.simplices[kept]
        self.neighbours = number[whole.neighbors[kept]]  # -1 across the boundary

    def edges(self):
        """Returns the edge opposite each corner, three rows for each triangle."""
        return self.triangles[:, [1, 2, 2, 0, 0, 1]].reshape(-1, 2)

    def boundary_edges(self):
        return self.edges()[self.neighbours.ravel() < 0]


def flat_on_boundary(points, triangles, domain):
    """Returns which triangles are degenerate between nodes in a straight row of the boundary.
    Rounding gives them a tiny height, and they are no part of a mesh. Flat triangles elsewhere are
    kept."""
    corners = points[triangles]
    sides = np.hypot(*(corners - np.roll(corners, 1, 1)).transpose(2, 0, 1))
    longest = sides.max(1)
    flat = 2 * np.abs(area(points, triangles)) < 1e-9 * longest ** 2
    a, b = domain.ends()
    for t in np.flatnonzero(flat):
        middle = corners[t].mean(0)
        along = np.clip(((middle - a) * (b - a)).sum(1) / ((b - a) ** 2).sum(1), 0, 1)
        way = np.hypot(*(a + along[:, None] * (b - a) - middle).T).min()
        flat[t] = way < 1e-8 * longest[t]
    return flat


def area(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    return 0.5 * np.abs((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1])
                        - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))


def side_lengths(points, triangles):
    """Returns the lengths of the sides opposite each corner."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.stack([np.hypot(*(c - b).T), np.hypot(*(a - c).T), np.hypot(*(b - a).T)])


def shape(points, triangles):
    """Returns the quality 2 r_in / R, 1 for an equilateral triangle, and the least angle in
    degrees."""
    sides = side_lengths(points, triangles)
    whole = area(points, triangles)
    quality = 16 * whole ** 2 / (sides.prod(0) * sides.sum(0))
    # The least angle is opposite the shortest side, between the two others.
    short, middle, long = np.sort(sides, 0)
    cosine = (middle ** 2 + long ** 2 - short ** 2) / (2 * middle * long)
    return quality, np.degrees(np.arctan2(2 * whole / (middle * long), cosine))


def cell_radius(points, triangles):
    """Returns the farthest corner of each node's Voronoi cell, which is the largest circumradius
    around it."""
    radius = side_lengths(points, triangles).prod(0) / (4 * area(points, triangles))
    largest = np.zeros(len(points))
    for corner in range(3):
        np.maximum.at(largest, triangles[:, corner], radius)
    return largest


def across_boundary(mesh, domain):
    """Returns which triangles have an inner edge that crosses a segment."""
    first, corner = np.nonzero(mesh.neighbours > np.arange(len(mesh.triangles))[:, None])
    second = mesh.neighbours[first, corner]
    edges = mesh.edges().reshape(-1, 3, 2)[first, corner]
    p, q = mesh.points[edges[:, 0]], mesh.points[edges[:, 1]]
    if len(edges) == 0:
        return np.zeros(len(mesh.triangles), bool)
    tree = cKDTree(0.5 * (p + q))
    reach = 0.5 * np.hypot(*(p - q).T).max()
    found = np.zeros(len(mesh.triangles), bool)
    for a, b in zip(*domain.ends()):
        near = tree.query_ball_point(0.5 * (a + b), reach + 0.5 * np.hypot(*(b - a)))
        hit = np.array(near, int)[cross(a, b, p[near], q[near])]
        found[first[hit]] = found[second[hit]] = True
    return found


def cross(a, b, p, q):
    """Returns whether the segment ab crosses those pq by more than rounding."""
    def height(u, v, w):  # height of w over the line uv, in units of its length
        e, r = v - u, w - u
        return (e[..., 0] * r[..., 1] - e[..., 1] * r[..., 0]) / (e ** 2).sum(-1)

    def on_both_sides(one, other):
        return (one * other < 0) & (np.minimum(np.abs(one), np.abs(other)) > 1e-9)

    return (on_both_sides(height(a, b, p), height(a, b, q))
            & on_both_sides(height(p, q, a), height(p, q, b)))


def touching(mesh, chosen):
    """Returns which triangles have an edge in common with a chosen one."""
    # The last entry stands for triangles beyond the boundary.
    return (np.append(chosen, False)[mesh.neighbours]).any(1)


def mendable(mesh, d):
    """Returns which triangles a better node set could improve."""
    edges = mesh.boundary_edges()
    length = np.hypot(*(mesh.points[edges[:, 0]] - mesh.points[edges[:, 1]]).T)
    by_short_edge = np.zeros(len(d), bool)
    by_short_edge[edges[length < SHORT_EDGE * d[edges].mean(1)].ravel()] = True
    near = np.zeros(len(d), bool)
    near[edges.ravel()] = True
    for _ in range(RINGS):
        touched = near[mesh.triangles].any(1)
        near[mesh.triangles[touched].ravel()] = True
    wide = ~by_short_edge[mesh.triangles].any(1)
    in_question = np.flatnonzero(wide & near[mesh.triangles].any(1))
    for first in range(0, len(in_question), 20000):  # limits the memory
        some = in_question[first:first + 20000]
        wide[some] = ~narrow(mesh, some, d[mesh.triangles[some]].mean(1))
    return wide


def narrow(mesh, triangles, d):
    middle = mesh.points[mesh.triangles[triangles]].mean(1)
    found = np.zeros(len(triangles), bool)
    for chord in range(CHORDS):
        # These directions differ from those of the rows of lattices.
        angle = (chord + 0.2718) * np.pi / CHORDS
        ahead = np.array([np.cos(angle), np.sin(angle)])
        length = (way_to_boundary(mesh, triangles, middle, ahead, NARROW * d)
                  + way_to_boundary(mesh, triangles, middle, -ahead, NARROW * d))
        found |= length < NARROW * d
    return found


def way_to_boundary(mesh, start, origin, ahead, most):
    """Returns the distance to the boundary from origins inside their start triangles, straight
    ahead through the triangles, at most `most`. All rays advance together, each by one triangle per
    round."""
    way = most.copy()
    ray = np.arange(len(start))  # rays that have not arrived
    at, before = start.copy(), np.full(len(start), -1)
    for _ in range(100):  # a ray that circles a node for ever counts as long
        if len(ray) == 0:
            break
        corners = mesh.points[mesh.triangles[at]]
        from_origin = corners - origin[ray, None, :]
        best, out = np.full(len(ray), np.inf), np.full(len(ray), -1)
        for k in range(3):
            a, b = from_origin[:, (k + 1) % 3], from_origin[:, (k + 2) % 3]
            e = b - a
            det = ahead[0] * e[:, 1] - ahead[1] * e[:, 0]
            with np.errstate(divide="ignore", invalid="ignore"):
                s = (a[:, 0] * e[:, 1] - a[:, 1] * e[:, 0]) / det
                u = (a[:, 0] * ahead[1] - a[:, 1] * ahead[0]) / det
            other = mesh.neighbours[at, k]
            hit = (s >= 0) & (u >= -1e-12) & (u <= 1 + 1e-12) & (s < best)
            hit &= (before < 0) | (other != before)
            best[hit], out[hit] = s[hit], k
        follow = (out >= 0) & (best < most[ray])
        beyond = np.full(len(ray), -1)
        beyond[follow] = mesh.neighbours[at[follow], out[follow]]
        arrived = follow & (beyond < 0)
        way[ray[arrived]] = best[arrived]
        on = beyond >= 0
        ray, before, at = ray[on], at[on], beyond[on]
    return way
