# SPDX-License-Identifier: BSD-3-Clause
"""Conversion of arguments for the library. Arrays of the right type and order are not copied."""

from __future__ import annotations

from typing import Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._types import Doubles, Ids, Int32s, Scalar


def as_points(points: ArrayLike, dim: int, what: str) -> Doubles:
    """(n, dim) numbers, a row for each point."""
    array = np.ascontiguousarray(points, dtype=np.float64)
    if array.size == 0:
        return array.reshape(0, dim)
    if array.ndim != 2 or array.shape[1] != dim:
        raise ValueError(f"{what} has shape {array.shape}; (n, {dim}) was expected, a row for each")
    return array


def as_point(point: ArrayLike, dim: int, what: str) -> Doubles:
    return _of_shape(np.ascontiguousarray(point, dtype=np.float64), (dim,), what)


def as_indices(indices: ArrayLike, columns: int, what: str) -> Ids:
    """(m, columns) indices from 0."""
    given = np.asarray(indices)
    if given.size and not np.issubdtype(given.dtype, np.integer):
        raise ValueError(f"{what} is of type {given.dtype}; integers were expected")
    array = np.ascontiguousarray(given, dtype=np.int64)
    if array.size == 0:
        return array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{what} has shape {array.shape}; (m, {columns}) was expected")
    return array


def as_tags(tags: Optional[ArrayLike], n: int, what: str) -> Optional[Int32s]:
    """None for the library's default, one for all, or one for each."""
    if tags is None:
        return None
    if np.ndim(tags) == 0:
        return np.full(n, tags, dtype=np.int32)
    return _of_shape(np.ascontiguousarray(tags, dtype=np.int32), (n,), what)


def _of_shape(array: NDArray[Scalar], shape: Tuple[int, ...],
              what: str) -> NDArray[Scalar]:
    if array.shape != shape:
        raise ValueError(f"{what} has shape {array.shape}; {shape} was expected")
    return array
