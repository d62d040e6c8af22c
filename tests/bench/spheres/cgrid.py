# SPDX-License-Identifier: BSD-3-Clause
"""A C-grid of Voronoi cells on a sphere, from points alone or from an MPAS file, and the operators
of TRiSK on it (Ringler, Thuburn, Klemp and Skamarock, Journal of Computational Physics 229 (2010),
3065-3090). It shares no code with the library: The triangles are those of SciPy's convex hull."""
import numpy as np
import scipy.sparse
from scipy.spatial import ConvexHull


def unit(x):
    return x / np.linalg.norm(x, axis=-1, keepdims=True)


def arc(a, b):
    return 2 * np.arcsin(np.minimum(1, np.linalg.norm(a - b, axis=-1) / 2))


def dot(a, b):
    return np.sum(a * b, axis=-1)


def signed_area(a, b, c):
    """Returns the area of spherical triangles, positive if counter-clockwise seen from outside."""
    return 2 * np.arctan2(dot(a, np.cross(b - a, c - a)), 1 + dot(a, b) + dot(b, c) + dot(c, a))


def circumcentres(a, b, c):
    """Returns the unit normals of the planes through three points. Differences are more precise for
    small triangles."""
    return unit(np.cross(b - a, c - a))


def hull(points):
    """Returns Delaunay triangles, counter-clockwise seen from outside."""
    triangles = ConvexHull(points).simplices.astype(np.int64)
    a, b, c = points[triangles].swapaxes(0, 1)
    turned = dot(a, np.cross(b - a, c - a)) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    return triangles


class CGrid:
    """A C-grid. Points are on the unit sphere, and lengths and areas are those on a sphere of the
    given radius. The normal of an edge points from its first cell to the second, its tangent from
    its first vertex to the second, which is on the left of the normal."""

    ARRAYS = ("cell", "edge", "vertex", "cells_on_edge", "vertices_on_edge", "cells_on_vertex", "dc",
              "dv", "area", "triangle_area", "kites", "weights")

    def __init__(self, radius, **arrays):
        self.radius = radius
        for name in self.ARRAYS:
            setattr(self, name, arrays[name])
        a, b = self.cell[self.cells_on_edge].swapaxes(0, 1)
        self.normal = unit(b - a - dot(b - a, self.edge)[:, None] * self.edge)
        self.tangent = np.cross(self.edge, self.normal)

    @classmethod
    def from_points(cls, points, radius=1.0, triangles=None):
        points = unit(points)
        triangles = hull(points) if triangles is None else triangles
        corners = points[triangles]
        vertex = circumcentres(*corners.swapaxes(0, 1))
        # Half an edge is a side of a triangle, from a corner to the next, with the triangle on the
        # left.
        begin, end = triangles.ravel(), np.roll(triangles, -1, 1).ravel()
        low, high = np.minimum(begin, end), np.maximum(begin, end)
        _, edge_of, count = np.unique(low * len(points) + high, return_inverse=True, return_counts=True)
        assert np.all(count == 2), "the triangles do not close"
        forward = begin < end
        triangle = np.arange(len(begin)) // 3
        cells, vertices = (np.empty((len(count), 2), np.int64) for _ in range(2))
        cells[edge_of[forward]] = np.column_stack([begin, end])[forward]
        vertices[edge_of[forward], 1] = triangle[forward]
        vertices[edge_of[~forward], 0] = triangle[~forward]
        edge = unit(points[cells].sum(1))

        # The kite of a corner lies between the midpoints of the two sides at the corner and the
        # vertex.
        middle = edge[edge_of].reshape(-1, 3, 3)
        kites = np.column_stack([
            signed_area(corners[:, k], middle[:, k], vertex)
            + signed_area(corners[:, k], vertex, middle[:, k - 1]) for k in range(3)])
        area = np.bincount(triangles.ravel(), kites.ravel(), len(points))
        dc, dv = arc(*points[cells].swapaxes(0, 1)), arc(*vertex[vertices].swapaxes(0, 1))

        # An index denotes an edge seen from one of its cells. Counter-clockwise around the cell of
        # a corner, the side that begins there comes before the one that ends there.
        place = 2 * edge_of + ~forward                       # index of a side at its begin
        other = 2 * edge_of + forward                        # index at its end
        after = np.empty(2 * len(dc), np.int64)
        between = np.empty(2 * len(dc))                      # share of the kite in between
        after[place] = np.roll(other.reshape(-1, 3), 1, 1).ravel()
        between[place] = (kites / area[triangles]).ravel()
        return cls(radius, cell=points, edge=edge, vertex=vertex, cells_on_edge=cells,
                   vertices_on_edge=vertices, cells_on_vertex=triangles, dc=radius * dc, dv=radius * dv,
                   area=radius**2 * area, triangle_area=radius**2 * kites.sum(1),
                   kites=radius**2 * kites, weights=tangential_weights(after, between, dc, dv))

    @classmethod
    def from_file(cls, path):
        """Reads a grid of a whole sphere from an MPAS file."""
        import netCDF4
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            radius = float(file.sphere_radius)
            points = {of: np.column_stack([file[c + of][:] for c in "xyz"]) / radius
                      for of in ("Cell", "Edge", "Vertex")}
            indices = {name: file[name][:].astype(np.int64) - 1
                       for name in ("cellsOnEdge", "verticesOnEdge", "cellsOnVertex", "edgesOnEdge")}
            assert all(np.all(indices[name] >= 0) for name in list(indices)[:3]), "no whole sphere"
            count, width = file["nEdgesOnEdge"][:], indices["edgesOnEdge"].shape[1]
            used = np.arange(width) < count[:, None]
            weights = scipy.sparse.csr_matrix(
                (file["weightsOnEdge"][:][used], (np.repeat(np.arange(len(count)), count),
                                                  indices["edgesOnEdge"][used])), (len(count),) * 2)
            return cls(radius, cell=points["Cell"], edge=points["Edge"], vertex=points["Vertex"],
                       cells_on_edge=indices["cellsOnEdge"], vertices_on_edge=indices["verticesOnEdge"],
                       cells_on_vertex=indices["cellsOnVertex"], dc=file["dcEdge"][:],
                       dv=file["dvEdge"][:], area=file["areaCell"][:],
                       triangle_area=file["areaTriangle"][:], kites=file["kiteAreasOnVertex"][:],
                       weights=weights)

    # The operators are sparse matrices.

    def _matrix(self, values, rows, columns, shape):
        return scipy.sparse.csr_matrix(
            (np.ravel(values), (np.ravel(rows), np.ravel(columns))), shape)

    def _on_edges(self, values, columns, count):
        """Returns the matrix of two values of each edge."""
        rows = np.broadcast_to(np.arange(len(self.dc))[:, None], columns.shape)
        return self._matrix(np.broadcast_to(values, columns.shape), rows, columns,
                            (len(self.dc), count))

    def divergence(self):
        """Returns the divergence at cells of velocities across edges."""
        out = self._on_edges(self.dv[:, None] * [1, -1], self.cells_on_edge, len(self.area))
        return scipy.sparse.diags_array(1 / self.area) @ out.T.tocsr()

    def gradient(self):
        """Returns the gradient across edges of values at cells."""
        return self._on_edges([[-1, 1]] / self.dc[:, None], self.cells_on_edge, len(self.area))

    def curl(self):
        """Returns the curl at vertices of velocities across edges."""
        around = self._on_edges(self.dc[:, None] * [-1, 1], self.vertices_on_edge,
                                len(self.triangle_area))
        return scipy.sparse.diags_array(1 / self.triangle_area) @ around.T.tocsr()

    def cells_to_edges(self):
        return self._on_edges(0.5, self.cells_on_edge, len(self.area))

    def vertices_to_edges(self):
        return self._on_edges(0.5, self.vertices_on_edge, len(self.triangle_area))

    def cells_to_vertices(self):
        rows = np.broadcast_to(np.arange(len(self.kites))[:, None], self.kites.shape)
        return self._matrix(self.kites / self.triangle_area[:, None], rows, self.cells_on_vertex,
                            (len(self.kites), len(self.area)))

    def kinetic_energy(self):
        """Returns the matrix from squares of velocities across edges to kinetic energy at cells."""
        half = self._on_edges((self.dc * self.dv / 4)[:, None], self.cells_on_edge, len(self.area))
        return scipy.sparse.diags_array(1 / self.area) @ half.T.tocsr()


def tangential_weights(after, between, dc, dv):
    """Returns the matrix from velocities across edges to those along edges. Around each cell a
    weight is one half minus the shares of the kites between the two edges."""
    start = np.arange(len(after))
    outward = 1 - 2 * (start % 2)
    rows, columns, values = [], [], []
    here, passed, going = after.copy(), between.copy(), np.ones(len(after), bool)
    while np.any(going):
        p, q = start[going], here[going]
        rows.append(p // 2)
        columns.append(q // 2)
        values.append(outward[p] * outward[q] * (0.5 - passed[going]) * dv[q // 2] / dc[p // 2])
        passed += between[here]
        here = after[here]
        going &= here != start
    return scipy.sparse.csr_matrix(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (len(dc),) * 2)


def differences(grid, other):
    """Returns the largest difference between two grids of the same cells, relative to the largest
    value, by array. Edges and vertices are matched by their cells."""
    n = len(grid.cell)

    def orders(name):
        keys = [np.sort(getattr(g, name), 1) @ n ** np.arange(getattr(g, name).shape[1])[::-1]
                for g in (grid, other)]
        assert np.array_equal(*(np.sort(key) for key in keys)), f"other {name}"
        return (np.argsort(key) for key in keys)

    edges, other_edges = orders("cells_on_edge")
    corners, other_corners = orders("cells_on_vertex")
    flip = np.where(grid.cells_on_edge[edges, 0] == other.cells_on_edge[other_edges, 0], 1, -1)
    found = {"cell": (grid.cell, other.cell), "area": (grid.area, other.area)}
    for name in ("edge", "dc", "dv"):
        found[name] = getattr(grid, name)[edges], getattr(other, name)[other_edges]
    for name in ("vertex", "triangle_area"):
        found[name] = getattr(grid, name)[corners], getattr(other, name)[other_corners]
    by_cell, by_other_cell = (np.argsort(g.cells_on_vertex[rows], 1)
                              for g, rows in ((grid, corners), (other, other_corners)))
    found["kites"] = (np.take_along_axis(grid.kites[corners], by_cell, 1),
                      np.take_along_axis(other.kites[other_corners], by_other_cell, 1))
    turn = scipy.sparse.diags_array(1.0 * flip)
    found["weights"] = (grid.weights[edges][:, edges],
                        turn @ other.weights[other_edges][:, other_edges] @ turn)
    return {name: abs(a - b).max() / abs(a).max() for name, (a, b) in found.items()}
