#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""README.md's tables of all cases against every other tool are those that the pages of the comparisons
give: scripts/peer_tables.py writes them.
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
        written = peer_tables.parts((root / "README.md").read_text(encoding="utf-8"))[1].splitlines()
    except peer_tables.Unknown as unknown:
        yield str(unknown)
        return
    for one, other in zip(wanted, written):
        if one != other:
            yield f"README.md has\n  {other}\nwhere the pages give\n  {one}"
    if len(wanted) != len(written):
        yield f"README.md has {len(written)} lines of peer tables, where the pages give {len(wanted)}"


def page(speed, cases, rows):
    """Of a comparison; the columns that do not matter here are left out."""
    head = f"| tool | {speed} | {peer_tables.QUALITY} |\n| --- | --- | --- |\n"
    return "# Comparison\n\n| tool | version |\n| --- | --- |\n| gmsh, frontal | 1 |\n\n" + "".join(
        f"## {case}, d for 70 000 nodes\n\n{head}{rows}\n" for case in cases)


def self_test():
    plane = page("nodes/s", list(peer_tables.CASES)[:6],
                 "| PNPBS, default | 111 556 | 0.9860 / 0.9114 / 0.8 |\n"
                 "| PNPBS, best | 200 000 | 0.9999 / 0.9999 / 0.9 |\n"
                 "| gmsh, Delaunay | 300 000 | 0.9 / 0.9 / 0.9 |\n"
                 "| gmsh, frontal | 9 940 | 0.9664 / 0.7958 / 0.5 |\n"
                 "| Triangle, by triangle | failed: not done after 9 s |  |\n")
    space = page("nodes per CPU s", list(peer_tables.CASES)[6:],
                 "| PNPBS, default | 26 554 | 0.7 / 0.785 / 0.542 |\n"
                 "| gmsh, Delaunay | 7 166 | 0.799 / 0.364 / 0.279 |\n")
    expected = {  # by the first words of a row
        "| square, 1:10 | **0.986 (0.91)** | 0.966 (0.80) |  |  | failed |  |  |  |",
        "| square, 1:10 | **112** | 9.9 |  |  | failed |  |  |  |",
        "| Eros, even | 0.700 (0.79) | **0.799 (0.36)** |  |  |  |  |  |  |",
        "| Eros, even | **27** | 7.2 |  |  |  |  |  |  |"}
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        (root / "docs").mkdir()
        readme, pages = root / "README.md", [root / path for path in peer_tables.PAGES]
        readme.write_text(f"before\n{peer_tables.BEGIN}\n{peer_tables.END}\nbehind\n")
        for path, text in zip(pages, (plane, space)):
            path.write_text(text)
        empty = main([name])
        peer_tables.main([name])
        written = readme.read_text()
        rows = set(written.splitlines())
        if not expected <= rows or not written.startswith("before\n<") or not written.endswith(">\nbehind\n"):
            sys.exit(f"the tables are wrong: {expected - rows} is not in {written}")
        if (empty, main([name])) != (1, 0):
            sys.exit("the check passes before the tables are written, or fails after that")
        for path, old, new, told in (
                (readme, "9.9 |", "9.8 |", "README.md has\n  | square, from a line | **112** | 9.8 |"),
                (readme, peer_tables.END, "", "README.md must have"),
                (pages[0], "0.9114", "0.9314", "where the pages give\n  | square, from a line | **0.986 (0.93)"),
                (pages[0], "Annulus", "Torus", "docs/comparison.md: no name for the case 'Torus, uniform'"),
                (pages[1], "PNPBS, default", "PNPBS", "docs/comparison_volumes.md: no row of PNPBS, default"),
                (pages[1], "Eros", "Kleopatra", "no page has the case 'Eros, even'"),
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
