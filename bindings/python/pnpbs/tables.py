# SPDX-License-Identifier: BSD-3-Clause
"""Information about the library. All functions are local and need no context."""

from __future__ import annotations

import ctypes
import os
from typing import Any, List, NamedTuple, Tuple

from ._interface import library
from ._types import Path
from .errors import check_without_context


class OptionRow(NamedTuple):
    """A row of the options table: name, type ("integer", "real" or "choice"), default value and
    range as texts, and a line of help."""

    name: str
    type: str
    default: str
    range: str
    help: str


class StatisticRow(NamedTuple):
    """A row of the statistics table: name, type ("integer", "real" or "string"), and a line of
    help."""

    name: str
    type: str
    help: str


class FormatRow(NamedTuple):
    """A row of the table of file formats.

    - `name`: the name, which is also the extension.
    - `help`: a line of help.
    - `binary`: whether the format is not text.
    - `elements`: whether one file can hold nodes and elements."""

    name: str
    help: str
    binary: bool
    elements: bool


def library_version() -> Tuple[int, int, int]:
    """Returns the version (major, minor, patch) of the loaded library."""
    parts = [ctypes.c_int32() for _ in range(3)]
    check_without_context(library().pnpbs_version(*map(ctypes.byref, parts)))
    major, minor, patch = (part.value for part in parts)
    return major, minor, patch


def build_info() -> str:
    """Returns the build configuration, one "name: value" per line."""
    return str(library().pnpbs_build_info().decode())


def mpi_library() -> str:
    """Returns the MPI library that PNPBS was built with, such as "Open MPI 4.1.4". The text is
    empty in a build without MPI. mpi4py must use the same MPI library."""
    return str(library().pnpbs_mpi_library().decode())


def file_dimension(path: Path) -> int:
    """Returns the dimension of the domain that a file describes, 2 or 3. The extension determines
    it. For .poly it is the second number in the file; for .msh it is 2 if the mesh lies in a plane
    of constant z. Raises `Status.ERROR_FILE` if a .msh file cannot be read; other files are not
    checked."""
    dim = ctypes.c_int32()
    check_without_context(library().pnpbs_file_dimension(os.fsencode(path), ctypes.byref(dim)))
    return dim.value


def shutdown() -> None:
    """Finalises Kokkos if PNPBS has initialised it. The call is optional. Kokkos cannot be
    initialised again, so placements cannot compute afterwards. Raises `Status.ERROR_STATE` in a
    callback."""
    check_without_context(library().pnpbs_finalize())


def discard_unfinished_files() -> None:
    """Removes the temporary files of unfinished writes of this process. Call it before the program
    ends early."""
    check_without_context(library().pnpbs_discard_unfinished_files())


def _count(function: Any) -> range:
    """Returns the range of the rows of a table."""
    count = ctypes.c_int32()
    check_without_context(function(ctypes.byref(count)))
    return range(count.value)


def _texts(function: Any, index: int, n: int, *others: Any) -> List[str]:
    """Returns the first n texts of a row of a table."""
    texts = [ctypes.c_char_p() for _ in range(n)]
    check_without_context(function(index, *map(ctypes.byref, texts), *others))
    return [(text.value or b"").decode() for text in texts]


def option_table() -> List[OptionRow]:
    """Returns the options of contexts and placements (see `Placement.set`)."""
    return [OptionRow(*_texts(library().pnpbs_option_info, i, 5))
            for i in _count(library().pnpbs_option_count)]


def statistic_table() -> List[StatisticRow]:
    """Returns the statistics of placements (see `Placement.statistic`)."""
    return [StatisticRow(*_texts(library().pnpbs_statistic_info, i, 3))
            for i in _count(library().pnpbs_statistic_count)]


def format_table() -> List[FormatRow]:
    """Returns the file formats (see `Placement.write`)."""
    rows = []
    for i in _count(library().pnpbs_format_count):
        binary, elements = ctypes.c_int32(), ctypes.c_int32()
        name, text = _texts(library().pnpbs_format_info, i, 2, ctypes.byref(binary),
                            ctypes.byref(elements))
        rows.append(FormatRow(name, text, binary.value != 0, elements.value != 0))
    return rows
