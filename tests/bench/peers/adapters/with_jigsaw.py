# SPDX-License-Identifier: BSD-3-Clause
"""JIGSAW, by its command, with the spacing on a grid."""
import re
import tempfile
from pathlib import Path

import numpy as np
from adapters import tool
from measure import measure
from spacing_table import SpacingTable, table_of

# Points per side of the grid. JIGSAW interpolates the spacing linearly between them. One row lies
# in the middle, where spacings of squares have their minimum.
GRID = 401


def geometry(domain):
    lines = ["mshid=1", "ndims=2", f"point={len(domain.vertices)}"]
    lines += [f"{x!r};{y!r};0" for x, y in domain.vertices.tolist()]
    lines.append(f"edge2={len(domain.segments)}")
    lines += [f"{a};{b};0" for a, b in domain.segments.tolist()]
    return "\n".join(lines) + "\n"


def spacing_grid(case):
    table = even_table(case) if case.has_formula else table_of(case)
    lines = ["mshid=3;euclidean-grid", "ndims=2"]
    for axis, values in enumerate((table.x, table.y), 1):
        lines.append(f"coord={axis};{len(values)}")
        lines += [repr(v) for v in values.tolist()]
    # The values are in columns: all heights of the first column, then the next one.
    lines.append(f"value={table.values.size};1")
    lines += [repr(v) for v in table.values.ravel().tolist()]
    return "\n".join(lines) + "\n"


def even_table(case):
    low, high = case.domain.vertices.min(0), case.domain.vertices.max(0)
    x, y = (np.linspace(a, b, GRID) for a, b in zip(low, high))
    grid = np.column_stack([part.ravel() for part in np.meshgrid(x, y, indexing="ij")])
    return SpacingTable(x, y, case.spacing(grid).reshape(GRID, GRID))


def read_points(path):
    """Returns the nodes of the triangles only."""
    text = path.read_text()
    points = block(text, "point")[:, :2]
    triangles = block(text, "tria3")[:, :3].astype(int)
    return points[np.unique(triangles)]


def block(text, name):
    count, start = re.search(rf"^{name}=(\d+)\n", text, re.MULTILINE | re.IGNORECASE), 0
    start = count.end()
    lines = text[start:].split("\n", int(count[1]))[:int(count[1])]
    return np.array([[float(word) for word in line.split(";")] for line in lines])


class Jigsaw(tool.Tool):
    needs = "the command jigsaw"

    def __init__(self, name, sweeps):
        self.name = f"JIGSAW, {name}"
        self.setting = f"delfront, OPTM_ITER {sweeps}"
        self.sweeps = sweeps

    def available(self):
        return bool(tool.command("jigsaw"))

    def version(self):
        # JIGSAW prints its version only in a run, before it reads the files.
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "none.jig").write_text("GEOM_FILE = none\nMESH_FILE = none\n"
                                                   "VERBOSITY = 1\n")
            said = tool.answer_of("jigsaw", Path(folder) / "none.jig", any_status=True)
        if "JIGSAW" not in said:
            raise tool.DoesNotStart(tool.last_line(said))
        told = re.search(r"JIGSAW VERSION ([\d.]+)", said)
        return told[1] if told else "unknown version"

    def mesh(self, case, dimension, geometry, spacing_grid, folder, time_limit):
        """Runs JIGSAW and returns the measured resources. The mesh is in nodes.msh."""
        (folder / "domain.msh").write_text(geometry)
        settings = {"GEOM_FILE": "domain.msh", "MESH_FILE": "nodes.msh", "MESH_DIMS": dimension,
                    "GEOM_FEAT": "TRUE", "MESH_TOP1": "TRUE", "HFUN_SCAL": "ABSOLUTE",
                    "OPTM_ITER": self.sweeps, "NUMTHREAD": 1, "VERBOSITY": 1}
        if case.slope == 0:
            settings["HFUN_HMAX"] = repr(case.constant)
            settings["HFUN_HMIN"] = repr(case.constant)
        else:
            (folder / "spacing.msh").write_text(spacing_grid(case))
            settings["HFUN_FILE"] = "spacing.msh"
            # Only the file's values apply.
            settings["HFUN_HMAX"] = repr(float(1e6 * case.constant))
            settings["HFUN_HMIN"] = 0
        (folder / "case.jig").write_text(
            "".join(f"{key} = {value}\n" for key, value in settings.items()))
        return measure(["jigsaw", "case.jig"], folder, time_limit)

    def run(self, case, folder, time_limit):
        used = self.mesh(case, 2, geometry(case.domain), spacing_grid, folder, time_limit)
        return tool.Outcome(read_points(folder / "nodes.msh"), used.seconds,
                            seconds_without_files(used.stdout), used.peak_bytes)


def seconds_without_files(text):
    """Returns the sum of the times in the log, which has a line "Done. (1.0e-02sec)" for each part,
    without those of files."""
    parts = re.split(r"^\s*(?:#-+|(?=(?:Reading|Writing) ))", text, flags=re.MULTILINE)
    times = [float(told) for part in parts if not re.match(r"\s*(Reading|Writing) ", part)
             for told in re.findall(r"Done\.\s+\(([\d.e+-]+)sec\)", part)]
    return sum(times) if times else None


def tools():
    return [Jigsaw("unoptimised", 0), Jigsaw("default", 16)]
