# SPDX-License-Identifier: BSD-3-Clause
"""Lagrange elements of first and second order on triangles and tetrahedra.

They solve -Laplace u = f with u given on the boundary. The error of the solution is in the energy
norm. All operations work on arrays of all elements."""
import itertools
import time

import numpy as np
import scipy.sparse as sparse

# Quadrature rules on each simplex that are exact to fourth degree or more: barycentric coordinates
# and weights.


def _orbit(*weights):
    return sorted(set(itertools.permutations(weights)))


def _rule(orbits):
    points = [(point, weight) for weight, corner in orbits for point in _orbit(*corner)]
    return np.array([p for p, _ in points]), np.array([w for _, w in points])


RULES = {
    2: _rule([(0.223381589678011, (0.108103018168070, 0.445948490915965, 0.445948490915965)),
              (0.109951743655322, (0.816847572980459, 0.091576213509771, 0.091576213509771))]),
    3: _rule([(0.112687925718015851, (1 - 3 * 0.310885919263300610,) + 3 * (0.310885919263300610,)),
              (0.0734930431163619495, (1 - 3 * 0.0927352503108912264,) + 3 * (0.0927352503108912264,)),
              (0.0425460207770814664, 2 * (0.0455037041256496495,) + 2 * (0.4544962958743503505,))]),
}


class Mesh:
    """A mesh with nodes (n, dim), elements (m, dim + 1), and flags of the boundary nodes."""

    def __init__(self, points, elements):
        self.points, corners = np.ascontiguousarray(points), np.asarray(elements)
        used = np.zeros(len(points), bool)
        used[corners] = True
        number = np.cumsum(used) - 1
        self.points, self.elements = self.points[used], number[corners]
        self.dim = points.shape[1]
        faces = np.concatenate([np.delete(self.elements, k, 1) for k in range(self.dim + 1)])
        faces.sort(axis=1)
        faces, times = np.unique(faces, axis=0, return_counts=True)
        self.border = faces[times == 1]

    def __len__(self):
        return len(self.points)


class Space:
    """The degrees of freedom: the nodes, for order 2 followed by the midpoints of edges."""

    def __init__(self, mesh, order):
        self.mesh, self.order = mesh, order
        self.dofs, self.points, border = mesh.elements, mesh.points, np.unique(mesh.border)
        if order == 2:
            self.pairs = list(itertools.combinations(range(mesh.dim + 1), 2))
            edges = np.sort(np.concatenate([mesh.elements[:, pair] for pair in self.pairs]), axis=1)
            edges, number = np.unique(edges, axis=0, return_inverse=True)
            number = number.reshape(len(self.pairs), -1).T
            self.dofs = np.hstack([mesh.elements, len(mesh) + number])
            self.points = np.vstack([mesh.points, mesh.points[edges].mean(axis=1)])
            rim = np.concatenate([mesh.border[:, pair] for pair in
                                  itertools.combinations(range(mesh.dim), 2)])
            on_rim = np.isin(edges[:, 0] * np.int64(len(mesh)) + edges[:, 1],
                             rim[:, 0] * np.int64(len(mesh)) + rim[:, 1])
            border = np.concatenate([border, len(mesh) + np.flatnonzero(on_rim)])
        self.fixed = np.zeros(len(self.points), bool)
        self.fixed[border] = True
        corners = mesh.points[mesh.elements]
        sides = corners[:, 1:] - corners[:, :1]
        self.size = np.abs(np.linalg.det(sides)) / {2: 2, 3: 6}[mesh.dim]
        # Columns are the gradients of the barycentric coordinates 1, ...
        inverse = np.linalg.inv(sides)
        gradients = np.swapaxes(inverse, 1, 2)
        self.barycentric = np.concatenate([-gradients.sum(1, keepdims=True), gradients], axis=1)

    def shapes(self, l):
        """Returns the shape functions at barycentric coordinates l, and their derivatives with
        respect to these."""
        n = len(l)
        if self.order == 1:
            return l, np.eye(n)
        values = np.concatenate([l * (2 * l - 1), [4 * l[a] * l[b] for a, b in self.pairs]])
        by = np.zeros((len(values), n))
        by[np.arange(n), np.arange(n)] = 4 * l - 1
        for k, (a, b) in enumerate(self.pairs):
            by[n + k, a], by[n + k, b] = 4 * l[b], 4 * l[a]
        return values, by

    def system(self, source):
        """Returns the stiffness matrix and the load."""
        many = self.dofs.shape[1]
        stiffness = np.zeros((len(self.dofs), many, many))
        load = np.zeros((len(self.dofs), many))
        for l, weight in zip(*RULES[self.mesh.dim]):
            values, by = self.shapes(l)
            gradients = np.einsum("ab,ebk->eak", by, self.barycentric)
            share = weight * self.size
            stiffness += np.einsum("e,eak,ebk->eab", share, gradients, gradients)
            x = np.einsum("c,eck->ek", l, self.mesh.points[self.mesh.elements])
            load += np.einsum("e,a->ea", share * source(x), values)
        rows = np.repeat(self.dofs, many, axis=1).ravel()
        columns = np.tile(self.dofs, (1, many)).ravel()
        n = len(self.points)
        matrix = sparse.csr_matrix((stiffness.ravel(), (rows, columns)), shape=(n, n))
        return matrix, np.bincount(self.dofs.ravel(), load.ravel(), n)

    def energy_error(self, u, gradient):
        """Returns the norm of grad u_h - grad u divided by that of grad u."""
        squared = total = 0.0
        for l, weight in zip(*RULES[self.mesh.dim]):
            by = self.shapes(l)[1]
            found = np.einsum("ab,ebk,ea->ek", by, self.barycentric, u[self.dofs])
            right = gradient(np.einsum("c,eck->ek", l, self.mesh.points[self.mesh.elements]))
            squared += (weight * self.size * ((found - right)**2).sum(1)).sum()
            total += (weight * self.size * (right**2).sum(1)).sum()
        return float(np.sqrt(squared / total))


def conjugate_gradients(matrix, right, tolerance=1e-8):
    """Solves by conjugate gradients from 0 with diagonal preconditioning. Returns the solution and
    the number of iterations."""
    inverse = 1 / matrix.diagonal()
    x, residual = np.zeros_like(right), right.copy()
    scaled = inverse * residual
    direction, now = scaled.copy(), residual @ scaled
    enough = tolerance**2 * now
    for step in range(1, 20001):
        image = matrix @ direction
        length = now / (direction @ image)
        x += length * direction
        residual -= length * image
        scaled = inverse * residual
        before, now = now, residual @ scaled
        if now <= enough:
            return x, step
        direction = scaled + now / before * direction
    raise RuntimeError("conjugate gradients do not converge")


class Solved:
    """The relative error of the solution on a mesh, and its cost."""

    def __init__(self, mesh, order, problem):
        begin = time.process_time()
        space = Space(mesh, order)
        matrix, load = space.system(problem.source)
        u = np.where(space.fixed, problem.solution(space.points), 0)
        free = ~space.fixed
        load = (load - matrix @ u)[free]
        u[free], self.iterations = conjugate_gradients(matrix[free][:, free].tocsr(), load)
        self.seconds = time.process_time() - begin
        self.dofs = len(space.points)
        self.error = space.energy_error(u, problem.gradient)
