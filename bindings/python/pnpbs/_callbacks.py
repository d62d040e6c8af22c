# SPDX-License-Identifier: BSD-3-Clause
"""Python functions as the library's callbacks. No exception may pass through the library: it is
stored in the context, the callback returns nonzero, and `Context._check` raises it after the call
returns. The caller that passes a callback keeps it alive."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Callable, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._interface import CALLBACKS
from ._types import ArrayFunction, Doubles, Monitor

if TYPE_CHECKING:
    from .context import Context

    # The library passes arrays of doubles as this type.
    _Address = ctypes._Pointer[ctypes.c_double]


def _guarded(context: Context, work: Callable[[], object]) -> int:
    """Calls `work()`, unless an exception is pending."""
    if context._raised is not None:
        return 1
    try:
        return 1 if work() else 0
    except BaseException as error:  # includes KeyboardInterrupt
        context._raised = error
        return 1


# The argument is copied, so that a function that keeps or changes it does no harm.
def _copied(address: _Address, shape: Tuple[int, ...]) -> Doubles:
    return np.ctypeslib.as_array(address, shape=shape).copy()


def _store(address: _Address, values: ArrayLike, shape: Tuple[int, ...], what: str) -> None:
    array = np.asarray(values, dtype=np.float64)
    if array.shape != shape:
        raise ValueError(f"the {what} function returned an array of shape {array.shape}; {shape} "
                         "was expected")
    np.ctypeslib.as_array(address, shape=shape)[...] = array


def _at_points(c_type: str, what: str, f: ArrayFunction, context: Context) -> Any:
    """Returns a callback that stores f(points), a value at each of n points (n, dim)."""

    def call(n: int, dim: int, coordinates: _Address, values: _Address, _user: Any) -> int:
        def work() -> None:
            if n > 0:
                _store(values, f(_copied(coordinates, (n, dim))), (n,), what)

        return _guarded(context, work)

    return CALLBACKS[c_type](call)


def spacing_callback(f: ArrayFunction, context: Context) -> Any:
    return _at_points("pnpbs_spacing_fn", "spacing", f, context)


def no_spacing() -> Any:
    return CALLBACKS["pnpbs_spacing_fn"]()


def level_set_callback(f: ArrayFunction, context: Context) -> Any:
    return _at_points("pnpbs_level_set_fn", "level set", f, context)


def curve_callback(f: ArrayFunction, context: Context) -> Any:
    def call(n: int, dim: int, t: _Address, coordinates: _Address, _user: Any) -> int:
        def work() -> None:
            if n > 0:
                _store(coordinates, f(_copied(t, (n,))), (n, dim), "curve")

        return _guarded(context, work)

    return CALLBACKS["pnpbs_curve_fn"](call)


def monitor_callback(f: Monitor, context: Context) -> Any:
    # Only True stops the run, as a monitor that ends with a print returns None.
    def call(fraction: float, step: int, nodes: int, max_speed: float, _user: Any) -> int:
        return _guarded(context, lambda: f(fraction, step, nodes, max_speed) is True)

    return CALLBACKS["pnpbs_monitor_fn"](call)
