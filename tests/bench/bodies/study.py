#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does every body come out whole? Places nodes in bodies from files with the command, and judges the
tetrahedra that it writes without the library (judge.py).

  tests/bench/bodies/study.py [--program build/release/bin/pnpbs] [--nodes 6000] [--spacing 1]
                              [--set resolve=1] [--figures figures.json] FILE...

Prints a line for each, and how many are whole, torn, and torn without a status that says so. Exit
status 1 if there is one of these. The bodies of CGAL's demos are in Debian's package libcgal-demo
(data/meshes/*.off).
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import meshio
import numpy as np

from judge import judged

ROOT = Path(__file__).resolve().parents[3]
NOT_CONFORMING = 6  # the command's exit code


def in_its_plane(points):
    """Two coordinates of each, so that the polygon turns left."""
    normal = np.cross(points, np.roll(points, -1, 0)).sum(0)
    k = np.abs(normal).argmax()
    u, v = (k + 1) % 3, (k + 2) % 3
    return points[:, [u, v] if normal[k] > 0 else [v, u]]


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def cut_to_triangles(x, polygon):
    """Of a face that need not be convex: one ear after the other, the widest first."""
    flat = dict(zip(polygon, in_its_plane(x[polygon])))
    left, triangles = list(polygon), []
    while len(left) > 3:
        ears = []
        for k in range(len(left)):
            a, b, c = left[k - 1], left[k], left[(k + 1) % len(left)]
            inside = [p for p in left if p not in (a, b, c) and all(
                turn(flat[i], flat[j], flat[p]) >= 0 for i, j in ((a, b), (b, c), (c, a)))]
            if not inside:
                ears.append((turn(flat[a], flat[b], flat[c]), k))
        _, k = max(ears)
        triangles.append([left[k - 1], left[k], left[(k + 1) % len(left)]])
        del left[k]
    return [*triangles, left]


def read_off(path):
    """A vertex or a face in a line; faces are cut into triangles."""
    lines = [line.split("#")[0].split() for line in path.read_text(errors="replace").splitlines()]
    rows = [line for line in lines if line]
    if rows[0][0].endswith("OFF"):
        rows[:1] = [rows[0][1:]] if len(rows[0]) > 1 else []
    count, faces = int(rows[0][0]), int(rows[0][1])
    x = np.array([row[:3] for row in rows[1:1 + count]], float)
    triangles = []
    for row in rows[1 + count:1 + count + faces]:
        triangles += cut_to_triangles(x, [int(word) for word in row[1:1 + int(row[0])]])
    return x, np.array(triangles)


def read_body(path):
    if path.suffix == ".off":
        return read_off(path)
    mesh = meshio.read(path)
    return mesh.points, mesh.cells_dict["triangle"]


def read_tetrahedra(base):
    rows = {suffix: np.loadtxt(base.with_suffix(suffix), comments="#", skiprows=1, ndmin=2)
            for suffix in (".node", ".ele")}
    first = int(rows[".node"][0, 0])
    return rows[".node"][:, 1:4], rows[".ele"][:, 1:5].astype(int) - first


def placed(path, arguments):
    """Figures of one body, or why there are none."""
    with tempfile.TemporaryDirectory() as folder:
        return judged_in(Path(folder) / "body", path, arguments)


def judged_in(base, path, arguments):
    outputs = [word for suffix in (".node", ".ele") for word in ("--output", base.with_suffix(suffix))]
    options = [word for setting in arguments.set for word in ("--set", setting)]
    command = [arguments.program, "--domain", path, "--spacing", arguments.spacing, "--nodes",
               arguments.nodes, "--quiet", *outputs, *options]
    started = time.monotonic()
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True)
    seconds = time.monotonic() - started
    if not base.with_suffix(".ele").exists():
        return {"refused": (done.stderr.strip().splitlines() or ["no message"])[0]}
    return {"exit_code": done.returncode, "seconds": seconds,
            **judged(read_body(path), *read_tetrahedra(base))}


def line_of(name, found):
    if "refused" in found:
        return f"{name:24} refused: {found['refused'][:100]}"
    state = "whole" if found["whole"] else "torn"
    return (f"{name:24} {state:5} exit {found['exit_code']}  {found['nodes']:7} nodes  torn edges "
            f"{found['torn_edges']}, nodes {found['torn_nodes']}, isolated {found['isolated']}  pieces "
            f"{found['pieces']}/{found['pieces_of_body']}  Euler {found['euler']}/{found['euler_of_body']}"
            f"  off {found['from_body']:.2f} {found['to_body']:.2f}  angle {found['least_angle']:.1f}, "
            f"small {found['small_angles']}  {found['seconds']:.1f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--program", default=ROOT / "build" / "release" / "bin" / "pnpbs")
    parser.add_argument("--nodes", default="6000")
    parser.add_argument("--spacing", default="1")
    parser.add_argument("--set", action="append", default=[], metavar="OPTION=VALUE")
    parser.add_argument("--figures", type=Path, help="write all figures there, as JSON")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="bodies at a time")
    arguments = parser.parse_args()
    found = {}
    with ThreadPoolExecutor(arguments.jobs) as jobs:
        for path, figures in zip(arguments.files, jobs.map(
                lambda path: placed(path, arguments), arguments.files)):
            found[str(path)] = figures
            print(line_of(path.stem, figures), flush=True)
    if arguments.figures:
        arguments.figures.write_text(json.dumps(found, indent=1) + "\n")
    bodies = [figures for figures in found.values() if "refused" not in figures]
    torn = [figures for figures in bodies if not figures["whole"]]
    silent = sum(figures["exit_code"] != NOT_CONFORMING for figures in torn)
    print(f"{len(bodies)} bodies: {len(bodies) - len(torn)} whole, {len(torn)} torn, {silent} of these "
          f"without exit code {NOT_CONFORMING}; {len(found) - len(bodies)} refused")
    return 1 if silent else 0


if __name__ == "__main__":
    sys.exit(main())
