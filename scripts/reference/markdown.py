# SPDX-License-Identifier: BSD-3-Clause
"""Helpers that format Markdown."""

import re
import textwrap

WIDTH = 104


def wrapped(text, indent=""):
    lines = textwrap.wrap(text, WIDTH, subsequent_indent=indent, break_long_words=False,
                          break_on_hyphens=False)
    # A line must not begin like a list item or a heading.
    return "\n".join([lines[0]] + [re.sub(r"^(\s*)([-+*#>]|\d+\.)(\s)", r"\1\\\2\3", line)
                                   for line in lines[1:]]) if lines else ""


def table(head, rows):
    lines = [head, ["---"] * len(head)] + rows
    return "\n".join("| " + " | ".join(str(cell).replace("|", "\\|") for cell in row) + " |"
                     for row in lines) + "\n"


def names_cell(names):
    return ", ".join(f"`{name}`" for name in dict.fromkeys(names))
