# SPDX-License-Identifier: BSD-3-Clause
"""Rows of different lengths in one array."""

from collections.abc import Sequence

import numpy as np


class CompressedRows(Sequence):
    """Rows one behind the other: row i is `values[offsets[i]:offsets[i + 1]]`, which `rows[i]` gives
    without a copy. As the indices of a sparse matrix they are what SciPy takes:
    `csr_array((entries, rows.values, rows.offsets))`."""

    def __init__(self, offsets, values):
        self.offsets = offsets
        self.values = values

    def __len__(self):
        return len(self.offsets) - 1

    def __getitem__(self, i):
        if isinstance(i, slice):
            return [self[k] for k in range(*i.indices(len(self)))]
        if not -len(self) <= i < len(self):
            raise IndexError(f"row {i} of {len(self)}")
        i = i % len(self)
        return self.values[self.offsets[i]:self.offsets[i + 1]]

    def lengths(self) -> np.ndarray:
        """The number of entries of each row."""
        return np.diff(self.offsets)

    def __repr__(self):
        return f"<pnpbs.CompressedRows, {len(self)} rows, {len(self.values)} entries>"
