#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random bodies by constructive solid geometry (manifold3d); seed and number determine a body.
  tests/bench/bodies/random_bodies.py SEED NUMBER FILE.off [--parts 25]

They have sharp edges at random angles, thin walls, narrow slots, small parts, holes through them,
cavities, and separate pieces. The size is about 1. Pieces and cavities smaller than 0.1 are left
out.
"""
import argparse
import sys
from pathlib import Path

import manifold3d
import numpy as np
from manifold3d import CrossSection, Manifold, OpType
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from sharp_edges import is_surface

MOST_PARTS = 25
LEAST_VOLUME = 1e-3
LEAST_PIECE = 0.1


# ---------------------------------------------------------------- draws ---------------------
def between(random, low, high):
    """Draws a number whose logarithm is uniformly distributed."""
    return float(np.exp(random.uniform(np.log(low), np.log(high))))


def segments(random):
    return int(random.integers(6, 48))


def part_count(random, most, least=2):
    return int(round(between(random, least, most)))


def turned(random, part):
    """Rotates a part randomly. One in three is rotated by right angles only, so that faces are
    parallel."""
    if random.random() < 1 / 3:
        return part.rotate((90 * random.integers(4, size=3)).tolist())
    q = random.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    return part.transform([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 0],
                           [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 0],
                           [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), 0]])


def put(random, part, reach=0.5):
    return part.translate(random.uniform(-reach, reach, 3).tolist())


# ---------------------------------------------------------------- parts ---------------------
def star(random, size):
    """Returns a polygon around the origin that need not be convex."""
    corners = int(random.integers(3, 10))
    angles = 2 * np.pi * (np.arange(corners) + random.uniform(-0.3, 0.3, corners)) / corners
    radii = size * random.uniform(0.3, 1, corners)
    return CrossSection([np.column_stack([radii * np.cos(angles), radii * np.sin(angles)]).tolist()])


def box(random, size):
    return Manifold.cube((size * random.uniform(0.3, 1.5, 3)).tolist(), True)


def cylinder(random, size):
    return Manifold.cylinder(size * random.uniform(0.5, 2), size * random.uniform(0.2, 0.7),
                             circular_segments=segments(random), center=True)


def cone(random, size):
    tip = random.choice([0, random.uniform(0.05, 0.6)])
    return Manifold.cylinder(size * random.uniform(0.5, 2), size * random.uniform(0.3, 0.8),
                             float(size * tip), segments(random), True)


def ball(random, size):
    return Manifold.sphere(size * random.uniform(0.3, 0.7), segments(random)).scale(
        random.uniform(0.6, 1.2, 3).tolist())


def torus(random, size):
    ring, tube = size * random.uniform(0.3, 0.7), random.uniform(0.1, 0.7)
    circle = CrossSection.circle(ring * tube, segments(random)).translate((ring, 0))
    return Manifold.revolve(circle, segments(random))


def prism(random, size):
    return Manifold.extrude(star(random, size), size * random.uniform(0.2, 1.5))


def twisted(random, size):
    return Manifold.extrude(star(random, size), size * random.uniform(0.5, 1.5), 12,
                            random.uniform(-120, 120), random.uniform(0.3, 1, 2).tolist())


def revolved(random, size):
    profile = star(random, 0.4 * size).translate((size * random.uniform(0.1, 0.6), 0))
    return Manifold.revolve(profile, segments(random), float(random.choice([360, random.uniform(60, 330)])))


def plate(random, size):
    thick = between(random, 0.04, 0.25)
    return Manifold.cube([*(size * random.uniform(0.6, 1.5, 2)).tolist(), size * thick], True)


PARTS = [box, cylinder, cone, ball, torus, prism, twisted, revolved, plate]


def part(random, small, large):
    kind = PARTS[random.integers(len(PARTS))]
    return turned(random, kind(random, between(random, small, large)))


# ---------------------------------------------------------------- recipes -------------------
def heap(random, most):
    """Combines parts one by one: Each is added, subtracted or intersected."""
    made = part(random, 0.5, 1)
    for _ in range(part_count(random, most) - 1):
        other = put(random, part(random, 0.15, 1))
        chance = random.random()
        made = made + other if chance < 0.5 else made - other if chance < 0.9 else cut(made, other)
    return made


def cut(made, other):
    """Returns the intersection, or the difference if the intersection is tiny."""
    both = made ^ other
    return both if both.volume() > 0.1 * made.volume() else made - other


def drilled(random, most):
    """Returns a part with through holes."""
    made = part(random, 0.7, 1.2)
    for _ in range(part_count(random, most, 1)):
        hole = Manifold.cylinder(5, between(random, 0.04, 0.25), circular_segments=segments(random),
                                 center=True)
        made -= put(random, turned(random, hole), 0.3)
    return made


def slotted(random, most):
    made = part(random, 0.7, 1.2)
    for _ in range(part_count(random, most, 1)):
        slot = Manifold.cube([between(random, 0.03, 0.2), between(random, 0.3, 3), 1], True)
        made -= put(random, turned(random, slot))
    return made


def hollow(random, most):
    """Returns a wall around a cavity. Further parts may open it, and the cavity may contain a part.
    """
    made = part(random, 0.8, 1.3)
    low, high = np.reshape(made.bounding_box(), (2, 3))
    centre = (low + high) / 2
    inner = made.translate((-centre).tolist()).scale((random.uniform(0.5, 0.92),) * 3)
    made -= inner.translate(centre.tolist())
    for _ in range(int(random.integers(0, 4))):
        other = put(random, part(random, 0.1, 0.5))
        made = made - other if random.random() < 0.6 else made + other
    return made


def fins(random, most):
    """Returns thin plates that cross each other."""
    return Manifold.batch_boolean([put(random, turned(random, plate(random, between(random, 0.4, 1.2))), 0.3)
                                   for _ in range(part_count(random, most))], OpType.Add)


def scattered(random, most):
    """Returns separate pieces of all sizes. Pieces that would cross others are left out."""
    made = part(random, 0.3, 0.8)
    for _ in range(part_count(random, most)):
        other = put(random, part(random, 0.1, 0.6), 0.8)
        if (made ^ other).is_empty():
            made += other
    return made


RECIPES = [heap, heap, drilled, slotted, hollow, fins, scattered]


# ---------------------------------------------------------------- bodies --------------------
def surface(made):
    """Returns points and triangles, with coincident points merged."""
    mesh = made.to_mesh64()
    x, places = np.unique(np.array(mesh.vert_properties)[:, :3], axis=0, return_inverse=True)
    return x, places.reshape(-1)[np.array(mesh.tri_verts, dtype=int)]


def without_crumbs(x, triangles):
    """Returns the closed surfaces that are long enough."""
    a, b, _ = triangles.T
    links = coo_matrix((np.ones(len(a)), (a, b)), shape=(len(x), len(x)))
    count, piece = connected_components(links, directed=False)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(low, piece, x)
    np.maximum.at(high, piece, x)
    kept = triangles[(high - low).max(1)[piece[a]] > LEAST_PIECE]
    used, places = np.unique(kept, return_inverse=True)
    return x[used], places.reshape(-1, 3)


def random_body(seed, number, most=MOST_PARTS):
    """Draws until the surface of a body nowhere touches itself along an edge. The body has at most
    `most` parts, or a few more."""
    random = np.random.default_rng([seed, number])
    while True:
        made = RECIPES[random.integers(len(RECIPES))](random, most)
        if made.status() != manifold3d.Error.NoError or made.volume() < LEAST_VOLUME:
            continue
        x, triangles = without_crumbs(*surface(made))
        if is_surface(triangles):
            return x, triangles


def write_off(path, x, triangles):
    rows = [" ".join(map(repr, row)) for row in x.tolist()]
    rows += [f"3 {a} {b} {c}" for a, b, c in triangles.tolist()]
    path.write_text("\n".join(["OFF", f"{len(x)} {len(triangles)} 0", *rows, ""]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("seed", type=int)
    parser.add_argument("number", type=int)
    parser.add_argument("file", type=Path)
    parser.add_argument("--parts", type=int, default=MOST_PARTS, help="of a body, at most about")
    arguments = parser.parse_args()
    write_off(arguments.file, *random_body(arguments.seed, arguments.number, arguments.parts))


if __name__ == "__main__":
    sys.exit(main())
