# SPDX-License-Identifier: BSD-3-Clause
"""The arrays of a rank's part of a distributed mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ._types import Doubles, Ids, Int32s
from .rows import CompressedRows


@dataclass(frozen=True, eq=False, repr=False)
class MeshArrays:
    """The numbers and arrays of a `DistributedMesh`. Local indices count from 0: first what this
    rank owns, then the ghosts. Numbers count from 0 over all ranks, contiguously by rank, as in
    `placement.numbering`.

    - `dim`: coordinates of a node, 2 or 3.
    - `owned_nodes`, `owned_elements`: how many this rank owns.
    - `first_node`, `first_element`: its node i has the number `first_node + i`; elements likewise.
    - `all_nodes`, `all_elements`: how many there are over all ranks, each counted once.
    - `coordinates`: of the nodes here, (nodes, dim).
    - `numbers`, `ids`, `owners`, `tags`: of each node; tags as in `placement.nodes`.
    - `elements`: local indices of their corners, (elements, 3) or (elements, 4).
    - `element_numbers`, `element_owners`, `element_tags`: of each element; the tag is that of the
      region it lies in (`domain.add_region`), or 0 if the region has none; on surfaces alone, that
      of the surface.
    - `connectivity`: numbers of the nodes at the corners, of the same shape as `elements`.
    - `facets`: local indices of the nodes of facets of these elements, (facets, 2) or (facets, 3):
      edges of triangles in the plane that are parts of the boundary or of inner curves, in the
      direction of the curve; triangles of tetrahedra that are parts of the boundary or of inner
      surfaces, counter-clockwise as seen from outside, or turning as the inner surface does; on
      surfaces alone the edges of only one triangle. Each comes once on a rank.
    - `facet_tags`: of the curve or surface; on surfaces alone, of the surface.
    - `facet_elements`: local indices of the elements at it, (facets, 2); the second is -1 if there
      is none, or if it is not on this rank.
    - `facet_opposite`: the corner of the first of them, from 0, that is none of the facet's.
    - `facet_inner`: whether there are elements on both sides, on whichever ranks.
    - `facet_owners`: the rank it belongs to, the owner of its element with the lowest number.
    - `shared_nodes`: local indices of the nodes that this rank shares, by number. A node is shared
      by its owner and the ranks that own an element at it.
    - `sharing_ranks`: rows of the other ranks that share each of `shared_nodes`."""

    dim: int
    owned_nodes: int
    first_node: int
    all_nodes: int
    owned_elements: int
    first_element: int
    all_elements: int
    coordinates: Doubles
    numbers: Ids
    ids: Ids
    owners: Int32s
    tags: Int32s
    elements: Int32s
    element_numbers: Ids
    element_owners: Int32s
    element_tags: Int32s
    connectivity: Ids
    facets: Int32s
    facet_tags: Int32s
    facet_elements: Int32s
    facet_opposite: Int32s
    facet_inner: NDArray[np.bool_]
    facet_owners: Int32s
    shared_nodes: Int32s
    sharing_ranks: CompressedRows[np.int32]
