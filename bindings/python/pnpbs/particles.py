# SPDX-License-Identifier: BSD-3-Clause
"""Particles that fill a body, and their volumes."""

from __future__ import annotations

import ctypes
import os
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ._interface import library
from ._signals import signals_kept_in
from ._types import Doubles, Ids, Int32s, Path
from .context import Handle
from .domain import Domain
from .errors import Status

if TYPE_CHECKING:
    from .placement import Placement

_Self = TypeVar("_Self", bound="Particles")


class Particles(Handle):
    """Particles that fill a body. Each represents a piece of matter of about d^2, or d^3 in space.
    The creation is collective.

    - `placement`: its current nodes become the particles. They lie in the offset that
      `Domain.add_offset` makes of the body.
    - `body`: the body, on the same context and of the same dimension.

    Where two nodes are closer than 0.5 times the mean of their d, as at creases and in thin places,
    one of them is left out. Then pairs closer than 0.85 times that mean in space, or 0.9 times in
    the plane, are pushed apart by at most 0.3 d. Of pairs that are still closer than 0.611 in
    space, or 0.651 in the plane, one is left out. All others keep their positions. The volumes add
    up to that of the body. The bits do not depend on the number of ranks and threads. The particles
    are a copy: nodes may move afterwards.

    Raises `Status.ERROR_STATE` without nodes, and `Status.ERROR_DOMAIN` if the body is invalid or
    the nodes do not fill it.

    Attributes for the particles of this rank, in the order of their ids:

    - `points`: positions, of shape (n, dim).
    - `volumes`: volumes, or areas in the plane.
    - `spacing`: d of the nodes from which the particles were made.
    - `ids`: ids of these nodes; some numbers may be missing.
    - `tags`: tags of these nodes: the outermost ones have that of the offset, all others 0.

    Attributes over all ranks:

    - `count`: number of particles.
    - `left_out`: number of nodes left out because others are too close.
    - `moved`: number of particles that were pushed away from the positions of their nodes.
    - `closest`: the least distance of two particles over the mean of their d; infinity if no two
      are closer than that mean."""

    def __init__(self, placement: Placement, body: Domain) -> None:
        super().__init__()
        self.context = placement.context
        handle = ctypes.c_void_p()
        with signals_kept_in(self.context):
            code = library().pnpbs_particles_create(placement._live(), body._live(),
                                                    ctypes.byref(handle))
        self.context._check(code)
        self._handle = handle.value
        self.context._children.append(self)
        self._copy()

    def _copy(self) -> None:
        """Copies numbers and arrays from the library."""
        dim, n, count = ctypes.c_int32(), ctypes.c_int64(), ctypes.c_int64()
        left_out, moved, closest = ctypes.c_int64(), ctypes.c_int64(), ctypes.c_double()
        self._call("sizes", ctypes.byref(dim), ctypes.byref(n), ctypes.byref(count))
        self._call("figures", ctypes.byref(left_out), ctypes.byref(moved), ctypes.byref(closest))
        self.count, self.left_out, self.moved = count.value, left_out.value, moved.value
        self.closest = closest.value
        self.points: Doubles = np.zeros((n.value, dim.value))
        self.volumes: Doubles = np.zeros(n.value)
        self.spacing: Doubles = np.zeros(n.value)
        self.ids: Ids = np.zeros(n.value, np.int64)
        self.tags: Int32s = np.zeros(n.value, np.int32)
        self._call("get", n.value, self.points, self.volumes, self.spacing, self.ids, self.tags)

    def _call(self, name: str, *arguments: Any) -> Status:
        """Calls the function pnpbs_particles_<name> and returns its status."""
        function = getattr(library(), f"pnpbs_particles_{name}")
        with signals_kept_in(self.context):
            code = function(self._live(), *arguments)
        return self.context._check(code)

    def close(self) -> None:
        """Releases the resources of the library. The arrays remain. Repeated calls have no effect.
        Local."""
        if self.is_open:
            self.context._check(self._destroy(library().pnpbs_particles_destroy))
            self.context._children.remove(self)

    def __len__(self) -> int:
        return len(self.volumes)

    def __repr__(self) -> str:
        return f"<pnpbs.Particles, {len(self)} here, {self.count} in all>"

    def add_output_field(self: _Self, name: str, values: ArrayLike) -> _Self:
        """Adds a field of the caller, such as masses, to files that are written afterwards, in the
        formats that `Placement.add_output_field` names. `values` has the shape (n,) or (n, ...) in
        the order of `points`. A name can be used once. Returns the particles. Local."""
        field = np.atleast_1d(np.ascontiguousarray(values, np.float64))
        components = int(np.prod(field.shape[1:], dtype=np.int64))
        self._call("add_output_field", name.encode(), len(field), components, field)
        return self

    def write(self, *paths: Path) -> Status:
        """Writes the particles of all ranks into files whose extensions select the formats
        (`pnpbs.format_table()`). They hold `id`, `tag`, `spacing` and `volume`, and the added
        fields. Several files appear together when all are complete, or not at all. Returns
        `Status.OK`, or `Status.STOPPED` if the placement's monitor has stopped the call, which
        keeps existing files. Collective."""
        encoded = [os.fsencode(path) for path in paths]
        return self._call("write", len(paths), (ctypes.c_char_p * len(paths))(*encoded), None)
