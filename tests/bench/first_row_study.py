#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What it brings to have one node over each boundary edge, as the advancing front of JIGSAW has: the
inner nodes beside the boundary are replaced by such a row, before rounds of sweeps and repairs. To
compare with what sliding brings (sliding_study.py).

  tests/bench/first_row_study.py [--pnpbs build/release/bin/pnpbs] [--nodes 20000]
                                 [--cases airfoil,gear] [--settings default,best] [--output FILE]

Writes a table in Markdown. Needs NumPy and SciPy."""
import copy
import sys

sys.dont_write_bytecode = True

import numpy as np  # noqa: E402
import sliding_study as sliding  # noqa: E402
from command_line import shown_command  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402
from tables import give, table_head  # noqa: E402

REGULAR = 0.75, 1.3   # length over d of edges that get a node
HEIGHT = 0.866        # of it, in lengths of the edge
APART = 0.7           # d, of these from each other and from the boundary
FROM_OTHERS = 0.62    # d, of the nodes that stay
ROOM = 2              # d, behind them, free of the boundary
STRAIGHT = 0.87       # cosine of the boundary's turn at the ends of such edges


def apexes(nodes):
    """Over regular edges of the boundary, with the number of the edge's first node."""
    a = np.flatnonzero(~nodes.inner)
    b = nodes.rim.beside[a, 1]
    ratio, (before, after) = nodes.over_d(a, b), nodes.rim.beside[[a, b], [[0], [1]]]
    regular = (ratio > REGULAR[0]) & (ratio < REGULAR[1])
    ways = [nodes.points[end] - nodes.points[begin] for begin, end in ((before, a), (a, b), (b, after))]
    ways = [way / np.hypot(*way.T)[:, None] for way in ways]
    regular &= np.minimum((ways[0] * ways[1]).sum(1), (ways[1] * ways[2]).sum(1)) > STRAIGHT
    a, b = a[regular], b[regular]
    ahead, middle = nodes.points[b] - nodes.points[a], (nodes.points[a] + nodes.points[b]) / 2
    up = HEIGHT * np.column_stack([-ahead[:, 1], ahead[:, 0]])
    up *= np.where(nodes.case.domain.contains(middle + 0.3 * up), 1, -1)[:, None]
    apex = middle + up
    fits = nodes.case.domain.contains(apex)
    rim = cKDTree(nodes.points[~nodes.inner])
    fits &= rim.query(apex)[0] > APART * nodes.d[a]
    fits &= rim.query(apex + ROOM * up)[0] > ROOM * nodes.d[a]
    return apex[fits], a[fits]


def apart(apex, d):
    """Of two that are too close to each other the first stays."""
    stays = np.ones(len(apex), bool)
    tree = cKDTree(apex)
    for i in range(len(apex)):
        if stays[i]:
            near = np.array(tree.query_ball_point(apex[i], APART * d[i]))
            stays[near[near > i]] = False
    return stays


def with_first_row(nodes, corner_angle):
    """A node of the old row stays where neighbours of it on the boundary have no new one beside."""
    apex, edge = apexes(nodes)
    stays = apart(apex, nodes.d[edge])
    apex, edge = apex[stays], edge[stays]
    covered, rim = np.zeros(len(nodes.points), bool), ~nodes.inner
    covered[edge] = covered[nodes.rim.beside[edge, 1]] = True
    beside = nodes.adjacent @ rim.astype(float)
    goes = nodes.inner & (beside > 0) & ~nodes.frozen
    goes &= nodes.adjacent @ (rim & covered).astype(float) == beside
    rest = nodes.inner & ~goes
    apex = apex[cKDTree(nodes.points[rest]).query(apex)[0] > FROM_OTHERS * nodes.d[edge]]
    points = np.vstack([nodes.points[rim], apex, nodes.points[rest]])
    return sliding.Set(points, np.arange(len(points)) < rim.sum(), nodes.case, corner_angle)


def rows(name, settings, args):
    make, angle = sliding.CASES[name]
    case = make(args.nodes)
    placed = sliding.placed(args.pnpbs, case, angle, sliding.SETTINGS[settings])
    start = sliding.Set(*placed, case, angle)
    yield sliding.row(name, settings, "as placed", start)
    for variant, nodes in (("no new row", copy.deepcopy(start)),
                           ("new row", with_first_row(start, angle))):
        sliding.improve(nodes, None, False, False)
        yield sliding.row(name, settings, variant, nodes)


def main():
    args = sliding.arguments(__doc__)
    lines = [line for name in args.cases for settings in args.settings
             for line in rows(name, settings, args)]
    command = shown_command("tests/bench/first_row_study.py", {"--pnpbs": "FILE", "--output": "FILE"})
    text = "\n".join(["Made by", "", "```sh", command, "```", "", *table_head(sliding.TITLES), *lines])
    give(text, args.output)


if __name__ == "__main__":
    main()
