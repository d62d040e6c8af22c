# SPDX-License-Identifier: BSD-3-Clause
"""The base class through which the parts of `Placement` call the library."""

from __future__ import annotations

from typing import Any

from ._interface import library
from ._signals import signals_kept_in
from .context import Context, Handle
from .errors import Status


class PlacementHandle(Handle):
    """A handle of a placement in the library, with its context."""

    context: Context

    def _call(self, name: str, *arguments: Any) -> Status:
        """Calls the function pnpbs_placement_<name> and returns its status. Raises the exception of
        a callback, or `PNPBSError`."""
        function = getattr(library(), f"pnpbs_placement_{name}")
        with signals_kept_in(self.context):
            code = function(self._live(), *arguments)
        return self.context._check(code)
