# SPDX-License-Identifier: BSD-3-Clause
"""The table of cases in space and the definition of its columns."""
from page import told
from tables import grouped

HEADING = "Comparison with other tools in space"
TITLES = ["tool", "nodes", "s", "CPU s", "s without start and files", "nodes per CPU s", "MB",
          "quality: mean / 99 % above / least", "least dihedral angle", "below 20°", "below 10°",
          "edge over d", "by octaves of d", "boundary triangles: mean / least angle", "covered",
          "nodes alone: quality: mean / 99 % above / least", "below 20°, 10°"]
SHORT = ["tool", "nodes", "s", "CPU s", "s inner", "nodes/CPU s", "MB", "mean / 99 % / least", "angle",
         "<20°", "<10°", "edge/d", "octaves", "triangles", "covered", "nodes alone", "<20°, 10°"]


def cells(result):
    m, alone = result["measures"], result["measures"]["delaunay"]
    octaves = m["edge_octaves"]
    return [grouped(m["nodes"]), f"{result['seconds']:.2f}", f"{result['cpu_seconds']:.2f}",
            told(result["inner_seconds"], 2), grouped(m["nodes"] / result["cpu_seconds"]),
            f"{result['peak_bytes'] / 1e6:.0f}", quality(m), f"{m['angle_least']:.1f}°", share(m, "below_20"), share(m, "below_10"),
            f"{m['edge_mean']:.3f} ± {m['edge_deviation']:.3f}",
            f"{min(octaves):.3f} to {max(octaves):.3f}" if octaves else "-",
            f"{m['triangle_quality_mean']:.3f} / {m['triangle_angle_least']:.1f}°",
            f"{m['covered']:.4f}", quality(alone),
            f"{share(alone, 'below_20')}, {share(alone, 'below_10')}"]


def quality(m):
    return f"{m['quality_mean']:.3f} / {m['quality_one_percent']:.3f} / {m['quality_least']:.3f}"


def share(m, what):
    """Returns a small number as it is and others in percent."""
    percent = 100 * m[what] / m["tetrahedra"]
    return grouped(m[what]) if percent < 0.01 else f"{percent:.2f} %"


HOW = """What the columns say:

- Every tool gets the same body and the same d, and runs as a process of its own with one thread;
  seconds, CPU seconds and the peak of its memory are the system's count of that process, start and
  files included. Python packages carry their interpreter in all three. CPU seconds hardly depend on
  what else the machine does, and the speed is of these. Where a tool tells its own time, that is the
  column between.
- Boxes and balls are the tools' own where they have such; TetGen and JIGSAW take a ball as triangles
  of side d. Asteroids are triangles for all: TetGen keeps them as they are, the others make theirs
  by d. A grid has d for JIGSAW, points with a size each have it for Netgen, TetGen gets a largest
  volume for each tetrahedron until hardly one is too large.
- The tetrahedra of a tool are judged as it gives them. Then its nodes alone: SciPy's Delaunay
  triangulation (Qhull) of them, less the tetrahedra with their centroid outside the body and flat
  ones of four boundary nodes that lie open to the outside. "Covered" is the volume of the tool's
  tetrahedra over that of the body.
- Quality is 3 r_in / R, 1 for a regular tetrahedron. Below 20° and 10° are the tetrahedra whose
  least dihedral angle is: their number, or their share of all where that is 0.01 % or more.
- Edge over d: mean and deviation over all edges, of the length over the mean of d at the ends.
  Tools that mean something else by size, such as an upper bound, were given a factor, told above,
  so that about the same number of nodes comes out.
- By octaves of d: the least and the largest mean of edge over d in a range of a factor 2 of d, from
  the least d on, of 100 edges or more with an end inside.
- Boundary triangles: mean of the quality 2 r_in / R, and the least angle.
"""
