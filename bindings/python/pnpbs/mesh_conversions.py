# SPDX-License-Identifier: BSD-3-Clause
"""Conversions of a distributed mesh for other packages. Each package is imported only by the
conversion that needs it."""

from __future__ import annotations

import importlib
import os
import pathlib
import tempfile
from typing import Any, Dict, Tuple

import numpy as np
from numpy.typing import NDArray

from ._petsc import plex_of
from ._plots import plot_mesh
from ._types import Int32s, Path
from .errors import PNPBSError, Status
from .mesh_arrays import MeshArrays


class MeshConversions(MeshArrays):
    """The part of `DistributedMesh` that converts it for other packages."""

    def to_meshio(self) -> Any:
        """Returns what this rank owns as a `meshio.Mesh`, with elements as cells and facets as
        cells of one dimension less. Cells have the data `tag`, which for elements is that of the
        region. Points have the data `tag`, `id` and `number`, and include nodes of other ranks at
        owned elements. Local."""
        meshio = _package("meshio")
        names = {2: "line", 3: "triangle", 4: "tetra"}
        mine = self._owned_facets()
        cells = [(names[self.elements.shape[1]], self.elements[:self.owned_elements])]
        tags = [self.element_tags[:self.owned_elements]]
        if mine.any():
            cells.append((names[self.facets.shape[1]], self.facets[mine]))
            tags.append(self.facet_tags[mine])
        return meshio.Mesh(self.coordinates, cells, cell_data={"tag": tags},
                           point_data={"tag": self.tags, "id": self.ids, "number": self.numbers})

    def to_pyvista(self, facets: bool = False) -> Any:
        """Returns the elements that this rank owns, or its facets if `facets` is true, as a
        `pyvista.UnstructuredGrid`. Cells have the data `tag`, which for elements is that of the
        region. Points have the data `tag`, `id` and `number`, and include nodes of other ranks at
        owned elements. Local."""
        pyvista = _package("pyvista")
        types = {2: pyvista.CellType.LINE, 3: pyvista.CellType.TRIANGLE, 4: pyvista.CellType.TETRA}
        mine = self._owned_facets() if facets else slice(self.owned_elements)
        cells = (self.facets if facets else self.elements)[mine]
        points = np.zeros((len(self.coordinates), 3))
        points[:, :self.dim] = self.coordinates
        grid = pyvista.UnstructuredGrid({types[cells.shape[1]]: cells}, points)
        grid.cell_data["tag"] = (self.facet_tags if facets else self.element_tags)[mine]
        grid.point_data.update({"tag": self.tags, "id": self.ids, "number": self.numbers})
        return grid

    def to_skfem(self) -> Any:
        """Returns the mesh as scikit-fem's `MeshTri` or `MeshTet`. Each tag of facets becomes a
        boundary, and each tag of regions a subdomain, with names such as `tag_7`. Local. Raises
        ValueError if other ranks have nodes, because scikit-fem does not use ranks, and for
        surfaces in space."""
        skfem = _package("skfem")
        if self.owned_nodes != self.all_nodes:
            raise ValueError(f"this rank owns {self.owned_nodes} of {self.all_nodes} nodes; "
                             "scikit-fem takes meshes that are on one rank")
        if self.elements.shape[1] != self.dim + 1:
            raise ValueError("this is a mesh of surfaces in space, which scikit-fem does not have")
        kind = skfem.MeshTri if self.dim == 2 else skfem.MeshTet
        mesh = kind(np.ascontiguousarray(self.coordinates.T),
                    np.ascontiguousarray(self.elements.T.astype(np.int64)))
        rows = _rows_of(np.sort(mesh.facets.T, axis=1), np.sort(self.facets, axis=1))
        mesh = mesh.with_boundaries({f"tag_{tag}": rows[self.facet_tags == tag]
                                     for tag in np.unique(self.facet_tags)})
        regions = np.unique(self.element_tags[self.element_tags != 0])
        return mesh.with_subdomains({f"tag_{tag}": np.flatnonzero(self.element_tags == tag)
                                     for tag in regions})

    def to_dolfinx(self, comm: Any, regions: bool = False) -> Tuple[Any, ...]:
        """Returns the mesh for DOLFINx and the tags of its facets as mesh tags, both of boundary
        and inner facets. Collective. Tested with DOLFINx 0.5.2.

        - `comm`: mpi4py's communicator of the context of the placement.
        - `regions`: whether to return the mesh tags of cells as well. They are the tags of regions,
          on surfaces alone those of the surfaces, without cells of the tag 0.

        Each rank keeps the elements that it owns as cells, and has the elements across their facets
        as ghosts. DOLFINx does not partition the mesh. On several ranks the mesh must have a ghost
        layer, as that of `placement.mesh(ghost_layers=1)`; otherwise the call raises ValueError.
        `input_global_indices` of the geometry are the numbers of the nodes, which relate fields of
        the placement to those of DOLFINx."""
        dolfinx = _package("dolfinx")
        ghosts = len(self.elements) - self.owned_elements
        if comm.allreduce(len(self.shared_nodes)) > 0 and comm.allreduce(ghosts) == 0:
            raise ValueError("the mesh has no ghost layer, which DOLFINx needs on several ranks: "
                             "placement.mesh(ghost_layers=1) has one")
        destinations = dolfinx.cpp.graph.AdjacencyList_int32(*self._destinations(comm.rank))
        cells = self.connectivity[:self.owned_elements]
        mesh = dolfinx.mesh.create_mesh(
            comm, dolfinx.cpp.graph.AdjacencyList_int64(cells),
            self.coordinates[:self.owned_nodes], _linear_coordinates(self.dim, cells.shape[1]),
            partitioner=lambda *_: destinations)
        mine, tags = self._owned_facets(), self.element_tags[:self.owned_elements]
        of_facets = _tags_in_dolfinx(mesh, mesh.topology.dim - 1, self.numbers[self.facets[mine]],
                                     self.facet_tags[mine])
        if not regions:
            return mesh, of_facets
        return mesh, of_facets, _tags_in_dolfinx(mesh, mesh.topology.dim, cells[tags != 0],
                                                 tags[tags != 0])

    def to_petsc(self, comm: Any) -> Tuple[Any, Any]:
        """Returns the mesh as petsc4py's `DMPlex`, with edges and faces, and an `SF` between the
        nodes of the placement and the vertices of the plex. Collective. Tested with petsc4py
        3.18.5.

        - `comm`: mpi4py's communicator of the context of the placement.

        The cells on each rank are the elements that it owns. Nothing is gathered, and PETSc does
        not partition the mesh. Ghost elements are omitted; `plex.distributeOverlap` creates ghost
        cells. The label "Face Sets" holds the tags of boundary and inner facets, "marker" is 1 on
        the boundary, and "Cell Sets" holds the tags of cells: those of regions, on surfaces alone
        those of the surfaces, without cells of the tag 0.

        The roots of the `SF` are the nodes that this rank owns, in the order of
        `placement.nodes()`. Its leaves are the vertices on this rank, in the order of the plex.
        `bcastBegin` and `bcastEnd` send a field from the nodes to the vertices; `reduceBegin` and
        `reduceEnd` send it back."""
        return plex_of(self, comm)

    def plot(self, ax: Any = None) -> Any:
        """Draws what this rank owns on `ax`, or on a new canvas if it is None, and returns the
        canvas. In the plane it draws triangles, and facets in the colours of their tags, with
        Matplotlib. In space it draws the facets of bodies, or the triangles of surfaces alone, in
        the colours of their tags, with PyVista, or with Matplotlib if PyVista is not installed.
        Local."""
        return plot_mesh(self, self._owned_facets(), ax)

    def _destinations(self, rank: int) -> Tuple[Int32s, Int32s]:
        """Returns the ranks that need each owned element, as compressed rows (ranks, offsets): this
        rank first, then the owners of the elements across its facets."""
        here = np.arange(self.owned_elements)
        element, other = self._across_facets()
        owned = element < self.owned_elements
        ranks = np.stack([element[owned], self.element_owners[other[owned]]], axis=1)
        ranks = np.unique(ranks[ranks[:, 1] != rank], axis=0)
        row = np.concatenate([here, ranks[:, 0]])
        order = np.argsort(row, kind="stable")  # the owner comes first
        value = np.concatenate([np.full(len(here), rank), ranks[:, 1]])[order]
        offsets = np.searchsorted(row[order], np.arange(self.owned_elements + 1))
        return value.astype(np.int32), offsets.astype(np.int32)

    def _across_facets(self) -> Tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Returns all pairs of elements on this rank with a common facet, in both orders."""
        n, corners = self.elements.shape
        if n == 0:
            return np.zeros(0, np.int64), np.zeros(0, np.int64)
        ordered = np.sort(self.elements, axis=1)
        sides = np.concatenate([np.delete(ordered, k, axis=1) for k in range(corners)])
        element = np.tile(np.arange(n), corners)
        order = np.lexsort(sides.T)
        same = (sides[order[1:]] == sides[order[:-1]]).all(axis=1)
        a, b = element[order[:-1][same]], element[order[1:][same]]
        return np.concatenate([a, b]), np.concatenate([b, a])

    def _owned_facets(self) -> NDArray[np.bool_]:
        """Returns the mask of the facets that this rank owns. A rank without nodes owns no
        facet."""
        rank = self.owners[0] if self.owned_nodes else -1
        return np.equal(self.facet_owners, rank)


def write_meshio(mesh: Any, path: Path, names: Dict[Tuple[int, int], str]) -> None:
    """Writes a `meshio.Mesh` made by `to_meshio`. The file, and those that meshio writes beside it,
    replace existing ones when all are complete. Raises `Status.ERROR_FILE` if meshio fails.
    `names` are those of tags, as of `Domain.tag_names`."""
    target = pathlib.Path(os.fsdecode(path))
    if target.suffix.lower() == ".inp":  # the only one of these formats with sets in meshio
        for block, tags in enumerate(mesh.cell_data["tag"]):
            for tag in np.unique(tags[tags != 0]):
                name = names.get((mesh.cells[block].dim, tag), f"{('region', 'tag')[block]}_{tag}")
                mesh.cell_sets[name] = [np.flatnonzero((tags == tag) & (k == block))
                                        for k in range(len(mesh.cells))]
    try:
        with tempfile.TemporaryDirectory(prefix=".pnpbs-", dir=target.parent) as folder:
            mesh.write(pathlib.Path(folder) / target.name)
            for written in pathlib.Path(folder).iterdir():
                written.replace(target.parent / written.name)
    except Exception as error:  # meshio raises errors of many types
        reason = f"{type(error).__name__}: {error}"
        raise PNPBSError(Status.ERROR_FILE, f"meshio cannot write '{target}' ({reason}); write a .msh "
                         "file, which Gmsh converts") from error


def _package(name: str) -> Any:
    """Imports an optional package."""
    return importlib.import_module(name)


def _rows_of(table: NDArray[Any], rows: NDArray[Any]) -> NDArray[np.int64]:
    """Returns the index in `table` of each of the rows. Each of them occurs in the table exactly
    once."""
    _, key = np.unique(np.concatenate([table, rows]), axis=0, return_inverse=True)
    key = key.ravel()
    place = np.empty(len(table), np.int64)
    place[key[:len(table)]] = np.arange(len(table))
    return np.take(place, key[len(table):])


def _linear_coordinates(dim: int, corners: int) -> Any:
    """Returns UFL's mesh of straight triangles or tetrahedra."""
    ufl = _package("ufl")
    cell = ufl.Cell("triangle" if corners == 3 else "tetrahedron", geometric_dimension=dim)
    return ufl.Mesh(ufl.VectorElement("Lagrange", cell, 1, dim=dim))


def _tags_in_dolfinx(mesh: Any, dim: int, corners: NDArray[np.int64], tags: Int32s) -> Any:
    """Returns mesh tags of entities of a dimension. Each entity is given on one rank by the numbers
    of its nodes."""
    dolfinx = _package("dolfinx")
    entities, values = dolfinx.cpp.io.distribute_entity_data(mesh._mesh, dim, corners, tags)
    mesh.topology.create_connectivity(dim, 0)
    mesh.topology.create_connectivity(dim, mesh.topology.dim)
    return dolfinx.mesh.meshtags_from_entities(
        mesh, dim, dolfinx.cpp.graph.AdjacencyList_int32(entities), values)
