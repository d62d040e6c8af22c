#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the layers of src: a folder includes only folders that stand before it in FLOORS, and only
the topmost folders include the public headers.
usage: check_floors.py <folder> [--self-test]"""

import pathlib
import re
import sys
import tempfile

import checks

FLOORS = ("base sphere method comm predicates tree geometry formats surfaces implicit domain shape spacing "
          "initial partition neighbors dynamics population delaunay quality settings level "
          "results check transfer estimate sizing run checkpoint placement mesh cgrid voronoi particles io picture api geo tool").split()
PUBLIC_HEADER_FOR = "api", "geo", "tool"
OURS = re.compile(r'^\s*#\s*include\s*"((?:\w+/)+\w+\.hpp)"', re.M)
PUBLIC = re.compile(r'^\s*#\s*include\s*["<](pnpbs/\w+\.h)[">]', re.M)


def faults(root):
    """What is wrong, a line each."""
    source = root / "src"
    files = sorted([*source.rglob("*.cpp"), *source.rglob("*.hpp")])
    if not files:
        yield f"{source}: no sources"
    for path in files:
        name = path.relative_to(source)
        text = path.read_text()
        floor = name.parts[0]
        if floor not in FLOORS:
            yield f"{name}: the folder {floor} has no place in FLOORS"
            continue
        yield from wrong_includes(name, floor, text)


def wrong_includes(name, floor, text):
    if floor not in PUBLIC_HEADER_FOR:
        for header in PUBLIC.findall(text):
            yield f"{name}: includes the public header {header}"
    for included in OURS.findall(text):
        folder = included.split("/")[0]
        if folder not in FLOORS:
            yield f"{name}: includes {included}, from no folder in FLOORS"
        elif FLOORS.index(folder) > FLOORS.index(floor):
            yield f"{name}: includes {included}, which stands above it"


def self_test():
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        files = {
            "base/types.hpp": "#include <sys/stat.h>\n#include <vector>\n",
            "tree/tree.hpp": '#include "base/types.hpp"\n',
            "domain/plane/boundary.hpp": '#include "tree/tree.hpp"\n#include "domain/map.hpp"\n',
            "domain/map.hpp": '#include "level/level.hpp"\n',
            "base/nodes.hpp": '#include "pnpbs/pnpbs.h"\n',
            "api/handles.hpp": '#include <pnpbs/pnpbs.h>\n#include "base/types.hpp"\n',
            "level/level.hpp": "",
            "cellar/wine.hpp": "",
        }
        for file, text in files.items():
            path = root / "src" / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        found = list(faults(root))
        statuses = main([name]), main([f"{name}/src"])
        for file in found:
            (root / "src" / file.split(":")[0]).unlink()
        statuses += main([name]),
    expected = ["base/nodes.hpp: includes the public header pnpbs/pnpbs.h",
                "cellar/wine.hpp: the folder cellar has no place in FLOORS",
                "domain/map.hpp: includes level/level.hpp, which stands above it"]
    if found != expected:
        sys.exit(f"the check is wrong: it finds {found}")
    if statuses != (1, 1, 0):
        sys.exit(f"the check ends with {statuses} where there are faults, no files, and no faults")


def main(arguments):
    return checks.main(arguments, faults, self_test)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
