# SPDX-License-Identifier: BSD-3-Clause
"""Writes a table of a spacing on an even grid, as an ESRI ASCII grid has even steps."""
import math

import numpy as np
from measure import Failed
from spacing_table import table_of

# The steps in x and y in units of the least d, which is at most an eighth of the radius of the
# airfoil's nose.
STEPS, MOST_STEP = (12, 6), 0.002
MOST_VALUES = 3e7


def write_grid(case, path):
    x_step, y_step = (min(share * case.constant, MOST_STEP) for share in STEPS)
    low, high = case.domain.vertices.min(0), case.domain.vertices.max(0)
    x = even_lines(low[0], high[0], x_step, case.loop[0, 0])
    y = even_lines(low[1], high[1], y_step, case.loop[0, 1])
    if len(x) * len(y) > MOST_VALUES:
        raise Failed(f"an even grid for this d has {len(x) * len(y) / 1e6:.0f} million values")
    table = table_of(case)
    with open(path, "w") as file:
        file.write(f"ncols {len(x)}\nnrows {len(y)}\nxllcenter {float(x[0])!r}\n"
                   f"yllcenter {float(y[0])!r}\ndx {x_step!r}\ndy {y_step!r}\n")
        for height in y[::-1].tolist():
            file.write(" ".join(f"{d:.5g}" for d in table.at(x, height).tolist()) + "\n")


def even_lines(low, high, step, through):
    """Returns coordinates from below `low` to above `high`. One of them passes through the loop's
    sharpest corner."""
    return through + step * np.arange(math.floor((low - through) / step),
                                      math.ceil((high - through) / step) + 1)
