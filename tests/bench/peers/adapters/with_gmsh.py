# SPDX-License-Identifier: BSD-3-Clause
"""gmsh, by its command or its Python package, with the spacing as a background field."""
import math
import re
import sys

import numpy as np
from adapters import tool
from measure import Failed, measure

AS_COMMAND = "import gmsh, sys; gmsh.initialize(sys.argv, run=True); gmsh.finalize()"

# The largest relative error of d on the loop that d grows from, as gmsh computes distances to
# points on it.
TOO_LARGE = 0.02

# The first release whose Distance fields have all options that the cases set.
LEAST_VERSION = "4.9"


def outline(domain):
    """Returns the domain in gmsh's language, and the first line of each loop."""
    lines, first_of_loop = [], []
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
    return lines, first_of_loop


def geometry(case):
    """Returns the domain and its spacing in gmsh's language."""
    lines, first_of_loop = outline(case.domain)
    lines += ["Mesh.MeshSizeExtendFromBoundary = 0;", "Mesh.MeshSizeFromPoints = 0;"]
    if case.slope == 0:
        lines += [f"Mesh.MeshSize{bound} = {case.constant!r};" for bound in ("Min", "Max")]
    elif case.has_formula:
        lines += ["Field[1] = MathEval;", f'Field[1].F = "{case.formula("Sqrt")}";',
                  "Background Field = 1;"]
    else:
        lines += field_from_loop(case, f"{first_of_loop[1]}:{len(case.domain.segments)}")
    return "\n".join(lines) + "\n"


def field_from_loop(case, curves):
    """Returns a field in which d grows from the curves of the domain's only hole, the loop of the
    case."""
    longest = np.hypot(*(case.loop - np.roll(case.loop, 1, 0)).T).max()
    points = math.ceil(0.5 * case.slope * longest / (TOO_LARGE * case.constant)) + 1
    way = (case.largest - case.constant) / case.slope
    return ["Field[1] = Distance;", f"Field[1].CurvesList = {{{curves}}};",
            f"Field[1].Sampling = {points};",
            "Field[2] = Threshold;", "Field[2].InField = 1;",
            "Field[2].DistMin = 0;", f"Field[2].SizeMin = {case.constant!r};",
            f"Field[2].DistMax = {way!r};", f"Field[2].SizeMax = {case.largest!r};",
            "Background Field = 2;"]


def read_nodes(file, dimension):
    """Returns number and coordinates of each node in a file of format 2.2. The elements are next in
    the file."""
    for line in file:
        if line.startswith("$Nodes"):
            break
    count = int(next(file))
    return np.loadtxt(file, usecols=range(dimension + 1), max_rows=count, ndmin=2)


def read_msh(path):
    """Returns the nodes of the triangles in a file of format 2.2."""
    with open(path) as file:
        nodes = read_nodes(file, 2)
        used = set()
        for line in file:
            words = line.split()
            if len(words) > 5 and words[1] == "2":
                used.update(words[-3:])
    return nodes[np.isin(nodes[:, 0], [int(number) for number in used]), 1:]


class GmshCommand(tool.Tool):
    needs = f"the command gmsh, {LEAST_VERSION} or later, or the Python package gmsh"

    def __init__(self, name, setting):
        self.name = f"gmsh, {name}"
        self.setting = setting

    def command(self):
        if tool.command("gmsh"):
            return ["gmsh"]
        return [sys.executable, "-c", AS_COMMAND]

    def available(self):
        return bool(tool.command("gmsh")) or tool.module("gmsh")

    def version(self):
        version = tool.answer_of(*self.command(), "--version").splitlines()[-1]
        tool.require_version(version, LEAST_VERSION, "whose Distance fields have Sampling")
        return version

    def mesh(self, text, folder, time_limit, words=None):
        """Runs gmsh on a text in its language. Returns the measured resources and the seconds that
        it reports."""
        (folder / "case.geo").write_text(text)
        used = measure([*self.command(), "case.geo", *(words or self.setting).split(), "-nt", 1, "-format",
                        "msh22", "-o", "nodes.msh"], folder, time_limit)
        if not (folder / "nodes.msh").exists():
            raise Failed("wrote no file")
        # gmsh prints "Done meshing 2D (Wall 0.1s, CPU 0.1s)", the same for other dimensions, and
        # then "Done optimizing".
        told = re.findall(r"Done (?:meshing \dD|optimizing mesh) \(Wall ([\d.e+-]+)s", used.stdout)
        return used, sum(map(float, told)) if told else None


class Gmsh(GmshCommand):
    def run(self, case, folder, time_limit):
        used, inner = self.mesh(geometry(case), folder, time_limit)
        return tool.Outcome(read_msh(folder / "nodes.msh"), used.seconds, inner, used.peak_bytes)


def tools():
    # One smoothing step is gmsh's default.
    return [Gmsh(name, f"-2 -algo {algorithm} -smooth {smoothing}")
            for name, algorithm, smoothing in (("frontal", "front2d", 1),
                                               ("frontal, 10 smoothings", "front2d", 10),
                                               ("Delaunay", "del2d", 1))]
