# SPDX-License-Identifier: BSD-3-Clause
"""Solids in random positions inside a cube, as triangles and as functions of points."""

import itertools
import json

import numpy

from command import CommandTest
from test_fragment import box, solid, volumes_by_region


def grid_of_triangles(points):
    """Returns the triangles of a surface that is closed in both directions of a grid of points."""
    ahead, right = numpy.roll(points, -1, axis=0), numpy.roll(points, -1, axis=1)
    across = numpy.roll(ahead, -1, axis=1)
    return numpy.concatenate([numpy.stack(corners, axis=2).reshape(-1, 3, 3)
                              for corners in ((points, ahead, across), (points, across, right))])


class Block:
    """A box in any direction."""

    def __init__(self, random):
        self.centre = random.uniform(0.25, 0.75, 3)
        self.half = random.uniform(0.1, 0.2, 3)
        self.axes = numpy.linalg.qr(random.normal(size=(3, 3)))[0]
        self.axes *= numpy.sign(numpy.linalg.det(self.axes))

    def triangles(self):
        return self.centre + numpy.array(box(-self.half, self.half)) @ self.axes

    def contains(self, x):
        return numpy.all(numpy.abs((x - self.centre) @ self.axes.T) < self.half, axis=1)


class Ball:
    def __init__(self, random):
        self.centre, self.radius = random.uniform(0.25, 0.75, 3), random.uniform(0.12, 0.2)

    def triangles(self, steps=40):
        """Returns the triangles between circles of latitude, those at the poles once."""
        polar = numpy.pi * numpy.arange(steps // 2 + 1) / (steps // 2)
        around = 2 * numpy.pi * numpy.arange(steps) / steps
        across = numpy.sin(polar) * (numpy.arange(len(polar)) % (steps // 2) > 0)
        points = numpy.stack([numpy.outer(across, numpy.cos(around)),
                              numpy.outer(across, numpy.sin(around)),
                              numpy.outer(numpy.cos(polar), numpy.ones(steps))], axis=2)
        triangles = []
        for i, j in itertools.product(range(steps // 2), range(steps)):
            a, b = points[i][j], points[i][(j + 1) % steps]
            c, d = points[i + 1][(j + 1) % steps], points[i + 1][j]
            if i > 0:
                triangles.append([a, c, b])
            if i + 1 < steps // 2:
                triangles.append([a, d, c])
        return self.centre + self.radius * numpy.array(triangles)

    def contains(self, x):
        return ((x - self.centre) ** 2).sum(axis=1) < self.radius ** 2


class Torus:
    def __init__(self, random):
        self.centre = random.uniform(0.3, 0.7, 3)
        self.axes = numpy.linalg.qr(random.normal(size=(3, 3)))[0]
        self.axes *= numpy.sign(numpy.linalg.det(self.axes))
        self.radius = random.uniform(0.15, 0.2)
        self.tube = random.uniform(0.08, 0.1)

    def triangles(self, steps=(48, 24)):
        along, around = (2 * numpy.pi * numpy.arange(n) / n for n in steps)
        distance = self.radius + self.tube * numpy.cos(around)
        points = numpy.stack([numpy.outer(numpy.cos(along), distance),
                              numpy.outer(numpy.sin(along), distance),
                              numpy.outer(numpy.ones(steps[0]), self.tube * numpy.sin(around))],
                             axis=2)
        return self.centre + grid_of_triangles(points) @ self.axes

    def contains(self, x):
        x, y, z = ((x - self.centre) @ self.axes.T).T
        return (numpy.hypot(x, y) - self.radius) ** 2 + z ** 2 < self.tube ** 2


def random_solids(count, seed):
    random = numpy.random.default_rng(seed)
    return [(Block, Ball, Torus)[k % 3](random) for k in range(count)]


def model_of(solids):
    """Returns an STL file of a unit cube and of these solids in it."""
    return solid("cube", box((0, 0, 0), (1, 1, 1))) + "".join(
        solid(f"solid{k}", it.triangles().tolist()) for k, it in enumerate(solids))


def sampled_volumes(solids, points=100):
    """Returns the volumes of the cube and of the solids where the last one counts, by points on a
    grid."""
    line = (numpy.arange(points) + 0.5) / points
    volumes = numpy.zeros(len(solids) + 1)
    for height in line:
        x = numpy.array(list(itertools.product(line, line, [height])))
        tags = numpy.zeros(len(x), dtype=int)
        for k, it in enumerate(solids, 1):
            tags[it.contains(x)] = k
        volumes += numpy.bincount(tags, minlength=len(volumes))
    return volumes / points ** 3


class SolidsTest(CommandTest):
    def check_solids(self, count, seed, spacing):
        """Runs the command and compares the volumes of the regions. Returns the smallest angle."""
        solids = random_solids(count, seed)
        expected = sampled_volumes(solids)
        model = self.folder / "solids.stl"
        model.write_text(model_of(solids))
        self.run_command("--domain", model, "--fragment", "--spacing", spacing,
                         "--output", "a.vtu", "--report", "a.json", "--check")
        found = volumes_by_region(self.folder / "a.vtu")
        self.assertEqual(sorted(found), [k for k, volume in enumerate(expected, 1) if volume > 0])
        self.assertAlmostEqual(sum(found.values()), 1, 9)
        for tag, volume in found.items():
            # The faces of elements are chords of the curved solids.
            self.assertAlmostEqual(volume / expected[tag - 1], 1, delta=0.1, msg=tag)
        return json.loads((self.folder / "a.json").read_text())["quality"]["min_angle"]
