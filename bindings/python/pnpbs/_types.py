# SPDX-License-Identifier: BSD-3-Clause
"""Types of arguments and results, for type checkers."""

from __future__ import annotations

import os
from typing import Callable, Literal, Protocol, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

Doubles = NDArray[np.float64]
Ids = NDArray[np.int64]
Int32s = NDArray[np.int32]
Scalar = TypeVar("Scalar", bound=np.generic)

# f(points) receives (n, dim) points and returns n values; a curve f(t) receives n parameters and
# returns (n, 2) points.
ArrayFunction = Callable[[Doubles], ArrayLike]
# f(fraction, step, nodes, max_speed); only the result True stops the run.
Monitor = Callable[[float, int, int, float], object]

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]
Role = Literal["boundary", "inner"]
OptionValue = Union[str, float]


class FortranComm(Protocol):
    """A communicator of mpi4py."""

    def py2f(self) -> int:
        """Returns the Fortran handle of the communicator."""
