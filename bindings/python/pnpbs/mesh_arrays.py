# SPDX-License-Identifier: BSD-3-Clause
"""The arrays of a distributed mesh on one rank."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ._types import Doubles, Ids, Int32s
from .rows import CompressedRows


@dataclass(frozen=True, eq=False, repr=False)
class MeshArrays:
    """The numbers and arrays of a `DistributedMesh` on one rank. Local indices count from 0: first
    what this rank owns, then the ghosts. Numbers count from 0 over all ranks and are contiguous by
    rank, as in `placement.numbering`.

    - `dim`: number of coordinates of a node, 2 or 3.
    - `owned_nodes`, `owned_elements`: how many this rank owns.
    - `first_node`, `first_element`: the owned node i has the number `first_node + i`; likewise for
      elements.
    - `all_nodes`, `all_elements`: how many exist over all ranks, each counted once.
    - `coordinates`: those of the nodes on this rank, of shape (nodes, dim).
    - `numbers`, `ids`, `owners`, `tags`: one of each per node; tags are those of `placement.nodes`.
    - `elements`: local indices of corners, of shape (elements, 3) or (elements, 4).
    - `element_numbers`, `element_owners`, `element_tags`: one of each per element. The tag is that
      of the region (`domain.add_region`), or 0 if the region has none; on surfaces alone it is that
      of the surface.
    - `connectivity`: numbers of the nodes at the corners, in the shape of `elements`.
    - `facets`: local indices of the nodes of the facets of these elements, of shape (facets, 2) or
      (facets, 3). In the plane, facets are edges on the boundary or on inner curves, in the
      direction of the curve. In space, they are triangles on the boundary, counter-clockwise as
      seen from outside, or on inner surfaces, oriented as the surface. On surfaces alone, they are
      the edges of only one triangle. Each facet occurs once on a rank.
    - `facet_tags`: tag of the curve or surface; on surfaces alone that of the surface.
    - `facet_elements`: local indices of the elements at each facet, of shape (facets, 2). The
      second is -1 if it does not exist or is not on this rank.
    - `facet_opposite`: index, from 0, of the corner of the first element that is not a corner of
      the facet.
    - `facet_inner`: whether elements lie on both sides of the facet, on any ranks.
    - `facet_owners`: the rank to which the facet belongs, the owner of its element with the lowest
      number.
    - `shared_nodes`: local indices of the nodes that this rank shares, in the order of numbers. A
      node is shared by its owner and the ranks that own an element at it.
    - `sharing_ranks`: for each of `shared_nodes`, a row of the other ranks that share it."""

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
