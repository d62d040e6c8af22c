# SPDX-License-Identifier: BSD-3-Clause
"""From the library's status to Python's exceptions."""

import enum

from ._interface import STATUSES, library


class _Named(enum.IntEnum):
    def __str__(self):
        return self.name


Status = _Named("Status", {name.removeprefix("PNPBS_"): value for name, value in STATUSES.items()},
                module=__name__)
Status.__doc__ = """The header's statuses: what a call came to, and why it failed.

Of a run: `OK`; `NOT_CONVERGED`, the step limit came before the bubbles rested, which is no failure;
`SPACING_MISSED`, in one of the bands of `Placement.edge_bands` with 50 edges or more the mean is off
1 by more than 0.1; `STOPPED` by the monitor. In all four cases the nodes are valid."""


class PNPBSError(Exception):
    """What the library refused. `status` is a `Status` such as `Status.ERROR_SPACING`; the message
    says what was wrong, with the value, and what to change. Functions marked "collective" raise on
    all ranks or on none.

    An exception that your own callback raises comes out of the call in progress as it is, on the
    rank that raised it; the other ranks get a `PNPBSError` with `Status.ERROR_CALLBACK`."""

    def __init__(self, status, message):
        super().__init__(message)
        self.status = status


def last_error(context):
    """The message of the last error on a context; of this thread with None."""
    return library().pnpbs_last_error(context).decode()


def check_without_context(code):
    """What could not be made has no context to hold the message."""
    if code < 0:
        raise PNPBSError(Status(code), last_error(None))
