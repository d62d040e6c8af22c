# SPDX-License-Identifier: BSD-3-Clause
"""gmsh, by its command or its Python package, with the spacing as a background field."""
import math
import re
import sys

import numpy as np
from adapters import tool
from measure import Failed, measure

AS_COMMAND = "import gmsh, sys; gmsh.initialize(sys.argv, run=True); gmsh.finalize()"

# On the loop that d grows from, d is too large by this share at most: gmsh takes distances from
# points on it.
TOO_LARGE = 0.02


def geometry(case):
    """The domain and its spacing in gmsh's language."""
    domain, lines, first_of_loop = case.domain, [], []
    for i, (x, y) in enumerate(domain.vertices.tolist(), 1):
        lines.append(f"Point({i}) = {{{x!r}, {y!r}, 0}};")
    line, loops = 0, domain.loops()
    for number, loop in enumerate(loops, 1):
        first = line + 1
        first_of_loop.append(first)
        for a, b in zip(loop, np.roll(loop, -1)):
            line += 1
            lines.append(f"Line({line}) = {{{a + 1}, {b + 1}}};")
        lines.append(f"Curve Loop({number}) = {{{first}:{line}}};")
    lines.append(f"Plane Surface(1) = {{1:{len(loops)}}};")
    lines += ["Mesh.MeshSizeExtendFromBoundary = 0;", "Mesh.MeshSizeFromPoints = 0;"]
    if case.slope == 0:
        lines += [f"Mesh.MeshSize{bound} = {case.constant!r};" for bound in ("Min", "Max")]
    elif case.has_formula:
        lines += ["Field[1] = MathEval;", f'Field[1].F = "{case.formula("Sqrt")}";',
                  "Background Field = 1;"]
    else:
        lines += field_from_loop(case, f"{first_of_loop[1]}:{line}")
    return "\n".join(lines) + "\n"


def field_from_loop(case, curves):
    """d grows from the curves of the domain's only hole, the loop of the case."""
    longest = np.hypot(*(case.loop - np.roll(case.loop, 1, 0)).T).max()
    points = math.ceil(0.5 * case.slope * longest / (TOO_LARGE * case.constant)) + 1
    way = (case.largest - case.constant) / case.slope
    return ["Field[1] = Distance;", f"Field[1].CurvesList = {{{curves}}};",
            f"Field[1].Sampling = {points};",
            "Field[2] = Threshold;", "Field[2].InField = 1;",
            "Field[2].DistMin = 0;", f"Field[2].SizeMin = {case.constant!r};",
            f"Field[2].DistMax = {way!r};", f"Field[2].SizeMax = {case.largest!r};",
            "Background Field = 2;"]


def read_msh(path):
    """The nodes of the triangles in a file of format 2.2."""
    with open(path) as file:
        for line in file:
            if line.startswith("$Nodes"):
                break
        count = int(next(file))
        nodes = np.loadtxt(file, usecols=(0, 1, 2), max_rows=count, ndmin=2)
        used = set()
        for line in file:
            words = line.split()
            if len(words) > 5 and words[1] == "2":
                used.update(words[-3:])
    return nodes[np.isin(nodes[:, 0], [int(number) for number in used]), 1:]


class Gmsh(tool.Tool):
    needs = "the command gmsh (Debian's package gmsh) or the Python package gmsh"

    def __init__(self, name, algorithm, smoothing):
        self.name = f"gmsh, {name}"
        self.setting = f"-2 -algo {algorithm} -smooth {smoothing}"
        self.options = self.setting.split()

    def command(self):
        if tool.command("gmsh"):
            return ["gmsh"]
        return [sys.executable, "-c", AS_COMMAND]

    def available(self):
        return bool(tool.command("gmsh")) or tool.module("gmsh")

    def version(self):
        return tool.answer_of(*self.command(), "--version").splitlines()[-1]

    def run(self, case, folder, time_limit):
        (folder / "case.geo").write_text(geometry(case))
        used = measure([*self.command(), "case.geo", *self.options, "-nt", 1, "-format", "msh22",
                        "-o", "nodes.msh"], folder, time_limit)
        if not (folder / "nodes.msh").exists():
            raise Failed("wrote no file")
        # "Done meshing 2D (Wall 0.1s, CPU 0.1s)", and 1D.
        told = re.findall(r"Done meshing \dD \(Wall ([\d.e+-]+)s", used.stdout)
        return tool.Outcome(read_msh(folder / "nodes.msh"), used.seconds,
                            sum(map(float, told)) if told else None, used.peak_bytes)


def tools():
    # A smoothing step is gmsh's default.
    return [Gmsh("frontal", "front2d", 1), Gmsh("frontal, 10 smoothings", "front2d", 10),
            Gmsh("Delaunay", "del2d", 1)]
