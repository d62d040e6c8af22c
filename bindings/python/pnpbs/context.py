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
from .errors import PNPBSError, Status, check_without_context, error_of

# The open contexts on communicators of mpi4py, in the order of their creation, which is the same on
# all ranks. mpi4py ends MPI after Python's own exit handlers.
_on_mpi4py: List[Context] = []

_Self = TypeVar("_Self", bound="Handle")


class Handle:
    """Common base of contexts, domains and placements: a handle of the library that is closed once,
    by `close` or at the end of a `with` block."""

    def __init__(self) -> None:
        self._handle: Optional[int] = None

    @property
    def is_open(self) -> bool:
        """Whether the object has not been closed."""
        return self._handle is not None

    def _live(self) -> int:
        """Returns the handle for the library: never the handle of a closed object."""
        if self._handle is None:
            raise PNPBSError(Status.ERROR_HANDLE, f"this {type(self).__name__} has been closed")
        return self._handle

    def _destroy(self, function: Callable[..., int]) -> int:
        """Destroys the handle. Keeps it if the library returns an error, for example inside a
        callback."""
        handle = ctypes.c_void_p(self._handle)
        code = function(ctypes.byref(handle))
        self._handle = handle.value
        return code

    def close(self) -> None:
        """Releases the resources of the library. Closing twice is allowed."""
        raise NotImplementedError

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()


class Context(Handle):
    """The context on which domains and placements are made.

    `Context()` is for one process and calls no MPI function. `Context(comm)` with a communicator of
    mpi4py, or with the Fortran handle of any communicator (`comm.py2f()`), uses a duplicate of that
    communicator and is created collectively; `library` is the result of `MPI_Get_library_version`,
    if the library should compare it with its own MPI. Other keywords are options, the defaults of
    placements made on it.

    `close` it, or use it in a `with` block, when it is no longer needed: this is collective, so no
    garbage collector does it. Contexts on communicators of mpi4py are closed when Python ends, at
    the latest; those with a raw handle must be closed before MPI is finalised. If a `with` block
    ends by an exception, a context on several ranks is not closed, because the others might never
    close theirs."""

    def __init__(self, comm: Optional[Union[int, FortranComm]] = None,
                 library: Optional[str] = None, **options: OptionValue) -> None:
        super().__init__()
        self._on_ranks = comm is not None
        self._raised: Optional[BaseException] = None  # by a callback during the current call
        # The open domains and placements. They are kept here because the library holds their
        # callbacks.
        self._children: List[Handle] = []
        self._handle = _created(comm, library)
        if hasattr(comm, "py2f"):
            _close_with_mpi(self)
        self.set(**options)

    def set(self, **options: OptionValue) -> Context:
        """Sets options by name, for placements made later; `threads` can be set only here. Local.
        Unknown names and values out of range raise a `PNPBSError` that names the nearest option or
        the range. `pnpbs.option_table()` lists them."""
        for key, value in options.items():
            self._check(_set_option("context", self._live(), key, value))
        return self

    def close(self) -> None:
        """Releases the resources of the library, with the domains and placements made here. Closing
        twice is allowed. Collective."""
        if not self.is_open:
            return
        for child in list(self._children):
            child.close()
        handle = self._handle
        code = self._destroy(_library().pnpbs_context_destroy)
        if code < 0:
            raise error_of(code, handle)

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        if kind is None or not self._on_ranks:
            self.close()

    def __repr__(self) -> str:
        what = ("over ranks" if self._on_ranks else "one process") if self.is_open else "closed"
        return f"<pnpbs.Context, {what}>"

    def _check(self, code: int) -> Status:
        """Checks the status of every call. An exception raised by a callback takes precedence, as
        the library's own message only says that a callback failed."""
        raised, self._raised = self._raised, None
        if raised is not None:
            raise raised
        if code < 0:
            raise error_of(code, self._handle)
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
    """Returns the Fortran handle and the library. A communicator is valid only while MPI runs.
    Otherwise the library reports the error."""
    from mpi4py import MPI
    running = MPI.Is_initialized() and not MPI.Is_finalized()
    # Open MPI counts the terminating zero as a part of the text.
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
    """Calls one of the three functions of the library that set an option of a context or a
    placement."""
    code: int
    if isinstance(value, numbers.Integral):
        code = getattr(_library(), f"pnpbs_{kind}_set_int64")(handle, key.encode(), int(value))
    elif isinstance(value, numbers.Real):
        code = getattr(_library(), f"pnpbs_{kind}_set_double")(handle, key.encode(), float(value))
    else:
        code = getattr(_library(), f"pnpbs_{kind}_set")(handle, key.encode(), str(value).encode())
    return code
