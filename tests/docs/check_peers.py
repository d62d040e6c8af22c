#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of all cases against every other tool in docs/comparison_summary.md are those that the pages of the
comparisons give: scripts/peer_tables.py writes them.
usage: check_peers.py <folder> [--self-test]"""

import pathlib
import sys
import tempfile

import checks

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import peer_tables


def faults(root):
    """What is wrong, a line each."""
    try:
        wanted = peer_tables.block(root).splitlines()
        written = peer_tables.parts((root / peer_tables.SUMMARY).read_text(encoding="utf-8"))[1].splitlines()
    except peer_tables.Unknown as unknown:
        yield str(unknown)
        return
    for one, other in zip(wanted, written):
        if one != other:
            yield f"{peer_tables.SUMMARY} has\n  {other}\nwhere the pages give\n  {one}"
    if len(wanted) != len(written):
        yield f"{peer_tables.SUMMARY} has {len(written)} lines of peer tables, where the pages give {len(wanted)}"


def page(path, titles, rows):
    """Of a comparison; the columns that do not matter here are left out."""
    head = f"| tool | {titles} |\n| --- |" + " --- |" * len(titles.split(" | ")) + "\n"
    return "# Comparison\n\n| tool | version |\n| --- | --- |\n| gmsh, frontal | 1 |\n\n" + "".join(
        f"## {case}, d for 70 000 nodes\n\n{head}{rows}\n" for case in peer_tables.PAGES[path].cases)


def self_test():
    plane_path, space_path = peer_tables.PAGES
    plane = page(plane_path, f"nodes/s | {peer_tables.QUALITY} | least where wide",
                 "| PNPBS, default | 111 556 | 0.9860 / 0.9114 / 0.1 | 0.8056 |\n"
                 "| PNPBS, best | 60 200 * | 0.9860 / 0.9156 / 0.9 | 0.8700 |\n"
                 "| gmsh, Delaunay | 300 000 | 0.9999 / 0.9999 / 0.9 | 0.9000 |\n"
                 "| JIGSAW, default | 5 106 | 0.9774 / 0.9060 / 0.1 | - |\n"
                 "| gmsh, frontal | 9 940 | 0.9664 / 0.7958 / 0.5 | 0.8800 |\n"
                 "| Triangle, by triangle | failed: not done after 9 s |  |  |\n")
    space = page(space_path, f"nodes per CPU s | {peer_tables.QUALITY}",
                 "| PNPBS, default | 26 554 | 0.700 / 0.785 / 0.542 |\n"
                 "| gmsh, Delaunay | 7 166 | 0.799 / 0.364 / 0.279 |\n")
    expected = {  # by the first words of a row
        "| square, 1:10 | **0.9860** / 0.9114 / 0.8056 | **0.9860** / **0.9156** / 0.8700 "
        "| 0.9664 / 0.7958 / **0.8800** |  | failed | 0.9774 / 0.9060 / - |",
        "| square, 1:10 | **112** | 60 | 9.9 |  | failed | 5.1 |",
        "| Eros, even | 0.700 / **0.785** / **0.542** | **0.799** / 0.364 / 0.279 |  |  |  |  |",
        "| Eros, even | **27** | 7.2 |  |  |  |  |"}
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        (root / "docs").mkdir()
        summary, pages = root / peer_tables.SUMMARY, [root / path for path in peer_tables.PAGES]
        summary.write_text(f"before\n{peer_tables.BEGIN}\n{peer_tables.END}\nbehind\n")
        for path, text in zip(pages, (plane, space)):
            path.write_text(text)
        empty = main([name])
        peer_tables.main([name])
        written = summary.read_text()
        rows = set(written.splitlines())
        if not expected <= rows or not written.startswith("before\n<") or not written.endswith(">\nbehind\n"):
            sys.exit(f"the tables are wrong: {expected - rows} is not in {written}")
        if (empty, main([name])) != (1, 0):
            sys.exit("the check passes before the tables are written, or fails after that")
        for path, old, new, told in (
                (summary, "9.9 |", "9.8 |", f"{peer_tables.SUMMARY} has\n  | square, even | **112** | 60 | 9.8 |"),
                (summary, peer_tables.END, "", f"{peer_tables.SUMMARY} must have"),
                (pages[0], "0.9114", "0.9314", "give\n  | square, even | **0.9860** / **0.9314** / 0.8056"),
                (pages[0], "Annulus", "Torus", "docs/comparison.md: no name for the case 'Torus, uniform'"),
                (pages[1], "PNPBS, default", "PNPBS", "docs/comparison_volumes.md: no row of PNPBS, default"),
                (pages[1], "Eros", "Kleopatra", "comparison_volumes.md does not have the case 'Eros, even'"),
                (pages[1], "## ", "### ", "docs/comparison_volumes.md has no table of a case")):
            text = path.read_text()
            path.write_text(text.replace(old, new))
            found = "\n".join(faults(root))
            path.write_text(text)
            if told not in found:
                sys.exit(f"the check is wrong: with {new} for {old} it finds '{found}', not '{told}'")


def main(arguments):
    return checks.main(arguments, faults, self_test)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
