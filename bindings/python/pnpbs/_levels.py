# SPDX-License-Identifier: BSD-3-Clause
"""Selection of the library for this processor, if there are several. When the loader of glibc
searches its folders for a library, it prefers the subfolders of `glibc-hwcaps` for newer x86-64
processors. It does not do so for a path, as ctypes passes it, so this module repeats the selection.
"""

from __future__ import annotations

import pathlib
from typing import Collection

_V2 = {"cx16", "lahf_lm", "popcnt", "pni", "sse4_1", "sse4_2", "ssse3"}
_V3 = _V2 | {"abm", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe", "xsave"}
_V4 = _V3 | {"avx512bw", "avx512cd", "avx512dq", "avx512f", "avx512vl"}
# The levels of the x86-64 psABI, in Linux's names of these features, the best one first.
_LEVELS = {"x86-64-v4": _V4, "x86-64-v3": _V3, "x86-64-v2": _V2}
_FOLDER = "glibc-hwcaps"
# The name with which programs are linked.
_SONAME = "libpnpbs.so.0"


def processor_flags(cpuinfo: pathlib.Path = pathlib.Path("/proc/cpuinfo")) -> set[str]:
    """Returns the features of the first processor, or an empty set if the system does not report
    them."""
    try:
        lines = cpuinfo.read_text().splitlines()
    except OSError:
        return set()
    return next((set(line.split(":")[1].split()) for line in lines if line.startswith("flags")), set())


def common_folder(library: pathlib.Path) -> pathlib.Path:
    """Returns the folder of the library for all processors. The other libraries of the package are
    in the same folder."""
    folder = library.parent
    return folder.parent.parent if folder.parent.name == _FOLDER else folder


def best_level(library: pathlib.Path, flags: Collection[str]) -> pathlib.Path:
    """Returns the best library next to this one that a processor with these features can run, or
    `library` if there is none."""
    for level, needed in _LEVELS.items():
        other = library.parent / _FOLDER / level / _SONAME
        if needed.issubset(flags) and other.is_file():
            return other
    return library
