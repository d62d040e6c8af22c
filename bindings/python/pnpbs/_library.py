# SPDX-License-Identifier: BSD-3-Clause
"""Search for the shared library, and its loading."""

from __future__ import annotations

import contextlib
import ctypes
import os
import pathlib
import sys
from typing import Iterator

from ._levels import best_level, processor_flags

# The interface version that this package requires. While the major version is 0, a new minor
# version may change the interface.
INTERFACE = (0, 2)

_HERE = pathlib.Path(__file__).resolve().parent


def _candidates() -> Iterator[str]:
    """Yields paths or names of the library in order of preference."""
    if os.environ.get("PNPBS_LIBRARY"):
        yield os.environ["PNPBS_LIBRARY"]
        return
    suffix = "dylib" if sys.platform == "darwin" else "so"
    # A wheel contains the library; an installed package lies in <prefix>/share/pnpbs/python.
    prefix = _HERE.parents[3]
    folders = [_HERE / "lib", prefix / "lib", prefix / "lib64",
               prefix / "lib" / f"{os.uname().machine}-linux-gnu"]
    for folder in folders:
        for path in sorted(folder.glob(f"libpnpbs*.{suffix}*")):
            if not path.name.startswith("libpnpbs_"):
                yield str(best_level(path, processor_flags()))
    # The name without a number exists only with development files, so the linked name is used.
    yield "libpnpbs.so.0" if suffix == "so" else "libpnpbs.dylib"


def library_path() -> str:
    """Returns the path or name of the library that is or will be opened. This is the value of the
    environment variable `PNPBS_LIBRARY` if it is set. Otherwise it is the library that was
    installed with this package, in the variant for this processor if there are several, or the
    library that the system finds as `libpnpbs`. Local."""
    return next(_candidates())


@contextlib.contextmanager
def _waiting_threads_sleep() -> Iterator[None]:
    """Makes waiting OpenMP threads of GCC sleep early, unless the environment defines how they
    wait. GCC's OpenMP reads this setting when it is loaded. By default threads spin for a
    millisecond, which slows a run down several times if other programs use the cores. The
    environment is restored at the end of the block, so child processes do not inherit the setting.
    """
    if "OMP_WAIT_POLICY" in os.environ or "GOMP_SPINCOUNT" in os.environ:
        yield
        return
    os.environ["GOMP_SPINCOUNT"] = "1000"
    try:
        yield
    finally:
        del os.environ["GOMP_SPINCOUNT"]


def open_library() -> ctypes.CDLL:
    """Opens the library. Raises ImportError if it is not found or has another interface version."""
    path = library_path()
    try:
        with _waiting_threads_sleep():
            opened = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"the shared library of PNPBS could not be opened: {error}; set "
                          "PNPBS_LIBRARY to its path") from error
    major, minor = ctypes.c_int32(), ctypes.c_int32()
    opened.pnpbs_version(ctypes.byref(major), ctypes.byref(minor), None)
    # Calls with the declarations of another interface version can crash.
    if (major.value, minor.value) != INTERFACE:
        raise ImportError(f"{path} is PNPBS {major.value}.{minor.value}, but this package is for "
                          f"{INTERFACE[0]}.{INTERFACE[1]}; use the package of the same version")
    return opened
