# SPDX-License-Identifier: BSD-3-Clause
"""The base through which the parts of `Placement` call the library."""

from __future__ import annotations

from typing import Any

from ._interface import library
from ._signals import signals_kept_in
from .context import Context, Handle
from .errors import Status


class PlacementHandle(Handle):
    """The library's handle of a placement and the context that it was made on."""

    context: Context

    def _call(self, name: str, *arguments: Any) -> Status:
        function = getattr(library(), f"pnpbs_placement_{name}")
        with signals_kept_in(self.context):
            code = function(self._live(), *arguments)
        return self.context._check(code)
