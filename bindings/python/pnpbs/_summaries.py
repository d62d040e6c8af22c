# SPDX-License-Identifier: BSD-3-Clause
"""Short descriptions of objects for shells and notebooks."""

from __future__ import annotations

from typing import Any

import numpy as np


def counted(n: int, what: str) -> str:
    """Returns a text such as "1 234 nodes"."""
    return f"{n:,} {what}{'' if n == 1 else 's'}".replace(",", " ")


def summary(results: Any) -> str:
    """Describes a named tuple of arrays: the shapes of arrays, and numbers as they are."""
    parts = [f"{name} {value.shape if isinstance(value, np.ndarray) else value!r}"
             for name, value in results._asdict().items()]
    return f"<pnpbs.{type(results).__name__}, {', '.join(parts)}>"
