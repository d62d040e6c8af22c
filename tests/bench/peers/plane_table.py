# SPDX-License-Identifier: BSD-3-Clause
"""The table of cases in the plane and the definition of its columns."""
from page import speed, told
from tables import grouped

HEADING = "Comparison with other tools"
TITLES = ["tool", "nodes", "s", "s without start and files", "nodes/s", "MB",
          "quality: mean / 99 % above / least", "least where wide", "least angle where wide",
          "edge over d", "by bands of d", "nearest over d, deviation", "cell radius over nearest, 99 % below",
          "crossing", "covered"]
SHORT = ["tool", "nodes", "s", "s inner", "nodes/s", "MB", "mean / 99 % / least", "wide", "angle",
         "edge/d", "bands", "nn/d", "cell", "cross", "covered"]


def cells(result):
    m = result["measures"]
    quality = f"{m['quality_mean']:.4f} / {m['quality_one_percent']:.4f} / {m['quality_least']:.4f}"
    speed_told = grouped(speed(result)) + ("" if result["inner_seconds"] else " *")
    angle = told(m["wide_angle_least"], 1)
    return [grouped(m["nodes"]), f"{result['seconds']:.2f}",
            told(result["inner_seconds"], 2), speed_told, f"{result['peak_bytes'] / 1e6:.0f}",
            quality, told(m["wide_quality_least"], 4), angle if angle == "-" else angle + "°",
            f"{m['edge_mean']:.4f} ± {m['edge_deviation']:.4f}",
            f"{min(m['edge_bands']):.3f} to {max(m['edge_bands']):.3f}",
            f"{m['nearest_deviation']:.4f}",
            told(m["cell_99_percent"], 3), grouped(m["crossing"]), f"{m['covered']:.5f}"]


HOW = """What the columns say:

- Every tool gets the same domain and the same d, and runs as a process of its own with one thread;
  seconds and the peak of its memory are the system's count of that process, start and files
  included. Python packages carry their interpreter in both. Where a tool tells its own time, that
  is the next column, and the speed is of that one; else the speed is marked *.
- Around the airfoil no formula has d. CGAL, Triangle and JIGSAW get a table whose lines are dense
  around it, off d by 5 % at most; gmsh a distance field, d at most 2 % too large; PNPBS that table
  on the even grid that its command takes, off by 15 % at the trailing edge and by less than 2 % for
  99 % of the nodes. The evaluator has d exactly.
- The nodes, and nothing else that the tool says, go to one evaluator: SciPy's Delaunay
  triangulation (Qhull), less the triangles with their centroid outside the domain. "Covered" is the
  area of these over that of the domain; 1 where the nodes resolve the boundary. "Crossing" counts
  those that lie across the boundary: nodes on both sides of a thin strip of land see each other
  there, and who needs triangles would have them constrained to the boundary.
- Quality is 2 r_in / R, 1 for an equilateral triangle. "Where wide" leaves out what no node set can
  mend, or need not: those crossing and their neighbours, triangles at a boundary edge shorter than
  0.7 d, and those through whose centroid some chord of the domain is shorter than 3 d.
- Edge over d: mean and deviation of the edges over the mean of d at their ends. Tools that mean
  something else by size, such as an upper bound, were given a factor, told above, so that about the
  same number of nodes comes out.
- By bands of d: the least and the largest mean of edge over d in eight bands, equal in log d, of
  100 edges or more.
- Nearest over d: deviation of the distance to the nearest node. Cell radius over nearest: how far
  the farthest point of a node's Voronoi cell is, over the distance to its nearest node, for the
  nodes that are not on the boundary; 0.577 in a hexagonal lattice.
"""
