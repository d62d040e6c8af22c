# SPDX-License-Identifier: BSD-3-Clause
"""Conversion of arguments to arrays of the library. Arrays of the right type and memory order are
not copied."""

from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._types import Doubles, Ids, Int32s, Scalar


def as_points(points: ArrayLike, dim: int, what: str) -> Doubles:
    """Converts to float64 points of shape (n, dim). Raises ValueError for another shape; `what`
    names the argument."""
    array = np.ascontiguousarray(points, dtype=np.float64)
    if array.size == 0:
        return array.reshape(0, dim)
    if array.ndim != 2 or array.shape[1] != dim:
        raise ValueError(f"{what} has shape {array.shape}; (n, {dim}) was expected, a row for each")
    return array


def as_point(point: ArrayLike, dim: int, what: str) -> Doubles:
    """Converts to one float64 point of shape (dim,). Raises ValueError for another shape."""
    return _of_shape(np.ascontiguousarray(point, dtype=np.float64), (dim,), what)


def as_indices(indices: ArrayLike, columns: int, what: str) -> Ids:
    """Converts to int64 indices of shape (m, columns). Raises ValueError for another shape or
    type."""
    array = np.ascontiguousarray(_integers(indices, what), dtype=np.int64)
    if array.size == 0:
        return array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{what} has shape {array.shape}; (m, {columns}) was expected")
    return array


def as_tags(tags: Optional[ArrayLike], n: int, what: str) -> Optional[Int32s]:
    """Converts to n int32 tags. A single number becomes the tag of all, and None, which stands for
    the default of the library, stays None. Raises ValueError for another shape or type, or for
    numbers beyond 32 bits."""
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
