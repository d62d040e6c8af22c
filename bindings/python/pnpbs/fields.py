# SPDX-License-Identifier: BSD-3-Clause
"""Fields: values at nodes, on all ranks and from one set of nodes to the next."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import as_points
from ._interface import library
from ._types import Doubles
from .context import Handle
from .placement_handle import PlacementHandle

if TYPE_CHECKING:
    from .placement import Placement


def _sizes(values: Doubles) -> Tuple[int, int]:
    """Returns the number of entries, and of components at each."""
    return values.shape[0], int(np.prod(values.shape[1:], dtype=np.int64))


def _as_field(values: ArrayLike) -> Doubles:
    field = np.ascontiguousarray(values, np.float64)
    return field.reshape(1) if field.ndim == 0 else field


class Fields(PlacementHandle):
    """The part of `Placement` that works on values at nodes: arrays of (n,) or (n, ...) numbers,
    those of this rank's nodes in the order of `nodes`, then those of its ghosts."""

    def update_ghosts(self, values: Doubles) -> Doubles:
        """Updates the values at ghosts from their owners: `values`, with an entry for each node of
        this rank, followed by one for each ghost, is changed in place and returned. Collective."""
        self._in_place("update_ghosts", values)
        return values

    def begin_update_ghosts(self, values: ArrayLike) -> None:
        """Begins an update of ghosts, for a solver that computes while messages travel: starts
        sending what other ranks need of `values`, which may be changed after the call. At most one
        update is in progress. Collective."""
        field = _as_field(values)
        self._call("begin_update_ghosts", *_sizes(field), field)

    def end_update_ghosts(self, values: Doubles) -> Doubles:
        """Ends an update of ghosts: waits for what the other ranks sent and fills the ghosts'
        entries of `values`, which is returned. Local."""
        self._in_place("end_update_ghosts", values)
        return values

    def add_from_ghosts(self, values: Doubles) -> Doubles:
        """Adds the values at ghosts to those of the nodes they represent, on the ranks that own
        these. It is the reverse of `update_ghosts`, for sums over elements to which several ranks
        contribute. `values` is changed in place and returned; the entries of ghosts are unchanged.
        Each sum, of a node's value and those at its ghosts, is exact and rounded once, so the order
        of ranks has no effect. Values that a rank has summed by itself before were rounded there:
        unless these sums are exact, results differ by rounding between numbers of ranks. Where all
        bits must agree, use `incident_elements`. Collective."""
        self._in_place("add_from_ghosts", values)
        return values

    def _in_place(self, name: str, values: Doubles) -> None:
        ok = (isinstance(values, np.ndarray) and values.dtype == np.float64 and values.ndim > 0
              and values.flags.c_contiguous and values.flags.writeable)
        if ok:
            self._call(name, *_sizes(values), values)
            return
        # The library hears of it, and so do the other ranks, which would wait otherwise.
        getattr(library(), f"pnpbs_placement_{name}")(self._live(), -1, 1, None)
        raise ValueError("values must be a writable, C-contiguous array of float64")

    # Any: a float of (n,) values, an array of others, which their types do not tell apart.
    def sum(self, values: ArrayLike) -> Any:
        """Sums each component over the nodes of all ranks: exact, rounded once, and so the same
        bits for any number of ranks and threads. Entries of ghosts are ignored. Collective."""
        field = _as_field(values)
        n, components = _sizes(field)
        sums = np.zeros(components)
        self._call("sum", n, components, field, sums)
        return _shaped(sums, field)

    def dot(self, x: ArrayLike, y: ArrayLike) -> Any:
        """Computes the dot product of two fields over the nodes of all ranks, for each component,
        as exact as `sum`. Collective."""
        first, second = _as_field(x), _as_field(y)
        n, components = _sizes(first)
        if first.shape != second.shape:
            library().pnpbs_placement_dot(self._live(), -1, 1, None, None, None)
            raise ValueError(f"x has shape {first.shape} and y {second.shape}; the same was expected")
        products = np.zeros(components)
        self._call("dot", n, components, first, second, products)
        return _shaped(products, first)


def _shaped(sums: Doubles, field: Doubles) -> Any:
    return float(sums[0]) if field.ndim == 1 else sums.reshape(field.shape[1:])


class Transfer(Handle):
    """Transfers a field to a later set of nodes: copies `values` at the current nodes of the
    placement, (n,) or (n, ...) in the order of `nodes`, with these nodes and their triangles or
    tetrahedra, on which it is linear. The nodes may then move, be replaced or change their ranks.
    Linear fields are preserved, and others change by a term of second order in d. With `order=2` a
    quadratic polynomial is fitted to the neighbours of each node: then quadratic fields are
    preserved, others change by a term of third order, and next to jumps they may leave the range of
    the values there. Collective.

        field = pnpbs.Transfer(placement, temperature)
        placement.set_spacing(finer).run()
        temperature = field.at_nodes(placement)"""

    def __init__(self, placement: Placement, values: ArrayLike, order: int = 1) -> None:
        super().__init__()
        if order not in (1, 2):
            raise ValueError(f"order is {order}; 1 or 2 was expected")
        self.context = placement.context
        field = _as_field(values)
        self._shape = field.shape[1:]
        handle = ctypes.c_void_p()
        create = (library().pnpbs_transfer_create if order == 1 else
                  library().pnpbs_transfer_create_second_order)
        self.context._check(create(placement._live(), *_sizes(field), field, ctypes.byref(handle)))
        self._handle = handle.value
        self.context._children.append(self)

    def close(self) -> None:
        """Releases the resources of the library. Closing twice is allowed. Local."""
        if self.is_open:
            self.context._check(self._destroy(library().pnpbs_transfer_destroy))
            self.context._children.remove(self)

    def __repr__(self) -> str:
        return f"<pnpbs.Transfer, {'open' if self.is_open else 'closed'}>"

    @property
    def linear_nodes(self) -> int:
        """The number of nodes, on all ranks, at which a second-order transfer has no quadratic
        polynomial: they had too few neighbours, or are on surfaces alone. -1 for a first-order one.
        Local."""
        count = ctypes.c_int64()
        self.context._check(library().pnpbs_transfer_order(self._live(), None, ctypes.byref(count)))
        return count.value

    def at_nodes(self, placement: Placement, conserve: bool = False) -> Doubles:
        """Evaluates the field at the current nodes of a placement: the same bits for any number of
        ranks, at creation and now. With `conserve` the same number is added everywhere, so that the
        integral is unchanged, to rounding; on a sphere that is the sum of the triangles' areas
        along it times the means of their corners' values. Collective."""
        n = placement.node_count
        values = np.zeros((n, *self._shape))
        self.context._check(library().pnpbs_transfer_at_nodes(
            self._live(), placement._live(), bool(conserve), n, values))
        return values

    def at_points(self, coordinates: ArrayLike) -> Doubles:
        """Evaluates the field at arbitrary points, the rows of `coordinates`; each rank passes its
        own, or none. Collective."""
        dim = ctypes.c_int32()
        self.context._check(library().pnpbs_transfer_sizes(self._live(), ctypes.byref(dim), None))
        points = as_points(coordinates, dim.value, "coordinates")
        values = np.zeros((len(points), *self._shape))
        self.context._check(library().pnpbs_transfer_at_points(self._live(), len(points), points,
                                                               values))
        return values
