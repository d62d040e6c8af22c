# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C during a call of the library. Python handles a signal between any two instructions of a
callback, even before a `try` of this package is entered, and ctypes drops what is raised there."""

from __future__ import annotations

import contextlib
import signal
import threading
from types import FrameType
from typing import TYPE_CHECKING, Iterator, Optional

if TYPE_CHECKING:
    from .context import Context


@contextlib.contextmanager
def signals_kept_in(context: Context) -> Iterator[None]:
    """Stores what the program's handler of SIGINT raises in the block in the context, as for
    exceptions of callbacks: the next callback ends the call. Nothing changes in threads other than
    the main one, where Python handles no signals, or if no Python handler is set."""
    is_main = threading.current_thread() is threading.main_thread()
    handler = signal.getsignal(signal.SIGINT) if is_main else None
    if not callable(handler):
        yield
        return

    def keep(number: int, frame: Optional[FrameType]) -> None:
        try:
            handler(number, frame)
        except BaseException as error:
            context._raised = context._raised or error

    signal.signal(signal.SIGINT, keep)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)
