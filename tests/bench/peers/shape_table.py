# SPDX-License-Identifier: BSD-3-Clause
"""The tables of spacing from the shape and the definition of their columns."""
from page import told
from tables import grouped

HEADING = "Spacing from the shape: comparison with other tools"


class Followed:
    """The table of cases with a prescribed d."""
    TITLES = ["tool", "nodes", "CPU s", "CPU s for the sizes", "CPU s at one d", "edge over d",
              "1 % to 99 %", "by bands of d", "on the boundary", "inside", "farthest off, at"]
    SHORT = ["tool", "nodes", "CPU s", "sizes", "one d", "edge/d", "1 % to 99 %", "bands", "boundary",
             "inside", "worst at"]

    @staticmethod
    def cells(result):
        m = result["measures"]
        place = ", ".join(f"{x:.4g}" for x in m["worst_at"])
        bands = f"{min(m['edge_bands']):.3f} to {max(m['edge_bands']):.3f}" if m["edge_bands"] else "-"
        return [*spent(result), spread(m, "edge"),
                f"{m['edge_one_percent']:.2f} to {m['edge_99_percent']:.2f}", bands,
                spread(m, "boundary"), spread(m, "inside"), f"{m['worst']:.2f} at ({place})"]


class Automatic:
    """The table of cases with the tool's own sizes."""
    TITLES = ["tool", "nodes", "CPU s", "CPU s for the sizes", "CPU s at one d",
              "least, mean and largest size", "growth, 99 % below", "nodes per turn: 5 % below, median",
              "at", "sizes across gaps: 5 % below, median", "gaps"]
    SHORT = ["tool", "nodes", "CPU s", "sizes", "one d", "size", "growth", "per turn", "at", "across",
             "gaps"]

    @staticmethod
    def cells(result):
        m = result["measures"]
        return [*spent(result), f"{m['size_least']:.3g}, {m['size_mean']:.3g}, {m['size_largest']:.3g}",
                f"{m['growth_99_percent']:.2f}", pair(m["per_turn"], 0), grouped(m["curved"]),
                pair(m["across"], 1), grouped(m["gaps"])]


def of(case):
    return Automatic if case.startswith("auto-") else Followed


def spent(result):
    m = result["measures"]
    even = result["even_seconds"] * m["nodes"] / result["even_points"]
    return [grouped(m["nodes"]), f"{result['cpu_seconds']:.2f}", told(result["field_seconds"], 2),
            f"{even:.2f}"]


def spread(m, what):
    return f"{told(m[what + '_mean'], 3)} ± {told(m[what + '_deviation'], 3)}"


def pair(values, digits):
    return ", ".join(told(v, digits) for v in values) if values else "-"


HOW = """What the columns say:

- Every tool gets the same shape, and runs as processes of its own with one thread. CPU seconds are
  what the system gave them, start and files included: they hardly depend on what else the machine
  does, as long as it leaves them their share of the caches.
- For the sizes: where a tool makes them in a step of their own. Of PNPBS it is `--dry-run`, which
  makes the tree of d and counts the nodes; of JIGSAW it is its command marche, and SciPy's work for
  the sizes it starts from, which is not in the CPU seconds of the whole. gmsh has no such step: it asks its
  fields as it goes. "At one d" is the same tool on the same shape with one d for about as many nodes,
  scaled to as many: what is spent beyond that goes to the sizes, and to grading itself.
- Prescribed is d = min(largest, least + slope * distance from the boundary), the largest eight times
  the least; from the airfoil alone in the box. PNPBS has it as a formula with `dist`, gmsh as the
  fields Distance (from samples) and Threshold, JIGSAW as exact values at grid points beside the
  boundary, whose growth marche limits to the slope. The evaluator has the distance from the segments
  and triangles themselves.
- In the plane PNPBS and gmsh have a node at every vertex of the input, so that where the input is finer
  than d, edges are too short; JIGSAW has one at sharp corners, and refines where the boundary would touch
  itself (MESH_TOP1).
- In space gmsh is told 0.79 of d, so that about as many nodes come out: its edges inside are longer than
  its size, those on the boundary are not, and so come out at 0.78 there. Part of its deviation is this.
- Sizes by the tool itself have bounds alone: the largest for a fifth of the nodes asked, and a
  hundredth of it. PNPBS: `--spacing auto`, of 20 nodes per turn, 3 across a gap and the input's own
  segments the least. gmsh: 20 elements per turn, of straight lines none, so that it gets the airfoil as
  splines, and no wish about gaps; inside it continues the sizes of the boundary. JIGSAW: 2 pi / 20 of
  the local feature size (distance from the medial axis, by poles of Voronoi cells), by SciPy, as no
  command of JIGSAW has it; no less than a twentieth of the largest d, in space a quarter.
- The nodes, and nothing else, go to one evaluator: SciPy's Delaunay triangulation (Qhull) inside the
  domain. Edge over d: of the length over the mean of d at the ends; on the boundary, where both ends
  lie there. By bands: the least and the largest mean in eight bands, equal in log d, of 100 edges or
  more. Farthest off: the edge whose length over d is, by ratio, and its middle; narrow places and short
  segments of the input make some edges short whatever the tool, and in space some long edges are those
  of flat tetrahedra over dips of the surface, which the triangulation is not forced to follow.
- A node's size is the mean length of its edges; growth the difference of sizes over the length of the
  edge between. Nodes per turn: the circumference of the circle of curvature over the size, of nodes
  on the boundary where 20 per turn ask for less than the largest d; curvature is how much neighbouring
  segments or triangles of the input turn, up to 40 degrees. Sizes across gaps: the way along the
  inward normal from the middle of a segment or triangle to the facing side (within 20 degrees), over
  the size of the node next to the middle of that way; of ways below three times the largest d.
"""
