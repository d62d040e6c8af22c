# SPDX-License-Identifier: BSD-3-Clause
"""The types that the package's functions take and return, for type checkers."""

from __future__ import annotations

import os
from typing import Callable, Literal, Protocol, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

Doubles = NDArray[np.float64]
Ids = NDArray[np.int64]
Int32s = NDArray[np.int32]
Scalar = TypeVar("Scalar", bound=np.generic)

# f(points) returns a value at each of n points, (n, dim). Curves f(t) return n points, (n, 2).
ArrayFunction = Callable[[Doubles], ArrayLike]
# The arguments are fraction, step, nodes, max_speed. Only True stops the run.
Monitor = Callable[[float, int, int, float], object]

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]
Role = Literal["boundary", "inner"]
OptionValue = Union[str, float]


class FortranComm(Protocol):
    """A communicator of mpi4py."""

    def py2f(self) -> int:
        """Returns its Fortran handle."""
