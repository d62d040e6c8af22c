# SPDX-License-Identifier: BSD-3-Clause
"""Location of the shared library."""

from __future__ import annotations

import contextlib
import ctypes
import os
import pathlib
import sys
from typing import Iterator

from ._levels import best_level, processor_flags

# The version of the interface that this package is written for. While the major version is 0, a new
# minor version may change it.
INTERFACE = (0, 2)

_HERE = pathlib.Path(__file__).resolve().parent


def _candidates() -> Iterator[str]:
    if os.environ.get("PNPBS_LIBRARY"):
        yield os.environ["PNPBS_LIBRARY"]
        return
    suffix = "dylib" if sys.platform == "darwin" else "so"
    # In a wheel the library lies in the package. An installed package is in
    # <prefix>/share/pnpbs/python.
    prefix = _HERE.parents[3]
    folders = [_HERE / "lib", prefix / "lib", prefix / "lib64",
               prefix / "lib" / f"{os.uname().machine}-linux-gnu"]
    for folder in folders:
        for path in sorted(folder.glob(f"libpnpbs*.{suffix}*")):
            if not path.name.startswith("libpnpbs_"):
                yield str(best_level(path, processor_flags()))
    # This is the name that programs are linked with. The name without a number exists only in
    # installations for development.
    yield "libpnpbs.so.0" if suffix == "so" else "libpnpbs.dylib"


def library_path() -> str:
    """Returns the path or name of the library that is or would be opened: the environment variable
    `PNPBS_LIBRARY`, or the library that this package was installed with (the one for this processor, if
    there are several), or the one that the system finds as `libpnpbs`."""
    return next(_candidates())


@contextlib.contextmanager
def _waiting_threads_sleep() -> Iterator[None]:
    """Sets the wait policy of threads in the block. GCC's OpenMP reads it when it is loaded. By
    default threads spin for a millisecond, so that a run takes many times as long on a busy
    machine. The environment that child processes inherit does not change."""
    if "OMP_WAIT_POLICY" in os.environ or "GOMP_SPINCOUNT" in os.environ:
        yield
        return
    os.environ["GOMP_SPINCOUNT"] = "1000"
    try:
        yield
    finally:
        del os.environ["GOMP_SPINCOUNT"]


def open_library() -> ctypes.CDLL:
    path = library_path()
    try:
        with _waiting_threads_sleep():
            opened = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"the shared library of PNPBS could not be opened: {error}; set "
                          "PNPBS_LIBRARY to its path") from error
    major, minor = ctypes.c_int32(), ctypes.c_int32()
    opened.pnpbs_version(ctypes.byref(major), ctypes.byref(minor), None)
    # A library with another interface would lead to a crash.
    if (major.value, minor.value) != INTERFACE:
        raise ImportError(f"{path} is PNPBS {major.value}.{minor.value}, but this package is for "
                          f"{INTERFACE[0]}.{INTERFACE[1]}; use the package of the same version")
    return opened
