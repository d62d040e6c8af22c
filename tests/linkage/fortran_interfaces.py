# SPDX-License-Identifier: BSD-3-Clause
"""Parser of pnpbs_c.f90: interface bodies and constants, as plain data."""

import functools
import re
from typing import NamedTuple


class Argument(NamedTuple):
    name: str
    type: str  # such as "integer(c_int64_t)"
    by_value: bool
    intent: str  # "in", "out", "inout" or ""
    array: str  # "(*)", "(2, n)" or ""
    note: str  # the C type in the comment after it, or ""


class Function(NamedTuple):
    label: str  # the name in C, or "" in abstract interfaces
    result: str
    arguments: tuple
    imports: bool  # whether it has "import" and "implicit none"


def joined_lines(text):
    """Returns the lines with continuations joined. Only comments after declarations are kept."""
    text = re.sub(r"&[ \t]*\n[ \t]*&?", " ", text)
    return [line.strip() for line in text.splitlines() if not line.lstrip().startswith("!")]


def entities_of(text):
    """Returns [(name, array)] of "a, b(*), c(2, n)"."""
    return [(name, array or "") for name, array in
            re.findall(r"(\w+)\s*(\([^)]*\))?\s*(?:,|$)", text)]


def declarations_of(line):
    """Returns the Arguments that a line declares, by name."""
    declaration, _, note = line.partition("!")
    left, _, right = declaration.partition("::")
    attributes = [part.strip() for part in re.split(r",(?![^(]*\))", left)]
    intent = [re.sub(r"\s|intent|[()]", "", part) for part in attributes
              if part.startswith("intent")]
    known = {"value"} | {part for part in attributes[1:] if part.startswith("intent")}
    if set(attributes[1:]) - known:
        raise ValueError(f"an attribute that C knows nothing of: '{line}'")
    return {name: Argument(name, attributes[0].replace(" ", ""), "value" in attributes,
                           intent[0] if intent else "", array, note.strip())
            for name, array in entities_of(right.strip())}


HEAD = re.compile(r'function\s+(\w+)\s*\(([^)]*)\)\s*bind\(C(?:,\s*name="(\w+)")?\)$')


@functools.lru_cache(maxsize=2)
def functions(text):
    """Returns {Fortran name: Function} of all interface bodies."""
    found, name = {}, None
    for line in joined_lines(text):
        head = HEAD.fullmatch(line)
        if head:
            name, names, label = head[1], head[2], head[3] or ""
            declared, statements = {}, set()
        elif line.startswith("function"):
            raise ValueError(f"cannot read '{line}'")
        elif name and line == "end function":
            order = [one.strip() for one in names.split(",") if one.strip()]
            if set(declared) != set(order) | {name}:
                raise ValueError(f"{name}: declared {sorted(declared)}, not {order} and the result")
            found[name] = Function(label, declared[name].type,
                                   tuple(declared[one] for one in order),
                                   statements == {"import", "implicit none"})
            name = None
        elif name and "::" in line:
            declared.update(declarations_of(line))
        elif name and line:
            statements.add(line)
    return found


@functools.lru_cache(maxsize=2)
def constants(text):
    """Returns {name: integer} of all parameters."""
    return {name: int(value) for name, value in
            re.findall(r"parameter :: (PNPBS_\w+) = (-?\d+)", text)}
