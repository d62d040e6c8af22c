# SPDX-License-Identifier: BSD-3-Clause
"""Selects the library for this processor if there are several.

If glibc's loader searches for a library, it takes the best one in folders for the levels of x86-64
processors (`glibc-hwcaps`). It does not do this if it gets a path, as it does from ctypes.
"""

from __future__ import annotations

import pathlib
from typing import Collection

_V2 = {"cx16", "lahf_lm", "popcnt", "pni", "sse4_1", "sse4_2", "ssse3"}
_V3 = _V2 | {"abm", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe", "xsave"}
_V4 = _V3 | {"avx512bw", "avx512cd", "avx512dq", "avx512f", "avx512vl"}
# The features of each level are those of the x86-64 psABI by the names that Linux uses. The best
# level is first.
_LEVELS = {"x86-64-v4": _V4, "x86-64-v3": _V3, "x86-64-v2": _V2}
_FOLDER = "glibc-hwcaps"
# The name of the library for the loader.
_SONAME = "libpnpbs.so.0"


def processor_flags(cpuinfo: pathlib.Path = pathlib.Path("/proc/cpuinfo")) -> set[str]:
    """Returns the features of the first processor, or none if the system does not report them."""
    try:
        lines = cpuinfo.read_text().splitlines()
    except OSError:
        return set()
    return next((set(line.split(":")[1].split()) for line in lines if line.startswith("flags")), set())


def common_folder(library: pathlib.Path) -> pathlib.Path:
    """Returns the folder of the library for all processors. The libraries for other levels are in
    subfolders of it."""
    folder = library.parent
    return folder.parent.parent if folder.parent.name == _FOLDER else folder


def best_level(library: pathlib.Path, flags: Collection[str]) -> pathlib.Path:
    """Returns the best library in the subfolders that a processor with these features can run, or
    this one."""
    for level, needed in _LEVELS.items():
        other = library.parent / _FOLDER / level / _SONAME
        if needed.issubset(flags) and other.is_file():
            return other
    return library
