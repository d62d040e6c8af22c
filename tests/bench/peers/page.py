# SPDX-License-Identifier: BSD-3-Clause
"""The results as tables: for the terminal and as a page in Markdown."""
from tables import grouped, table_head, table_row

TITLES = ["tool", "nodes", "s", "s without start and files", "nodes/s", "MB",
          "quality: mean / 99 % above / least", "least where wide", "least angle where wide",
          "edge over d", "by bands of d", "nearest over d, deviation", "cell radius over nearest, 99 % below",
          "crossing", "covered"]


def speed(result):
    """Nodes per second, without start and files where the tool tells it."""
    return result["measures"]["nodes"] / (result["inner_seconds"] or result["seconds"])


def told(value, digits):
    return "-" if value is None else f"{value:.{digits}f}"


def row(result):
    name = result["tool"]
    if result.get("failed"):
        return [name, f"failed: {result['failed']}"] + [""] * (len(TITLES) - 2)
    m = result["measures"]
    quality = f"{m['quality_mean']:.4f} / {m['quality_one_percent']:.4f} / {m['quality_least']:.4f}"
    speed_told = grouped(speed(result)) + ("" if result["inner_seconds"] else " *")
    angle = told(m["wide_angle_least"], 1)
    return [name, grouped(m["nodes"]), f"{result['seconds']:.2f}",
            told(result["inner_seconds"], 2), speed_told, f"{result['peak_bytes'] / 1e6:.0f}",
            quality, told(m["wide_quality_least"], 4), angle if angle == "-" else angle + "°",
            f"{m['edge_mean']:.4f} ± {m['edge_deviation']:.4f}",
            f"{min(m['edge_bands']):.3f} to {max(m['edge_bands']):.3f}",
            f"{m['nearest_deviation']:.4f}",
            told(m["cell_99_percent"], 3), grouped(m["crossing"]), f"{m['covered']:.5f}"]


def groups(results):
    """By case and size, in the order they were run."""
    found = {}
    for result in results["placements"]:
        found.setdefault((result["case"], result["asked"]), []).append(result)
    return found


def title(result):
    return f"{result['case_title']}, d for {grouped(result['asked'])} nodes"


def text_tables(results):
    lines = []
    for group in groups(results).values():
        rows = [["tool", "nodes", "s", "s inner", "nodes/s", "MB", "mean / 99 % / least", "wide",
                 "angle", "edge/d", "bands", "nn/d", "cell", "cross", "covered"]]
        rows += [row(result) for result in group]
        widths = [max(len(r[i]) for r in rows if not r[1].startswith("failed"))
                  for i in range(len(TITLES))]
        lines += ["", title(group[0])]
        for cells in rows:
            lines.append("  ".join([cells[0].ljust(widths[0])] + [
                cell.rjust(width) for cell, width in zip(cells[1:], widths[1:])]).rstrip())
    if results["forces"]:
        lines += ["", "force evaluation"]
        lines += [f"{r['tool']:20s} {grouped(r['nodes']):>9s} nodes, {r['listed']:.1f} listed, "
                  f"{r['nanoseconds']:.1f} ns per node and step: {r['what']}"
                  for r in results["forces"]]
    return "\n".join(lines)


def machine_lines(results):
    m = results["machine"]
    lines = [f"{m['date']}, one thread of an {m['processor']}, {m['cores']} cores, "
             f"{m['memory_gib']} GiB; {m['system']}; load before the first run {m['load']}; "
             f"Python {m['python']}, NumPy {m['numpy']}, SciPy {m['scipy']}. "
             f"Times and memory are medians of {results['repeat']}. Made by", "",
             "```sh", results["command"], "```", ""]
    lines += table_head(["tool", "version", "told"])
    lines += [table_row([t["name"], t["version"], t["setting"]]) for t in results["tools"]]
    if results["left_out"]:
        lines += ["", "Left out:", ""]
        lines += [f"- {t['name']}: {t['why']}" for t in results["left_out"]]
    return lines


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


def markdown(results, pictures):
    lines = ["# Comparison with other tools", "", *machine_lines(results), "", HOW]
    if "quality_speed" in pictures:
        lines += [f"![quality against speed]({pictures['quality_speed']})", ""]
    for group in groups(results).values():
        lines += [f"## {title(group[0])[0].upper()}{title(group[0])[1:]}", "",
                  *table_head(TITLES)]
        lines += [table_row(row(result)) for result in group] + [""]
    if "histogram" in pictures:
        lines += [f"![histogram of quality]({pictures['histogram']})", ""]
    if results["forces"]:
        lines += ["## Force evaluation", "",
                  "A hexagonal lattice for LAMMPS, our own run on the uniform square for us; lists "
                  "to 1.6 spacings, made by each for its own nodes; one thread.", "",
                  *table_head(["tool", "nodes", "listed neighbours", "ns per node and step", "of"])]
        lines += [table_row([r["tool"], grouped(r["nodes"]), f"{r['listed']:.1f}",
                                f"{r['nanoseconds']:.1f}", r["what"]])
                  for r in results["forces"]] + [""]
    return "\n".join(lines)
