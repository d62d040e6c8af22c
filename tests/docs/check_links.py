#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every relative link of every page leads to a file that exists and to a heading of it, and that the C++
files that pages name, as `level/level.hpp`, exist in src or from the root. Installed pages have no sources beside them.
usage: check_links.py <folder> [--self-test]"""

import contextlib
import io
import os
import pathlib
import re
import sys
import tempfile

from pages import prose

LINK = re.compile(r"\]\(([^()\s]+)\)")
NAMED_FILE = re.compile(r"`([\w-]+(?:/[\w.-]+)+\.[ch]pp)`")
ANY_LINK = re.compile(r"\]\([^)]*\)")


def anchors(text):
    """What a link to a part of a page may be: its headings as GitHub names them, and ids."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.S | re.M)
    found = set(re.findall(r'<a id="([^"]+)">', text))
    for heading in re.findall(r"^#+ +(.*)$", text, re.M):
        slug = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower())
        slug, number = slug.strip().replace(" ", "-"), 0
        while slug + (f"-{number}" if number else "") in found:
            number += 1
        found.add(slug + (f"-{number}" if number else ""))
    return found


def pages_below(root):
    """The pages of the repository: nothing in hidden folders or build folders."""
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(one for one in folders
                            if not one.startswith((".", "build", "out")))
        yield from (pathlib.Path(folder) / one for one in sorted(files) if one.endswith(".md"))


def broken(page, root):
    """(link, what is wrong) of a page."""
    text = page.read_text()
    for file in NAMED_FILE.findall(text) if (root / "src").is_dir() else ():
        if not (root / "src" / file).exists() and not (root / file).exists():
            yield file, "no such file in src"
    text = prose(text)
    for link in ANY_LINK.findall(text):
        if not LINK.fullmatch(link):
            yield link[2:-1], "not understood"
    for link in LINK.findall(text):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, part = link.partition("#")
        target = (page.parent / path) if path else page
        if not target.exists():
            yield link, "no such file"
        elif part and (target.is_dir() or part not in anchors(target.read_text())):
            yield link, "no such heading"


def all_broken(root):
    pages = list(pages_below(root))
    if not pages:
        return [f"{root}: no pages"]
    return [f"{page.relative_to(root)}: {link}: {what}"
            for page in pages for link, what in broken(page, root)]


def self_test():
    """Good links pass, bad ones do not."""
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        (root / "build").mkdir()
        (root / "build" / "left.md").write_text("[x](nowhere.md)\n")
        (root / "a.md").write_text("# One `thing`, and more\n## Two\n## Two\n"
                                   "[a](b.md) [b](#one-thing-and-more) [c](#two-1) [d](b.md#here)\n"
                                   "[e](https://example.org/x#y) `[f](none.md)`\n"
                                   "```c\n[g](none.md)\n# Four\n```\n")
        (root / "b.md").write_text('<a id="here"></a>\n')
        (root / "c.md").write_text("`x/z.hpp`\n")
        assert all_broken(root) == [], all_broken(root)
        (root / "src" / "x").mkdir(parents=True)
        (root / "src" / "x" / "y.hpp").write_text("")
        (root / "c.md").write_text("`x/y.hpp` and `src/x/y.hpp`\n")
        assert all_broken(root) == [], all_broken(root)
        (root / "c.md").write_text("`x/z.hpp`\n")
        assert all_broken(root) == ["c.md: x/z.hpp: no such file in src"], all_broken(root)
        (root / "c.md").unlink()
        assert main([name]) == 0 and main([f"{name}/build/none"]) == 1
        bad = ["b.md 'title'", "c.md", "#three", "b.md#there", "#two-2", "build#x", "#four"]
        (root / "bad.md").write_text("# Two\n" + "\n".join(f"[x]({link})" for link in bad))
        found = [line.split(": ")[1] for line in all_broken(root)]
        assert found == bad, found
        assert main([name]) == 1


def main(arguments):
    if "--self-test" in arguments:
        with contextlib.redirect_stdout(io.StringIO()):
            self_test()
    root = pathlib.Path(arguments[0])
    found = all_broken(root)
    print("\n".join(found) or f"all links of {len(list(pages_below(root)))} pages lead somewhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
