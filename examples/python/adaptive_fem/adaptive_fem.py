#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Linear finite elements on an L-shaped domain, adapted by an error estimate. The solution of
Laplace's equation is r^(2/3) sin(2/3 theta): its gradient is infinite at the re-entrant corner. The
error of the gradient decreases as N^(-1/3) on N nodes of constant d, and as N^(-1/2) at best."""
import numpy as np
import pnpbs
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve


def exact(x):
    theta = np.mod(np.arctan2(x[:, 1], x[:, 0]), 2 * np.pi)
    return np.hypot(x[:, 0], x[:, 1])**(2 / 3) * np.sin(2 / 3 * theta)


def exact_gradient(x):
    theta = np.mod(np.arctan2(x[:, 1], x[:, 0]), 2 * np.pi)
    return (2 / 3 * np.hypot(x[:, 0], x[:, 1])**(-1 / 3) * (-np.sin(theta / 3), np.cos(theta / 3))).T


def solve(x, triangles, fixed):
    """Returns the gradients of the solution on the triangles, and their areas."""
    a, b, c = (x[triangles[:, k]] for k in range(3))
    areas = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    slopes = np.stack([c - b, a - c, b - a], axis=1)[:, :, ::-1] * (-1, 1) / (2 * areas)[:, None, None]
    entries = np.einsum("tik,tjk,t->tij", slopes, slopes, areas)
    rows, columns = np.repeat(triangles, 3, axis=1), np.tile(triangles, 3)
    matrix = coo_array((entries.ravel(), (rows.ravel(), columns.ravel()))).tocsr()
    u, free = exact(x), ~fixed
    u[free] = spsolve(matrix[free][:, free].tocsc(), -matrix[free][:, fixed] @ u[fixed])
    return np.einsum("tik,ti->tk", slopes, u[triangles]), areas


with pnpbs.Context() as context:
    ell = pnpbs.Domain(context).add_polyline([(0, 0), (1, 0), (1, 1), (-1, 1), (-1, -1), (0, -1)])
    placement = pnpbs.Placement(ell, growth_limit=0.3).set_spacing(0.1)
    history = []
    for cycle in range(5):
        placement.run()
        nodes, triangles = placement.nodes(), placement.triangles()
        gradients, areas = solve(nodes.points, triangles, nodes.tags != 0)
        # The error, by the midpoints of the edges, and its estimate: the distance from a continuous
        # gradient, the mean over the triangles around each node (Zienkiewicz and Zhu 1987).
        middles = [nodes.points[triangles[:, [k, (k + 1) % 3]]].mean(axis=1) for k in range(3)]
        error = sum(areas / 3 * ((gradients - exact_gradient(x))**2).sum(axis=1) for x in middles)
        weights = np.bincount(triangles.ravel(), np.repeat(areas, 3))
        mean = np.stack([np.bincount(triangles.ravel(), np.repeat(areas * gradients[:, k], 3))
                         for k in range(2)], axis=1) / weights[:, None]
        estimate = areas * ((gradients - mean[triangles].mean(axis=1))**2).sum(axis=1)
        history.append((placement.node_count, error.sum()**0.5))
        print("%d nodes, error of the gradient %.5f" % history[-1])
        # The error of a triangle decreases as d^2: all are to have half of the present mean.
        there = np.bincount(triangles.ravel(), np.repeat(areas * estimate**0.5, 3)) / weights
        factor = np.clip((0.5 * np.mean(estimate**0.5) / there)**0.5, 0.5, 1.5)
        placement.set_spacing(factor * nodes.spacing)

n, errors = np.log(history).T
print(f"order in the number of nodes: {-np.polyfit(n, errors, 1)[0]:.2f}, expected at least 0.5")
