# SPDX-License-Identifier: BSD-3-Clause
"""Fields: values at nodes. They are exchanged between ranks, summed, and transferred from one set
of nodes to the next."""

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
    """Returns the number of entries, and the number of components of each."""
    return values.shape[0], int(np.prod(values.shape[1:], dtype=np.int64))


def _as_field(values: ArrayLike) -> Doubles:
    """Converts to a float64 array of at least one dimension. An array of the right type and order
    is not copied."""
    field = np.ascontiguousarray(values, np.float64)
    return field.reshape(1) if field.ndim == 0 else field


class Fields(PlacementHandle):
    """The part of `Placement` that works on fields. A field is an array of shape (n,) or (n, ...)
    with the values at the nodes of this rank in the order of `nodes`, followed by those at its
    ghosts."""

    def update_ghosts(self, values: Doubles) -> Doubles:
        """Updates the values at ghosts from their owners. `values` has an entry for each node of
        this rank, followed by one for each ghost. It is changed in place and returned. Collective.

        Raises ValueError unless `values` is a writeable float64 array in C order, and
        `Status.ERROR_ARGUMENT` for a wrong number of entries."""
        self._in_place("update_ghosts", values)
        return values

    def begin_update_ghosts(self, values: ArrayLike) -> None:
        """Begins an update of ghosts, for a solver that computes while messages are being sent. It
        copies the values that other ranks need and starts sending them, so `values` may be changed
        after the call. A placement has at most one update in progress. Collective.

        Raises `Status.ERROR_STATE` if an update is in progress."""
        field = _as_field(values)
        self._call("begin_update_ghosts", *_sizes(field), field)

    def end_update_ghosts(self, values: Doubles) -> Doubles:
        """Ends an update of ghosts. It waits for the values that the other ranks have sent and
        fills the entries of ghosts in `values`, which is returned. Local.

        Raises `Status.ERROR_STATE` if no update is in progress, or if nodes have moved since it
        began."""
        self._in_place("end_update_ghosts", values)
        return values

    def add_from_ghosts(self, values: Doubles) -> Doubles:
        """Adds the values at ghosts to the values of the nodes that they represent, on the ranks
        that own these nodes. It is the reverse of `update_ghosts`, for sums over elements to which
        several ranks contribute. `values` is changed in place and returned; the entries of ghosts
        do not change. Collective.

        Each sum, of the value of a node and those at its ghosts, is exact and rounded once, so the
        order of ranks has no effect. Values that a rank has summed before are rounded already.
        Unless those sums are exact, results for different numbers of ranks differ by rounding. Use
        `incident_elements` where all bits must agree."""
        self._in_place("add_from_ghosts", values)
        return values

    def _in_place(self, name: str, values: Doubles) -> None:
        """Calls a function that changes `values`. Raises ValueError on this rank if the array is
        not suitable."""
        ok = (isinstance(values, np.ndarray) and values.dtype == np.float64 and values.ndim > 0
              and values.flags.c_contiguous and values.flags.writeable)
        if ok:
            self._call(name, *_sizes(values), values)
            return
        # An invalid call informs the library and thus the other ranks, which otherwise block.
        getattr(library(), f"pnpbs_placement_{name}")(self._live(), -1, 1, None)
        raise ValueError("values must be a writable, C-contiguous array of float64")

    # The result type is Any, because it depends on the shape of the values.
    def sum(self, values: ArrayLike) -> Any:
        """Sums each component over the nodes of all ranks. The sum is exact and rounded once, so
        its bits do not depend on the number of ranks and threads. Entries of ghosts are ignored.
        Returns a float for values of shape (n,), otherwise an array of shape (...). Collective."""
        field = _as_field(values)
        n, components = _sizes(field)
        sums = np.zeros(components)
        self._call("sum", n, components, field, sums)
        return _shaped(sums, field)

    def dot(self, x: ArrayLike, y: ArrayLike) -> Any:
        """Computes the dot product of two fields over the nodes of all ranks, for each component.
        It is as exact as `sum` and has the same shape. Both arrays must have the same shape, or the
        call raises ValueError. Collective."""
        first, second = _as_field(x), _as_field(y)
        n, components = _sizes(first)
        if first.shape != second.shape:
            library().pnpbs_placement_dot(self._live(), -1, 1, None, None, None)
            raise ValueError(f"x has shape {first.shape} and y {second.shape}; the same was expected")
        products = np.zeros(components)
        self._call("dot", n, components, first, second, products)
        return _shaped(products, first)


def _shaped(sums: Doubles, field: Doubles) -> Any:
    """Returns the sums as a float, or in the shape of the components."""
    return float(sums[0]) if field.ndim == 1 else sums.reshape(field.shape[1:])


class Transfer(Handle):
    """A transfer of a field to later sets of nodes. It holds copies of the values at the current
    nodes of a placement, of these nodes, and of their triangles or tetrahedra, each rank its own.
    The nodes may then move, be replaced or change their ranks. The creation is collective.

    - `placement`: the placement whose nodes have the values.
    - `values`: an array of shape (n,) or (n, ...) in the order of `placement.nodes`.
    - `order`: 1 or 2. With 1 the field is linear on each triangle or tetrahedron: linear fields are
      preserved, and others change by a term of second order in d. With 2 a quadratic polynomial is
      fitted to the neighbours of each node: quadratic fields are preserved, and others change by a
      term of third order. Next to jumps such a field may leave the range of the values.

    Raises `Status.ERROR_STATE` without nodes, and `Status.ERROR_ARGUMENT` for a wrong number of
    values or a value that is not finite.

        field = pnpbs.Transfer(placement, temperature)
        placement.set_spacing(finer).run()
        temperature = field.at_nodes(placement)
    """

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
        """Releases the resources of the library. Repeated calls have no effect. Local."""
        if self.is_open:
            self.context._check(self._destroy(library().pnpbs_transfer_destroy))
            self.context._children.remove(self)

    def __repr__(self) -> str:
        return f"<pnpbs.Transfer, {'open' if self.is_open else 'closed'}>"

    @property
    def linear_nodes(self) -> int:
        """The number of nodes, on all ranks, at which a second-order transfer has no quadratic
        polynomial, because they have too few neighbours or lie on surfaces alone. -1 for a
        first-order transfer. Local."""
        count = ctypes.c_int64()
        self.context._check(library().pnpbs_transfer_order(self._live(), None, ctypes.byref(count)))
        return count.value

    def at_nodes(self, placement: Placement, conserve: bool = False) -> Doubles:
        """Evaluates the field at the current nodes of a placement. The bits do not depend on the
        number of ranks, at creation and now. Collective.

        - `placement`: the same placement, or another one of the same context and dimension.
        - `conserve`: if true, one number per component is added everywhere, so that the integral of
          the field does not change, up to rounding. On a sphere the integral is the sum of the
          areas of the triangles along it times the means of the values at their corners.

        Returns an array of shape (n,) or (n, ...) in the order of `placement.nodes`. Use
        `update_ghosts` for values at ghosts."""
        n = placement.node_count
        values = np.zeros((n, *self._shape))
        self.context._check(library().pnpbs_transfer_at_nodes(
            self._live(), placement._live(), bool(conserve), n, values))
        return values

    def at_points(self, coordinates: ArrayLike) -> Doubles:
        """Evaluates the field at points of shape (n, dim). Each rank passes its own points, or
        none. In a periodic domain each point stands for its image in the box. Returns an array of
        shape (n,) or (n, ...). Raises `Status.ERROR_ARGUMENT` for coordinates that are not finite.
        Collective."""
        dim = ctypes.c_int32()
        self.context._check(library().pnpbs_transfer_sizes(self._live(), ctypes.byref(dim), None))
        points = as_points(coordinates, dim.value, "coordinates")
        values = np.zeros((len(points), *self._shape))
        self.context._check(library().pnpbs_transfer_at_points(self._live(), len(points), points,
                                                               values))
        return values
