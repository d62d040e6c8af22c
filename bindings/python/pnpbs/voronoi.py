# SPDX-License-Identifier: BSD-3-Clause
"""Voronoi cells: volumes, faces and shares of the boundary as plain arrays."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from ._interface import library
from ._types import Doubles, Ids
from .context import Context
from .placement_handle import PlacementHandle
from .rows import CompressedRows


@dataclass(frozen=True, eq=False, repr=False)
class VoronoiCells:
    """The Voronoi cells of the nodes that this rank owns, as returned by `placement.voronoi`, in
    the order of `placement.nodes`. In the plane and on surfaces, volumes are areas, and areas of
    faces are lengths. On surfaces alone distances are straight. On spheres lengths, areas and
    distances are along the sphere.

    - `volumes`: volume of each cell.
    - `boundary`: the outward normal integrated over the part of the boundary that is closest to the
      node, of shape (nodes, dim). Where the boundary is flat, its length is the area of this part.
      It is 0 for nodes away from the boundary. In the plane and in bodies, the areas of the faces
      of a cell times their normals and its share of the boundary add up to 0.
    - `neighbours`: for each cell, a row of the ids of the neighbours with which it shares a face,
      in the order of ids.
    - `numbers`: numbers of these neighbours, as in `placement.numbering`. This array and the
      following ones have an entry for each of `neighbours.values`.
    - `areas`: areas of the faces. Both cells at a face have the same area to the last bit.
    - `distances`: distances from the node to the neighbour.
    - `normals`: unit vectors from the node to the neighbour, of shape (faces, dim)."""

    volumes: Doubles
    boundary: Doubles
    neighbours: CompressedRows[np.int64]
    numbers: Ids
    areas: Doubles
    distances: Doubles
    normals: Doubles

    def __repr__(self) -> str:
        return f"<pnpbs.VoronoiCells, {len(self.volumes)} cells, {len(self.areas)} faces here>"

    @classmethod
    def _copied(cls, context: Context, handle: ctypes.c_void_p) -> VoronoiCells:
        """Copies all arrays of cells of the library."""
        check = context._check
        dim, nodes, faces = ctypes.c_int32(), ctypes.c_int64(), ctypes.c_int64()
        check(library().pnpbs_voronoi_sizes(handle, *map(ctypes.byref, (dim, nodes, faces))))
        n, m, k = nodes.value, faces.value, dim.value
        cells = cls(
            volumes=np.zeros(n), boundary=np.zeros((n, k)), neighbours=CompressedRows(
                np.zeros(n + 1, np.int64), np.zeros(m, np.int64)), numbers=np.zeros(m, np.int64),
            areas=np.zeros(m), distances=np.zeros(m), normals=np.zeros((m, k)))
        check(library().pnpbs_voronoi_get_cells(handle, n, cells.volumes, cells.boundary))
        check(library().pnpbs_voronoi_get_faces(
            handle, n, m, cells.neighbours.offsets, cells.neighbours.values, cells.numbers,
            cells.areas, cells.distances, cells.normals))
        return cells


class Tessellation(PlacementHandle):
    """The part of `Placement` that creates Voronoi cells."""

    def voronoi(self) -> VoronoiCells:
        """Creates the Voronoi cells of the current nodes: for each node the part of the elements of
        the placement that is closer to it than to any other node, with its volume, its faces to
        neighbours and its share of the boundary. Each element is divided among the corners of all
        elements that touch it, so a cell does not extend through a gap without elements. The
        volumes add up to that of the elements, up to rounding. The bits do not depend on the number
        of ranks and threads. Collective.

        Returns `VoronoiCells`, which are copies: nodes may move afterwards, and the placement may
        be closed. Raises `Status.ERROR_STATE` without nodes."""
        handle = ctypes.c_void_p()
        self.context._check(library().pnpbs_voronoi_create(self._live(), ctypes.byref(handle)))
        try:
            return VoronoiCells._copied(self.context, handle)
        finally:
            self.context._check(library().pnpbs_voronoi_destroy(ctypes.byref(handle)))
