# SPDX-License-Identifier: BSD-3-Clause
"""The page of compare.py, with the median and the worst value of each figure over the bodies."""
import numpy as np
from tables import grouped, table_head, table_row

TITLES = ["tool", "whole", "torn", "nothing", "torn in silence", "nodes", "CPU ms per node",
          "least dihedral angle away from sharp edges", "at sharp edges", "quality: mean", "99 % above",
          "volume too large or small, %", "body to boundary, over d", "boundary to body, over d"]

HOW = """What the columns say:

- Every tool gets the same triangles and the same d, in a process of its own with one thread. CPU time is the
  system's count for that process, start and files included. gmsh, whose volumes have one outer surface each, has a
  process for each solid of a body.
- Whole is a body whose tetrahedra have two boundary triangles at each edge, one fan of them around each
  node, the Euler characteristic and the number of closed surfaces of the input, no tetrahedron turned over, and, in
  PNPBS, no node in no tetrahedron. All others that a tool wrote are torn. "Nothing" is a crash, an
  error, or no end within the time limit.
- "In silence" counts those that are torn though the tool's exit code is 0, 3 or 4 (PNPBS) or 0 (others).
- The figures are of all bodies for which the tool wrote tetrahedra, whole or torn: the median over these bodies,
  and after the slash the worst. Quality is 3 r_in / R, 1 for a regular tetrahedron.
- Sharp edges are those where the sheets of the input meet at less than 33 degrees inside the body; a
  tetrahedron is at one if a corner of it is within d. Of the least angles there the table has the worst alone.
- The volume is that of the tetrahedra beside that enclosed by the input's triangles. Chords of round surfaces make it
  smaller; "-" where an older run has not measured it.
- The distance from body to boundary is the farthest that a point of the input's triangles is from the triangles of
  the tetrahedra's boundary, by points d / 10 apart on both; the other way it is from these to the input. Where
  both are the same surface, such points leave some 0.15.
"""


def middle_and_worst(runs, name, worst, digits):
    values = [run[name] for run in runs if run.get(name) is not None]
    return f"{np.median(values):.{digits}f} / {worst(values):.{digits}f}" if values else "-"


def volume_error(run):
    """In percent of the body; none of runs that have not measured it."""
    if "volume" not in run:
        return {}
    return {"percent": 100 * abs(run["volume"] / run["volume_of_body"] - 1)}


def is_silent(run):
    return not run["whole"] and run["exit_code"] != 6


def row(tool, runs):
    done = [run for run in runs if "failed" not in run]
    whole = sum(run["whole"] for run in done)
    sharp = [run["least_angle_at_sharp_edges"] for run in done
             if run["least_angle_at_sharp_edges"] is not None]
    per_node = [{"ms": 1000 * run["cpu_seconds"] / run["nodes"]} for run in done]
    return [tool, whole, len(done) - whole, len(runs) - len(done), sum(map(is_silent, done)),
            grouped(sum(run["nodes"] for run in done)), middle_and_worst(per_node, "ms", max, 2),
            middle_and_worst(done, "least_angle_elsewhere", min, 2), f"{min(sharp):.2f}" if sharp else "-",
            middle_and_worst(done, "quality_mean", min, 3), middle_and_worst(done, "quality_one_percent", min, 3),
            middle_and_worst(list(map(volume_error, done)), "percent", max, 2),
            middle_and_worst(done, "from_body", max, 2), middle_and_worst(done, "to_body", max, 2)]


def state(run):
    if "failed" in run:
        return f"nothing: {run['failed'][:60]}"
    if run["whole"]:
        return "whole"
    what = [f"{run[name]} {words}" for name, words in
            (("torn_edges", "torn edges"), ("torn_nodes", "torn nodes"), ("isolated", "isolated"),
             ("turned_over", "turned over")) if run[name]]
    for name, words in (("pieces", "surfaces"), ("euler", "Euler")):
        if run[name] != run[name + "_of_body"]:
            what.append(f"{words} {run[name]} for {run[name + '_of_body']}")
    return "torn: " + ", ".join(what)


def intact(run):
    return "failed" not in run and run["whole"]


def bodies_lost(results):
    """Returns a row for each body for which some tool gives an incomplete result."""
    names = [tool["name"] for tool in results["tools"]]
    by_body = {}
    for run in results["runs"]:
        by_body.setdefault(run["body"], {})[run["tool"]] = run
    return names, [[body, *(state(runs[name]) for name in names)] for body, runs in by_body.items()
                   if not all(map(intact, runs.values()))]


def refused(results):
    """Returns the bodies that our command rejects, mostly because of crossing triangles."""
    return sorted(run["body"] for run in results["runs"] if run["tool"].startswith("PNPBS")
                  and run.get("failed", "").startswith("status 2:"))


def page(results):
    m, count = results["machine"], len({run["body"] for run in results["runs"]})
    lines = ["# Comparison with other tools on bodies", "",
             f"{count} bodies, d for {grouped(results['asked'])} nodes in each. {m['date']}, one thread of an "
             f"{m['processor']}, {m['cores']} cores, {m['memory_gib']} GiB; {m['system']}; load before the first run "
             f"{m['load']}. {results['note']} Made by", "", "```sh", results["command"], "```", "",
             *table_head(["tool", "version", "told"]),
             *(table_row([tool["name"], tool["version"], tool["setting"]]) for tool in results["tools"]), ""]
    lines += [f"Left out: {tool['name']}, {tool['why']}" for tool in results["left_out"]]
    if results["no_bodies"]:
        lines += [f"Left out as no closed surface: {', '.join(results['no_bodies'])}.", ""]
    lines += [HOW, *table_head(TITLES)]
    lines += [table_row(row(tool["name"], [run for run in results["runs"] if run["tool"] == tool["name"]]))
              for tool in results["tools"]]
    if refused(results):
        lines += ["", f"PNPBS refuses {len(refused(results))} files, with a message that names the place, as their triangles "
                  f"cross or touch each other: {', '.join(refused(results))}. They are among its \"nothing\"."]
    names, lost = bodies_lost(results)
    lines += ["", "## Bodies that some tool lost", "", *table_head(["body", *names]), *map(table_row, lost), ""]
    return "\n".join(lines)
