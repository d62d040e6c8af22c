# SPDX-License-Identifier: BSD-3-Clause
"""Tests --fragment with models of many parts: a printed circuit and a layered subsurface."""

import itertools
import unittest

import numpy

from command import CommandTest
from test_fragment import box, solid, volumes_by_region


def printed_circuit(unit=0.5, columns=12, rows=8, layers=8):
    """Returns boxes on a lattice: in each layer of a board a plate of resin, another one on it, and
    in the upper one a row of blocks with gaps between them, which share parts of their faces."""
    boxes = []
    for layer in range(layers):
        z = 2 * layer
        boxes += [((0, 0, z), (columns, rows, z + 1)), ((0, 0, z + 1), (columns, rows, z + 2))]
        for row in range(rows):
            first = 1 + (3 * row + layer) % 4
            boxes += [((first, row, z + 1), (first + 4, row + 1, z + 2)),
                      ((first + 4, row, z + 1), (first + 5, row + 1, z + 2)),
                      ((first + 5, row, z + 1), (columns - row % 2, row + 1, z + 2))]
    return [(numpy.array(low) * unit, numpy.array(high) * unit) for low, high in boxes]


def volumes_of_boxes(boxes, unit=0.5):
    """Returns the volumes on the lattice, where the last box counts."""
    size = tuple((numpy.max([high for _, high in boxes], axis=0) / unit + 0.5).astype(int))
    owner = numpy.zeros(size, dtype=int)
    for k, (low, high) in enumerate(boxes, 1):
        a, b = ((x / unit + 0.5).astype(int) for x in (low, high))
        owner[a[0]:b[0], a[1]:b[1], a[2]:b[2]] = k
    return {int(k): (owner == k).sum() * unit ** 3 for k in numpy.unique(owner) if k > 0}


class PrintedCircuit(CommandTest):
    def test_many_stacked_blocks(self):
        boxes = printed_circuit()
        self.assertGreater(len(boxes), 200)
        expected = volumes_of_boxes(boxes)
        model = self.folder / "board.stl"
        model.write_text("".join(solid(f"block{k}", box(low, high))
                                 for k, (low, high) in enumerate(boxes)))
        self.run_command("--domain", model, "--fragment", "--spacing", 0.25, "--output", "a.vtu",
                         "--check")
        found = volumes_by_region(self.folder / "a.vtu")
        self.assertEqual(sorted(found), sorted(expected))
        for tag, volume in expected.items():
            self.assertAlmostEqual(found[tag], volume, 9, tag)


# Six layers between undulating sheets that end on the sides of a block, and three faults that cross
# the layers.
WIDTH, DEPTH, HEIGHT = 4, 3, 2
FAULTS = ((1.1, 0.35), (2.0, -0.25), (3.0, 0.3))


def horizon(k, x, y):
    return HEIGHT * k / 6 + 0.06 * numpy.sin(1.7 * x + k) * numpy.cos(1.3 * y - 0.5 * k)


def horizon_triangles(k):
    columns, rows = 8, 6
    xs, ys = numpy.linspace(0, WIDTH, columns + 1), numpy.linspace(0, DEPTH, rows + 1)
    corner = [[(x, y, horizon(k, x, y)) for y in ys] for x in xs]
    triangles = []
    for i, j in itertools.product(range(columns), range(rows)):
        a, b, c, d = corner[i][j], corner[i + 1][j], corner[i + 1][j + 1], corner[i][j + 1]
        triangles += [[a, b, c], [a, c, d]]
    return triangles


def volume_below(k):
    """Returns the volume of the block below a horizon."""
    if k in (0, 6):
        return WIDTH * DEPTH * HEIGHT * k / 6
    triangles = numpy.array(horizon_triangles(k))
    return triangles[:, :, 2].mean() * WIDTH * DEPTH


def fault(k, y, z):
    start, dip = FAULTS[k]
    return start + dip * (z - 1) + 0.1 * y


def fault_triangles(k):
    a, b, c, d = [(fault(k, y, z), y, z) for y, z in ((-1, -1), (4, -1), (4, 3), (-1, 3))]
    return [[a, b, c], [a, c, d]]


class Subsurface(CommandTest):
    def test_layers_between_faults(self):
        model = self.folder / "layers.stl"
        model.write_text(
            solid("block", box((0, 0, 0), (WIDTH, DEPTH, HEIGHT)))
            + "".join(solid(f"horizon{k}", horizon_triangles(k)) for k in range(1, 6))
            + "".join(solid(f"fault{k}", fault_triangles(k)) for k in range(3)))
        regions = []
        for layer, part in itertools.product(range(6), range(4)):
            y, z = DEPTH / 2, HEIGHT * (layer + 0.5) / 6
            sides = [0, *(fault(k, y, z) for k in range(3)), WIDTH]
            regions += ["--region",
                        f"{(sides[part] + sides[part + 1]) / 2},{y},{z}:{10 * layer + part + 1}"]
        self.run_command("--domain", model, "--fragment", *regions, "--spacing", 0.2,
                         "--output", "a.vtu", "--check")
        found = volumes_by_region(self.folder / "a.vtu")
        self.assertEqual(len(found), 24)
        for layer in range(6):
            volume = sum(found[10 * layer + part + 1] for part in range(4))
            # The faces of elements are chords of the horizons.
            self.assertAlmostEqual(volume, volume_below(layer + 1) - volume_below(layer), delta=1e-3)


if __name__ == "__main__":
    unittest.main()
