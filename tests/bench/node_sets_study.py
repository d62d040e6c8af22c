#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures node sets for meshless methods (docs/guide/particles.md).

The measures are those of van der Sande and Fornberg (arXiv 1906.00636): covering radius, the
largest distance of a point of the domain to the nearest node, and mesh ratio, the covering radius
over the least distance of two nodes. The sets fill the unit square with d = 0.025 and the unit cube
with d = 0.05: placed nodes, the same nodes after the repulsion of particles, and the lattice.

  tests/bench/node_sets_study.py [--library build/release/lib/libpnpbs.so]

Writes a table in Markdown. Needs NumPy and SciPy."""
import argparse
import os
import sys
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(1, str(ROOT / "tests/bench/peers"))
sys.path.append(str(ROOT / "bindings/python"))

import numpy as np  # noqa: E402
from scipy.spatial import Voronoi, cKDTree  # noqa: E402
from tables import grouped, table_head, table_row  # noqa: E402

CASES = ("square", 2, 0.025), ("cube", 3, 0.05)
# In units of d: margin of the body in which nodes become particles, so that boundary nodes stay on
# the boundary.
WIDER = 0.4


def box(pnpbs, context, dim, by=0.0):
    domain, low, high = pnpbs.Domain(context, dim), -by, 1 + by
    if dim == 2:
        return domain.add_polyline([(low, low), (high, low), (high, high), (low, high)])
    return domain.add_box((low,) * 3, (high,) * 3)


def mirrored(points):
    """Returns the points with their mirror images beyond each side, so that Voronoi cells end at
    the sides."""
    images = [points]
    for axis in range(points.shape[1]):
        for side in 0, 1:
            near = points[(abs(points[:, axis] - side) < 0.25) & (points[:, axis] != side)].copy()
            near[:, axis] = 2 * side - near[:, axis]
            images.append(near)
    return np.concatenate(images)


def row(case, name, points):
    corners = Voronoi(mirrored(points)).vertices
    corners = corners[np.all((corners > -1e-9) & (corners < 1 + 1e-9), axis=1)]
    tree = cKDTree(points)
    covering, least = tree.query(corners)[0].max(), tree.query(points, 2)[0][:, 1].min()
    return table_row([case, name, grouped(len(points)), f"{covering:.4f}", f"{least:.4f}",
                      f"{covering / least:.3f}"])


def lattice(dim, d):
    axis = np.linspace(0, 1, round(1 / d) + 1)
    return np.stack(np.meshgrid(*[axis] * dim), axis=-1).reshape(-1, dim)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--library", type=Path, default=ROOT / "build/release/lib/libpnpbs.so")
    args = parser.parse_args()
    if not args.library.exists():
        parser.error(f"{args.library} is not there: build it")
    os.environ["PNPBS_LIBRARY"] = str(args.library)
    import pnpbs
    lines = table_head(["domain", "nodes", "number", "covering radius", "least distance", "mesh ratio"])
    with pnpbs.Context() as context:
        for case, dim, d in CASES:
            placement = pnpbs.Placement(box(pnpbs, context, dim)).set_spacing(d)
            placement.run()
            pushed = pnpbs.Particles(placement, box(pnpbs, context, dim, WIDER * d))
            lines += [row(case, "placed", placement.nodes().points),
                      row(case, "pushed apart", pushed.points), row(case, "lattice", lattice(dim, d))]
    print("\n".join(lines))


if __name__ == "__main__":
    main()
