# SPDX-License-Identifier: BSD-3-Clause
"""Domains: the region inside straight segments by the even-odd rule."""
import dataclasses
from pathlib import Path

import numpy as np


@dataclasses.dataclass
class Domain:
    vertices: np.ndarray  # (count, 2)
    segments: np.ndarray  # (count, 2), indices of vertices
    holes: np.ndarray     # (count, 2), a point in each hole

    def ends(self):
        """Returns the first and the second ends of the segments."""
        return self.vertices[self.segments[:, 0]], self.vertices[self.segments[:, 1]]

    def area(self):
        """Returns the area of simple closed curves, one inside another, by the even-odd rule."""
        areas = [abs(loop_area(self.vertices[loop])) for loop in self.loops()]
        return 2 * max(areas) - sum(areas)

    def perimeter(self):
        a, b = self.ends()
        return np.hypot(*(b - a).T).sum()

    def loops(self):
        """Returns the closed curves as arrays of vertex numbers. The one that encloses the others
        is first."""
        after = {}
        for a, b in self.segments.tolist():
            after.setdefault(a, []).append(b)
            after.setdefault(b, []).append(a)
        left, found = set(after), []
        while left:
            start = last = min(left)
            loop, at = [start], after[start][0]
            while at != start:
                loop.append(at)
                one, other = after[at]
                last, at = at, other if one == last else one
            left.difference_update(loop)
            found.append(np.array(loop))
        return sorted(found, key=lambda loop: -abs(loop_area(self.vertices[loop])))

    def contains(self, points):
        """Returns whether many points are inside, by the even-odd rule. Each segment toggles the
        points to its left in the strip of heights that it spans. With points sorted by height a
        strip is a slice."""
        order = np.argsort(points[:, 1], kind="stable")
        x, y = points[order].T
        inside = np.zeros(len(points), bool)
        for (ax, ay), (bx, by) in zip(*self.ends()):
            first, last = np.searchsorted(y, (min(ay, by), max(ay, by)))
            if first < last:
                strip = slice(first, last)
                inside[strip] ^= x[strip] < ax + (bx - ax) * ((y[strip] - ay) / (by - ay))
        result = np.empty(len(points), bool)
        result[order] = inside
        return result

    def write_poly(self, path, markers=None):
        """Writes a .poly file. `markers` is the tag of each segment."""
        lines = [f"{len(self.vertices)} 2 0 0"]
        lines += [f"{i} {x!r} {y!r}" for i, (x, y) in enumerate(self.vertices.tolist(), 1)]
        tags = [""] * len(self.segments) if markers is None else [f" {tag}" for tag in markers]
        lines.append(f"{len(self.segments)} {0 if markers is None else 1}")
        lines += [f"{i} {a + 1} {b + 1}{tag}"
                  for i, ((a, b), tag) in enumerate(zip(self.segments.tolist(), tags), 1)]
        lines.append(f"{len(self.holes)}")
        lines += [f"{i} {x!r} {y!r}" for i, (x, y) in enumerate(self.holes.tolist(), 1)]
        Path(path).write_text("\n".join(lines) + "\n")


def loop_area(xy):
    x, y = xy.T
    return 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))


def read_poly(path):
    """Reads a .poly file of Triangle with numbers from 0 or 1."""
    rows = iter([line.split("#")[0].split() for line in Path(path).read_text().splitlines()
                 if line.split("#")[0].strip()])
    vertices = [next(rows) for _ in range(int(next(rows)[0]))]
    first = int(vertices[0][0])
    segments = [next(rows) for _ in range(int(next(rows)[0]))]
    holes = [next(rows) for _ in range(int(next(rows)[0]))]
    return Domain(np.array([[float(v) for v in row[1:3]] for row in vertices]),
                  np.array([[int(v) - first for v in row[1:3]] for row in segments]),
                  np.array([[float(v) for v in row[1:3]] for row in holes]).reshape(-1, 2))


def from_loops(loops, holes=()):
    """Returns a domain of closed curves, each an array of its corners."""
    segments, count = [], 0
    for loop in loops:
        numbers = np.arange(len(loop))
        segments.append(count + np.column_stack([numbers, np.roll(numbers, -1)]))
        count += len(loop)
    return Domain(np.concatenate(loops), np.concatenate(segments),
                  np.array(holes, float).reshape(-1, 2))
