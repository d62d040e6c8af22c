# SPDX-License-Identifier: BSD-3-Clause
"""Tests distributed meshes in PETSc (petsc4py 3.18), on the ranks of MPI. Cells stay on their rank,
facets and cells keep their tags, fields are transferred to vertices and back, and Poisson's
equation has the errors of examples/c/petsc_poisson, before and after the spacing is adapted.
usage: test_petsc.py [FILE D], with the domain of a file instead of the square and the box."""
import math
import sys
import traceback

import numpy as np
import pnpbs
from mesh_domains import blocks, blocks_with_regions, box, of_file, placed, square, surfaces_of_a_box
from mpi4py import MPI
from petsc4py import PETSc

WORLD = MPI.COMM_WORLD
KNOWN = {2: (0.00148298, 0.0009809), 3: (0.00459653, 0.00394488)}
FAR = {2: 1 / 6, 3: (5 - math.sqrt(5)) / 20}


def check(holds, what):
    assert holds, what


def peak(x, centre, length):
    return 1 / (1 + ((x - centre)**2).sum(axis=-1) / length**2)


def load(x, centre, length):
    """Returns the load, rounded as in the C program, because the positions of nodes depend on its
    last bits."""
    r2 = ((x - centre)**2).sum(axis=-1) / length**2
    one = 1 + r2
    return (2 * x.shape[-1] / (one * one) - 8 * r2 / (one * one * one)) / length**2


def to_vertices(nodes, field, vertices):
    at_vertices = np.full(vertices, np.nan)
    nodes.bcastBegin(MPI.DOUBLE, field, at_vertices, MPI.REPLACE)
    nodes.bcastEnd(MPI.DOUBLE, field, at_vertices, MPI.REPLACE)
    return at_vertices


def to_nodes(nodes, at_vertices, count):
    field = np.full(count, np.nan)
    nodes.reduceBegin(MPI.DOUBLE, at_vertices, field, MPI.REPLACE)
    nodes.reduceEnd(MPI.DOUBLE, at_vertices, field, MPI.REPLACE)
    return field


class Plex:
    """A DMPlex with its own data: coordinates, and the vertices of its points."""

    def __init__(self, plex):
        self.plex = plex
        self.first, self.end = plex.getDepthStratum(0)
        self.x = plex.getCoordinatesLocal().array.reshape(-1, plex.getCoordinateDim())
        cells = [self.vertices(cell) for cell in range(*plex.getHeightStratum(0))]
        self.cells = np.array(cells, np.int32).reshape(-1, plex.getDimension() + 1)

    def vertices(self, point):
        closure, _ = self.plex.getTransitiveClosure(point)
        return closure[(closure >= self.first) & (closure < self.end)] - self.first

    def stratum(self, label, value):
        there = self.plex.getStratumIS(label, value)
        return there.indices if there else np.zeros(0, np.int32)

    def owned(self, points):
        """Returns those of the points that belong to this rank."""
        try:
            _, leaves, _ = self.plex.getPointSF().getGraph()
        except ValueError:  # petsc4py raises it if ranks share nothing and PETSc has no graph
            return points
        return np.setdiff1d(points, leaves)

    def measures(self, corners):
        """Returns the measures of simplices with these vertices."""
        sides = self.x[corners[:, 1:]] - self.x[corners[:, :1]]
        gram = np.linalg.det(sides @ sides.transpose(0, 2, 1))
        return np.sqrt(gram) / math.factorial(corners.shape[1] - 1)


def sums(part, of_elements):
    """Returns the numbers and measures of elements or facets by tag over all ranks, each counted
    once."""
    rows = part.elements[:part.owned_elements] if of_elements else part.facets
    mine = np.full(len(rows), True) if of_elements else part.facet_owners == WORLD.rank
    tags = part.element_tags[:len(rows)] if of_elements else part.facet_tags
    sides = part.coordinates[rows[:, 1:]] - part.coordinates[rows[:, :1]]
    gram = np.linalg.det(sides @ sides.transpose(0, 2, 1))
    measures = np.sqrt(gram) / math.factorial(rows.shape[1] - 1)
    return {tag: (WORLD.allreduce(int(np.count_nonzero(mine & (tags == tag)))),
                  WORLD.allreduce(measures[mine & (tags == tag)].sum()))
            for tag in sorted(set(WORLD.allreduce(np.unique(tags).tolist()))) if tag != 0}


def check_label(there, label, expected):
    values = there.plex.getLabelIdIS(label)
    tags = set(WORLD.allreduce(values.indices.tolist() if values else []))
    check(tags == set(expected), f"{label}: {tags}, not {set(expected)}")
    for tag, (count, measure) in expected.items():
        points = there.owned(there.stratum(label, tag))
        corners = np.array([there.vertices(point) for point in points])
        found = there.measures(corners).sum() if len(points) else 0
        check(WORLD.allreduce(len(points)) == count, f"{label} {tag}: not {count} points")
        np.testing.assert_allclose(WORLD.allreduce(found), measure, rtol=1e-12)


def check_plex(part, plex, nodes):
    there = Plex(plex)
    check(len(there.cells) == part.owned_elements, "cells on their rank")
    for depth in range(plex.getDimension() + 1):
        check_points(there, depth)
    vertices = WORLD.allreduce(len(there.owned(np.arange(there.first, there.end))))
    check(vertices == part.all_nodes, f"{vertices} vertices, {part.all_nodes} nodes")
    for axis in range(part.dim):
        field = np.ascontiguousarray(part.coordinates[:part.owned_nodes, axis])
        check((to_vertices(nodes, field, len(there.x)) == there.x[:, axis]).all(), "coordinates")
        back = to_nodes(nodes, np.ascontiguousarray(there.x[:, axis]), part.owned_nodes)
        check((back == field).all(), "coordinates at nodes")
    numbers = part.numbers[:part.owned_nodes].astype(float)
    numbers = to_vertices(nodes, numbers, len(there.x))
    check((np.sort(numbers[there.cells], axis=1) ==
           np.sort(part.connectivity[:part.owned_elements], axis=1)).all(), "corners of cells")
    check_label(there, "Face Sets", sums(part, False))
    check_label(there, "Cell Sets", sums(part, True))
    outer = part.facet_owners[~part.facet_inner] == WORLD.rank
    marked = there.owned(there.stratum("marker", 1))
    check(WORLD.allreduce(len(marked) - np.count_nonzero(outer)) == 0, "marked faces")
    return there


def check_points(there, depth):
    """Checks that every point has one owner and a position of its own, so that ranks agree on edges
    and faces."""
    plex = there.plex
    points = np.arange(*plex.getDepthStratum(depth))
    centres = np.array([there.x[there.vertices(point)].mean(axis=0) for point in points])
    centres = centres.reshape(-1, there.x.shape[1]).round(9) + 0.0
    everywhere = sum(WORLD.allgather(list(map(tuple, centres))), [])
    owned = WORLD.allreduce(len(there.owned(points)))
    check(owned == len(set(everywhere)), f"{owned} points of depth {depth}, of which "
          f"{len(set(everywhere))} differ")


def finite_elements(there, centre, length):
    """Returns stiffness matrix and load of each cell, the points of a quadrature, and the basis
    functions there."""
    x, dim = there.x[there.cells], there.x.shape[1]
    functions = np.full((dim + 1, dim + 1), FAR[dim]) + np.eye(dim + 1) * (1 - (dim + 1) * FAR[dim])
    points = functions @ x
    inner = np.linalg.inv(x[:, 1:] - x[:, :1])
    gradients = np.concatenate([-inner.sum(axis=2, keepdims=True), inner], axis=2)
    measures = there.measures(there.cells)
    matrices = measures[:, None, None] * gradients.transpose(0, 2, 1) @ gradients
    loads = measures[:, None] / (dim + 1) * (load(points, centre, length) @ functions)
    return matrices, loads, points, functions, measures


def error_of(there, centre, length):
    """Returns the L2 error of linear elements."""
    plex = there.plex
    section = PETSc.Section().create(plex.comm)
    section.setChart(*plex.getChart())
    for vertex in range(there.first, there.end):
        section.setDof(vertex, 1)
    section.setUp()
    plex.setSection(section)
    stiffness, right = plex.createMat(), plex.createGlobalVec()
    local, known, u = plex.createLocalVec(), right.duplicate(), right.duplicate()
    matrices, loads, points, functions, measures = finite_elements(there, centre, length)
    for cell, matrix in zip(there.cells.astype(PETSc.IntType), matrices):
        stiffness.setValuesLocal(cell, cell, matrix, PETSc.InsertMode.ADD_VALUES)
    stiffness.assemble()
    np.add.at(local.array, there.cells, loads)
    plex.localToGlobal(local, right, PETSc.InsertMode.ADD_VALUES)
    local.array = peak(there.x, centre, length)
    plex.localToGlobal(local, known)
    marked = plex.getLabel("marker")
    plex.labelComplete(marked)  # extends the label from faces to their corners
    marked = there.stratum("marker", 1)
    marked = marked[(marked >= there.first) & (marked < there.end)] - there.first
    stiffness.zeroRowsColumnsLocal(marked.astype(PETSc.IntType), 1, known, right)
    solver = PETSc.KSP().create(plex.comm)
    solver.setType("cg")
    solver.setOperators(stiffness)
    solver.setTolerances(rtol=1e-12)
    solver.solve(right, u)
    plex.globalToLocal(u, local)
    errors = local.array[there.cells] @ functions - peak(points, centre, length)
    square = measures @ (errors**2).mean(axis=1) if len(errors) else 0.0
    return math.sqrt(WORLD.allreduce(square))


def run(domain, d, centre, length):
    """Returns the errors before and after adapting. d decreases where the load is large, by up to a
    factor of three."""
    placement, errors = pnpbs.Placement(domain).set_spacing(d), []
    for _ in range(2):
        placement.run()
        part = placement.mesh()
        plex, nodes = part.to_petsc(WORLD)
        there = check_plex(part, plex, nodes)
        errors.append(error_of(there, centre, length))
        at_nodes = abs(to_nodes(nodes, load(there.x, centre, length), part.owned_nodes))
        largest = WORLD.allreduce(at_nodes.max(initial=0), MPI.MAX)
        placed_nodes = placement.nodes()
        placement.set_spacing(placed_nodes.spacing / np.maximum(1, 3 * np.sqrt(at_nodes / largest)))
        if WORLD.rank == 0:
            print(f"{WORLD.size} ranks, {part.all_nodes} nodes: {errors[-1]:.6g}")
    return errors


def check_meshes_with_regions(context):
    for dim, d in ((2, 0.1), (3, 0.3)):
        for domain in (blocks, blocks_with_regions):
            for layers in (0, 1):
                part = placed(domain(context, dim), d).mesh(ghost_layers=layers)
                check_plex(part, *part.to_petsc(WORLD))
    part = placed(surfaces_of_a_box(context), 0.1).mesh()
    check_plex(part, *part.to_petsc(WORLD))


def check_an_empty_rank(context):
    """Checks a domain of about two triangles, for which some ranks have no cells."""
    triangle = pnpbs.Domain(context).add_polyline([(0, 0), (1, 0), (0, 1)], tags=1)
    part = placed(triangle, 0.9).mesh()
    check_plex(part, *part.to_petsc(WORLD))


def check_overlap(context):
    """Checks a layer of PETSc's own ghost cells, with their labels."""
    part = placed(blocks_with_regions(context, 2), 0.1).mesh()
    plex, _ = part.to_petsc(WORLD)
    if WORLD.size > 1:
        plex.distributeOverlap(1)
        there = Plex(plex)
        more = WORLD.allreduce(len(there.cells)) - part.all_elements
        check(more > 0, "ghost cells")
        check_label(there, "Cell Sets", sums(part, True))
        check_label(there, "Face Sets", sums(part, False))


def solve_in_file(context, path, d):
    domain, middle = of_file(context, path)
    run(domain, d, middle, 10 * d)


def main():
    context = pnpbs.Context(WORLD)
    if len(sys.argv) == 3:
        return solve_in_file(context, sys.argv[1], float(sys.argv[2]))
    for domain, d, centre, length in ((square, 0.03, (0.7, 0.6), 0.1),
                                      (box, 0.1, (0.7, 0.6, 0.5), 0.2)):
        errors = run(domain(context), d, centre, length)
        np.testing.assert_allclose(errors, KNOWN[len(centre)], rtol=1e-5)
    check_meshes_with_regions(context)
    check_an_empty_rank(context)
    return check_overlap(context)


try:
    main()
except Exception:  # otherwise the other ranks would wait for this one
    traceback.print_exc()
    WORLD.Abort(1)
