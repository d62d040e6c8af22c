# SPDX-License-Identifier: BSD-3-Clause
"""Information about the library. All local, and without a context."""

from __future__ import annotations

import ctypes
import os
from typing import Any, List, NamedTuple, Tuple

from ._interface import library
from ._types import Path
from .errors import check_without_context


class OptionRow(NamedTuple):
    name: str
    type: str
    default: str
    range: str
    help: str


class StatisticRow(NamedTuple):
    name: str
    type: str
    help: str


class FormatRow(NamedTuple):
    name: str
    help: str
    binary: bool
    elements: bool


def library_version() -> Tuple[int, int, int]:
    """Returns the version of the library that is loaded."""
    parts = [ctypes.c_int32() for _ in range(3)]
    check_without_context(library().pnpbs_version(*map(ctypes.byref, parts)))
    major, minor, patch = (part.value for part in parts)
    return major, minor, patch


def build_info() -> str:
    """Returns the build configuration, one "name: value" per line."""
    return str(library().pnpbs_build_info().decode())


def mpi_library() -> str:
    """Returns the MPI that the library was built with, such as "Open MPI 4.1.4"; empty in a build
    without MPI. mpi4py must use the same one."""
    return str(library().pnpbs_mpi_library().decode())


def file_dimension(path: Path) -> int:
    """Returns the dimension of the domain that a file describes, 2 or 3, from its extension; for
    .poly from the second number in the file, for .msh from whether the mesh lies in a plane of
    constant z."""
    dim = ctypes.c_int32()
    check_without_context(library().pnpbs_file_dimension(os.fsencode(path), ctypes.byref(dim)))
    return dim.value


def shutdown() -> None:
    """Finalises Kokkos if PNPBS initialised it. Optional. Kokkos cannot be initialised twice, so
    nothing can be placed afterwards."""
    check_without_context(library().pnpbs_finalize())


def discard_unfinished_files() -> None:
    """Removes the temporary files of unfinished writes of this process; for programs about to end.
    """
    check_without_context(library().pnpbs_discard_unfinished_files())


def _count(function: Any) -> range:
    count = ctypes.c_int32()
    check_without_context(function(ctypes.byref(count)))
    return range(count.value)


def _texts(function: Any, index: int, n: int, *others: Any) -> List[str]:
    texts = [ctypes.c_char_p() for _ in range(n)]
    check_without_context(function(index, *map(ctypes.byref, texts), *others))
    return [(text.value or b"").decode() for text in texts]


def option_table() -> List[OptionRow]:
    """Returns the options of contexts and placements (`Placement.set`)."""
    return [OptionRow(*_texts(library().pnpbs_option_info, i, 5))
            for i in _count(library().pnpbs_option_count)]


def statistic_table() -> List[StatisticRow]:
    """Returns the statistics of placements (`Placement.statistic`)."""
    return [StatisticRow(*_texts(library().pnpbs_statistic_info, i, 3))
            for i in _count(library().pnpbs_statistic_count)]


def format_table() -> List[FormatRow]:
    """Returns the formats of files (`Placement.write`)."""
    rows = []
    for i in _count(library().pnpbs_format_count):
        binary, elements = ctypes.c_int32(), ctypes.c_int32()
        name, text = _texts(library().pnpbs_format_info, i, 2, ctypes.byref(binary),
                            ctypes.byref(elements))
        rows.append(FormatRow(name, text, binary.value != 0, elements.value != 0))
    return rows
