# SPDX-License-Identifier: BSD-3-Clause
"""Distributed meshes, as plain arrays of the part of each rank. They need not be closed."""

from __future__ import annotations

import ctypes
import os
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Iterator, List, TypeVar

import numpy as np

from ._interface import library
from ._signals import signals_kept_in
from ._summaries import counted
from ._types import Path
from .context import Context
from .mesh_conversions import MeshConversions
from .placement_handle import PlacementHandle
from .rows import CompressedRows


@dataclass(frozen=True, eq=False, repr=False)
class DistributedMesh(MeshConversions):
    """The part of this rank of a distributed mesh, as returned by `placement.mesh`. Its attributes
    are those of `MeshArrays`. `plot` draws it; `to_meshio`, `to_pyvista`, `to_skfem`, `to_dolfinx`
    and `to_petsc` convert it for other packages."""

    def __repr__(self) -> str:
        return (f"<pnpbs.DistributedMesh, {self.dim}D, {counted(len(self.ids), 'node')}, "
                f"{counted(len(self.elements), 'element')}, {counted(len(self.facets), 'facet')} "
                "on this rank>")

    @classmethod
    def _copied(cls, context: Context, handle: ctypes.c_void_p) -> DistributedMesh:
        """Copies all arrays of a mesh of the library."""
        check = context._check
        dim, corners = ctypes.c_int32(), ctypes.c_int32()
        owned_nodes, nodes, owned_elements, elements, facets = sizes = _int64s(5)
        check(library().pnpbs_mesh_sizes(handle, ctypes.byref(dim), ctypes.byref(corners),
                                         *map(ctypes.byref, sizes)))
        first_node, all_nodes, first_element, all_elements = numbering = _int64s(4)
        check(library().pnpbs_mesh_numbering(handle, *map(ctypes.byref, numbering)))
        shared, entries = sharing = _int64s(2)
        check(library().pnpbs_mesh_sharing_sizes(handle, *map(ctypes.byref, sharing)))
        n, m, f, k = nodes.value, elements.value, facets.value, corners.value
        inner = np.zeros(f, np.int8)
        mesh = cls(
            dim.value, owned_nodes.value, first_node.value, all_nodes.value, owned_elements.value,
            first_element.value, all_elements.value, coordinates=np.zeros((n, dim.value)),
            numbers=np.zeros(n, np.int64), ids=np.zeros(n, np.int64), owners=np.zeros(n, np.int32),
            tags=np.zeros(n, np.int32), elements=np.zeros((m, k), np.int32),
            element_numbers=np.zeros(m, np.int64), element_owners=np.zeros(m, np.int32),
            element_tags=np.zeros(m, np.int32), connectivity=np.zeros((m, k), np.int64),
            facets=np.zeros((f, k - 1), np.int32), facet_tags=np.zeros(f, np.int32),
            facet_elements=np.zeros((f, 2), np.int32), facet_opposite=np.zeros(f, np.int32),
            facet_inner=inner.view(np.bool_), facet_owners=np.zeros(f, np.int32),
            shared_nodes=np.zeros(shared.value, np.int32), sharing_ranks=CompressedRows(
                np.zeros(shared.value + 1, np.int64), np.zeros(entries.value, np.int32)))
        check(library().pnpbs_mesh_get_nodes(handle, n, mesh.coordinates, mesh.numbers, mesh.ids,
                                             mesh.owners, mesh.tags))
        check(library().pnpbs_mesh_get_elements(handle, m, mesh.elements, mesh.element_numbers,
                                                mesh.element_owners, mesh.element_tags))
        check(library().pnpbs_mesh_get_connectivity(handle, m, mesh.connectivity))
        check(library().pnpbs_mesh_get_facets(handle, f, mesh.facets, mesh.facet_tags,
                                              mesh.facet_elements, mesh.facet_opposite, inner,
                                              mesh.facet_owners))
        check(library().pnpbs_mesh_get_sharing(
            handle, shared.value, entries.value, mesh.shared_nodes, mesh.sharing_ranks.offsets,
            mesh.sharing_ranks.values))
        return mesh


def _int64s(n: int) -> List[ctypes.c_int64]:
    """Returns n integers for outputs of the library."""
    return [ctypes.c_int64() for _ in range(n)]


_Self = TypeVar("_Self", bound="Meshes")


class Meshes(PlacementHandle):
    """The part of `Placement` that creates distributed meshes."""

    def mesh(self, ghost_layers: int = 0) -> DistributedMesh:
        """Creates a distributed mesh of the current nodes. On each rank it has the nodes, elements
        and facets that the rank owns, and layers of ghost elements with their nodes. No rank holds
        more than its part. Collective.

        - `ghost_layers`: 0 to 16, the same on all ranks. With 0 this rank has only the elements
          that it owns. With 1 it also has the elements of other ranks that share a node with these
          elements or contain a node that it owns, and therefore all elements at its nodes. Each
          further layer adds the elements that share a node with the previous layer.

        Elements are triangles in the plane, tetrahedra in space, and triangles on surfaces alone.
        All have a positive orientation; on surfaces alone they are counter-clockwise as seen from
        the side to which the normal points. A node belongs to the rank that owns it in the
        placement, and an element to the owner of its node with the lowest id.

        Returns a `DistributedMesh`, which is a copy: nodes may move afterwards, and the placement
        may be closed. Raises `Status.ERROR_STATE` without nodes."""
        with self._mesh_of_library(ghost_layers) as handle:
            return DistributedMesh._copied(self.context, handle)

    def write_mesh(self: _Self, prefix: Path, ghost_layers: int = 1) -> _Self:
        """Writes a distributed mesh of the current nodes (see `mesh`) into files of Gmsh's format
        4.1, partitioned as Gmsh does it: rank r writes partition r + 1 to `prefix_<r + 1>.msh`.
        Collective.

        - `prefix`: folder and beginning of the names of the files, the same on all ranks.
        - `ghost_layers`: as in `mesh`. Programs that read ghost elements, such as deal.II, need one
          layer.

        A file has the nodes, elements and ghost elements of the rank and the facets that it owns.
        Nodes and elements have their numbers plus 1, and facets are numbered after all elements, so
        all files use the same numbers. Tags are physical groups, named as by `write`; the inside is
        a group, too. All files appear when all are complete. If the call raises, existing files do
        not change. Files of an earlier mesh on more ranks remain.

        Returns the placement. Raises `Status.ERROR_FILE` if a rank cannot write, with the name of
        its file."""
        with self._mesh_of_library(ghost_layers) as handle:
            with signals_kept_in(self.context):
                code = library().pnpbs_mesh_write(handle, os.fsencode(prefix))
            self.context._check(code)
        return self

    @contextmanager
    def _mesh_of_library(self, ghost_layers: int) -> Iterator[ctypes.c_void_p]:
        """Yields the handle of a new mesh, which is destroyed at the end of the block."""
        handle = ctypes.c_void_p()
        self.context._check(library().pnpbs_mesh_create(self._live(), ghost_layers,
                                                        ctypes.byref(handle)))
        try:
            yield handle
        finally:
            self.context._check(library().pnpbs_mesh_destroy(ctypes.byref(handle)))
