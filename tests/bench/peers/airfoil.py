# SPDX-License-Identifier: BSD-3-Clause
"""The airfoil of ../cases.cpp."""
import math

import numpy as np

CAMBER, CAMBER_AT, THICKNESS = 0.02, 0.4, 0.12


def airfoil(per_side):
    """Returns NACA 2412 with its trailing edge closed, with chord 1 from the origin and points
    dense at both ends (Jacobs, Ward, Pinkerton 1933; NACA report 460)."""
    over_the_top_to_the_front = points(np.arange(per_side, 0, -1), per_side, 1)
    and_back_below = points(np.arange(per_side), per_side, -1)
    return np.vstack([over_the_top_to_the_front, and_back_below])


def points(k, per_side, side):
    x = 0.5 * (1 - np.cos(math.pi * k / per_side))
    half = 5 * THICKNESS * (0.2969 * np.sqrt(x)
                            + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - x * 0.1036))))
    along = np.where(x < CAMBER_AT, CAMBER_AT, 1 - CAMBER_AT)
    rest = np.where(x < CAMBER_AT, 0, 1 - 2 * CAMBER_AT)
    y = CAMBER / along ** 2 * (rest + 2 * CAMBER_AT * x - x * x)
    slope = 2 * CAMBER / along ** 2 * (CAMBER_AT - x)
    norm = np.hypot(1, slope)
    return np.column_stack([x - side * half * slope / norm, y + side * half / norm])
