# SPDX-License-Identifier: BSD-3-Clause
"""Warnings of the library: their codes, their data, and the classes of Python's warnings."""

from __future__ import annotations

import enum
from typing import NamedTuple, Optional, Type

from ._types import Doubles


class WarningCode(enum.IntEnum):
    """Codes of warnings, as documented in the header `pnpbs.h`, which also defines the counts and
    values of `WarningData`. The hundreds digit is the kind: 1 the domain, 2 the spacing, 3 the
    elements, 4 the options and the run. Codes that this package does not have become `UNKNOWN`."""

    UNKNOWN = 0
    LEFT_OUT_OUTSIDE = 101
    UNUSED_VERTICES = 102
    REGION_POINTS = 103
    SIMPLIFIED = 104
    REPAIRED = 105
    TRIANGLES_LEFT_OUT = 106
    TRIANGLES_TURNED = 107
    VERTICES_MERGED = 108
    SURFACES_TOUCH = 109
    PIECES_LEFT_OUT = 110
    EDGES_ROUNDED = 111
    CREASES_IGNORED = 112
    FEATURE_ANGLE = 113
    CURVED_ELEMENTS = 114
    GROUPS = 115
    FEATURE_UNRESOLVED = 201
    FIXED_NODES_CLOSE = 202
    GROWTH = 203
    PARTIAL_EXTENT = 204
    SPACING_COARSE = 205
    SPACING_MISSED = 206
    SPACING_HELD = 207
    BOUNDARY_NOT_FOLLOWED = 301
    NOT_CONFORMING = 302
    SMALL_ANGLES = 303
    FEATURES_LEFT_OUT = 304
    OPTION_WITHOUT_EFFECT = 401
    OPTIONS_CHANGED = 402
    DEPENDS_ON_RANKS = 403

    @classmethod
    def _missing_(cls, value: object) -> WarningCode:
        return cls.UNKNOWN  # code of a newer library

    def __str__(self) -> str:
        return self.name


class WarningData(NamedTuple):
    """A warning as data.

    - `code`: the `WarningCode`.
    - `text`: the message.
    - `count`: number of nodes, edges, triangles or points that the warning is about; 0 if it is not
      known.
    - `value`: a number that the warning is about, or None.
    - `point`: the first point that the message names, or None."""

    code: WarningCode
    text: str
    count: int  # type: ignore[assignment]  # hides tuple.count
    value: Optional[float]
    point: Optional[Doubles]


class PNPBSWarning(UserWarning):
    """A warning of the library. The attribute `data` is its `WarningData`."""

    def __init__(self, data: WarningData) -> None:
        super().__init__(data.text)
        self.data = data


class DomainWarning(PNPBSWarning):
    """A warning that the domain differs from the input, for example because curves outside the
    domain are left out."""


class SpacingWarning(PNPBSWarning):
    """A warning that nodes cannot follow the spacing, or do not follow it."""


class ElementsWarning(PNPBSWarning):
    """A warning that triangles or tetrahedra do not fill the domain, or that some of them have a
    poor quality."""


_CLASSES = {1: DomainWarning, 2: SpacingWarning, 3: ElementsWarning}


def warning_class(code: int) -> Type[PNPBSWarning]:
    """Returns the class of warnings with this code."""
    return _CLASSES.get(code // 100, PNPBSWarning)
