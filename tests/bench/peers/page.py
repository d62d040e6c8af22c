# SPDX-License-Identifier: BSD-3-Clause
"""The results as tables for the terminal and as a page in Markdown. A `table` defines the columns:
plane_table, volume_table, or shape_table, which has a different table for each kind of case."""
from tables import grouped, table_head, table_row


def speed(result):
    """Returns nodes per second, without start and files if the tool reports this time."""
    return result["measures"]["nodes"] / (result["inner_seconds"] or result["seconds"])


def told(value, digits):
    return "-" if value is None else f"{value:.{digits}f}"


def row(result, table):
    if result.get("failed"):
        return [result["tool"], f"failed: {result['failed']}"] + [""] * (len(table.TITLES) - 2)
    return [result["tool"], *table.cells(result)]


def part(table, group):
    """Returns the table of these cases."""
    return table.of(group[0]["case"]) if hasattr(table, "of") else table


def groups(results):
    """Returns the results by case and size, in the order of the runs."""
    found = {}
    for result in results["placements"]:
        found.setdefault((result["case"], result["asked"]), []).append(result)
    return found


def title(result):
    return f"{result['case_title']}, d for {grouped(result['asked'])} nodes"


def text_tables(results, table):
    lines = []
    for group in groups(results).values():
        columns = part(table, group)
        rows = [columns.SHORT, *(row(result, columns) for result in group)]
        widths = [max(len(r[i]) for r in rows if not r[1].startswith("failed"))
                  for i in range(len(columns.TITLES))]
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


def markdown(results, pictures, table):
    lines = [f"# {table.HEADING}", "", *machine_lines(results), "", table.HOW]
    if "quality_speed" in pictures:
        lines += [f"![quality against speed]({pictures['quality_speed']})", ""]
    for group in groups(results).values():
        lines += [f"## {title(group[0])[0].upper()}{title(group[0])[1:]}", "",
                  *table_head(part(table, group).TITLES)]
        lines += [table_row(row(result, part(table, group))) for result in group] + [""]
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
