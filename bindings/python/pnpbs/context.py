# SPDX-License-Identifier: BSD-3-Clause
"""Contexts: one process, or the ranks of a communicator."""

from __future__ import annotations

import atexit
import ctypes
import numbers
from types import TracebackType
from typing import Any, Callable, List, Optional, Tuple, Type, TypeVar, Union

from ._interface import library
from ._types import FortranComm, OptionValue
from .errors import PNPBSError, Status, check_without_context, last_error

# Open contexts on communicators of mpi4py, in the order in which they were made: the same one on all
# ranks. mpi4py ends MPI after Python's own exit handlers.
_on_mpi4py: List[Context] = []

_Self = TypeVar("_Self", bound="Handle")


class Handle:
    """What contexts, domains and placements have in common: a handle of the library's that is closed
    once, by `close` or at the end of a `with` block."""

    def __init__(self) -> None:
        self._handle: Optional[int] = None

    @property
    def is_open(self) -> bool:
        """Whether it has not been closed."""
        return self._handle is not None

    def _live(self) -> int:
        """What the library is given: never the handle of a closed one."""
        if self._handle is None:
            raise PNPBSError(Status.ERROR_HANDLE, f"this {type(self).__name__} has been closed")
        return self._handle

    def _destroy(self, function: Callable[..., int]) -> int:
        """The handle stays where the library refuses, as in a callback."""
        handle = ctypes.c_void_p(self._handle)
        code = function(ctypes.byref(handle))
        self._handle = handle.value
        return code

    def close(self) -> None:
        """Releases what the library holds. Closing twice is allowed."""
        raise NotImplementedError

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()


class Context(Handle):
    """What domains and placements are made on.

    `Context()` is for one process and calls no MPI function. `Context(comm)` with a communicator of
    mpi4py, or with the Fortran handle of any communicator (`comm.py2f()`), lives on a duplicate of
    that communicator and is made collectively; `library` is what `MPI_Get_library_version` says, if
    the library should compare it with its own MPI. Other keywords are options, the defaults of
    placements made on it.

    `close` it, or use it in a `with` block, when it is no longer needed: that is collective, so no
    garbage collector does it. Contexts on communicators of mpi4py are closed when Python ends, at
    the latest; those with a raw handle must be closed before MPI is finalised. If a `with` block
    ends by an exception, a context on several ranks is not closed, for the others might never come
    to close theirs."""

    def __init__(self, comm: Optional[Union[int, FortranComm]] = None,
                 library: Optional[str] = None, **options: OptionValue) -> None:
        super().__init__()
        self._on_ranks = comm is not None
        self._raised: Optional[BaseException] = None  # by a callback, during the call in progress
        # Open domains and placements, kept here because the library holds their callbacks.
        self._children: List[Handle] = []
        self._handle = _created(comm, library)
        if hasattr(comm, "py2f"):
            _close_with_mpi(self)
        self.set(**options)

    def set(self, **options: OptionValue) -> Context:
        """Sets options by name, as placements made later start with them; `threads` can be set only
        here. Local. Unknown names and values out of range raise a `PNPBSError` that names the
        nearest option or the range. `pnpbs.option_table()` lists them."""
        for key, value in options.items():
            self._check(_set_option("context", self._live(), key, value))
        return self

    def close(self) -> None:
        """Releases what the library holds, with the domains and placements made here. Closing twice
        is allowed. Collective."""
        if not self.is_open:
            return
        for child in list(self._children):
            child.close()
        handle = self._handle
        code = self._destroy(_library().pnpbs_context_destroy)
        if code < 0:
            raise PNPBSError(Status(code), last_error(handle))

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        if kind is None or not self._on_ranks:
            self.close()

    def __repr__(self) -> str:
        what = ("over ranks" if self._on_ranks else "one process") if self.is_open else "closed"
        return f"<pnpbs.Context, {what}>"

    def _check(self, code: int) -> Status:
        """Every status of a call passes here. What a callback raised comes first: the library's own
        message could only say that a callback failed."""
        raised, self._raised = self._raised, None
        if raised is not None:
            raise raised
        if code < 0:
            raise PNPBSError(Status(code), last_error(self._handle))
        return Status(code)


_library = library  # the constructor has an argument of that name


def _created(comm: Optional[Union[int, FortranComm]],
             library_text: Optional[str]) -> Optional[int]:
    handle = ctypes.c_void_p()
    if comm is None:
        code = _library().pnpbs_context_create_serial(ctypes.byref(handle))
        check_without_context(code)
        return handle.value
    if hasattr(comm, "py2f"):
        comm, library_text = _of_mpi4py(comm)
    if not isinstance(comm, numbers.Integral):
        raise TypeError("a communicator of mpi4py or a Fortran handle was expected, not "
                        f"{type(comm).__name__}")
    if library_text is None:
        code = _library().pnpbs_context_create_f(comm, ctypes.byref(handle))
    else:
        code = _library().pnpbs_context_create_checked_f(comm, library_text.encode(),
                                                         ctypes.byref(handle))
    check_without_context(code)
    return handle.value


def _of_mpi4py(comm: FortranComm) -> Tuple[int, str]:
    """Fortran handle and library; a communicator means something only while MPI runs, and otherwise
    the library says what is wrong."""
    from mpi4py import MPI
    running = MPI.Is_initialized() and not MPI.Is_finalized()
    # Open MPI counts the text's end as a part of it.
    return (comm.py2f() if running else 0), MPI.Get_library_version().rstrip("\0")


def _close_with_mpi(context: Context) -> None:
    if not _on_mpi4py:
        atexit.register(_close_contexts_of_mpi4py)
    _on_mpi4py[:] = [other for other in _on_mpi4py if other.is_open]
    _on_mpi4py.append(context)


def _close_contexts_of_mpi4py() -> None:
    from mpi4py import MPI
    for context in _on_mpi4py:
        if not MPI.Is_finalized():
            context.close()
    _on_mpi4py.clear()


def _set_option(kind: str, handle: int, key: str, value: OptionValue) -> int:
    """The three ways of the library to set an option, of a context or a placement."""
    code: int
    if isinstance(value, numbers.Integral):
        code = getattr(_library(), f"pnpbs_{kind}_set_int64")(handle, key.encode(), int(value))
    elif isinstance(value, numbers.Real):
        code = getattr(_library(), f"pnpbs_{kind}_set_double")(handle, key.encode(), float(value))
    else:
        code = getattr(_library(), f"pnpbs_{kind}_set")(handle, key.encode(), str(value).encode())
    return code
