# SPDX-License-Identifier: BSD-3-Clause
"""Compressed rows: rows of different lengths in one array."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Generic, List, Union, overload

import numpy as np
from numpy.typing import NDArray

from ._types import Ids, Scalar


class CompressedRows(Sequence["NDArray[Scalar]"], Generic[Scalar]):
    """Rows of different lengths, stored one after another. Row i is `values[offsets[i]:offsets[i +
    1]]`. `rows[i]` returns it as a view without a copy. SciPy accepts the arrays as the indices of
    a sparse matrix: `csr_array((entries, rows.values, rows.offsets))`."""

    def __init__(self, offsets: Ids, values: NDArray[Scalar]) -> None:
        self.offsets = offsets
        self.values = values

    def __len__(self) -> int:
        return len(self.offsets) - 1

    @overload
    def __getitem__(self, i: int) -> NDArray[Scalar]:
        ...

    @overload
    def __getitem__(self, i: slice) -> List[NDArray[Scalar]]:
        ...

    def __getitem__(self, i: Union[int, slice]) -> Union[NDArray[Scalar], List[NDArray[Scalar]]]:
        if isinstance(i, slice):
            return [self[k] for k in range(*i.indices(len(self)))]
        if not -len(self) <= i < len(self):
            raise IndexError(f"row index {i} is out of range for {len(self)} rows")
        i = i % len(self)
        return self.values[self.offsets[i]:self.offsets[i + 1]]

    def lengths(self) -> Ids:
        """Returns the number of entries of each row."""
        return np.diff(self.offsets)

    def __repr__(self) -> str:
        return f"<pnpbs.CompressedRows, {len(self)} rows, {len(self.values)} entries>"
