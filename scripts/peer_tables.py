#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes README.md's tables of all cases against every other tool, between two comments, from the pages
of the comparisons in the plane and in space. The test docs_peers compares them.
usage: peer_tables.py [<folder of the sources>]"""

import pathlib
import re
import sys

PAGES = {"docs/comparison.md": "nodes/s", "docs/comparison_volumes.md": "nodes per CPU s"}
BEGIN, END = "<!-- peer tables: written by scripts/peer_tables.py -->", "<!-- end of the peer tables -->"
QUALITY = "quality: mean / 99 % above / least"
# Each tool as the pages name it, in the plane or in space.
COLUMNS = {
    "PNPBS": ("PNPBS, default",),
    "gmsh": ("gmsh, frontal", "gmsh, Delaunay"),
    "gmsh HXT": ("gmsh, HXT",),
    "CGAL": ("CGAL, Delaunay refinement",),
    "Triangle": ("Triangle, by triangle",),
    "TetGen": ("TetGen",),
    "Netgen": ("Netgen",),
    "JIGSAW": ("JIGSAW, default",),
}
# The cases as the headings of the pages name them, without "d for 100 000 nodes".
CASES = {
    "Unit square, d growing by 0.2 from a line": "square, from a line",
    "Unit square, d graded 1:10": "square, 1:10",
    "Box, d growing by 0.15 from an airfoil": "airfoil",
    "Great Lakes with 109 islands, graded": "Great Lakes",
    "Unit square, uniform": "square, even",
    "Annulus, uniform": "annulus, even",
    "Unit cube, uniform": "cube, even",
    "Unit cube, d graded 1:5": "cube, 1:5",
    "Ball, uniform": "ball, even",
    "L-block, uniform": "L-block, even",
    "Asteroid Kleopatra, uniform": "Kleopatra, even",
    "Asteroid Eros, uniform": "Eros, even",
}


class Unknown(Exception):
    """A page has something that has no place here, or lacks what has; tells what."""


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def tables(text):
    """By case, its rows by tool, each by title."""
    found, case, titles = {}, None, None
    for line in text.splitlines():
        if line.startswith("## "):
            heading = re.fullmatch(r"## (.*), d for [\d ]+ nodes", line)
            case, titles = heading[1] if heading else None, None
        elif case and line.startswith("|") and titles is None:
            titles = cells(line)
        elif case and line.startswith("|") and not line.startswith("| ---"):
            row = dict(zip(titles, cells(line)))
            found.setdefault(case, {})[row[titles[0]]] = row
    return found


def figures(row, speed):
    """Mean and 1 % of the quality, and thousand nodes a second; None for a tool that failed."""
    if not row.get(QUALITY):
        return None
    mean, one_percent = row[QUALITY].split(" / ")[:2]
    return float(mean), float(one_percent), float(row[speed].replace(" ", "")) / 1000


def lines_of(root):
    """By case and column, its figures, or None; a column that a page does not have is not there."""
    found = {}
    for page, speed in PAGES.items():
        on_page = tables((root / page).read_text(encoding="utf-8"))
        if not on_page:
            raise Unknown(f"{page} has no table of a case")
        for case, rows in on_page.items():
            if case not in CASES:
                raise Unknown(f"{page}: no name for the case '{case}'")
            found[CASES[case]] = {
                column: figures(rows[name], speed)
                for column, names in COLUMNS.items()
                for name in [name for name in names if name in rows][:1]}
            if "PNPBS" not in found[CASES[case]]:
                raise Unknown(f"{page}: no row of {COLUMNS['PNPBS'][0]} for '{case}'")
    missing = [name for name in CASES.values() if name not in found]
    if missing:
        raise Unknown(f"no page has the case '{missing[0]}'")
    return found


def table(title, found, key, shown):
    """A row for each case; the best figure is bold."""
    rows = ["| " + " | ".join([title, *COLUMNS]) + " |", "| --- |" + " --- |" * len(COLUMNS)]
    for case, tools in found.items():
        best = max(key(one) for one in tools.values() if one)
        row = [case]
        for column in COLUMNS:
            if column not in tools:
                row.append("")
            elif tools[column] is None:
                row.append("failed")
            else:
                text = shown(tools[column])
                row.append(f"**{text}**" if key(tools[column]) == best else text)
        rows.append("| " + " | ".join(row) + " |")
    return rows


def block(root):
    found = lines_of(root)
    quality = table("quality: mean (1 %)", found, lambda one: round(one[0], 3),
                    lambda one: f"{one[0]:.3f} ({one[1]:.2f})")
    speed = table("thousand nodes a second", found, lambda one: round(one[2], 1),
                  lambda one: f"{one[2]:.0f}" if one[2] >= 10 else f"{one[2]:.1f}")
    return "\n".join([BEGIN, "", *quality, "", *speed, "", END])


def parts(text):
    """What is before, between and behind the two comments, these included in the middle."""
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise Unknown(f"README.md must have '{BEGIN}' and '{END}' once each, in this order")
    end = text.index(END) + len(END)
    return text[:text.index(BEGIN)], text[text.index(BEGIN):end], text[end:]


def main(arguments):
    root = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).resolve().parents[1]
    readme = root / "README.md"
    before, _, behind = parts(readme.read_text(encoding="utf-8"))
    readme.write_text(before + block(root) + behind, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
