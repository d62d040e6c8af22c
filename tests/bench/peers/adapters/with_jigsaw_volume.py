# SPDX-License-Identifier: BSD-3-Clause
"""JIGSAW in space, by its command. Bodies are given by triangles, the spacing on a grid."""
import numpy as np
from adapters import tool
from adapters.with_jigsaw import Jigsaw, block, seconds_without_files

GRID = 41  # points per side; JIGSAW interpolates the spacing linearly between them


def geometry(body):
    lines = ["mshid=1", "ndims=3", f"point={len(body.vertices)}"]
    lines += [f"{x!r};{y!r};{z!r};0" for x, y, z in body.vertices.tolist()]
    triangles = body.triangles().tolist()
    lines.append(f"tria3={len(triangles)}")
    lines += [f"{a};{b};{c};0" for a, b, c in triangles]
    return "\n".join(lines) + "\n"


def spacing_grid(case):
    lines = ["mshid=3;euclidean-grid", "ndims=3"]
    axes = [np.linspace(a, b, GRID) for a, b in zip(*case.body.bounds())]
    for axis, values in enumerate(axes, 1):
        lines.append(f"coord={axis};{GRID}")
        lines += [repr(v) for v in values.tolist()]
    # The second coordinate varies fastest, then the first, then the third.
    z, x, y = np.meshgrid(axes[2], axes[0], axes[1], indexing="ij")
    values = case.spacing(np.column_stack([x.ravel(), y.ravel(), z.ravel()]))
    lines.append(f"value={len(values)};1")
    lines += [repr(v) for v in values.tolist()]
    return "\n".join(lines) + "\n"


class JigsawInSpace(Jigsaw):
    def run(self, case, folder, time_limit):
        used = self.mesh(case, 3, geometry(case.body), spacing_grid, folder, time_limit)
        text = (folder / "nodes.msh").read_text()
        return tool.VolumeOutcome(block(text, "point")[:, :3],
                                  block(text, "tria4")[:, :4].astype(int), used,
                                  seconds_without_files(used.stdout))


def tools():
    return [JigsawInSpace("default", 16)]
