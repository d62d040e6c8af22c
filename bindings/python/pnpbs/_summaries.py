# SPDX-License-Identifier: BSD-3-Clause
"""Short texts that represent objects in a shell or a notebook."""

from __future__ import annotations

from typing import Any

import numpy as np


def counted(n: int, what: str) -> str:
    """Returns a number with its noun, such as "1 234 nodes"."""
    return f"{n:,} {what}{'' if n == 1 else 's'}".replace(",", " ")


def summary(results: Any) -> str:
    """Returns the text that represents a named tuple: the shapes of its arrays, and its other
    values."""
    parts = [f"{name} {value.shape if isinstance(value, np.ndarray) else value!r}"
             for name, value in results._asdict().items()]
    return f"<pnpbs.{type(results).__name__}, {', '.join(parts)}>"
