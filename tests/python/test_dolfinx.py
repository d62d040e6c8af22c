# SPDX-License-Identifier: BSD-3-Clause
"""Tests distributed meshes in DOLFINx 0.5, on the ranks of MPI. Cells stay on their rank, facets
and cells keep their tags, and Poisson's equation has the same error on any number of ranks, before
and after the spacing is adapted.
usage: test_dolfinx.py [FILE D], with the domain of a file instead of the square and the box."""
import sys

import dolfinx
import numpy as np
import pnpbs
import ufl
from dolfinx import fem
from mesh_domains import blocks, blocks_with_regions, box, of_file, placed, square, surfaces_of_a_box
from mpi4py import MPI

WORLD = MPI.COMM_WORLD
OPTIONS = {"ksp_type": "cg", "ksp_rtol": 1e-12, "pc_type": "jacobi"}


def total(comm, form):
    return comm.allreduce(fem.assemble_scalar(fem.form(form)))


def peak(x, centre, length):
    return 1 / (1 + sum(((x[k] - centre[k]) / length)**2 for k in range(len(centre))))


def error_of(mesh, facets, centre, length):
    """Returns the L2 error of linear elements."""
    space = fem.FunctionSpace(mesh, ("CG", 1))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    exact = peak(ufl.SpatialCoordinate(mesh), centre, length)
    known = fem.Function(space)
    known.interpolate(lambda x: peak(x, centre, length))
    fixed = fem.locate_dofs_topological(space, mesh.topology.dim - 1, facets)
    problem = fem.petsc.LinearProblem(
        ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, -ufl.div(ufl.grad(exact)) * v * ufl.dx,
        bcs=[fem.dirichletbc(known, fixed)], petsc_options=OPTIONS)
    return np.sqrt(total(mesh.comm, (problem.solve() - exact)**2 * ufl.dx))


def check(holds, what):
    assert holds, what


def check_mesh(comm, part, mesh, tags):
    dim = mesh.topology.dim
    check(mesh.topology.index_map(dim).size_local == part.owned_elements, "cells on their rank")
    check(mesh.topology.index_map(0).size_global == part.all_nodes, "vertices are shared")
    owned = tags.indices < mesh.topology.index_map(dim - 1).size_local
    mine = part.facet_owners == comm.rank
    for tag in sorted(set(comm.allreduce(np.unique(part.facet_tags).tolist()))):
        there, here = (comm.allreduce(int(np.count_nonzero(found == tag)))
                       for found in (tags.values[owned], part.facet_tags[mine]))
        check(there == here > 0, f"{here} facets with tag {tag}, of which DOLFINx has {there}")
    place = {number: i for i, number in enumerate(part.numbers)}
    for k, number in enumerate(mesh.geometry.input_global_indices):
        if number in place:
            x = mesh.geometry.x[k, :part.dim]
            check((x == part.coordinates[place[number]]).all(), f"node {number}")


def solve(placement, comm, centre, length):
    part = placement.mesh(ghost_layers=1)
    mesh, tags = part.to_dolfinx(comm)
    check_mesh(comm, part, mesh, tags)
    boundary = np.isin(tags.indices, dolfinx.mesh.exterior_facet_indices(mesh.topology))
    return part.all_nodes, error_of(mesh, tags.indices[boundary], centre, length)


def run(domain, comm, d, centre, length):
    """Returns the errors before and after adapting."""
    placement = placed(domain, d, steps=100)
    nodes, error = solve(placement, comm, centre, length)
    away = np.linalg.norm(placement.nodes().points - centre, axis=1) / length
    placement.set_spacing(d * np.clip(0.4 + 0.6 * away, None, 1)).run()
    more_nodes, adapted = solve(placement, comm, centre, length)
    check(adapted < error, "adapting helps")
    if WORLD.rank == 0:
        print(f"{comm.size} ranks, {nodes} nodes: {error:.9g}, {more_nodes} adapted: {adapted:.9g}")
    return error, adapted


def check_regions(placement, expected):
    """Checks the tags of all cells on this rank, including ghosts, and the measures of regions."""
    part = placement.mesh(ghost_layers=1)
    mesh, tags, regions = part.to_dolfinx(WORLD, regions=True)
    check_mesh(WORLD, part, mesh, tags)
    tag_of = dict(zip(part.element_numbers, part.element_tags))
    there = np.zeros(len(mesh.topology.original_cell_index), np.int32)
    there[regions.indices] = regions.values
    check((there == [tag_of[number] for number in mesh.topology.original_cell_index]).all(),
          "tags of cells")
    check((regions.values != 0).all(), "cells without a tag are in none")
    dx = ufl.Measure("dx", domain=mesh, subdomain_data=regions)
    one = fem.Constant(mesh, 1.0)
    for tag, measure in expected.items():
        np.testing.assert_allclose(total(WORLD, one * dx(tag)), measure, rtol=1e-12)


def check_meshes_with_regions(context):
    for dim, d in ((2, 0.1), (3, 0.1)):
        size = 0.3 * 0.6**(dim - 1)
        check_regions(placed(blocks(context, dim), d), {7: 0})
        check_regions(placed(blocks_with_regions(context, dim), d), {7: size, 20: size})
    check_regions(placed(surfaces_of_a_box(context), 0.3), {5: 6})


def check_without_a_layer(context):
    try:
        placed(square(context), 0.1).mesh().to_dolfinx(WORLD)
        told = WORLD.size == 1
    except ValueError as error:
        told = "ghost_layers=1" in str(error)
    check(told, "without a ghost layer the way out is told")


def solve_in_file(context, path, d):
    domain, middle = of_file(context, path)
    run(domain, WORLD, d, middle, 10 * d)


def main():
    context = pnpbs.Context(WORLD)
    if len(sys.argv) == 3:
        return solve_in_file(context, sys.argv[1], float(sys.argv[2]))
    for domain, d, centre, length in ((square, 0.03, (0.7, 0.6), 0.1),
                                      (box, 0.1, (0.7, 0.6, 0.5), 0.2)):
        errors = run(domain(context), WORLD, d, centre, length)
        alone = run(domain(pnpbs.Context()), MPI.COMM_SELF, d, centre, length)
        np.testing.assert_allclose(errors, alone, rtol=1e-9)
    check_meshes_with_regions(context)
    return check_without_a_layer(context)


main()
