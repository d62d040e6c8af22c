#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The house stands from the ground up: a folder of src includes only what stands before it in
FLOORS; the public header is for the topmost folders alone. And no file and no function is too long
to be read; the table of options or statistics may be.
usage: check_floors.py <folder> [--self-test]"""

import pathlib
import re
import sys
import tempfile

import checks

FLOORS = ("base sphere method comm predicates tree geometry formats surfaces implicit domain shape spacing "
          "initial partition neighbors dynamics population delaunay quality settings level "
          "placement mesh cgrid voronoi particles io picture api geo tool").split()
PUBLIC_HEADER_FOR = "api", "geo", "tool"
MAX_LINES = 400
MAX_FUNCTION_LINES = 60
OURS = re.compile(r'^\s*#\s*include\s*"((?:\w+/)+\w+\.hpp)"', re.M)
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)
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
        if text.count("\n") > MAX_LINES:
            yield f"{name}: {text.count(chr(10))} lines, at most {MAX_LINES}"
        for function, lines in functions(text):
            if lines > MAX_FUNCTION_LINES and not function.endswith("_table"):
                yield f"{name}: {function} has {lines} lines, at most {MAX_FUNCTION_LINES}"


def functions(text):
    """Name and number of lines of the functions defined in a source file."""
    code = NO_CODE.sub(lambda found: "\n" * found[0].count("\n"), text)
    scopes, header_begin = [], 0  # of each open brace: the name of a function, or what it is else
    for at, sign in enumerate(code):
        if sign == "{":
            header = code[header_begin:at]
            inside = any(kind not in ("namespace", "class") for kind, _ in scopes)
            scopes.append((kind_of(header) if not inside else "block",
                           header_begin + len(header) - len(header.lstrip())))
        elif sign == "}" and scopes:
            kind, begin = scopes.pop()
            if kind not in ("namespace", "class", "block"):
                yield kind, code.count("\n", begin, at) + 1
        if sign in "{};":
            header_begin = at + 1


def kind_of(header):
    if "namespace" in header:
        return "namespace"
    called = re.search(r"([\w~:]+|operator\S+)\s*\(", re.sub(r"template\s*<[^{]*?>\n", "", header))
    if re.search(r"\b(class|struct|union|enum)\b", header.split("(")[0]) and not header.rstrip().endswith(")"):
        return "class"
    return called[1] if called else "block"


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
            "level/level.hpp": "// a line\n" * (MAX_LINES + 1),
            "cellar/wine.hpp": "",
            "quality/sweep.cpp": "namespace pnpbs {\n\nvoid sweep(int n) {\n" + "  ++n;\n" * 59 +
                                 "}\n\nvoid short_one() {\n}\n\n}\n",
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
                "domain/map.hpp: includes level/level.hpp, which stands above it",
                "level/level.hpp: 401 lines, at most 400",
                "quality/sweep.cpp: sweep has 61 lines, at most 60"]
    if found != expected:
        sys.exit(f"the check is wrong: it finds {found}")
    if statuses != (1, 1, 0):
        sys.exit(f"the check ends with {statuses} where there are faults, no files, and no faults")


def main(arguments):
    return checks.main(arguments, faults, self_test)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
