# SPDX-License-Identifier: BSD-3-Clause
"""Warnings of the library: their codes, and the classes of Python's warnings."""

from __future__ import annotations

import enum
from typing import NamedTuple, Optional, Type

from ._types import Doubles


class WarningCode(enum.IntEnum):
    """The codes of the header, which says what each means, as do the counts and values of
    `WarningData`. The hundreds are the kinds: the domain, the spacing, the elements, and the
    options and the run."""

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
        return cls.UNKNOWN  # the code is from a newer library

    def __str__(self) -> str:
        return self.name


class WarningData(NamedTuple):
    code: WarningCode
    text: str
    count: int  # type: ignore[assignment]  # not what tuple.count is
    value: Optional[float]
    point: Optional[Doubles]


class PNPBSWarning(UserWarning):
    """A warning of the library. `data` is its `WarningData`."""

    def __init__(self, data: WarningData) -> None:
        super().__init__(data.text)
        self.data = data


class DomainWarning(PNPBSWarning):
    """The domain is not quite what was given, such as where curves outside of it are left out."""


class SpacingWarning(PNPBSWarning):
    """The spacing cannot be followed, or is not followed."""


class ElementsWarning(PNPBSWarning):
    """Triangles or tetrahedra do not fill the domain, or some of them are of little use."""


_CLASSES = {1: DomainWarning, 2: SpacingWarning, 3: ElementsWarning}


def warning_class(code: int) -> Type[PNPBSWarning]:
    return _CLASSES.get(code // 100, PNPBSWarning)
