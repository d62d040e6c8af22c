# SPDX-License-Identifier: BSD-3-Clause
"""Handling of Ctrl-C during a call of the library. Python may handle a signal between any two
instructions of a callback, even before the callback enters a `try` statement, and ctypes discards
exceptions that are raised there."""

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
    """Stores exceptions that the SIGINT handler raises inside the block in the context, like those
    of callbacks. The next callback then ends the call. The function has no effect in threads other
    than the main one, in which Python handles no signals, and if no Python handler is set."""
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
