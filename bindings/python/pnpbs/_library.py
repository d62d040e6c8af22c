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

# The interface this package is written for. While the major version is 0, a new minor one may change
# it.
INTERFACE = (0, 2)

_HERE = pathlib.Path(__file__).resolve().parent


def _candidates() -> Iterator[str]:
    if os.environ.get("PNPBS_LIBRARY"):
        yield os.environ["PNPBS_LIBRARY"]
        return
    suffix = "dylib" if sys.platform == "darwin" else "so"
    # In a wheel it lies in the package; an installed package lies in <prefix>/share/pnpbs/python.
    prefix = _HERE.parents[3]
    folders = [_HERE / "lib", prefix / "lib", prefix / "lib64",
               prefix / "lib" / f"{os.uname().machine}-linux-gnu"]
    for folder in folders:
        for path in sorted(folder.glob(f"libpnpbs*.{suffix}*")):
            if not path.name.startswith("libpnpbs_"):
                yield str(best_level(path, processor_flags()))
    # By the name its users are linked with: the one without a number comes with development only.
    yield "libpnpbs.so.0" if suffix == "so" else "libpnpbs.dylib"


def library_path() -> str:
    """Returns the path or name of the library that is or would be opened: the environment variable
    `PNPBS_LIBRARY`, or the library that this package was installed with (the one for this processor, if
    there are several), or the one that the system finds as `libpnpbs`."""
    return next(_candidates())


@contextlib.contextmanager
def _waiting_threads_sleep() -> Iterator[None]:
    """GCC's OpenMP reads how threads wait when it is loaded. By default they spin for a millisecond, and
    where other programs keep the machine busy, a run takes many times as long. What processes of the
    caller find in their environment stays."""
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
    # Two different interfaces must not meet: what would come of it is a crash.
    if (major.value, minor.value) != INTERFACE:
        raise ImportError(f"{path} is PNPBS {major.value}.{minor.value}, but this package is for "
                          f"{INTERFACE[0]}.{INTERFACE[1]}; use the package of the same version")
    return opened
