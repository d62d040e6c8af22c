# SPDX-License-Identifier: BSD-3-Clause
"""Extracts the comments of the C headers as plain data: sections, and in each the entries, which
are a comment and the declarations below it."""

import pathlib
import re
import sys
from typing import NamedTuple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "linkage"))
import c_header


class Parameter(NamedTuple):
    names: tuple
    direction: str  # "in", "out" or ""
    text: str


class Comment(NamedTuple):
    blocks: tuple  # of ("text", paragraph) and ("item", (word, text))
    errors: str  # the sentence about errors, or ""
    parameters: tuple
    reach: str  # "Collective", "Local" or ""


class Entry(NamedTuple):
    comment: Comment
    functions: dict  # {name: c_header.Function}; empty for types and constants
    declaration: str  # the lines below the comment, unchanged


class Section(NamedTuple):
    title: str
    entries: tuple


PARAMETER = re.compile(r"@param(?:\[(in|out)\])?\s+(\w+(?:,\s?\w+)*)\s+")


def bare_lines(comment):
    """Returns the lines of a comment without its stars."""
    body = re.sub(r"^/\*\*?|\*/$", "", comment.strip())
    return [re.sub(r"^\s*\* ?", "", line).rstrip() for line in body.splitlines()]


def blocks_of(lines):
    """Returns paragraphs, and lists where lines are indented. Deeper lines continue the item above.
    """
    lines = [line[1:] if line.startswith(" ") else line for line in lines]
    depths = [len(line) - len(line.lstrip()) for line in lines if line.startswith("  ")]
    blocks = []
    for line in lines:
        depth = len(line) - len(line.lstrip())
        before = blocks[-1] if blocks else ("", "")
        if not line.strip():
            blocks.append(("", ""))
        elif depth >= 2 and depth == min(depths):
            word, _, text = line.strip().partition(" ")
            blocks.append(("item", (word, text.strip())))
        elif depth >= 2 and before[0] == "item":
            blocks[-1] = ("item", (before[1][0], before[1][1] + " " + line.strip()))
        elif before[0] == "text":
            blocks[-1] = ("text", before[1] + " " + line.strip())
        else:
            blocks.append(("text", line.strip()))
    return tuple(block for block in blocks if block[0])


def comment_of(text):
    """Splits a comment into description, errors and parameters."""
    lines = bare_lines(text)
    joined = "\n".join(lines)
    first = joined.find("@param")
    description = joined if first < 0 else joined[:first]
    parameters = []
    pieces = [] if first < 0 else re.split(r"(?=@param)", joined[first:])
    for piece in filter(None, pieces):
        match = PARAMETER.match(piece)
        if not match:
            raise ValueError(f"cannot read '{piece}'")
        parameters.append(Parameter(tuple(re.split(r",\s?", match[2])), match[1] or "",
                                    " ".join(piece[match.end():].split())))
    head, errors_word, errors = description.partition("Errors")
    reach = set(re.findall(r"\b(Collective|Local)\b", description))
    if len(reach) > 1:
        raise ValueError(f"both collective and local: {text}")
    # A sentence without further content is shown by the badge.
    head = re.sub(r"(^|(?<=[.)]))\s*(Collective|Local)\.(?=\s|$)", "", head)
    return Comment(blocks_of(head.splitlines()),
                   " ".join((errors_word + errors).split()), tuple(parameters),
                   reach.pop() if reach else "")


def entries_of(text):
    """Returns the documented declarations of a part of the header."""
    entries = []
    pieces = re.split(r"(?=^/\*\*)", text, flags=re.M)
    for piece in pieces:
        if not piece.startswith("/**"):
            continue
        comment, _, rest = piece.partition("*/")
        declaration = rest.strip()
        found = c_header.functions(declaration)
        found.update(inline_functions(declaration))
        entries.append(Entry(comment_of(comment + "*/"), found, declaration))
    return tuple(entries)


def inline_functions(text):
    """Returns {name: Function} of the inline functions in the header."""
    found = {}
    for match in re.finditer(r"^static inline (\w+) (pnpbs_\w+)\(([^)]*)\) \{", text, re.M):
        found[match[2]] = c_header.Function(match[1], c_header.arguments_of(match[3]))
    return found


def sections(text):
    """Returns the sections of a header, which are separated by lines of dashes."""
    pieces = re.split(r"^/\* -{10,} (.*?) -+ \*/$", text, flags=re.M)
    return tuple(Section(title, entries_of(body))
                 for title, body in zip(pieces[1::2], pieces[2::2]))


def opening(text):
    """Returns {title: ((word, text), ...)} of the lists at the beginning of the header."""
    comment = re.match(r"/\*.*?\*/", text, re.S)[0]
    lists, title = {}, None
    for line in bare_lines(comment):
        heading = re.fullmatch(r"(Glossary|Conventions of every function)", line)
        item = re.fullmatch(r"  (\S(?:\S| (?! ))*)  +(\S.*)", line)
        if heading:
            title = heading[1]
            lists[title] = []
        elif not line.strip():
            title = None
        elif title and item:
            lists[title].append((item[1], item[2]))
        elif title and line.startswith("   "):
            word, before = lists[title][-1]
            lists[title][-1] = (word, before + " " + line.strip())
    return lists
