#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finite element errors on meshes by PNPBS and by gmsh (its Python package), at equal numbers of nodes.

usage: study.py run RESULTS.json [CASE...]    measures what the file does not have yet
       study.py page RESULTS.json DOCS        writes DOCS/comparison_fem.md and the picture

A case is one of problems.py, or a body of body_cases.py. The page keeps the sections of cases without
results, and its picture if there is any such case.

Uses the package pnpbs (PYTHONPATH, PNPBS_LIBRARY), NumPy, SciPy and Matplotlib. One thread:
OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1."""
import json
import pathlib
import platform
import re
import sys

import numpy as np

import equal_error
from body_cases import BODIES
from problems import CASES

ORDERS = (1, 2)
MOST_DOFS = 60_000


# ---------------------------------------------------------------- measuring ----------------------

def measure(path, wanted):
    rows = json.loads(path.read_text()) if path.exists() else []
    done = {(row["case"], row["mesher"], row["h"]) for row in rows}
    for name, mesher, h, order, mesh, seconds, solved in measurements(wanted, done):
        rows.append({"case": name, "mesher": mesher, "h": h, "order": order, "nodes": len(mesh),
                     "elements": len(mesh.elements), "dofs": solved.dofs, "error": solved.error,
                     "iterations": solved.iterations, "meshing": seconds, "solving": solved.seconds})
        print(*rows[-1].values(), flush=True)
        path.write_text("[" + ",\n".join(json.dumps(row) for row in rows) + "]\n")


def measurements(wanted, done):
    yield from case_measurements([one for one in CASES if not wanted or one.name in wanted], done)
    yield from body_measurements([one for one in BODIES if not wanted or one.name in wanted], done)


def case_measurements(cases, done):
    import meshers
    from elements import Solved
    for case in cases:
        for h in case.sizes + case.finer:
            for name in meshers.names(case):
                if (case.name, name, h) in done or (h in case.finer and name == meshers.OURS):
                    continue
                mesh, seconds = meshers.mesh(case, name, h)
                for order in ORDERS:
                    if order == 2 and len(mesh) * {2: 4, 3: 8}[case.dim] > MOST_DOFS:
                        continue
                    yield case.name, name, h, order, mesh, seconds, Solved(mesh, order, case.problem)


def body_measurements(bodies, done):
    """Measures linear elements on bodies. The column h has the spacing, in the graded body the
    smallest one."""
    import body_meshers
    from elements import Solved
    for body in bodies:
        for nodes in body.sizes:
            for mesher, times in body_meshers.TIMES_NODES.items():
                case = body.with_nodes(times * nodes)
                if (body.name, mesher, case.constant) in done:
                    continue
                mesh, seconds = body_meshers.mesh(case, mesher)
                yield (body.name, mesher, case.constant, 1, mesh, seconds,
                       Solved(mesh, 1, body.problem))


# ---------------------------------------------------------------- what it comes to ---------------

class Line:
    """The results of a mesher in a case, by increasing number of nodes."""

    def __init__(self, rows, case, mesher, order):
        self.rows = sorted((row for row in rows if row["case"] == case.name and
                            row["mesher"] == mesher and row["order"] == order),
                           key=lambda row: row["nodes"])

    def column(self, *names):
        return np.array([sum(row[name] for name in names) for row in self.rows], float)

    def at_nodes(self, nodes, *names):
        """Interpolates between the meshes, and extrapolates beyond them, by powers of the number of
        nodes."""
        x, y = np.log(self.column("nodes")), np.log(self.column(*names))
        k = int(np.clip(np.searchsorted(x, np.log(nodes)), 1, len(x) - 1))
        slope = (y[k] - y[k - 1]) / (x[k] - x[k - 1])
        return float(np.exp(y[k] + slope * (np.log(nodes) - x[k])))

    def nodes_for(self, error):
        x, y = np.log(self.column("nodes")), np.log(self.column("error"))
        slope, offset = np.polyfit(y[-2:], x[-2:], 1)
        return float(np.exp(slope * np.log(error) + offset))


def meshers_of(rows, case):
    return list(dict.fromkeys(row["mesher"] for row in rows if row["case"] == case.name))


def table(rows, case, order):
    ours = Line(rows, case, "PNPBS", order)
    nodes, error = ours.column("nodes")[-1], ours.column("error")[-1]
    lines = [f"| P{order} at {nodes:,.0f} nodes".replace(",", " ") +
             " | error | nodes over those of PNPBS | Jacobi-CG iterations | CPU s: meshing | solving |",
             "| --- | --- | --- | --- | --- | --- |"]
    for mesher in meshers_of(rows, case):
        line = Line(rows, case, mesher, order)
        lines.append(f"| {mesher} | {line.at_nodes(nodes, 'error'):#.3g} "
                     f"| {line.nodes_for(error) / nodes:.2f} "
                     f"| {line.at_nodes(nodes, 'iterations'):.0f} "
                     f"| {line.at_nodes(nodes, 'meshing'):.2f} "
                     f"| {line.at_nodes(nodes, 'solving'):.2f} |")
    return "\n".join(lines) + "\n"


def sections_of(text):
    """Returns the sections of a page by their titles."""
    parts = re.split(r"^## (.*)\n", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2]))


def case_section(rows, case, before):
    """Returns the section of a case, or the one of the page before if there are no results."""
    if not meshers_of(rows, case):
        return before.get(case.title, "\n")
    return "\n" + "\n".join(table(rows, case, order) for order in ORDERS) + "\n"


def bodies_section(rows, before):
    """Returns the section about meshing time at an equal error, or the one of the page before."""
    measured = {body.title: {mesher: sorted((row for row in rows if row["case"] == body.name and
                                             row["mesher"] == mesher), key=lambda row: row["nodes"])
                             for mesher in ("PNPBS", "gmsh, HXT")}
                for body in BODIES if meshers_of(rows, body)}
    if not measured:
        return before.get(BODIES_TITLE, "\n")
    compared = {title: equal_error.Comparison(*meshers.values())
                for title, meshers in measured.items()}
    return (f"\n{BODIES_TEXT}\n{equal_error.table(compared)}\nThe measured sizes:\n\n"
            f"{equal_error.measured_table(measured)}\n")


BODIES_TITLE = "Meshing time at an equal error"
BODIES_TEXT = """\
The aim is a ratio HXT / PNPBS above 1 in all bodies. Above 1: PNPBS is faster.

- The bodies, the spacing and the scripts for gmsh are those of the [comparison in space](comparison_volumes.md). The
  asteroids are scaled to reach from -1 to 1.
- Elements are linear. Uniform cases have the u of the ball above; the graded one u = log(r² + e²) / 2, where r is the
  distance from the middle, e = 0.2165, and d is in proportion to r + e.
- HXT runs with gmsh's default optimisation (Mesh.Optimize = 1).
- Seconds are CPU time, as the machine was shared; medians of three meshings in one process with one thread. They
  include reading the triangles of the L-block (PNPBS) and of the asteroids (both), and handing the mesh to Python.
- Seconds and nodes at an error are interpolated between the measured sizes by power laws, without extrapolation. The
  ratio in bold is at the middle of the errors that both meshers have (in the logarithm).
- `docs/comparison_fem.json` has the results of this section.
"""


def page(rows, notes, before=""):
    before = sections_of(before)
    import gmsh
    import scipy
    gmsh.initialize()
    version = gmsh.option.getString("General.Version")
    gmsh.finalize()
    text = f"""# Comparison by finite element errors

What counts for a solver is the error at a number of nodes. Here -Laplace u = f with a known u is solved by
elements of first (P1) and second order (P2, straight) on meshes by PNPBS and by gmsh {version}, for the same
domain and spacing d. Made by

```sh
OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 tests/bench/fem/study.py run results.json
tests/bench/fem/study.py page results.json docs
```

with Python {platform.python_version()}, NumPy {np.__version__} and SciPy {scipy.__version__}, one thread.

- The error is the norm of the gradient's error over that of the gradient (H1), by integrals of fourth
  order or more over the mesh. The solutions go on smoothly outside of the ball.
- Every mesher gets several d; its figures are those between its meshes, at the number of nodes that PNPBS
  has, by powers of the number of nodes. So it does not matter that gmsh takes d for an upper bound.
- "Nodes over those of PNPBS": the nodes that a mesher needs for the error of PNPBS, by its own rate.
- Iterations are those of conjugate gradients, preconditioned by the diagonal, to 1e-8.
- CPU seconds of one thread. PNPBS gives more than a mesh: adjacency lists, stars, the same bits on any
  ranks; solving is by SciPy, and the same for all.
- Uniform cases have u = sin(3 x + y) exp(y), in space times exp(z / 2); graded ones u = log(r² + e²) / 2,
  e = 0.05, and d in proportion to (r² + e²)^(1/2), which spreads the error evenly.

![Error over nodes, and over CPU seconds of meshing and solving](images/comparison_fem.png)

"""
    for case in CASES:
        text += f"## {case.title}\n" + case_section(rows, case, before)
    return text + f"## {BODIES_TITLE}\n" + bodies_section(rows, before) + notes


# ---------------------------------------------------------------- picture ------------------------

COLORS = {"PNPBS": "#c0392b", "gmsh, frontal": "#2471a3", "gmsh, HXT": "#2471a3",
          "gmsh, Delaunay": "#7d8c93", "gmsh, Delaunay and Netgen's optimiser": "#1e8449"}


def picture(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(2, len(CASES), figsize=(15, 7.6), sharey="col")
    for across, case in enumerate(CASES):
        for down, (label, names) in enumerate((("nodes", ["nodes"]),
                                               ("CPU seconds, meshing and solving",
                                                ["meshing", "solving"]))):
            axis = axes[down][across]
            for mesher in meshers_of(rows, case):
                for order in ORDERS:
                    line = Line(rows, case, mesher, order)
                    axis.loglog(line.column(*names), line.column("error"), "o-" if order == 1 else "s--",
                                color=COLORS[mesher], markersize=4, linewidth=1.2,
                                label=mesher if order == 1 else None)
            axis.set_xlabel(label)
            axis.grid(True, which="major", alpha=0.3)
            if across == 0:
                axis.set_ylabel("relative H1 error")
        axes[0][across].set_title(case.title)
        # The legend is below the axes, where there are no lines.
        axes[1][across].legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=2)
    figure.text(0.5, 0.005, "solid, circles: P1; dashed, squares: P2", ha="center", fontsize=9)
    figure.tight_layout(rect=(0, 0.02, 1, 1))
    figure.savefig(path, dpi=110)


def main():
    if len(sys.argv) < 3 or sys.argv[1] not in ("run", "page"):
        sys.exit(__doc__)
    path = pathlib.Path(sys.argv[2])
    if sys.argv[1] == "run":
        return measure(path, sys.argv[3:])
    rows, docs = json.loads(path.read_text()), pathlib.Path(sys.argv[3])
    there = docs / "comparison_fem.md"
    before = there.read_text() if there.exists() else ""
    # The notes that people have written about the figures are kept.
    mark = "## What it shows\n"
    notes = mark + before.split(mark)[1] if mark in before else ""
    if all(meshers_of(rows, case) for case in CASES):
        picture(rows, docs / "images/comparison_fem.png")
    there.write_text(page(rows, notes, before))


if __name__ == "__main__":
    main()
