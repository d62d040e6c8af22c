#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A finite element solver on the library's nodes, over the ranks of an MPI program. It solves
-Laplace u = 0 in the ring 0.5 <= r <= 1 with u = log r on both circles; the solution is log r
everywhere. The row of a node follows from the triangles of its Delaunay star alone, so every rank
assembles the rows of its own nodes without a mesh file and without messages.
examples/c/laplace_ring is the same program in C and explains the expected results.

    python3 laplace_ring.py                     one process
    mpirun -n 4 python3 laplace_ring.py --mpi   with mpi4py

The dot products are those of the library, which are exact and rounded once, and rows are summed in
the order of the stars. The solution therefore has the same bits on any number of ranks."""
import sys

import numpy as np
import pnpbs

INNER_RADIUS, OUTER_RADIUS, D = 0.5, 1.0, 0.03
INNER_CIRCLE, OUTER_CIRCLE = 1, 2


def known_solution(points):
    return np.log(np.hypot(points[:, 0], points[:, 1]))


def cotangent(points, a, b, c):
    """Returns the cotangents of the angles at nodes a in counter-clockwise triangles a, b, c."""
    u, v = points[b] - points[a], points[c] - points[a]
    return (u * v).sum(axis=1) / (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])


def assemble(placement, points):
    """Assembles the rows of the owned nodes from their Delaunay stars; the columns of row i are the
    nodes of the star of node i. For linear elements the integral of grad phi_i . grad phi_j over a
    triangle is -1/2 times the cotangent of the angle opposite to the edge ij, and every row sums to
    zero. Returns offsets, columns and off-diagonal entries. Collective."""
    stars = placement.stars()
    offsets, columns = stars.neighbours.offsets, stars.neighbours.values
    rows = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    here = np.flatnonzero(stars.triangle.values)        # the others are gaps outside the domain
    last = offsets[rows[here] + 1] - 1
    after = np.where(here == last, offsets[rows[here]], here + 1)
    i, j, k = rows[here], columns[here], columns[after]
    at_k, at_j = cotangent(points, k, i, j) / 2, cotangent(points, j, k, i) / 2
    entries = np.zeros(len(columns))
    np.subtract.at(entries, here, at_k)
    np.subtract.at(entries, after, at_j)
    return offsets, columns, entries


def row_sums(offsets, terms):
    """Returns the sums of the rows. The order of summation does not depend on the ranks."""
    sums = np.zeros(len(offsets) - 1)
    np.add.at(sums, np.repeat(np.arange(len(sums)), np.diff(offsets)), terms)
    return sums


class Matrix:
    """The matrix rows of the owned nodes."""

    def __init__(self, placement, points):
        self.placement = placement
        self.offsets, self.columns, self.entries = assemble(placement, points)
        self.diagonal = -row_sums(self.offsets, self.entries)

    def times(self, x):
        """Returns A x at the owned nodes. Updates the ghosts of x first. Collective."""
        self.placement.update_ghosts(x)
        return self.diagonal * x[:len(self.diagonal)] + row_sums(self.offsets,
                                                                 self.entries * x[self.columns])


def solve(matrix, u, inner):
    """Solves A u = 0 at the inner nodes by conjugate gradients, and returns the number of steps.
    `inner` is 1 at inner nodes and 0 on the boundary, where u does not change, because the residual
    is set to zero there. Collective."""
    dot = matrix.placement.dot
    n = len(inner)
    r = -inner * matrix.times(u)
    p = np.zeros_like(u)
    p[:n] = r
    rr = dot(r, r)
    enough, steps = 1e-20 * rr, 0
    while rr > enough:
        q = matrix.times(p)
        alpha = rr / dot(p[:n], q)
        u[:n] += alpha * p[:n]
        r = inner * (r - alpha * q)
        rr_before, rr = rr, dot(r, r)
        p[:n] = r + rr / rr_before * p[:n]
        steps += 1
    matrix.placement.update_ghosts(u)
    return steps


def main(context, is_first, largest):
    ring = pnpbs.Domain(context)
    ring.add_arc((0, 0), INNER_RADIUS, tag=INNER_CIRCLE)
    ring.add_arc((0, 0), OUTER_RADIUS, tag=OUTER_CIRCLE)
    placement = pnpbs.Placement(ring).set_spacing(D)
    placement.run()

    own, ghosts = placement.nodes(), placement.ghosts()
    points = np.concatenate([own.points, ghosts.points])
    tags = np.concatenate([own.tags, ghosts.tags])
    matrix = Matrix(placement, points)
    u = np.where(tags == 0, 0.0, known_solution(points))
    steps = solve(matrix, u, np.where(own.tags == 0, 1.0, 0.0))

    total = lambda values: placement.sum(np.asarray(values, float))
    n, boundary = total(np.ones(len(own.tags))), total(own.tags != 0)
    flux = total(np.where(own.tags == OUTER_CIRCLE, matrix.times(u), 0))
    error = np.abs(u - known_solution(points))[:len(own.tags)]
    worst = largest(error.max(initial=0))
    norm = placement.dot(u[:len(own.tags)], u[:len(own.tags)])
    triangles = total(np.where(np.arange(len(own.tags)) == 0, len(placement.triangles()), 0))
    if is_first:
        area = np.pi * (OUTER_RADIUS**2 - INNER_RADIUS**2)
        print(f"nodes: {n:.0f}, expected about {2 * area / 3**0.5 / D**2 + boundary / 2:.0f}")
        print(f"triangles: {triangles:.0f}, expected {2 * n - boundary:.0f}")
        print(f"flux through the outer circle: {flux:.5f}, expected about {2 * np.pi:.5f}")
        print(f"largest error: {worst:.8f}, expected at most {D**2 / 6 / INNER_RADIUS**2:.8f}")
        print(f"after {steps} steps, u . u to the last bit: {norm.hex()}")


if "--mpi" in sys.argv:
    from mpi4py import MPI
    world = MPI.COMM_WORLD
    with pnpbs.Context(world) as everywhere:
        main(everywhere, world.rank == 0, lambda x: world.allreduce(x, MPI.MAX))
else:
    with pnpbs.Context() as alone:
        main(alone, True, lambda x: x)
