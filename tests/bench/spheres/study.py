#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures MPAS grids of the command for a finite volume model.

The measures are the errors of TRiSK's operators and of a steady flow of shallow water, beside
icosahedral grids with about the same number of cells.

  tests/bench/spheres/study.py [--pnpbs build/release/bin/pnpbs] [--levels 4,5] [--lloyd 10,300]
                               [--pnpbs-arguments='--set effort=best']... [--days 5]
                               [--output FILE]
  tests/bench/spheres/study.py --grids file --file GRID.nc...

Writes tables in Markdown. Needs NumPy, SciPy and netCDF4."""
import argparse
import math
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path[:0] = [str(HERE), str(HERE.parent)]

import machine  # noqa: E402
import numpy as np  # noqa: E402
from cgrid import CGrid, differences  # noqa: E402
from command_line import shown_command  # noqa: E402
from operators import operator_errors  # noqa: E402
from points import bisected, centroidal, constant  # noqa: E402
from progress import Progress  # noqa: E402
from shallow_water import SteadyFlow  # noqa: E402
from tables import give, grouped, table_head, table_row  # noqa: E402

RADIUS = 6371220.0
# d grows from 60 km at a point in North America to 240 km on the opposite side, which gives about
# 40 900 nodes.
GRADED = "60e3 + 90e3*(1 - (-0.13302*x - 0.75441*y + 0.64279*z)/6371220)"
GRIDS = ["icosahedral", "pnpbs", "graded"]
COURANT = 0.5


def placed(args, spacing, nodes, more):
    """Creates a grid with the command, with about this number of nodes."""
    command = [args.pnpbs.absolute(), "--sphere", RADIUS, "--spacing", spacing, "--nodes", nodes,
               "--format", "mpas", "--output", "grid.nc", "--quiet", *shlex.split(more)]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True,
                              stdin=subprocess.DEVNULL, text=True, check=False)
        if done.returncode not in (0, 3, 4):  # 3: not at rest, 4: d is missed somewhere
            sys.exit(f"pnpbs: status {done.returncode}: {done.stderr.strip()}")
        return CGrid.from_file(Path(folder) / "grid.nc")


def graded_density(x):
    d = eval(GRADED, {}, dict(zip("xyz", RADIUS * x.T)))  # noqa: S307
    return d**-4.0


def grids(args):
    """Yields the names of grids and the functions that create them."""
    for level in args.levels:
        nodes = 10 * 4**level + 2
        yield from with_lloyd(args, "icosahedral", "icosahedral",
                              lambda level=level: CGrid.from_points(bisected(level), RADIUS))
        for more in args.pnpbs_arguments:
            yield from with_lloyd(args, "pnpbs", " ".join(["PNPBS", more]).strip(),
                                  lambda nodes=nodes, more=more: placed(args, "100e3", nodes, more))
    nodes = 10 * 4**max(args.levels, default=0) + 2
    for more in args.pnpbs_arguments:
        yield from with_lloyd(args, "graded", " ".join(["PNPBS, graded 1:4", more]).strip(),
                              lambda more=more: placed(args, GRADED, nodes, more), graded_density)
    for path in args.file:
        yield path.name, lambda path=path: CGrid.from_file(path)


def with_lloyd(args, kind, name, make, density=constant):
    if kind not in args.grids:
        return
    yield name, make
    for rounds in args.lloyd:
        def centred(rounds=rounds):
            return CGrid.from_points(centroidal(make().cell, rounds, density), RADIUS)

        yield f"{name}, {rounds} Lloyd iterations", centred


OPERATORS = ["gradient", "divergence", "curl", "tangential velocity", "Laplacian"]


def figures(value, digits=2):
    return f"{value:.{digits - 1}e}".replace("e-0", "e-").replace("e+00", "")


def both(errors):
    return " / ".join(figures(e) for e in errors)


def shape_row(name, grid):
    middle = grid.vertex[grid.vertices_on_edge].sum(1)
    middle /= np.linalg.norm(middle, axis=1)[:, None]
    off = np.linalg.norm(middle - grid.edge, axis=1) * grid.radius / grid.dc
    sides = np.bincount(grid.cells_on_edge.ravel())
    own = CGrid.from_points(grid.cell, grid.radius)
    return [name, grouped(len(grid.cell)), f"{np.mean(sides != 6):.3f}",
            f"{grid.dc.min() / grid.dc.mean():.2f}", f"{(grid.dv / grid.dc).min():.2f}",
            f"{off.mean():.3f} / {off.max():.2f}", figures(max(differences(grid, own).values()))]


def measured(args):
    """Returns the rows of the three tables."""
    named = list(grids(args))
    progress, shapes, operators, flows = Progress(len(named)), [], [], []
    for name, make in named:
        progress.begin(name)
        grid = make()
        cells = grouped(len(grid.cell))
        shapes.append(shape_row(name, grid))
        errors = operator_errors(grid)
        operators.append([name, cells, *(both(errors[key]) for key in OPERATORS)])
        runs = [SteadyFlow(grid, math.radians(angle)).run(args.days, args.courant) for angle in args.angles]
        if runs:
            flows.append([name, cells, f"{runs[0]['dt']:.0f}",
                          *(both(run[key]) for run in runs for key in "hu"),
                          figures(max(abs(run["mass"]) for run in runs)),
                          figures(max((run["energy"] for run in runs), key=abs))])
        progress.end()
    return shapes, operators, flows


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pnpbs", type=Path, default=ROOT / "build/release/bin/pnpbs")
    parser.add_argument("--grids", default=GRIDS, type=lambda text: text.split(","),
                        help="of " + ",".join(GRIDS) + ",file")
    parser.add_argument("--levels", default=[4, 5], type=lambda text: [int(n) for n in text.split(",")],
                        help="of the icosahedral grids: 10 4^level + 2 cells, and as many of the others")
    parser.add_argument("--pnpbs-arguments", action="append", metavar="TEXT",
                        help="more arguments of the command: --pnpbs-arguments='--set NAME=VALUE'; "
                        "each time it is given makes grids of its own")
    parser.add_argument("--lloyd", default=[10, 300],
                        type=lambda text: [int(n) for n in text.split(",") if n],
                        help="iterations, of each grid besides; '' for none")
    parser.add_argument("--file", type=Path, nargs="+", default=[], help="grids of MPAS besides")
    parser.add_argument("--angles", default=[0.0, 45.0],
                        type=lambda text: [float(a) for a in text.split(",") if a],
                        help="degrees of the axis of the flow; '' for no flow")
    parser.add_argument("--days", type=float, default=5)
    parser.add_argument("--courant", type=float, default=COURANT,
                        help="of gravity waves at the shortest dcEdge")
    parser.add_argument("--output", type=Path, help="file for the tables; else standard output")
    args = parser.parse_args()
    args.pnpbs_arguments = args.pnpbs_arguments or [""]
    if not set(args.grids) <= {*GRIDS, "file"}:
        parser.error(f"--grids: of {', '.join(GRIDS)}, with commas between them")
    if {"pnpbs", "graded"} & set(args.grids) and not args.pnpbs.exists():
        parser.error(f"{args.pnpbs} is not there: build it")
    return args


def main():
    args = arguments()
    shapes, operators, flows = measured(args)
    angles = [f"{key}, {angle:g} degrees: l2 / l_inf" for angle in args.angles for key in "hu"]
    tables = [
        (["grid", "cells", "not hexagons", "least dc / mean", "least dv / dc",
          "middle of edge off, over dc: mean / most", "differs from grid by points"], shapes),
        (["grid", "cells", *(f"{name}: l2 / l_inf" for name in OPERATORS)], operators),
        (["grid", "cells", "time step, s", *angles, "mass changes", "energy changes"], flows)]
    command = shown_command("tests/bench/spheres/study.py", {"--pnpbs": "FILE", "--output": "FILE"}, args.file)
    text = [f"{machine.date.today().isoformat()}, {machine.system()}. Made by", "", "```sh", command, "```"]
    for titles, rows in tables:
        if rows:
            text += ["", *table_head(titles), *(table_row(row) for row in rows)]
    give("\n".join(text), args.output)


if __name__ == "__main__":
    main()
