# SPDX-License-Identifier: BSD-3-Clause
"""A progress bar for runs. It is that of tqdm, also in notebooks, or a line of text if tqdm is not
installed."""

from __future__ import annotations

import importlib
import sys
from types import TracebackType
from typing import Any, Optional, Type

_WIDTH = 40


class ProgressBar:
    """A monitor that shows the completed fraction and the number of nodes. Use it in a `with`
    statement; the bar exists until the end of the block."""

    def __enter__(self) -> ProgressBar:
        try:
            tqdm = importlib.import_module("tqdm.auto").tqdm
        except ImportError:
            self._bar: Any = None
        else:
            self._bar = tqdm(total=100, bar_format="{percentage:3.0f}%|{bar}| {postfix}[{elapsed}]")
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        if self._bar is not None:
            self._bar.close()
        else:
            print(file=sys.stderr)

    def __call__(self, fraction: float, step: int, nodes: int, max_speed: float) -> None:
        if self._bar is not None:
            self._bar.set_postfix_str(f"{nodes} nodes ", refresh=False)
            self._bar.update(100 * fraction - self._bar.n)  # draws at most ten times a second
        else:
            bar = "#" * round(_WIDTH * fraction)
            print(f"\r{fraction:4.0%} [{bar:{_WIDTH}}] {nodes} nodes ", end="",
                  file=sys.stderr, flush=True)
