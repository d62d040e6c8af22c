# SPDX-License-Identifier: BSD-3-Clause
"""Results of a placement, which are copied into new arrays. Local indices count the nodes of this
rank from 0, followed by its ghosts. Global ids do not depend on the number of ranks."""

from __future__ import annotations

import ctypes
import importlib
import os
from typing import Any, Dict, List, NamedTuple, Sequence, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike

from ._plots import plot_nodes
from ._summaries import summary
from ._types import Doubles, Ids, Int32s, Path
from ._warnings import WarningCode, WarningData
from .errors import PNPBSError, Status
from .placement_handle import PlacementHandle
from .rows import CompressedRows
from .tables import format_table, statistic_table


class Nodes(NamedTuple):
    """Nodes of a rank.

    - `points`: positions, of shape (n, dim).
    - `ids`: global ids.
    - `tags`: 0 for inner nodes, otherwise the tag of the curve, surface or fixed node.
    - `spacing`: d at the nodes."""

    points: Doubles
    ids: Ids
    tags: Int32s
    spacing: Doubles

    def __repr__(self) -> str:
        return summary(self)


class Ghosts(NamedTuple):
    """Ghosts of a rank: points, ids, tags and spacing as in `Nodes`, and the ranks that own
    them."""

    points: Doubles
    ids: Ids
    tags: Int32s
    spacing: Doubles
    owners: Int32s

    def __repr__(self) -> str:
        return summary(self)


class ExchangePattern(NamedTuple):
    """A halo exchange pattern: the neighbouring ranks, and a row of nodes to send and of ghosts to
    receive for each of them."""

    ranks: Int32s
    send: CompressedRows[np.int64]
    receive: CompressedRows[np.int64]

    def __repr__(self) -> str:
        return summary(self)


class Numbering(NamedTuple):
    """Numbers that are contiguous per rank: that of the first node of this rank, the number of its
    nodes, and the numbers of its ghosts."""

    first: int
    count: int  # type: ignore[assignment]  # hides tuple.count
    ghosts: Ids

    def __repr__(self) -> str:
        return summary(self)


class Stars(NamedTuple):
    """Delaunay stars: rows of neighbours, and for each neighbour whether it forms a triangle with
    the node and the next neighbour."""

    neighbours: CompressedRows[np.int64]
    triangle: CompressedRows[np.bool_]

    def __repr__(self) -> str:
        return summary(self)


class Edges(NamedTuple):
    """Edges with a mid node each.

    - `ends`: local indices, ascending, of shape (n, 2).
    - `numbers`: 0, 1, ... over all ranks.
    - `midpoints`: positions of the mid nodes, of shape (n, dim).
    - `straight`: number of edges of all ranks that do not follow the boundary, because an element
      would fold."""

    ends: Ids
    numbers: Ids
    midpoints: Doubles
    straight: int

    def __repr__(self) -> str:
        return summary(self)


class Facets(NamedTuple):
    """Facets: local indices of their corners, of shape (n, corners), and their tags. Facets of
    second order have mid nodes after the corners."""

    corners: Ids
    tags: Int32s

    def __repr__(self) -> str:
        return summary(self)


class EdgeBands(NamedTuple):
    """Statistics of edges by bands of d: ends of the bands, numbers of edges, and mean and standard
    deviation of edge length over d."""

    d_from: Doubles
    d_to: Doubles
    edges: Ids
    mean: Doubles
    deviation: Doubles


class CellBands(NamedTuple):
    """Statistics of Voronoi cells by bands of d: ends of the bands, numbers of cells or edges, the
    mean, and the worst value."""

    d_from: Doubles
    d_to: Doubles
    number: Ids
    mean: Doubles
    worst: Doubles


class CrackNodes(NamedTuple):
    """Copies of nodes on cracks: the local indices of the originals, numbers over all ranks, and
    the number of copies of all ranks. The local indices of the copies follow those of all nodes and
    ghosts."""

    nodes: Ids
    numbers: Ids
    all: int


class CrackFacets(NamedTuple):
    """Both sides of the facets of cracks: local indices in front and behind, the tags, and the area
    of all facets over that of the surfaces."""

    front: Ids
    back: Ids
    tags: Int32s
    covered: float


class Regions(NamedTuple):
    """The regions of a placement: their tags, numbers of nodes and of elements, and volumes or
    areas."""

    tags: Int32s
    nodes: Ids
    elements: Ids
    measures: Doubles


_Self = TypeVar("_Self", bound="Results")


def _extension(path: Path) -> str:
    return os.path.splitext(os.fsdecode(path))[1][1:].lower()


def _meshio_writes(path: Path) -> bool:
    """Returns whether meshio is installed and knows files with this extension."""
    try:
        known = importlib.import_module("meshio").extension_to_filetypes
    except ImportError:
        return False
    return "." + _extension(path) in known


def _refuse_pictures(paths: Sequence[Path]) -> None:
    for path in paths:
        if _extension(path) in ("png", "svg", "pdf"):
            raise ValueError(f"{os.fsdecode(path)!r} would be a picture: draw it with `plot`, and "
                             "save that, or write it by the command, pnpbs --output")


class Results(PlacementHandle):
    """The part of `Placement` that copies and writes results."""

    def _number(self, name: str, c_type: Any, *arguments: Any) -> Any:
        """Returns the number that a function of the library stores through its last argument."""
        number = c_type()
        self._call(name, *arguments, ctypes.byref(number))
        return number.value

    # ------------------------------------------------------------ nodes ------------------------

    @property
    def dim(self) -> int:
        """The dimension of points: 2 in the plane, 3 in space and on a sphere. Local."""
        return int(self._number("dimension", ctypes.c_int32))

    @property
    def sphere_radius(self) -> float:
        """The radius of the sphere on which the nodes lie, or 0 if the domain is not on a sphere.
        Local."""
        return float(self._number("sphere_radius", ctypes.c_double))

    @property
    def node_count(self) -> int:
        """The number of nodes of this rank. Local."""
        return int(self._number("count", ctypes.c_int64))

    def _placed_count(self) -> int:
        """Returns `node_count`. Raises `Status.ERROR_STATE` if it is 0, unless other ranks may have
        nodes."""
        if self.node_count == 0 and not self.context._on_ranks:
            raise PNPBSError(Status.ERROR_STATE,
                             "the placement has no nodes yet: call run first")
        return self.node_count

    def nodes(self) -> Nodes:
        """Returns a copy of the nodes of this rank, in their local order. `points` has the shape
        (n, dim). `ids` are global. `tags` are 0 for inner nodes and otherwise that of the curve,
        surface or fixed node. `spacing` is d at the nodes. Raises `Status.ERROR_STATE` before the
        first run, which on several ranks returns no nodes. Local."""
        n = self._placed_count()
        found = Nodes(np.zeros((n, self.dim)), np.zeros(n, np.int64), np.zeros(n, np.int32),
                      np.zeros(n))
        self._call("get_nodes", n, *found)
        return found

    def plot(self, ax: Any = None) -> Any:
        """Draws the nodes of this rank on `ax`, or on a new canvas if it is None, each in the
        colour of its tag, and returns the canvas. It uses Matplotlib in the plane, and PyVista in
        space, or Matplotlib if PyVista is not installed. Local."""
        nodes = self.nodes()
        return plot_nodes(nodes.points, nodes.tags, ax)

    def normals(self) -> Doubles:
        """Returns the surface normals at the nodes of this rank, of shape (n, 3), for a placement
        in space. They are unit normals. On feature edges and in corners they are means of the
        adjacent normals. They are 0 at inner nodes. Local."""
        found = np.zeros((self._placed_count(), 3))
        self._call("get_normals", len(found), found)
        return found

    def ghost_count(self) -> int:
        """Returns the number of ghosts: nodes of other ranks close to those of this rank.
        Collective."""
        return int(self._number("ghost_count", ctypes.c_int64))

    def ghosts(self) -> Ghosts:
        """Returns a copy of the ghosts in the order of their ids. `owners` are the ranks that own
        them. In lists, stars, triangles and tetrahedra, ghost g has the local index `node_count +
        g`. Collective."""
        n = self.ghost_count()
        found = Ghosts(np.zeros((n, self.dim)), np.zeros(n, np.int64), np.zeros(n, np.int32),
                       np.zeros(n), np.zeros(n, np.int32))
        self._call("get_ghosts", n, *found)
        return found

    def exchange_pattern(self) -> ExchangePattern:
        """Returns the halo exchange pattern: send the values at the nodes `send[k]` to `ranks[k]`,
        and store the values received from it at `receive[k]`, in the same order. The pattern is
        valid until nodes move. Collective."""
        neighbours, sends, receives = ctypes.c_int32(), ctypes.c_int64(), ctypes.c_int64()
        self._call("exchange_sizes", ctypes.byref(neighbours), ctypes.byref(sends),
                   ctypes.byref(receives))
        ranks = np.zeros(neighbours.value, np.int32)
        send = CompressedRows(np.zeros(len(ranks) + 1, np.int64), np.zeros(sends.value, np.int64))
        receive = CompressedRows(np.zeros(len(ranks) + 1, np.int64),
                                 np.zeros(receives.value, np.int64))
        self._call("get_exchange", len(ranks), sends.value, receives.value, ranks, send.offsets,
                   send.values, receive.offsets, receive.values)
        return ExchangePattern(ranks, send, receive)

    def numbering(self) -> Numbering:
        """Returns numbers that are contiguous per rank and start from 0 over all ranks, as PETSc
        and hypre require. Local node i has the number `first + i`, and ghost g has `ghosts[g]`.
        Unlike ids they depend on the partition. Collective."""
        first, count = ctypes.c_int64(), ctypes.c_int64()
        numbers = np.zeros(self.ghost_count(), np.int64)
        self._call("get_numbering", len(numbers), ctypes.byref(first), ctypes.byref(count), numbers)
        return Numbering(first.value, count.value, numbers)

    # ------------------------------------------------------------ lists and elements -----------

    def adjacency(self) -> CompressedRows[np.int64]:
        """Returns the adjacency lists: row i has the local indices of all nodes within
        `adjacency_radius` times the mean spacing of the pair, in the order of global ids. Pairs
        separated by a boundary are not neighbours. Collective."""
        entries = self._number("adjacency_size", ctypes.c_int64)
        rows = CompressedRows(np.zeros(self.node_count + 1, np.int64), np.zeros(entries, np.int64))
        self._call("get_adjacency", entries, rows.offsets, rows.values)
        return rows

    def stars(self) -> Stars:
        """Returns the star of each node in the constrained Delaunay triangulation of the domain.
        `neighbours[i]` has the local indices of the neighbours of node i, counter-clockwise.
        `triangle[i][k]` is True if the node, its k-th neighbour and the next one around form a
        triangle of the domain, and False if a gap outside the domain lies between them. In space
        the neighbours are all nodes that share a tetrahedron with node i, and `triangle[i][k]` is
        False. Collective."""
        entries = self._number("star_size", ctypes.c_int64)
        rows = CompressedRows(np.zeros(self.node_count + 1, np.int64), np.zeros(entries, np.int64))
        triangle = np.zeros(entries, np.int8)
        self._call("get_stars", entries, rows.offsets, rows.values, triangle)
        return Stars(rows, CompressedRows(rows.offsets, triangle.view(np.bool_)))

    def triangles(self, order: int = 1) -> Ids:
        """Returns the triangles of a placement in the plane or on a sphere, (n, 3) local indices,
        each once, counter-clockwise, on a sphere as seen from outside. A triangle belongs to the
        rank that owns its node with the lowest id; its other corners may be ghosts. Collective.

        - `order`: with 2 the shape is (n, 6): mid nodes follow, which are the `edges` in their
          order behind all nodes and ghosts. In a triangle with the corners 0, 1, 2 they are on 01,
          12 and 02."""
        return self._of_order(self._elements("get_triangles", 3), order)

    def tetrahedra(self, order: int = 1) -> Ids:
        """Returns the tetrahedra of a placement in space, (n, 4) local indices, each once. Seen
        from the fourth corner, the first three are counter-clockwise. A tetrahedron belongs to the
        rank that owns its node with the lowest id; its other corners may be ghosts. Collective.

        - `order`: with 2 the shape is (n, 10), with the mid nodes of `triangles` on 01, 12, 02, 03,
          13 and 23, the order of VTK and meshio."""
        return self._of_order(self._elements("get_tetrahedra", 4), order)

    def edges(self) -> Edges:
        """Returns the edges of the elements of this rank, and of its facets, with a mid node each,
        for elements of second order. Mid nodes on curves and surfaces of the domain lie on these,
        except where an element would fold. Numbers and mid nodes are the same for any number of
        ranks, several of which may have an edge. Collective."""
        count, straight = ctypes.c_int64(), ctypes.c_int64()
        sizes = ctypes.byref(count), ctypes.byref(straight)
        self._call("get_edges", 0, *sizes, None, None, None)
        n = count.value
        arrays = np.zeros((n, 2), np.int64), np.zeros(n, np.int64), np.zeros((n, self.dim))
        self._call("get_edges", n, *sizes, *arrays)
        return Edges(*arrays, straight.value)

    def set_cracks(self: _Self, tags: ArrayLike) -> _Self:
        """Sets which inner curves, in space inner surfaces, are cracks: those with these tags. Then
        `cracked_elements` and files of elements in .msh, .msh2, .vtu and .vtkhdf have elements that
        share no node across a crack; other formats of elements are an error, and all other results
        are unchanged. The elements around a node fall into sectors that cracks separate. One of
        them keeps the node, along a crack that on the left of a curve or in front of a surface, and
        each other one gets a copy of it. At the tip of a crack there is no copy. Local, with the
        same tags on all ranks. Raises `Status.ERROR_ARGUMENT` for the tag 0."""
        given = np.ascontiguousarray(np.atleast_1d(tags), np.int32)
        self._call("set_cracks", len(given), given)
        return self

    def crack_nodes(self) -> CrackNodes:
        """Returns the pairs of nodes on cracks: the local indices of the originals, of copies of
        this rank's nodes, and then of copies of ghosts that its elements refer to. Copy k of this
        list has the local index k behind all nodes and ghosts, and position, tag and spacing of its
        original. Numbers do not depend on ranks. Raises `Status.ERROR_ARGUMENT` if no inner curve
        or surface has one of the tags of `set_cracks`, and on surfaces alone. Collective."""
        count, all_copies = ctypes.c_int64(), ctypes.c_int64()
        sizes = ctypes.byref(count), ctypes.byref(all_copies)
        self._call("get_crack_nodes", 0, *sizes, None, None)
        nodes, numbers = np.zeros(count.value, np.int64), np.zeros(count.value, np.int64)
        self._call("get_crack_nodes", len(nodes), *sizes, nodes, numbers)
        return CrackNodes(nodes, numbers, all_copies.value)

    def cracked_elements(self) -> Ids:
        """Returns the elements with doubled nodes along cracks (`set_cracks`): triangles in the
        plane, (n, 3) local indices, in the order of `triangles`, or tetrahedra in space, (n, 4), in
        that of `tetrahedra`, which is also that of `element_tags`. Indices behind all nodes and
        ghosts are those of `crack_nodes`. Collective."""
        self._placed_count()
        in_space = self.dim == 3 and self.sphere_radius == 0
        corners = 3 if self.sphere_radius > 0 else self.dim + 1
        return self._elements("get_cracked_elements", corners)

    def crack_facets(self) -> CrackFacets:
        """Returns both sides of the facets of cracks, edges in the plane, (n, 2) local indices, and
        triangles in space, (n, 3), with their tags. Front is on the left of a curve from the first
        to the second node, or in front of a surface, from where the corners are counter-clockwise.
        The nodes of the sides coincide in pairs and are different except at tips. `covered` is 1 in
        the plane. Where d is too coarse for elements to follow a surface, facets are missing, and
        elements connect its two sides there. Collective."""
        self._placed_count()
        corners = 2 if self.sphere_radius > 0 else self.dim
        count, covered = ctypes.c_int64(), ctypes.c_double()
        sizes = ctypes.byref(count), ctypes.byref(covered)
        self._call("get_crack_facets", 0, *sizes, None, None, None)
        n = count.value
        front, back = np.zeros((n, corners), np.int64), np.zeros((n, corners), np.int64)
        tags = np.zeros(n, np.int32)
        self._call("get_crack_facets", n, *sizes, front, back, tags)
        return CrackFacets(front, back, tags, covered.value)

    def _of_order(self, cells: Ids, order: int) -> Ids:
        """Appends the mid nodes of elements or facets to their corners, if the order is 2."""
        if order not in (1, 2):
            raise ValueError(f"order is {order!r}; 1 or 2 was expected")
        if order == 1:
            return cells
        n, corners = cells.shape
        edges = np.zeros((n, corners * (corners - 1) // 2), np.int64)
        self._call("find_edges", n, corners, cells, edges)
        return np.hstack([cells, edges + self.node_count + self.ghost_count()])

    def element_tags(self) -> Int32s:
        """Returns the tag of each element, which is that of its region (`Domain.add_region`), or 0
        if the region has none. The order is that of `triangles`, in space that of `tetrahedra`.
        Raises `Status.ERROR_ARGUMENT` on surfaces alone. Collective."""
        count = ctypes.c_int64()
        self._call("get_element_tags", 0, ctypes.byref(count), None)
        tags = np.zeros(count.value, np.int32)
        self._call("get_element_tags", len(tags), ctypes.byref(count), tags)
        return tags

    def incident_elements(self) -> Ids:
        """Returns every element with a corner among the nodes of this rank, also those that belong
        to other ranks: triangles in the plane and on surfaces alone, (n, 3) local indices, or
        tetrahedra in space, (n, 4). With these a rank assembles the rows of its nodes without
        communication. The corner with the lowest id comes first. An element belongs to this rank,
        as defined by `triangles` and `tetrahedra`, if its first corner is one of the nodes of the
        rank. Elements are in the order of the ids of their corners, so those of a node are the
        same, in the same order, for any number of ranks. A row that is summed in this order always
        has the same bits. Collective."""
        count, corners = ctypes.c_int64(), ctypes.c_int32()
        sizes = ctypes.byref(count), ctypes.byref(corners)
        self._call("get_incident_elements", 0, *sizes, None)
        found = np.zeros((count.value, corners.value), np.int64)
        self._call("get_incident_elements", len(found), *sizes, found)
        return found

    def boundary_edges(self, order: int = 1) -> Facets:
        """Returns the edges between consecutive nodes on boundary and inner curves of a placement
        in the plane or on a sphere: (n, 2) local indices, and the tags of the curves. An edge
        belongs to the rank that owns its first node; the other one may be a ghost. Local with the
        order 1; with 2 the shape is (n, 3), with the mid node of `triangles` last, and the call is
        collective."""
        self._placed_count()
        return self._facets("get_boundary_edges", 2, order)

    def boundary_triangles(self, order: int = 1) -> Facets:
        """Returns the boundary triangles of a placement in space: (n, 3) local indices,
        counter-clockwise as seen from outside, and the tags of the surfaces there. On surfaces
        alone, they are the triangles between the nodes. A triangle belongs to the rank that owns
        its node with the lowest id. With the order 2 the shape is (n, 6), with mid nodes as in
        `triangles`. Collective."""
        return self._facets("get_boundary_triangles", 3, order)

    def _elements(self, name: str, corners: int) -> Ids:
        """Copies elements with so many corners."""
        count = ctypes.c_int64()
        self._call(name, 0, ctypes.byref(count), None)
        found = np.zeros((count.value, corners), np.int64)
        self._call(name, len(found), ctypes.byref(count), found)
        return found

    def _facets(self, name: str, corners: int, order: int) -> Facets:
        """Copies facets with so many corners."""
        count = ctypes.c_int64()
        self._call(name, 0, ctypes.byref(count), None, None)
        found = Facets(np.zeros((count.value, corners), np.int64), np.zeros(count.value, np.int32))
        self._call(name, count.value, ctypes.byref(count), *found)
        return Facets(self._of_order(found.corners, order), found.tags)

    def check(self) -> Status:
        """Checks the invariants of the results. Returns `Status.OK`, or `Status.NOT_CONFORMING`
        where `run` does, too. Raises `Status.ERROR_INTERNAL` if anything else is wrong, with ids
        and coordinates. Collective."""
        return self._call("check")

    # ------------------------------------------------------------ statistics -------------------

    def statistic(self, key: str) -> Any:
        """Returns a statistic by its name, such as "nodes", "hash" or "imbalance", as an int, a
        float or a str. `pnpbs.statistic_table()` lists them. Raises `Status.ERROR_KEY` for an
        unknown name. Collective."""
        types = {row.name: row.type for row in statistic_table()}
        return self._statistic(key, types.get(key, "real"))

    def statistics(self) -> Dict[str, Any]:
        """Returns all statistics as {name: value}. Collective."""
        return {row.name: self._statistic(row.name, row.type) for row in statistic_table()}

    def _statistic(self, key: str, kind: str) -> Any:
        """Returns a statistic with the function for its type."""
        if kind == "integer":
            return self._number("get_int64", ctypes.c_int64, key.encode())
        if kind == "real":
            return self._number("get_double", ctypes.c_double, key.encode())
        return (self._number("get_string", ctypes.c_char_p, key.encode()) or b"").decode()

    def edge_bands(self) -> EdgeBands:
        """Measures how well the edges of the triangles or tetrahedra follow the spacing, by bands
        of d. There are eight bands, equal in log d between the smallest and the largest d at the
        nodes, or one if the largest is less than 1.1 times the smallest. Bands without edges are
        left out. Returns for each band its lower and upper end, the number of edges, and the mean
        and standard deviation of their length over d. Edges between two boundary nodes are not
        counted. The result includes all ranks and is the same on each. Collective."""
        count = ctypes.c_int64()
        self._call("get_edge_bands", 0, ctypes.byref(count), *[None] * 5)
        n = count.value
        bands = EdgeBands(np.zeros(n), np.zeros(n), np.zeros(n, np.int64), np.zeros(n), np.zeros(n))
        self._call("get_edge_bands", n, ctypes.byref(count), *bands)
        return bands

    def cell_bands(self, measure: str) -> CellBands:
        """Measures the Voronoi cells of the nodes as finite volumes need them, by bands of d, in
        the plane and on spheres; elsewhere there are no bands. A cell is the polygon of the
        circumcentres of the triangles around an inner node that is not fixed. Collective.

        - `measure`: "edge_ratio" is the shortest over the longest edge of each cell. "area_ratio"
          is the smaller over the larger area of the two cells at each edge. "dual_offset" is, for
          each edge between two such nodes, the distance of its midpoint from that of the Voronoi
          edge across it, over its length. On spheres, lengths and areas are along the sphere.

        Returns for each band its lower and upper end, the number of cells or edges, the mean, and
        the smallest ratio or largest offset. The ends of the bands are those of `edge_bands`. Bands
        with neither a cell nor an edge are left out, so the bands are the same for all measures.
        The d of a cell is that of its node; the d of an edge is the mean at its ends. The result
        includes all ranks and is the same on each."""
        count = ctypes.c_int64()
        self._call("get_cell_bands", measure.encode(), 0, ctypes.byref(count), *[None] * 5)
        n = count.value
        bands = CellBands(np.zeros(n), np.zeros(n), np.zeros(n, np.int64), np.zeros(n), np.zeros(n))
        self._call("get_cell_bands", measure.encode(), n, ctypes.byref(count), *bands)
        return bands

    def regions(self) -> Regions:
        """Measures the regions of the domain by the tags of their elements (`element_tags`), also
        the elements without a tag if there are any. Returns for each tag the number of nodes of
        these elements, the number of elements, and their volume, in the plane their area. Nodes of
        an interface are in several regions. The result includes all ranks and is the same on each,
        with the same bits for any number of them. Raises `Status.ERROR_ARGUMENT` on surfaces alone.
        Collective."""
        count = ctypes.c_int64()
        self._call("get_regions", 0, ctypes.byref(count), *[None] * 4)
        n = count.value
        regions = Regions(np.zeros(n, np.int32), np.zeros(n, np.int64), np.zeros(n, np.int64),
                          np.zeros(n))
        self._call("get_regions", n, ctypes.byref(count), *regions)
        return regions

    def warnings(self) -> List[str]:
        """Returns the messages of warnings about domain and spacing, and, from the last run, about
        nodes that do not follow the spacing. Local."""
        count = self._number("warning_count", ctypes.c_int32)
        texts = [self._number("get_warning", ctypes.c_char_p, i) for i in range(count)]
        return [text.decode() for text in texts]

    def warning_data(self) -> List[WarningData]:
        """Returns the same warnings as a list of `WarningData`, for programs that act on them.
        Local."""
        return [self._warning(i, text) for i, text in enumerate(self.warnings())]

    def _warning(self, index: int, text: str) -> WarningData:
        """Returns the data of a warning."""
        code, count, value = ctypes.c_int32(), ctypes.c_int64(), ctypes.c_double()
        point = np.zeros(3)
        self._call("get_warning_data", index, ctypes.byref(code), ctypes.byref(count),
                   ctypes.byref(value), point)
        point = point[~np.isnan(point)]
        return WarningData(WarningCode(code.value), text, count.value,
                           None if np.isnan(value.value) else value.value,
                           point if len(point) else None)

    # ------------------------------------------------------------ files ------------------------

    def write(self, *paths: Path, elements: Union[bool, Sequence[bool]] = False,
              order: int = 1) -> Status:
        """Writes the nodes of all ranks into files. Several files appear together when all are
        complete, or not at all. Collective.

        - `*paths`: the files; their extensions select the formats (`pnpbs.format_table()`). All
          ranks pass the same.
        - `elements`: whether to write triangles or tetrahedra as well, one for all files or one for
          each. One True for all applies to the formats that can hold elements.
        - `order`: 2 writes elements of second order, with the mid nodes of `edges`, into .msh,
          .msh2, .vtu and .vtkhdf, whatever `elements` is. Mid nodes have the id -1, the smallest
          tag of the facets there, or 0, and the mean of d and of fields at both ends.

        A file with an extension that only meshio knows, such as .inp, .mesh or .exo, is
        written by meshio from `Placement.mesh` with elements, and as the only file of a call on one
        rank. In .inp each tag of facets and regions is a set of elements, with the name of the tag.

        Returns `Status.OK`, or `Status.STOPPED` if the monitor has stopped the call, which keeps
        existing files. Raises `Status.ERROR_FILE` with the name of the file, and
        `Status.ERROR_UNSUPPORTED` if a format requires HDF5 and the library has none."""
        encoded = [os.fsencode(path) for path in paths]
        formats = {row.name: row for row in format_table()}
        of_paths = [formats.get(_extension(path)) for path in paths]
        _refuse_pictures(paths)
        if order not in (1, 2):
            raise ValueError(f"order is {order!r}; 1 or 2 was expected")
        by_meshio = [path for path, row in zip(paths, of_paths) if row is None and _meshio_writes(path)]
        if by_meshio and (order == 2 or len(paths) > 1):
            raise ValueError(f"{os.fsdecode(by_meshio[0])!r} would be written by meshio, which takes one "
                             "file of a call, and elements of first order")
        if by_meshio:
            return self._write_by_meshio(paths[0])
        if order == 2 and elements is False:
            elements = True
        wanted = np.full(len(paths), elements, np.int32)
        if elements is True and len(paths) > 1:
            wanted[:] = [row is None or row.elements for row in of_paths]
        wanted *= order
        return self._call("write_files", len(paths), (ctypes.c_char_p * len(paths))(*encoded), None,
                          wanted)

    def _write_by_meshio(self, path: Path) -> Status:
        """Writes the mesh of the placement by meshio."""
        raise NotImplementedError  # Placement has meshes

    def add_output_field(self: _Self, name: str, values: ArrayLike) -> _Self:
        """Adds a field of the caller to files that are written afterwards, and returns the
        placement. The field appears next to `id`, `tag` and `spacing` in .vtu, .pvtu, .vtkhdf and
        .xdmf, in .msh and .msh2 as `$NodeData`, and in .csv as a column `name`, or `name:0`,
        `name:1` and so on. All ranks must add the same fields in the same order. Local.

        - `name`: 1 to 63 letters, digits, "_" and "-".
        - `values`: an array of shape (n,) or (n, ...) with up to 9 numbers at each node, in the
          order of `nodes`. Entries for ghosts may follow and are ignored. The values are copied.
          They belong to the current nodes: once these have moved, `write` raises until
          `clear_output_fields` is called."""
        field = np.atleast_1d(np.ascontiguousarray(values, np.float64))
        components = int(np.prod(field.shape[1:], dtype=np.int64))
        self._call("add_output_field", name.encode(), len(field), components, field)
        return self

    def clear_output_fields(self: _Self) -> _Self:
        """Removes the fields that `add_output_field` has added, and returns the placement.
        Local."""
        self._call("clear_output_fields")
        return self

    def write_checkpoint(self: _Self, path: Path) -> _Self:
        """Writes a file from which `read_checkpoint` continues, in another process and on any
        number of ranks, bit for bit as if there was no interruption. The format is VTKHDF, which
        ParaView opens, so name the file .vtkhdf. It replaces an existing file when it is complete.
        A monitor may call this function, on all ranks, in its calls between two steps; its other
        calls raise `Status.ERROR_STATE`. Returns the placement. Raises `Status.ERROR_UNSUPPORTED`
        without HDF5. Collective."""
        self._call("write_checkpoint", os.fsencode(path))
        return self

    def read_checkpoint(self: _Self, path: Path) -> _Self:
        """Restores a placement from a checkpoint. The placement must have the domain, options and
        spacing of the first run, except a spacing given by values at nodes, which the file
        contains. The next `run` or `step` does what it would have done where the checkpoint was
        written. Returns the placement. If the call raises, the placement does not change.
        Collective."""
        self._call("read_checkpoint", os.fsencode(path))
        return self
