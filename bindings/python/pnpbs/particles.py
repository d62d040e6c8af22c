# SPDX-License-Identifier: BSD-3-Clause
"""Particles that fill a body, with their volumes."""

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
    """Particles that fill `body`, made of the current nodes of a placement in what
    `Domain.add_offset` makes of the body: each stands for a piece of matter of about d^2, or d^3 in
    space. Where two nodes are closer than 0.5 times the mean of their d, as at creases and in thin
    places, one of them is left out; then pairs closer than 0.85, or 0.9 in the plane, are pushed
    apart, by at most 0.3 d; and of pairs still closer than 0.611, or 0.651 in the plane, one is left
    out. All others stay where they are. The volumes add up to the body's. Any number of ranks and threads gives the same bits.
    The particles are a copy: nodes may move afterwards. Collective.

    Of this rank, in the order of their ids:

    - `points`: (n, dim).
    - `volumes`: areas in the plane.
    - `spacing`: d of the bubbles that they were.
    - `ids`: of the nodes that they were; there may be gaps.
    - `tags`: of these nodes: the outermost ones have that of the offset, all others 0.

    Of all ranks:

    - `count`: how many there are.
    - `left_out`: nodes left out because others are too close.
    - `moved`: particles that were pushed away from where their nodes are.
    - `closest`: the least distance of two over the mean of their d; infinity if no two are closer
      than that mean."""

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
        function = getattr(library(), f"pnpbs_particles_{name}")
        with signals_kept_in(self.context):
            code = function(self._live(), *arguments)
        return self.context._check(code)

    def close(self) -> None:
        """Releases the resources of the library; the arrays remain. Closing twice is allowed.
        Local."""
        if self.is_open:
            self.context._check(self._destroy(library().pnpbs_particles_destroy))
            self.context._children.remove(self)

    def __len__(self) -> int:
        return len(self.volumes)

    def __repr__(self) -> str:
        return f"<pnpbs.Particles, {len(self)} here, {self.count} in all>"

    def add_output_field(self: _Self, name: str, values: ArrayLike) -> _Self:
        """Adds a field of the caller, such as masses, to files written from now on, in the formats
        that `Placement.add_output_field` names. A name can be used once. Local."""
        field = np.atleast_1d(np.ascontiguousarray(values, np.float64))
        components = int(np.prod(field.shape[1:], dtype=np.int64))
        self._call("add_output_field", name.encode(), len(field), components, field)
        return self

    def write(self, *paths: Path) -> Status:
        """Writes the particles of all ranks into files whose extensions select the formats
        (`pnpbs.format_table()`): with `id`, `tag`, `spacing` and `volume`, and the fields added.
        Several files appear together when all are complete, or not at all. The outcome is
        `Status.OK`, or `Status.STOPPED` by the placement's monitor, which keeps the old files.
        Collective."""
        encoded = [os.fsencode(path) for path in paths]
        return self._call("write", len(paths), (ctypes.c_char_p * len(paths))(*encoded), None)
