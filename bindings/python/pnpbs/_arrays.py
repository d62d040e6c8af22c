# SPDX-License-Identifier: BSD-3-Clause
"""Conversion of arguments for the library. Arrays of the right type and order are not copied."""

from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._types import Doubles, Ids, Int32s, Scalar


def as_points(points: ArrayLike, dim: int, what: str) -> Doubles:
    """Returns (n, dim) numbers, a row for each point."""
    array = np.ascontiguousarray(points, dtype=np.float64)
    if array.size == 0:
        return array.reshape(0, dim)
    if array.ndim != 2 or array.shape[1] != dim:
        raise ValueError(f"{what} has shape {array.shape}; (n, {dim}) was expected, a row for each")
    return array


def as_point(point: ArrayLike, dim: int, what: str) -> Doubles:
    return _of_shape(np.ascontiguousarray(point, dtype=np.float64), (dim,), what)


def as_indices(indices: ArrayLike, columns: int, what: str) -> Ids:
    """Returns (m, columns) indices from 0."""
    array = np.ascontiguousarray(_integers(indices, what), dtype=np.int64)
    if array.size == 0:
        return array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{what} has shape {array.shape}; (m, {columns}) was expected")
    return array


def as_tags(tags: Optional[ArrayLike], n: int, what: str) -> Optional[Int32s]:
    """Returns None for the library's default, one tag for all, or one for each."""
    if tags is None:
        return None
    given = _integers(tags, what)
    bounds = np.iinfo(np.int32)
    wrong = given[(given < bounds.min) | (given > bounds.max)]
    if wrong.size:
        raise ValueError(f"{what} has {wrong.flat[0]}, which does not fit into 32 bits")
    if given.ndim == 0:
        return np.full(n, given, dtype=np.int32)
    return _of_shape(np.ascontiguousarray(given, dtype=np.int32), (n,), what)


def _integers(values: ArrayLike, what: str) -> NDArray[Any]:
    given = np.asarray(values)
    if given.size and not np.issubdtype(given.dtype, np.integer):
        raise ValueError(f"{what} is of type {given.dtype}; integers were expected")
    return given


def _of_shape(array: NDArray[Scalar], shape: Tuple[int, ...],
              what: str) -> NDArray[Scalar]:
    if array.shape != shape:
        raise ValueError(f"{what} has shape {array.shape}; {shape} was expected")
    return array
