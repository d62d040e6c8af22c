# SPDX-License-Identifier: BSD-3-Clause
"""A spacing without a formula, for tools that read tables: its values at crossings of grid lines,
with linear interpolation in each direction."""
import bisect

import numpy as np

FINEST = 2         # rows across the loop, in units of the least d
ROWS = 20          # least number of rows across the loop
GROWTH = 0.1       # growth of the gaps between lines per distance from the loop


class SpacingTable:
    def __init__(self, x, y, values):
        self.x, self.y, self.values = x, y, values  # a column of values for each x

    def at(self, x, y):
        """Interpolates at many points. Values beyond the border are those at the border."""
        i, u = place(self.x, x)
        j, v = place(self.y, y)
        low = (1 - v) * self.values[i, j] + v * self.values[i, j + 1]
        high = (1 - v) * self.values[i + 1, j] + v * self.values[i + 1, j + 1]
        return (1 - u) * low + u * high

    def at_one(self):
        """Returns a function of x and y for one inner point at a time. It does not use NumPy, which
        is slower here."""
        xs, ys, values = self.x.tolist(), self.y.tolist(), self.values.tolist()

        def at(x, y):
            i = min(max(bisect.bisect_right(xs, x) - 1, 0), len(xs) - 2)
            j = min(max(bisect.bisect_right(ys, y) - 1, 0), len(ys) - 2)
            u = (x - xs[i]) / (xs[i + 1] - xs[i])
            v = (y - ys[j]) / (ys[j + 1] - ys[j])
            left, right = values[i], values[i + 1]
            return ((1 - u) * ((1 - v) * left[j] + v * left[j + 1])
                    + u * ((1 - v) * right[j] + v * right[j + 1]))

        return at

    def write(self, path):
        """Writes the counts of lines, x of the columns, y of the rows, and the values column by
        column."""
        with open(path, "w") as file:
            file.write(f"{len(self.x)} {len(self.y)}\n")
            for row in (self.x, self.y, *self.values):
                file.write(" ".join(map(repr, row.tolist())) + "\n")


def read_table(path):
    numbers = np.fromfile(path, sep=" ")
    columns, rows = numbers[:2].astype(int)
    x, y, values = np.split(numbers[2:], [columns, columns + rows])
    return SpacingTable(x, y, values.reshape(columns, rows))


def place(lines, t):
    """Returns the gap between lines that contains each t, and the relative position of t in it."""
    gap = np.clip(np.searchsorted(lines, t, "right") - 1, 0, len(lines) - 2)
    return gap, np.clip((t - lines[gap]) / (lines[gap + 1] - lines[gap]), 0, 1)


def table_of(case):
    """Returns a table around the loop of a case. Columns pass through all corners of the loop, so
    that its sides are straight between them. Rows are dense across the loop."""
    low, high = case.domain.vertices.min(0), case.domain.vertices.max(0)
    bottom, top = case.loop[:, 1].min(), case.loop[:, 1].max()
    finest = min(FINEST * case.constant, (top - bottom) / ROWS)
    tip = case.loop[0, 1]  # where the contours of d have their sharpest corner
    rows = tip + finest * np.arange(np.floor((bottom - tip) / finest),
                                    np.ceil((top - tip) / finest) + 1)
    x = with_lines_beyond(low[0], np.unique(case.loop[:, 0]), high[0], finest)
    y = with_lines_beyond(low[1], rows, high[1], finest)
    points = np.column_stack([axis.ravel() for axis in np.meshgrid(x, y, indexing="ij")])
    return SpacingTable(x, y, case.continued_spacing(points).reshape(len(x), len(y)))


def with_lines_beyond(low, lines, high, finest):
    """Adds lines on both sides with growing distances, the last ones at the ends."""
    outside = finest / GROWTH * ((1 + GROWTH) ** np.arange(1, 1000) - 1)
    below, above = lines[0] - outside, lines[-1] + outside
    return np.concatenate([[low], below[below > low][::-1], lines, above[above < high], [high]])
