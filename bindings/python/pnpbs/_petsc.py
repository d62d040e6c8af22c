# SPDX-License-Identifier: BSD-3-Clause
"""Conversion of distributed meshes to a DMPlex of PETSc through petsc4py. petsc4py has no function
for cells that are distributed already, so this module repeats the steps of PETSc's own function: it
creates the cells and vertices of a rank, the star forest of shared vertices, and then the faces."""

from __future__ import annotations

import importlib
from typing import Any, Tuple

import numpy as np
from numpy.typing import NDArray

from ._types import Int32s
from .mesh_arrays import MeshArrays


def plex_of(mesh: MeshArrays, comm: Any) -> Tuple[Any, Any]:
    """Returns the plex, and the star forest from owned nodes to vertices. Collective."""
    petsc = importlib.import_module("petsc4py.PETSc")
    corners = mesh.elements.shape[1]
    elements = mesh.elements[:mesh.owned_elements]
    at_vertices = np.unique(elements)
    vertices = np.zeros(len(mesh.numbers), petsc.IntType)
    vertices[at_vertices] = np.arange(len(at_vertices))
    nodes = _star_forest(petsc, comm, mesh.owned_nodes, np.arange(len(at_vertices)),
                         _owners_and_indices(mesh, comm, at_vertices))
    cells = vertices[elements]
    if corners == 4:  # PETSc orients tetrahedra in the opposite direction
        cells = cells[:, [1, 0, 2, 3]]
    plex = _cells_and_vertices(petsc, comm, cells, len(at_vertices))
    _set_coordinates(petsc, plex, mesh.coordinates[at_vertices])
    plex.setPointSF(_shared_vertices(petsc, comm, nodes, mesh.owned_nodes, len(cells)))
    plex.interpolate()
    _label_facets(petsc, plex, mesh)
    tags = mesh.element_tags[:mesh.owned_elements]
    _label(petsc, plex, "Cell Sets", np.flatnonzero(tags), tags[tags != 0])
    return plex, nodes


def _cells_and_vertices(petsc: Any, comm: Any, cells: NDArray[Any], vertices: int) -> Any:
    """Creates a plex of cells and vertices without faces. Vertices are numbered after the cells."""
    n, corners = cells.shape
    plex = petsc.DMPlex().create(comm=comm)
    plex.setDimension(corners - 1)
    plex.setChart(0, n + vertices)
    for cell in range(n):
        plex.setConeSize(cell, corners)
    plex.setUp()
    for cell, cone in enumerate(cells + petsc.IntType(n)):
        plex.setCone(cell, cone)
    plex.symmetrize()
    plex.stratify()
    return plex


def _set_coordinates(petsc: Any, plex: Any, coordinates: NDArray[np.float64]) -> None:
    """Sets the coordinates of the vertices, an array of shape (vertices, dim)."""
    dim = coordinates.shape[1]
    first, end = plex.getDepthStratum(0)
    plex.setCoordinateDim(dim)
    section = plex.getCoordinateSection()
    section.setNumFields(1)
    section.setFieldComponents(0, dim)
    section.setChart(first, end)
    for vertex in range(first, end):
        section.setDof(vertex, dim)
        section.setFieldDof(vertex, 0, dim)
    section.setUp()
    local = petsc.Vec().createSeq(coordinates.size, bsize=dim, comm=petsc.COMM_SELF)
    local.array = coordinates.ravel()
    local.setName("coordinates")
    plex.setCoordinatesLocal(local)


def _star_forest(petsc: Any, comm: Any, roots: int, leaves: NDArray[Any],
                 remote: NDArray[Any]) -> Any:
    """Creates a star forest. Each row of `remote` is the rank and the index of the root of a
    leaf."""
    forest = petsc.SF().create(comm=comm)
    forest.setGraph(roots, leaves.astype(petsc.IntType), remote.astype(petsc.IntType))
    return forest


def _owners_and_indices(mesh: MeshArrays, comm: Any, nodes: Int32s) -> NDArray[np.int64]:
    """Returns, for each node, the rank that owns it and its index on that rank. Collective."""
    first = np.array(comm.allgather(mesh.first_node))
    owners = mesh.owners[nodes]
    return np.stack([owners, mesh.numbers[nodes] - first[owners]], axis=1)


def _shared_vertices(petsc: Any, comm: Any, nodes: Any, owned_nodes: int, cells: int) -> Any:
    """Returns the star forest of those vertices of the plex that another rank owns. A vertex
    belongs to the highest rank that has it. Collective."""
    mpi = importlib.import_module("mpi4py.MPI")
    _, leaves, _ = nodes.getGraph()

    def largest(at_vertices: NDArray[Any]) -> NDArray[Any]:
        """Returns, for each vertex, the largest value of all ranks that have it. Collective."""
        at_vertices = at_vertices.astype(np.int32)
        at_nodes = np.full(owned_nodes, -1, np.int32)
        nodes.reduceBegin(mpi.INT, at_vertices, at_nodes, mpi.MAX)
        nodes.reduceEnd(mpi.INT, at_vertices, at_nodes, mpi.MAX)
        nodes.bcastBegin(mpi.INT, at_nodes, at_vertices, mpi.REPLACE)
        nodes.bcastEnd(mpi.INT, at_nodes, at_vertices, mpi.REPLACE)
        return at_vertices

    points = cells + np.arange(len(leaves))
    owners = largest(np.full(len(points), comm.rank))
    mine = owners == comm.rank
    roots = np.stack([owners, largest(np.where(mine, points, -1))], axis=1)
    return _star_forest(petsc, comm, cells + len(points), points[~mine], roots[~mine])


def _label_facets(petsc: Any, plex: Any, mesh: MeshArrays) -> None:
    """Labels the facets of the elements that this rank owns."""
    owned = np.where(mesh.facet_elements < mesh.owned_elements, mesh.facet_elements, -1)
    element = owned.max(axis=1, initial=-1)
    here = element >= 0
    corners = mesh.elements[element[here]]
    in_facet = (corners[:, :, np.newaxis] == mesh.facets[here][:, np.newaxis]).any(axis=2)
    faces = _faces(plex, element[here], np.argmin(in_facet, axis=1), corners.shape[1])
    outer = ~mesh.facet_inner[here]
    _label(petsc, plex, "Face Sets", faces, mesh.facet_tags[here])
    _label(petsc, plex, "marker", faces[outer], np.ones(np.count_nonzero(outer), np.int32))


def _faces(plex: Any, cells: Int32s, opposite: NDArray[Any], corners: int) -> NDArray[Any]:
    """Returns the face of each cell that does not contain the corner `opposite`. PETSc's order of
    faces in a cell determines its index."""
    if corners == 3:
        places = (opposite + 1) % 3
    else:
        places = 3 - np.array([1, 0, 2, 3])[opposite]
    return np.array([plex.getCone(cell)[place] for cell, place in zip(cells, places)], np.int32)


def _label(petsc: Any, plex: Any, name: str, points: NDArray[Any], values: Int32s) -> None:
    """Creates a label with these values at points of the plex."""
    plex.createLabel(name)
    label = plex.getLabel(name)
    for value in np.unique(values):
        stratum = petsc.IS().createGeneral(points[values == value].astype(petsc.IntType),
                                           comm=petsc.COMM_SELF)
        label.insertIS(stratum, int(value))
        stratum.destroy()
