# SPDX-License-Identifier: BSD-3-Clause
"""Conversion of the library's status to Python exceptions."""

from __future__ import annotations

import enum
from typing import Any, Optional

from ._interface import library


class Status(enum.IntEnum):
    """The header's statuses: the outcome of a call, or the reason for its failure.

    Of a run: `OK`; `NOT_CONVERGED`, the step limit was reached before the bubbles were at rest,
    which is no failure; `SPACING_MISSED`, in one of the bands of `Placement.edge_bands` with 50
    edges or more the mean differs from 1 by more than 0.1; `NOT_CONFORMING`, the elements do not
    fill the domain; `STOPPED` by the monitor. In all these cases the nodes are valid."""

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


class PNPBSError(Exception):
    """An error of the library. `status` is a `Status` such as `Status.ERROR_SPACING`; the message
    says what was wrong, with the value, and what to change. Functions marked "collective" raise on
    all ranks or on none.

    An exception that a callback raises is raised unchanged by the call in progress, on the rank
    that raised it; the other ranks get a `PNPBSError` with `Status.ERROR_CALLBACK`."""

    def __init__(self, status: Status, message: str) -> None:
        super().__init__(message)
        self.status = status


def last_error(context: Any) -> str:
    """Returns the message of the last error on a context; of this thread with None."""
    return str(library().pnpbs_last_error(context).decode())


def check_without_context(code: int) -> None:
    """Checks a status without a context to hold the message, after a failed create."""
    if code < 0:
        raise PNPBSError(Status(code), last_error(None))
