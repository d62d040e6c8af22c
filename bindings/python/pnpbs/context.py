# SPDX-License-Identifier: BSD-3-Clause
"""Contexts: a single process, or the ranks of a communicator."""

from __future__ import annotations

import atexit
import ctypes
import numbers
from types import TracebackType
from typing import Any, Callable, List, Optional, Tuple, Type, TypeVar, Union

from ._interface import library
from ._types import FortranComm, OptionValue
from .errors import PNPBSError, Status, check_without_context, error_of

# Open contexts on communicators of mpi4py in the order of their creation, which is the same on all
# ranks. mpi4py finalises MPI after the exit handlers of Python.
_on_mpi4py: List[Context] = []

_Self = TypeVar("_Self", bound="Handle")


class Handle:
    """The common base class of contexts, domains, placements and other objects of the library. A
    handle is closed once, by `close` or at the end of a `with` block."""

    def __init__(self) -> None:
        self._handle: Optional[int] = None

    @property
    def is_open(self) -> bool:
        """Whether the object has not been closed. Local."""
        return self._handle is not None

    def _live(self) -> int:
        """Returns the handle for the library. Raises `Status.ERROR_HANDLE` if the object is
        closed."""
        if self._handle is None:
            raise PNPBSError(Status.ERROR_HANDLE, f"this {type(self).__name__} has been closed")
        return self._handle

    def _destroy(self, function: Callable[..., int]) -> int:
        """Destroys the handle and returns the status. Keeps the handle if the library refuses, as
        in a callback."""
        handle = ctypes.c_void_p(self._handle)
        code = function(ctypes.byref(handle))
        self._handle = handle.value
        return code

    def close(self) -> None:
        """Releases the resources of the library. Repeated calls have no effect."""
        raise NotImplementedError

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()


class Context(Handle):
    """A context, on which domains and placements are created.

    - `comm`: None for a single process; no MPI function is called then. Otherwise a communicator of
      mpi4py, or the Fortran handle of a communicator (`comm.py2f()`). The context uses a duplicate
      of the communicator, and its creation is collective.
    - `library`: the result of `MPI_Get_library_version`, for a Fortran handle. If it is given, the
      library compares it with its own MPI.
    - `**options`: options by name, which are the defaults of placements on this context.

    Raises `Status.ERROR_MPI` if MPI is not running or is another MPI library, and
    `Status.ERROR_UNSUPPORTED` for a communicator in a build without MPI.

    Call `close`, or use a `with` block. Closing is collective, so the garbage collector does not do
    it. Contexts on communicators of mpi4py are closed when Python ends. Contexts with a Fortran
    handle must be closed before MPI is finalised. If a `with` block ends by an exception, a context
    on several ranks is not closed, because the other ranks may not close theirs."""

    def __init__(self, comm: Optional[Union[int, FortranComm]] = None,
                 library: Optional[str] = None, **options: OptionValue) -> None:
        super().__init__()
        self._on_ranks = comm is not None
        self._raised: Optional[BaseException] = None  # exception of a callback, until its call ends
        # Open domains and placements. The library holds addresses of their callbacks.
        self._children: List[Handle] = []
        self._handle = _created(comm, library)
        if hasattr(comm, "py2f"):
            _close_with_mpi(self)
        self.set(**options)

    def set(self, **options: OptionValue) -> Context:
        """Sets options by name, for placements that are created later, and returns the context.
        `pnpbs.option_table()` lists the options. `threads` can be set only here, before the first
        placement of the process is created. Local.

        Raises `Status.ERROR_KEY` for an unknown name, with the nearest known one, and
        `Status.ERROR_ARGUMENT` for a value out of range, with the range."""
        for key, value in options.items():
            self._check(_set_option("context", self._live(), key, value))
        return self

    def close(self) -> None:
        """Releases the resources of the library, also those of the domains and placements on this
        context. Repeated calls have no effect. Collective."""
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
        """Returns the status of a call, or raises its error. An exception that a callback has
        raised has priority, because the error of the library only says that a callback failed."""
        raised, self._raised = self._raised, None
        if raised is not None:
            raise raised
        if code < 0:
            raise error_of(code, self._handle)
        return Status(code)


_library = library  # the constructor has an argument named `library`


def _created(comm: Optional[Union[int, FortranComm]],
             library_text: Optional[str]) -> Optional[int]:
    """Creates a context in the library and returns its handle."""
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
    """Returns the Fortran handle of a communicator, and the MPI library. The communicator is valid
    only while MPI runs. Otherwise the handle is 0, and the library reports the error."""
    from mpi4py import MPI
    running = MPI.Is_initialized() and not MPI.Is_finalized()
    # Open MPI includes the terminating null character in the text.
    return (comm.py2f() if running else 0), MPI.Get_library_version().rstrip("\0")


def _close_with_mpi(context: Context) -> None:
    """Registers a context that is closed when Python ends."""
    if not _on_mpi4py:
        atexit.register(_close_contexts_of_mpi4py)
    _on_mpi4py[:] = [other for other in _on_mpi4py if other.is_open]
    _on_mpi4py.append(context)


def _close_contexts_of_mpi4py() -> None:
    """Closes the registered contexts, unless MPI is finalised already."""
    from mpi4py import MPI
    for context in _on_mpi4py:
        if not MPI.Is_finalized():
            context.close()
    _on_mpi4py.clear()


def _set_option(kind: str, handle: int, key: str, value: OptionValue) -> int:
    """Sets an option of a context or placement with the function for the type of the value, and
    returns the status."""
    code: int
    if isinstance(value, numbers.Integral):
        code = getattr(_library(), f"pnpbs_{kind}_set_int64")(handle, key.encode(), int(value))
    elif isinstance(value, numbers.Real):
        code = getattr(_library(), f"pnpbs_{kind}_set_double")(handle, key.encode(), float(value))
    else:
        code = getattr(_library(), f"pnpbs_{kind}_set")(handle, key.encode(), str(value).encode())
    return code
