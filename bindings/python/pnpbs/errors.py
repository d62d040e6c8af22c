# SPDX-License-Identifier: BSD-3-Clause
"""Conversion of the library's status to exceptions."""

from __future__ import annotations

import ctypes
import enum
from typing import Any, Optional, Sequence, Tuple

import numpy as np

from ._interface import library


class Status(enum.IntEnum):
    """Status of a call: an outcome with valid results, or the kind of an error.

    Outcomes of a run, in all of which the nodes are valid:

    - `OK`: the bubbles are at rest.
    - `NOT_CONVERGED`: the step limit was reached before the bubbles were at rest. This is not an
      error.
    - `STOPPED`: the monitor has stopped the run.
    - `SPACING_MISSED`: in a band of `Placement.edge_bands` with 50 edges or more, the mean differs
      from 1 by more than 0.1.
    - `NOT_CONFORMING`: the elements do not fill the domain.

    The other values are errors; `PNPBSError.status` has them."""

    OK = 0
    NOT_CONVERGED = 1
    STOPPED = 2
    SPACING_MISSED = 3
    NOT_CONFORMING = 4
    ERROR_ARGUMENT = -1
    ERROR_HANDLE = -2
    ERROR_STATE = -3
    ERROR_DOMAIN = -4
    ERROR_SPACING = -5
    ERROR_KEY = -6
    ERROR_CAPACITY = -7
    ERROR_FILE = -8
    ERROR_CALLBACK = -9
    ERROR_MEMORY = -10
    ERROR_MPI = -11
    ERROR_KOKKOS = -12
    ERROR_UNSUPPORTED = -13
    ERROR_INTERNAL = -14

    def __str__(self) -> str:
        return self.name


class ErrorReason(enum.IntEnum):
    """Detail of an error besides its status. `CROSSING` comes with `Status.ERROR_DOMAIN`: segments
    of curves cross or overlap."""

    OTHER = 0
    CROSSING = 1


class PNPBSError(Exception):
    """An error of the library.

    - `status`: a `Status` such as `Status.ERROR_SPACING`.
    - `reason`: an `ErrorReason`.
    - `points`: the points that the message names.

    The message states what is wrong, with the value, and what to change. "Collective" functions
    raise on all ranks or on none.

    An exception that a callback raises ends the call in progress, which raises it unchanged on the
    rank of the callback. The other ranks raise a `PNPBSError` with `Status.ERROR_CALLBACK`."""

    def __init__(self, status: Status, message: str,
                 reason: ErrorReason = ErrorReason.OTHER,
                 points: Sequence[Tuple[float, ...]] = ()) -> None:
        super().__init__(message)
        self.status = status
        self.reason = reason
        self.points = tuple(points)


class OutcomeError(Exception):
    """The outcome of a run with `strict=True` that is not `Status.OK`. The nodes are valid and are
    kept.

    - `status`: the outcome, such as `Status.SPACING_MISSED`.
    - `warnings`: the messages of the run's warnings."""

    def __init__(self, status: Status, warnings: Sequence[str]) -> None:
        super().__init__("; ".join([f"the outcome of the run is {status}", *warnings]))
        self.status = status
        self.warnings = tuple(warnings)


def last_error(context: Any) -> str:
    """Returns the message of the last error on a context, or of this thread if it is None."""
    return str(library().pnpbs_last_error(context).decode())


def error_of(code: int, context: Any) -> PNPBSError:
    """Returns the exception for a status that is an error, with reason and points of the last
    error."""
    reason, count = ctypes.c_int32(), ctypes.c_int32()
    library().pnpbs_last_error_data(context, ctypes.byref(reason), ctypes.byref(count))
    known = reason.value in ErrorReason.__members__.values()
    points = []
    for k in range(count.value):
        point = np.zeros(3)
        library().pnpbs_last_error_point(context, k, point, None, None)
        points.append(tuple(float(c) for c in point if not np.isnan(c)))
    return PNPBSError(Status(code), last_error(context),
                      ErrorReason(reason.value) if known else ErrorReason.OTHER, points)


def check_without_context(code: int) -> None:
    """Raises a `PNPBSError` if a function without a context fails."""
    if code < 0:
        raise error_of(code, None)
