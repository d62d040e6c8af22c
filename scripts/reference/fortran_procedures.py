# SPDX-License-Identifier: BSD-3-Clause
"""Extracts the procedures that users of pnpbs.f90 and pnpbs_geo.f90 can call, and the C functions
that each of them calls, as plain data."""

import re
from typing import NamedTuple


class Procedure(NamedTuple):
    call: str  # as a user writes it: "call placement%get_nodes(xy, ids, tags, spacing)"
    name: str  # in the module: "placement_get_nodes"
    declarations: tuple  # of its arguments except self, stat and errmsg
    notes: tuple  # of the comment above: (argument, text)
    calls: frozenset  # C functions


def joined(text):
    return re.sub(r"&[ \t]*\n[ \t]*", "", text)


def bindings(text):
    """Returns {module procedure: (type, the name it is called by)} of the public names of the
    types."""
    found = {}
    for match in re.finditer(r"^  type :: pnpbs_(?:geo_)?(\w+)$(.*?)^  end type$", text, re.S | re.M):
        for line in match[2].splitlines():
            plain = re.fullmatch(r"\s*procedure :: (\w+) => (\w+)", line)
            generic = re.fullmatch(r"\s*generic :: (\w+) => (.*)", line)
            names = [plain[2]] if plain else re.split(r",\s*", generic[2]) if generic else []
            for name in names:
                found[name.strip()] = (match[1], (plain or generic)[1])
    return found


def public_names(text):
    return {name for line in re.findall(r"^  public :: (.*)$", text, re.M)
            for name in re.split(r",\s*", line)}


def notes_of(comment):
    """Returns ((argument, text), ...) of the indented lines of a comment."""
    notes = []
    for line in comment:
        item = re.fullmatch(r"  (\w+(?:, \w+)*)  +(\S.*)", line)
        if item:
            notes.append((item[1], item[2]))
        elif notes and line.startswith("   "):
            notes[-1] = (notes[-1][0], notes[-1][1] + " " + line.strip())
    return tuple(notes)


def declarations_of(body, arguments):
    """Returns the declarations of arguments, except those that every procedure has."""
    found = []
    for line in body:
        left, colons, right = line.partition("::")
        names = re.findall(r"(\w+)(?:\([^)]*\))?(?:,|$)", right.replace(" ", ""))
        if colons and names and set(names) <= set(arguments):
            found.append(" ".join(line.split()))
    return tuple(found)


HEAD = re.compile(r"(subroutine|function) (\w+)\(([^)]*)\)(?: result\((\w+)\))?$")


def procedures(text, c_names):
    """Returns every procedure that a user can name, in the order of the module."""
    bound, public = bindings(joined(text)), public_names(joined(text))
    found, comment, name = [], [], None
    for line in (one.strip() for one in joined(text).splitlines()):
        head = HEAD.match(line)
        if line.startswith("!>"):
            comment.append(line[2:].removeprefix(" "))
        elif head:
            kind, name, result = head[1], head[2], head[4]
            given = [one.strip() for one in head[3].split(",") if one.strip()]
            body = []
        elif name and re.fullmatch(rf"end {kind}", line):
            if name in bound or name in public:
                found.append(procedure(kind, name, given, result, body, notes_of(comment),
                                       bound.get(name), c_names))
            name, comment = None, []
        elif name:
            body.append(line)
        elif line and not line.startswith("!"):
            comment = []
    return found


def procedure(kind, name, given, result, body, notes, binding, c_names):
    shown = [one for one in given if one not in ("self", "stat", "errmsg")]
    target = "%".join(binding) if binding else name
    left = "call " if kind == "subroutine" else f"{result} = "
    arguments = f"({', '.join(shown)})" if shown or kind == "function" else ""
    # The function is called directly, or passed to a procedure that calls it.
    called = {"pnpbs_" + one for one in re.findall(r"\bc_(\w+)\b", "\n".join(body))}
    return Procedure(left + target + arguments, name,
                     declarations_of(body, shown + ([result] if result else [])), notes,
                     frozenset(called & c_names))


def of_c_function(c_name, every):
    """Returns the procedures that correspond to a C function. A procedure with the same name as a C
    function corresponds to that one only, whatever else it calls."""
    def namesake(one):
        return one.name if one.name.startswith("pnpbs_") else "pnpbs_" + one.name
    return [one for one in every if c_name in one.calls
            and (namesake(one) == c_name or namesake(one) not in one.calls)]
