#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The map, docs/README.md, names every page of the documentation and every example.
usage: check_map.py <folder> [--self-test]"""

import contextlib
import io
import pathlib
import re
import sys
import tempfile

LANGUAGES = {"command": "the command", "c": "C", "cpp": "C++", "fortran": "Fortran", "julia": "Julia", "python": "Python"}


def missing(root):
    """What the map does not name, a line each."""
    text = (root / "docs/README.md").read_text()
    linked = set(re.findall(r"\]\(([^()\s#]+)", text))
    for page in sorted((root / "docs").rglob("*.md")):
        name = str(page.relative_to(root / "docs"))
        # The parts of the reference have a map of their own.
        if name != "README.md" and not re.match(r"reference/(?!README)", name) and name not in linked:
            yield f"docs/{name}"
    for language, title in LANGUAGES.items():
        table = re.search(rf"^\| \[?{re.escape(title)}(?!\w|\+)[^\n]*\n\| --- .*?(?=\n\n|\Z)", text,
                          re.M | re.S)
        for example in sorted((root / "examples" / language).glob("*/")):
            if not table or f"| [{example.name}](../examples/{language}/{example.name}" not in table[0]:
                yield f"examples/{language}/{example.name}"


def self_test():
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        for folder in ("docs/reference", "docs/guide", "examples/c/one", "examples/c/two",
                       "examples/julia/one", "examples/cpp/one"):
            (root / folder).mkdir(parents=True)
        for page in ("reference/README.md", "reference/domain.md", "guide/adapt.md", "method.md", "od.md"):
            (root / "docs" / page).touch()
        (root / "docs/README.md").write_text(
            "[a](method.md) [b](reference/README.md#c)\n\n| [C](x) | of a page |\n\n"
            "| [C](x) | |\n| --- | --- |\n| [one](../examples/c/one) | |\n\n| Julia | |\n| --- | --- |\n")
        found = list(missing(root))
        assert found == ["docs/guide/adapt.md", "docs/od.md", "examples/c/two", "examples/cpp/one",
                         "examples/julia/one"], found
        assert main([name]) == 1


def main(arguments):
    if "--self-test" in arguments:
        with contextlib.redirect_stdout(io.StringIO()):
            self_test()
    found = list(missing(pathlib.Path(arguments[0])))
    print("\n".join(f"docs/README.md does not name {one}" for one in found) or "all is named")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
