#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finite element errors on meshes by PNPBS and by gmsh (its Python package), at equal numbers of nodes.

usage: study.py run RESULTS.json [CASE...]    measures what the file does not have yet
       study.py page RESULTS.json DOCS        writes DOCS/comparison_fem.md and the picture

Uses the package pnpbs (PYTHONPATH, PNPBS_LIBRARY), NumPy, SciPy and Matplotlib. One thread:
OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1."""
import json
import pathlib
import platform
import sys

import numpy as np

from problems import CASES

ORDERS = (1, 2)
MOST_DOFS = 60_000


# ---------------------------------------------------------------- measuring ----------------------

def measure(path, wanted):
    import meshers
    from elements import Solved
    rows = json.loads(path.read_text()) if path.exists() else []
    done = {(row["case"], row["mesher"], row["h"]) for row in rows}
    for case in CASES:
        for h in case.sizes + case.finer if not wanted or case.name in wanted else []:
            for name in meshers.names(case):
                if (case.name, name, h) in done or (h in case.finer and name == meshers.OURS):
                    continue
                mesh, seconds = meshers.mesh(case, name, h)
                for order in ORDERS:
                    if order == 2 and len(mesh) * {2: 4, 3: 8}[case.dim] > MOST_DOFS:
                        continue
                    solved = Solved(mesh, order, case.problem)
                    rows.append({"case": case.name, "mesher": name, "h": h, "order": order,
                                 "nodes": len(mesh), "elements": len(mesh.elements),
                                 "dofs": solved.dofs, "error": solved.error,
                                 "iterations": solved.iterations, "meshing": seconds,
                                 "solving": solved.seconds})
                    print(*rows[-1].values(), flush=True)
                path.write_text("[" + ",\n".join(json.dumps(row) for row in rows) + "]\n")


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
             " | error | nodes for our error | Jacobi-CG iterations | CPU s: meshing | solving |",
             "| --- | --- | --- | --- | --- | --- |"]
    for mesher in meshers_of(rows, case):
        line = Line(rows, case, mesher, order)
        lines.append(f"| {mesher} | {line.at_nodes(nodes, 'error'):#.3g} "
                     f"| {line.nodes_for(error) / nodes:.2f} times ours "
                     f"| {line.at_nodes(nodes, 'iterations'):.0f} "
                     f"| {line.at_nodes(nodes, 'meshing'):.2f} "
                     f"| {line.at_nodes(nodes, 'solving'):.2f} |")
    return "\n".join(lines) + "\n"


def page(rows, notes):
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
- "Nodes for our error": how many nodes a mesher would need for the error that PNPBS has there.
- Iterations are those of conjugate gradients, preconditioned by the diagonal, to 1e-8.
- CPU seconds of one thread. PNPBS gives more than a mesh: adjacency lists, stars, the same bits on any
  ranks; solving is by SciPy, and the same for all.
- Uniform cases have u = sin(3 x + y) exp(y), in space times exp(z / 2); graded ones u = log(r² + e²) / 2,
  e = 0.05, and d in proportion to (r² + e²)^(1/2), which spreads the error evenly.

![Error over nodes, and over CPU seconds of meshing and solving](images/comparison_fem.png)
"""
    for case in CASES:
        text += f"## {case.title}\n\n" + "\n".join(table(rows, case, order) for order in ORDERS) + "\n"
    return text + notes


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
    # The notes that people have written about the figures are kept.
    mark = "## What it shows\n"
    notes = mark + there.read_text().split(mark)[1] if there.exists() and \
        mark in there.read_text() else ""
    picture(rows, docs / "images/comparison_fem.png")
    there.write_text(page(rows, notes))


if __name__ == "__main__":
    main()
