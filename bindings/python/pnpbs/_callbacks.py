# SPDX-License-Identifier: BSD-3-Clause
"""Adapters that make Python functions callbacks of the library. Exceptions must not pass through
the library. An adapter stores the exception in the context and returns nonzero, and
`Context._check` raises it after the call has returned. The caller that passes a callback must keep
it alive."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Callable, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._interface import CALLBACKS
from ._types import ArrayFunction, Doubles, Monitor

if TYPE_CHECKING:
    from .context import Context

    # The address of doubles of the library.
    _Address = ctypes._Pointer[ctypes.c_double]


def _guarded(context: Context, work: Callable[[], object]) -> int:
    """Calls `work()` unless an exception is pending. Returns 1 if an exception is pending or
    raised, or if `work()` returns a true value; otherwise 0."""
    if context._raised is not None:
        return 1
    try:
        return 1 if work() else 0
    except BaseException as error:  # also KeyboardInterrupt
        context._raised = error
        return 1


def _copied(address: _Address, shape: Tuple[int, ...]) -> Doubles:
    """Returns a copy of the array of the library. A function that keeps or changes its argument
    thus has no effect on the library."""
    return np.ctypeslib.as_array(address, shape=shape).copy()


def _store(address: _Address, values: ArrayLike, shape: Tuple[int, ...], what: str) -> None:
    """Writes the result of a function into the array of the library. A single number stands for all
    values of a spacing. Raises TypeError for None, and ValueError for another shape."""
    if values is None:
        raise TypeError(f"the {what} function returned None; an array of shape {shape} was expected")
    array = np.asarray(values, dtype=np.float64)
    if array.ndim == 0 and what == "spacing":
        array = np.full(shape, array)
    if array.shape != shape:
        raise ValueError(f"the {what} function returned an array of shape {array.shape}; {shape} "
                         "was expected")
    np.ctypeslib.as_array(address, shape=shape)[...] = array


def _at_points(c_type: str, what: str, f: ArrayFunction, context: Context) -> Any:
    """Makes a callback of f(points), which receives points of shape (n, dim) and returns n
    values."""

    def call(n: int, dim: int, coordinates: _Address, values: _Address, _user: Any) -> int:
        def work() -> None:
            if n > 0:
                _store(values, f(_copied(coordinates, (n, dim))), (n,), what)

        return _guarded(context, work)

    return CALLBACKS[c_type](call)


def spacing_callback(f: ArrayFunction, context: Context) -> Any:
    """Makes a spacing callback of d(points), which may also return one number for all points."""
    return _at_points("pnpbs_spacing_fn", "spacing", f, context)


def no_spacing() -> Any:
    """Returns the null pointer for an optional spacing callback."""
    return CALLBACKS["pnpbs_spacing_fn"]()


def level_set_callback(f: ArrayFunction, context: Context) -> Any:
    """Makes a level set callback of f(points)."""
    return _at_points("pnpbs_level_set_fn", "level set", f, context)


def curve_callback(f: ArrayFunction, context: Context) -> Any:
    """Makes a curve callback of f(t), which receives n parameters and returns points of shape (n,
    dim)."""
    def call(n: int, dim: int, t: _Address, coordinates: _Address, _user: Any) -> int:
        def work() -> None:
            if n > 0:
                _store(coordinates, f(_copied(t, (n,))), (n, dim), "curve")

        return _guarded(context, work)

    return CALLBACKS["pnpbs_curve_fn"](call)


def monitor_callback(f: Monitor, context: Context) -> Any:
    """Makes a progress callback of f(fraction, step, nodes, max_speed). Only True stops the run,
    because a monitor without a return statement returns None."""
    def call(fraction: float, step: int, nodes: int, max_speed: float, _user: Any) -> int:
        return _guarded(context, lambda: f(fraction, step, nodes, max_speed) is True)

    return CALLBACKS["pnpbs_monitor_fn"](call)
