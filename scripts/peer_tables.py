#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the tables of all cases against every other tool into docs/comparison_summary.md, between two comments,
from the pages of the comparisons in the plane and in space. The test docs_peers compares them.
usage: peer_tables.py [<folder of the sources>]"""

import pathlib
import re
import sys
from typing import NamedTuple

SUMMARY = "docs/comparison_summary.md"
BEGIN, END = "<!-- peer tables: written by scripts/peer_tables.py -->", "<!-- end of the peer tables -->"
QUALITY = "quality: mean / 99 % above / least"


class Page(NamedTuple):
    """The part of a page that the tables show: the names of its columns, and the tool for each
    column of the tables."""
    where: str
    speed: str
    unit: str
    least: str  # smallest quality of all triangles, or of those where the domain is wide
    tools: dict
    cases: dict  # as in the headings, without "d for 100 000 nodes"


PAGES = {
    "docs/comparison.md": Page(
        "plane", "nodes/s", "thousand nodes a second", "least where wide",
        {"PNPBS": "PNPBS, default",
         "PNPBS, best": "PNPBS, best",
         "gmsh": "gmsh, frontal",
         "CGAL": "CGAL, Delaunay refinement",
         "Triangle": "Triangle, by triangle",
         "JIGSAW": "JIGSAW, default"},
        {"Unit square, uniform": "square, even",
         "Unit square, d graded 1:10": "square, 1:10",
         "Unit square, d growing by 0.2 from a line": "square, from a line",
         "Box, d growing by 0.15 from an airfoil": "airfoil",
         "Annulus, uniform": "annulus, even",
         "Great Lakes with 109 islands, graded": "Great Lakes"}),
    "docs/comparison_volumes.md": Page(
        "space", "nodes per CPU s", "thousand nodes a CPU second", QUALITY,
        {"PNPBS": "PNPBS, default",
         "gmsh": "gmsh, Delaunay",
         "gmsh HXT": "gmsh, HXT",
         "TetGen": "TetGen",
         "Netgen": "Netgen",
         "JIGSAW": "JIGSAW, default"},
        {"Unit cube, uniform": "cube, even",
         "Unit cube, d graded 1:5": "cube, 1:5",
         "Ball, uniform": "ball, even",
         "L-block, uniform": "L-block, even",
         "Asteroid Kleopatra, uniform": "Kleopatra, even",
         "Asteroid Eros, uniform": "Eros, even"}),
}


class Unknown(Exception):
    """A page has an unknown entry or lacks a required one. The message names it."""


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def tables(text):
    """Returns the rows of each case by tool, each as a dictionary by column title."""
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


def figures(row, page):
    """Returns the numbers of the tables: mean, 1 % and smallest quality, and thousand nodes per
    second. None for a tool that failed."""
    if not row.get(QUALITY):
        return None
    mean, one_percent = row[QUALITY].split(" / ")[:2]
    speed = float(row[page.speed].rstrip(" *").replace(" ", "")) / 1000
    return ([mean, one_percent, row[page.least].split(" / ")[-1]],
            [f"{speed:.0f}" if speed >= 10 else f"{speed:.1f}"])


def value(text):
    return 0 if text == "-" else float(text)  # no triangle where the domain is wide


def lines_of(root, name, page):
    """Returns the figures by case and column, or None for a failed tool. Tools that the page does
    not contain are left out."""
    on_page = tables((root / name).read_text(encoding="utf-8"))
    if not on_page:
        raise Unknown(f"{name} has no table of a case")
    found = {}
    for case, rows in on_page.items():
        if case not in page.cases:
            raise Unknown(f"{name}: no name for the case '{case}'")
        if page.tools["PNPBS"] not in rows:
            raise Unknown(f"{name}: no row of {page.tools['PNPBS']} for '{case}'")
        found[page.cases[case]] = {column: figures(rows[tool], page)
                                   for column, tool in page.tools.items() if tool in rows}
    missing = [case for case in page.cases.values() if case not in found]
    if missing:
        raise Unknown(f"{name} does not have the case '{missing[0]}'")
    return found


def table(title, columns, found, which):
    """Returns a table with a row for each case; the best of each figure is bold."""
    rows = ["| " + " | ".join([title, *columns]) + " |", "| --- |" + " --- |" * len(columns)]
    for case, tools in found.items():
        shown = {column: one[which] for column, one in tools.items() if one}
        best = [max(map(value, same)) for same in zip(*shown.values())]
        row = [case]
        for column in columns:
            if column in shown:
                row.append(" / ".join(f"**{text}**" if value(text) == most else text
                                      for text, most in zip(shown[column], best)))
            else:
                row.append("failed" if column in tools else "")
        rows.append("| " + " | ".join(row) + " |")
    return rows


def block(root):
    lines = [BEGIN, ""]
    for name, page in PAGES.items():
        found = lines_of(root, name, page)
        for which, title in enumerate(("quality", page.unit)):
            lines += [*table(f"{page.where}, {title}", page.tools, found, which), ""]
    return "\n".join([*lines, END])


def parts(text):
    """Splits README.md into the text before, between and after the two comments, which belong to
    the middle part."""
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise Unknown(f"{SUMMARY} must have '{BEGIN}' and '{END}' once each, in this order")
    end = text.index(END) + len(END)
    return text[:text.index(BEGIN)], text[text.index(BEGIN):end], text[end:]


def main(arguments):
    root = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).resolve().parents[1]
    summary = root / SUMMARY
    before, _, behind = parts(summary.read_text(encoding="utf-8"))
    summary.write_text(before + block(root) + behind, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
