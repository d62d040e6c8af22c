# SPDX-License-Identifier: BSD-3-Clause
"""What a page of the documentation is made of: fenced blocks, and prose."""

import re
from typing import NamedTuple


class Block(NamedTuple):
    language: str
    file: str  # the name behind the language, or ""
    text: str
    line: int  # where it begins
    follows: bool  # nothing but blank lines between it and the block before


def blocks(text):
    """The fenced blocks of a page, in order."""
    found, opened, between = [], None, False
    for number, line in enumerate(text.splitlines(), 1):
        if opened is not None:
            if line == "```":
                found.append(Block(*opened, "".join(lines), start, bool(found) and not between))
                opened, between = None, False
            else:
                lines.append(line + "\n")
            continue
        fence = re.fullmatch(r"```(\w*)(?: (\S+))?", line)
        if fence:
            opened, lines, start = (fence[1], fence[2] or ""), [], number
        elif line.strip():
            between = True
    if opened is not None:
        raise ValueError(f"the block of line {start} has no end")
    return found


def prose(text):
    """The page without its fenced blocks and its code in backquotes."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.S | re.M)
    return re.sub(r"`[^`\n]*`", "", text)
