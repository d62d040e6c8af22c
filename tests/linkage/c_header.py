# SPDX-License-Identifier: BSD-3-Clause
"""Parser of the declarations of pnpbs.h: functions, callback types and constants, as plain data."""

import functools
import re
from typing import NamedTuple


class Argument(NamedTuple):
    name: str
    type: str  # as in C, with normalised blanks: "const double *"


class Function(NamedTuple):
    result: str
    arguments: tuple


def normalised(c_type):
    c_type = re.sub(r"\s*\*\s*", "*", " ".join(c_type.split()))
    return re.sub(r"(\*+)", r" \1", c_type).replace("* const", "*const").strip()


def arguments_of(text):
    if text.strip() == "void":
        return ()
    arguments = []
    for piece in text.split(","):
        match = re.fullmatch(r"\s*(.*?[\s*])(\w+)\s*", piece, re.S)
        if not match:
            raise ValueError(f"cannot read the argument '{piece}'")
        arguments.append(Argument(match[2], normalised(match[1])))
    return tuple(arguments)


def without_comments(text):
    return re.sub(r"/\*.*?\*/", " ", text, flags=re.S)


@functools.lru_cache(maxsize=2)
def functions(text):
    """Returns {name: Function} of all declarations marked PNPBS_API."""
    found = {}
    declarations = re.findall(r"^PNPBS_API\b(.*?);", without_comments(text), re.S | re.M)
    for declaration in declarations:
        match = re.fullmatch(r"\s*(.*?[\s*])(pnpbs_\w+)\s*\((.*)\)\s*", declaration, re.S)
        if not match:
            raise ValueError(f"cannot read the declaration '{declaration}'")
        found[match[2]] = Function(normalised(match[1]), arguments_of(match[3]))
    return found


@functools.lru_cache(maxsize=2)
def callbacks(text):
    """Returns {name: Function} of the types of callbacks."""
    found = {}
    for match in re.finditer(r"typedef\s+(\w+)\s*\(\*(pnpbs_\w+)\)\s*\((.*?)\)\s*;",
                             without_comments(text), re.S):
        found[match[2]] = Function(match[1], arguments_of(match[3]))
    return found


@functools.lru_cache(maxsize=2)
def constants(text):
    """Returns {name: integer} of the statuses, the roles of curves and the version."""
    text = without_comments(text)
    found = {name: int(value)
             for name, value in re.findall(r"X\(\s*(PNPBS_\w+),\s*(-?\d+)\s*,", text)}
    for name, value in re.findall(r"^#define\s+(PNPBS_\w+)\s+(-?\d+)\s*$", text, re.M):
        found[name] = int(value)
    return found
